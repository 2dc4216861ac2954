//! Simulates a tightening with and without a physical effect: `cargo run --release --example 02_simulate`.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use snug_campaign::{Intersample, Quantity, Rig};
use snug_model::{Effect, Input, Model, ModelError};

/// Sampled at 2 kHz.
const INTERVAL_S: f64 = 5e-4;

fn main() -> Result<(), ModelError> {
    let rig = Rig {
        lever_arm_m: 0.33,
        known_inertia_kg_m2: 0.275,
    };
    // Torque rises to 30 Nm in 150 ms, then the tool shuts off; half a second.
    let torque_nm: Vec<f64> = (0..1000)
        .map(|i| if i < 300 { 0.1 * f64::from(i) } else { 0.0 })
        .collect();
    let input = Input::new(&torque_nm, INTERVAL_S, Intersample::Linear);

    for effects in [&[][..], &[Effect::CoulombFriction]] {
        let model = Model::new(rig, effects)?;
        // The catalogue's values, but for a hand of 2.1 kg, 104 kg/s and 2450 N/m.
        let mut values: Vec<f64> = model.parameters().iter().map(|p| p.value).collect();
        values[..3].copy_from_slice(&[2.1, 104.0, 2450.0]);

        // The angle, and by how much it changes with each free parameter, one column after the other.
        let (free, samples) = (model.free(), torque_nm.len());
        let mut angle_rad = vec![0.0; samples];
        let mut columns = vec![0.0; free.len() * samples];
        let output = Quantity::Displacement;
        model.sensitivities(&values, &free, &input, output, &mut angle_rad, &mut columns)?;

        let peak = (0..samples).max_by(|&a, &b| angle_rad[a].total_cmp(&angle_rad[b]));
        let peak = peak.expect("there are samples");
        let (peak_rad, time_s) = (angle_rad[peak], peak as f64 * INTERVAL_S);
        println!("{effects:?}: largest angle {peak_rad:.4} rad after {time_s:.3} s");
        for (column, index) in columns.chunks_exact(samples).zip(free) {
            let (parameter, value) = (&model.parameters()[index], values[index]);
            let change = column[peak] * value;
            println!("  {} = {value} {}", parameter.name, parameter.unit);
            println!(
                "    1 % more of it changes that by {:.2e} rad",
                change / 100.0
            );
        }
    }
    Ok(())
}
