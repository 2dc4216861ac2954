//! The base model's m, c, k: constraints and covariance included, beside the bare loops, on one core.

use crate::campaign::{Campaign, START, record};
use crate::measure::{Clock, race};
use crate::table::{Reference, alone, section, times_the};
use crate::{bare_lanes, bare_loop};
use snug_campaign::{Estimate, FitStatus, Quantity};
use snug_identify::{FitTask, IdentifySettings, identify, identify_all};
use std::hint::black_box;

/// Tightenings that every row fits.
pub const FITS: usize = 200;
/// What two fits of the same tightening may differ by, relative.
pub const SAME_OPTIMUM: f64 = 1e-6;

pub fn fill(_is_long: bool) {
    section(&format!(
        "Base model: m, c, k of one tightening, 3000 samples, one core; {FITS} tightenings"
    ));
    let all = Campaign::hiding(&[], FITS).cases();
    let cases = inside(&all);
    let records: Vec<_> = cases.iter().map(|case| record(case)).collect();
    let count = cases.len();
    for (quantity, name) in OUTPUTS {
        let settings = fitting(quantity);
        let [bare, ours] = race(
            Clock::Core,
            [
                (count, &mut || {
                    records.iter().for_each(|record| {
                        black_box(bare_loop::fit(record, START));
                    });
                }),
                (count, &mut || {
                    cases.iter().for_each(|case| {
                        black_box(fit(case, &settings));
                    });
                }),
            ],
        );
        let reference = Reference {
            name: "the bare scalar loop",
            times: &bare,
        };
        times_the(&reference, &ours, &format!("one fit of the {name}"));
        let [bare, ours] = race(
            Clock::Core,
            [
                (count, &mut || {
                    black_box(bare_lanes::fit_all(&records, START));
                }),
                (count, &mut || {
                    black_box(fit_all(&cases, &settings));
                }),
            ],
        );
        let reference = Reference {
            name: "the bare loop in lanes",
            times: &bare,
        };
        times_the(
            &reference,
            &ours,
            &format!("one of many fits of the {name}"),
        );
    }
    let worst = worst_difference(&cases);
    alone(
        &format!("{worst:.1e} (allowed {SAME_OPTIMUM:.0e})"),
        &format!(
            "largest relative difference to either bare loop's optimum of the displacement, {count} tightenings ({} on a constraint left out)",
            all.len() - count
        ),
    );
    assert!(worst < SAME_OPTIMUM, "the rows compare different work");
}

const OUTPUTS: [(Quantity, &str); 2] = [
    (Quantity::Displacement, "displacement"),
    (Quantity::Acceleration, "whitened acceleration"),
];

pub fn fitting(fitted_output: Quantity) -> IdentifySettings {
    IdentifySettings {
        fitted_output,
        ..IdentifySettings::default()
    }
}

/// A complete fit.
pub fn fit(case: &FitTask<'_>, settings: &IdentifySettings) -> Estimate {
    identify(&case.model, &case.input, &case.tightening, settings)
        .expect("the benchmark's own data can be fitted")
}

/// Complete fits of many tightenings, as a study does them on one core.
pub fn fit_all(cases: &[&FitTask<'_>], settings: &IdentifySettings) -> Vec<Estimate> {
    let tasks: Vec<FitTask<'_>> = (cases.iter())
        .map(|case| FitTask::new(&case.tightening, &case.input, &case.model, settings))
        .collect();
    let fitted = identify_all(&tasks).into_iter();
    fitted
        .map(|estimate| estimate.expect("the benchmark's own data can be fitted"))
        .collect()
}

/// The tightenings whose optimum of the displacement lies inside the constraints: no other program here knows them.
pub fn inside<'a>(cases: &'a [FitTask<'static>]) -> Vec<&'a FitTask<'static>> {
    let settings = fitting(Quantity::Displacement);
    let is_inside = |case: &&FitTask<'_>| fit(case, &settings).status == FitStatus::Converged;
    cases.iter().filter(is_inside).collect()
}

/// m, c, k.
pub fn values(estimate: &Estimate) -> [f64; 3] {
    std::array::from_fn(|index| estimate.parameters[index].value)
}

/// Largest difference of one parameter, relative to the second's value.
pub fn difference(found: &[f64], expected: &[f64]) -> f64 {
    let pairs = found.iter().zip(expected);
    pairs
        .map(|(found, expected)| ((found - expected) / expected).abs())
        .fold(0.0, f64::max)
}

fn worst_difference(cases: &[&FitTask<'_>]) -> f64 {
    let settings = fitting(Quantity::Displacement);
    let records: Vec<_> = cases.iter().map(|case| record(case)).collect();
    let in_lanes = bare_lanes::fit_all(&records, START);
    let mut worst = 0.0_f64;
    for ((case, record), lane) in cases.iter().zip(&records).zip(&in_lanes) {
        let ours = values(&fit(case, &settings));
        let bare = bare_loop::fit(record, START);
        worst = worst
            .max(difference(&ours, &bare))
            .max(difference(&ours, lane));
    }
    worst
}
