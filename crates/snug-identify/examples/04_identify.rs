//! Identifies mass, damping and stiffness from one tightening: `cargo run --release --example 04_identify`.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use snug_campaign::{Intersample, NoiseFloor, Quantity, Rig};
use snug_identify::FitTask;
use snug_model::{Input, Model};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rig = Rig {
        lever_arm_m: 0.33,
        known_inertia_kg_m2: 0.275,
    };
    let interval_s = 5e-4;
    let torque_nm: Vec<f64> = (0..1000)
        .map(|i| if i < 300 { 0.1 * f64::from(i) } else { 0.0 })
        .collect();
    let input = Input::new(&torque_nm, interval_s, Intersample::Linear);
    let model = Model::new(rig, &[])?;

    // In place of a measurement: 2.1 kg, 104 kg/s, 2450 N/m, and what a sensor adds, here a fast tone of 0.5 rad/s² (rms).
    let mut acceleration = vec![0.0; torque_nm.len()];
    model.output(
        &[2.1, 104.0, 2450.0],
        &input,
        Quantity::Acceleration,
        &mut acceleration,
    )?;
    for (i, value) in acceleration.iter_mut().enumerate() {
        *value += 0.5 * 2f64.sqrt() * (2.9 * i as f64).sin();
    }

    let measured = Quantity::Acceleration;
    let task = FitTask::from_arrays(rig, interval_s, torque_nm, measured, acceleration)?
        .with_noise(NoiseFloor::white(measured, 0.5));
    let estimate = task.identify()?;

    println!(
        "{:?} after {} iterations",
        estimate.status, estimate.iterations
    );
    for parameter in &estimate.parameters {
        let interval = match parameter.interval {
            Some(interval) => format!("[{:.2}, {:.2}]", interval.low, interval.high),
            None => "no interval".into(),
        };
        println!(
            "  {:<18} {:>8.2} {interval} {}",
            parameter.name, parameter.value, parameter.unit
        );
    }
    if let Some((one, other, correlation)) = &estimate.identifiability.strongest_correlation {
        println!("  most correlated: {one} and {other}, {correlation:.2}");
    }
    Ok(())
}
