//! Laws that a study writes itself: read, compiled, and simulated with derivatives.

use super::Target;
use crate::mutation::Mutation;
use snug_campaign::{Intersample, Quantity, Rig};
use snug_model::{CustomEffectSettings, CustomParameterSettings, Input};
use snug_study::Study;
use std::path::Path;

pub const TARGET: Target = Target {
    name: "expression",
    file: "input.txt",
    mutate: Mutation::bytes,
    attempt,
};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};

fn attempt(_: &Path, input: &[u8]) {
    let parameter = |name: &str| CustomParameterSettings {
        name: name.to_owned(),
        ..CustomParameterSettings::default()
    };
    let mut study = Study::default();
    study.model.custom = vec![CustomEffectSettings {
        name: "law".to_owned(),
        expression: String::from_utf8_lossy(input).into_owned(),
        parameters: ["p", "q"].map(parameter).into(),
        ..CustomEffectSettings::default()
    }];
    study.model.effects = vec!["law".to_owned()];
    if let Err(error) = study.check() {
        assert!(error.to_string().len() < 2000, "{error}");
        return;
    }
    let model = study.model.model(RIG).expect("the study was checked");
    let torque_nm = [0.0, 1.0, 5.0, 20.0, 5.0, 0.0];
    let input = Input::new(&torque_nm, 1e-4, Intersample::Linear);
    let values: Vec<f64> = model
        .parameters()
        .iter()
        .map(|parameter| parameter.value)
        .collect();
    let free: Vec<usize> = (0..values.len()).collect();
    let mut angle = [0.0; 6];
    let mut slopes = vec![0.0; 6 * values.len()];
    model
        .sensitivities(
            &values,
            &free,
            &input,
            Quantity::Displacement,
            &mut angle,
            &mut slopes,
        )
        .unwrap();
}
