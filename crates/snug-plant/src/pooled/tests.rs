//! The pooled fit over a dataset beside the pooled fit of one machine, on data that fit both.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::engine::Engine;
use crate::functions::question::{Held, Sharing, States};
use crate::rows::{Row, batch};
use crate::storage::dataset::{Commit, Dataset};
use crate::storage::partition::Partition;
use crate::storage::store::Store;
use snug_campaign::{NoiseFloor, Quantity, Rig, Tightening, TighteningId};
use snug_diagnose::fit_together;
use snug_identify::{FitTask, IdentifySettings};
use snug_model::{Effect, Input, Model};
use snug_preprocess::Prepared;
use snug_study::{Compared, Study, shared_parameters};
use std::borrow::Cow;
use std::collections::BTreeMap;

const EFFECTS: [Effect; 2] = [Effect::CubicStiffness, Effect::QuadraticDamping];
const SIZES: [f64; 2] = [2e6, 150.0];
const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const INTERVAL_S: f64 = 1e-3;
const SAMPLES: usize = 250;

fn study() -> Study {
    let mut study = Study::default();
    study.model.effects = EFFECTS.map(|effect| effect.name().to_owned()).to_vec();
    study
}

/// Tightening `number` of hands that differ, with a hundredth of the noise that it states.
fn tightening(number: usize) -> Tightening {
    let peak_nm = 20.0 + 0.5 * number as f64;
    let torque_nm: Vec<f64> = (0..SAMPLES)
        .map(|k| {
            if k < 60 {
                peak_nm * k as f64 / 60.0
            } else {
                0.0
            }
        })
        .collect();
    let input = Input::new(&torque_nm, INTERVAL_S, study().model.intersample());
    let hand = [
        2.0 + 0.05 * number as f64,
        90.0,
        2200.0 + 10.0 * number as f64,
    ];
    let model = Model::new(RIG, &EFFECTS).unwrap();
    let mut motion = model
        .simulate(&[&hand[..], &SIZES].concat(), &input)
        .unwrap();
    for (sample, value) in motion
        .acceleration_rad_per_s2
        .iter_mut()
        .flatten()
        .enumerate()
    {
        let place = (sample * 7919 + number * 104_729) as f64;
        *value += 0.003 * 1.4 * (place * 12.9898).sin();
    }
    let mut one = Tightening::from_torque(RIG, INTERVAL_S, torque_nm)
        .with_noise(NoiseFloor::white(Quantity::Acceleration, 0.3));
    one.motion = motion;
    one.onset = Some(0);
    one.id = TighteningId {
        file: "made_up.mat".to_owned(),
        number: number as u32 + 1,
    };
    one
}

async fn dataset(folder: &std::path::Path, all: &[Tightening]) -> Dataset {
    let store = Store::open(folder.to_str().unwrap()).unwrap();
    let data = Dataset::make(store, "tightenings", &Study::default())
        .await
        .unwrap();
    for (number, some) in all.chunks(7).enumerate() {
        let part = Partition::new("2026-03-01", &format!("T{number}")).unwrap();
        let row = |one: &Tightening| Row {
            source: format!("{number}-{}", one.id.number),
            station: None,
            time_of_day_s: None,
            prepared: Prepared {
                tightening: one.clone(),
                thesis_checks: None,
                zero_sample: None,
                data_quality_rejects: false,
            },
        };
        let rows: Vec<Row> = some.iter().map(row).collect();
        let rows = batch(&part, &rows).unwrap();
        let file = data
            .write(
                "tightenings",
                &part,
                &rows.schema(),
                std::slice::from_ref(&rows),
            )
            .await;
        let commit = Commit {
            files: vec![file.unwrap()],
            ..Commit::default()
        };
        data.publish(&part, &commit).await.unwrap();
    }
    data
}

/// The sizes that one machine finds, everything in memory.
fn of_one_machine(all: &[Tightening]) -> Vec<f64> {
    let base = Study::default();
    let settings = IdentifySettings {
        fitted_output: Quantity::Acceleration,
        constraints: base.identify.constraints.clone(),
        ..IdentifySettings::default()
    };
    let of_one = |one: &Tightening| {
        let input = Input::new(&one.torque_nm, INTERVAL_S, base.model.intersample());
        FitTask {
            input: Cow::Owned(input),
            model: Cow::Owned(base.model.model(RIG).unwrap()),
            settings: Cow::Owned(settings.clone()),
            tightening: Cow::Owned(one.clone()),
        }
    };
    let tasks: Vec<FitTask<'_>> = all.iter().map(of_one).collect();
    let found = fit_together(&tasks, &EFFECTS).unwrap();
    assert!(found.converged);
    found.shared.into_iter().map(|(_, value)| value).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn sizes_of_all_rows_are_those_of_one_machine() {
    let all: Vec<Tightening> = (0..40).map(tightening).collect();
    let folder = tempfile::tempdir().unwrap();
    let data = dataset(folder.path(), &all).await;
    let session = Engine::Embedded.session(&[&data.store]).await.unwrap();
    let (study, parts) = (study(), data.partitions().await.unwrap());
    let text = study.to_ron().unwrap();
    let pass = Pass {
        session: &session,
        data: &data,
        study: &text,
        parts: &parts,
        given_up_after: std::time::Duration::from_secs(60),
        rows_per_job: 20,
    };
    let first = Prepared {
        tightening: all[0].clone(),
        thesis_checks: None,
        zero_sample: None,
        data_quality_rejects: false,
    };
    let shared = shared_parameters(&study, &first).unwrap();
    let bounds: Vec<(f64, f64)> = shared
        .iter()
        .map(|one| (one.minimum, one.maximum))
        .collect();
    let start = Held {
        compared: Compared {
            quantity: Quantity::Acceleration,
            is_over_noise: true,
        },
        states: States::default(),
        sharing: Sharing {
            factor: None,
            differs: vec![false; shared.len()],
        },
        all: shared.iter().map(|one| one.start).collect(),
        groups: BTreeMap::new(),
    };
    let found = pooled_over_all(&pass, &start, &bounds, &|_, _| ())
        .await
        .unwrap();
    assert!(found.converged && found.totals.members == 40.0, "{found:?}");
    for (found, expected) in found.held.all.iter().zip(of_one_machine(&all)) {
        let apart = (found / expected - 1.0).abs();
        assert!(apart < 1e-9, "{found} {expected}: {apart:.1e}");
    }
}
