//! The engine's speed beside the yardstick, one table, ratios first: `cargo xtask bench`.
#![allow(clippy::print_stdout, reason = "a benchmark prints its table")]

mod bare_loop;
mod problem;
mod table;

use problem::Problem;
use snug_campaign::Quantity;
use snug_identify::{IdentifySettings, identify};
use snug_model::{Effect, Input, Law, Model, ModelSettings, THESIS_START};
use std::hint::black_box;
use table::Table;

/// Fits per measurement; the same tightenings for every row.
const FITS: usize = 100;

fn main() {
    let filter = std::env::args()
        .skip(1)
        .find(|argument| !argument.starts_with("--"));
    let problems: Vec<Problem> = (0..FITS).map(Problem::number).collect();
    let mut table = Table::new(filter);
    let bare = table.measure("bare loop: displacement, no checks", FITS, || {
        for problem in &problems {
            black_box(problem.bare_fit());
        }
    });
    table.yardstick(bare);
    let displacement = settings(Quantity::Displacement);
    let base = ModelSettings::default();
    table.measure("base model, displacement", FITS, || {
        for problem in &problems {
            black_box(fit(problem, &base, &displacement));
        }
    });
    let acceleration = settings(Quantity::Acceleration);
    table.measure("base model, acceleration", FITS, || {
        for problem in &problems {
            black_box(fit(problem, &base, &acceleration));
        }
    });
    let few = &problems[..FITS / 25];
    for effect in Effect::ALL {
        let with = ModelSettings {
            effects: vec![effect.name().to_owned()],
            ..ModelSettings::default()
        };
        let name = format!("with {}, acceleration", effect.description().name);
        table.measure(&name, few.len(), || {
            for problem in few {
                black_box(fit(problem, &with, &acceleration));
            }
        });
    }
    assert_same_optimum(&problems);
    println!("{table}");
}

fn settings(fitted_output: Quantity) -> IdentifySettings {
    IdentifySettings {
        fitted_output,
        ..IdentifySettings::default()
    }
}

/// A complete fit, constraints and covariance included.
fn fit(problem: &Problem, model: &ModelSettings, settings: &IdentifySettings) -> Vec<f64> {
    let tightening = &problem.tightening;
    let model: Model = model
        .model(tightening.rig)
        .expect("the benchmark's own rig and effects");
    let input = Input::new(
        &tightening.torque_nm,
        tightening.time_base.interval_s,
        snug_campaign::Intersample::Linear,
    );
    let estimate = identify(&model, &input, tightening, settings)
        .expect("the benchmark's own data can be fitted");
    estimate.parameters.iter().map(|p| p.value).collect()
}

/// Both fits of the displacement must end at the same optimum, or the table compares different work.
fn assert_same_optimum(problems: &[Problem]) {
    for problem in problems {
        let bare = problem.bare_fit();
        let snug = fit(
            problem,
            &ModelSettings::default(),
            &settings(Quantity::Displacement),
        );
        for (index, (a, b)) in bare.iter().zip(&snug).enumerate() {
            let error = (a - b).abs() / THESIS_START[index];
            assert!(error < 1e-6, "parameter {index}: {a} against {b}");
        }
    }
}
