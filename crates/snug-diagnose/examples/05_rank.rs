//! Ranks the effects that a model lacks: `cargo run --release --example 05_rank`.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use snug_campaign::{Intersample, NoiseFloor, Quantity, Rig, Tightening};
use snug_diagnose::{DiagnoseSettings, Goal, Question, Watch, examine};
use snug_identify::{FitTask, IdentifySettings};
use snug_model::{Effect, Input, Model, ModelError};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};

/// In place of a measurement: a hand whose spring stiffens with its way, k3 = 2e6 N/m³, under reproducible noise.
fn measure(number: usize) -> Result<(Tightening, Input), ModelError> {
    let (interval_s, peak_nm) = (1e-3, 20.0 + 5.0 * number as f64);
    let torque_nm: Vec<f64> = (0..300)
        .map(|i| {
            if i < 90 {
                peak_nm * f64::from(i) / 90.0
            } else {
                0.0
            }
        })
        .collect();
    let input = Input::new(&torque_nm, interval_s, Intersample::Linear);
    let truth = Model::new(RIG, &[Effect::CubicStiffness])?;
    let mut motion = truth.simulate(&[2.0 + 0.1 * number as f64, 90.0, 2200.0, 2e6], &input)?;
    for (i, value) in motion
        .acceleration_rad_per_s2
        .iter_mut()
        .flatten()
        .enumerate()
    {
        *value += 0.5 * ((12.9898 * (i + 1000 * number) as f64 + 3.0).sin() * 43758.5453 % 1.0);
    }
    let mut tightening = Tightening::from_torque(RIG, interval_s, torque_nm)
        .with_noise(NoiseFloor::white(Quantity::Acceleration, 0.29));
    tightening.motion = motion;
    tightening.onset = Some(0);
    Ok((tightening, input))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let measured = (0..8).map(measure).collect::<Result<Vec<_>, _>>()?;
    let (model, settings) = (Model::new(RIG, &[])?, IdentifySettings::default());
    let cases: Vec<FitTask> = (measured.iter())
        .map(|(tightening, input)| FitTask::new(tightening, input, &model, &settings))
        .collect();
    let question = Question::new(&cases, Goal::Diagnose);
    let tell = |stage: &str| println!("{stage} …");
    let answer = examine(&question, &DiagnoseSettings::default(), &Watch::new(&tell))?;

    println!("{}", answer.diagnosis.headline);
    for candidate in answer.diagnosis.ranking.iter().take(3) {
        let share = 100.0 * candidate.heldout_gain;
        println!("  {:<22} removes {share:.0} %", candidate.effect);
    }
    Ok(())
}
