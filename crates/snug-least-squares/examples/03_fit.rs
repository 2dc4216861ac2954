//! Fits a curve under bounds: `cargo run --release --example 03_fit`.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use snug_least_squares::{
    Constraints, DenseResidual, DifferenceResidual, ResidualNoise, Settings, SolveError, solve,
};

/// Time \[s\] and temperature above the room's \[K\] of something that cools, read with a standard deviation of 0.1 K.
const MEASURED: [(f64, f64); 6] = [
    (0.0, 20.1),
    (60.0, 14.7),
    (120.0, 10.9),
    (180.0, 8.0),
    (240.0, 5.8),
    (300.0, 4.1),
];

fn main() -> Result<(), SolveError> {
    // y = a exp(-b t) + c, as residuals in multiples of the noise; derivatives by differences from typical sizes.
    let residual = DifferenceResidual::new(MEASURED.len(), &[10.0, 0.01, 1.0], |p, residual| {
        for (residual, (time_s, measured)) in residual.iter_mut().zip(MEASURED) {
            *residual = (measured - p[0] * f64::exp(-p[1] * time_s) - p[2]) / 0.1;
        }
        Ok(())
    });
    let names = ["amplitude", "decay", "offset"];
    let mut bounds = Constraints::new(names.len());
    for (parameter, name) in names.into_iter().enumerate() {
        bounds.bound(parameter, 0.0, f64::INFINITY, name);
    }
    let start = [10.0, 0.01, 1.0];
    let fit = solve(
        &mut DenseResidual::new(residual),
        &start,
        &bounds,
        &Settings::default(),
    )?;

    println!("{:?}, ½‖r‖² = {:.3}", fit.status, fit.cost);
    let covariance = fit.covariance(ResidualNoise::Unit);
    for (parameter, name) in names.into_iter().enumerate() {
        let value = fit.values[parameter];
        match covariance.interval(parameter, value, 0.95) {
            Some((low, high)) => println!("  {name}: {value:.5} [{low:.5}, {high:.5}]"),
            None => println!("  {name}: {value:.5}, no interval: on its bound or not determined"),
        }
    }
    for active in &fit.active {
        println!(
            "  {} lies on its bound and presses on it by {:.3}",
            active.name, active.multiplier
        );
    }
    Ok(())
}
