//! The NIST StRD nonlinear sets from both starting points, to certified digits.

#![allow(clippy::print_stderr)]

mod certified;

use certified::dataset::{Dataset, read};
use snug_least_squares::{Constraints, DenseResidual, Fit, ResidualNoise, Settings, Status, solve};

/// Digits that agree: −log₁₀ of the relative error, at most the 11 that are certified.
fn digits(found: f64, certified: f64) -> f64 {
    let error = ((found - certified) / certified).abs();
    (-error.log10()).min(11.0)
}

fn worst(found: &[f64], certified: &[f64]) -> f64 {
    let pairs = found.iter().zip(certified);
    pairs.map(|(f, c)| digits(*f, *c)).fold(11.0, f64::min)
}

/// Digits of the residuals that survive the rounding of the observations, less one: Lanczos1 has residuals of 1e-13.
fn attainable_digits(dataset: &Dataset) -> f64 {
    let observations = &dataset.regression.observations;
    let largest = observations
        .iter()
        .map(|(_, y)| y.abs())
        .fold(0.0, f64::max);
    let residual = (dataset.sum_of_squares / observations.len() as f64).sqrt();
    -(f64::EPSILON * largest / residual).log10() - 1.0
}

fn fit(dataset: &Dataset, start: &[f64]) -> Fit {
    let mut problem = DenseResidual::new(dataset.regression.clone());
    let free = Constraints::new(start.len());
    solve(&mut problem, start, &free, &Settings::default()).expect("a well-posed problem")
}

#[test]
fn certified_digits_from_both_starts() {
    let Some(folder) = std::env::var_os("SNUG_DATA") else {
        eprintln!("skipped: SNUG_DATA is not set");
        return;
    };
    let folder = std::path::Path::new(&folder).join("nist-strd/nonlinear");
    let mut paths: Vec<_> = (std::fs::read_dir(folder).expect("the folder of the sets"))
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "dat"))
        .collect();
    paths.sort();
    assert!(!paths.is_empty());
    for dataset in paths.iter().map(|path| read(path)) {
        for (number, start) in dataset.starts.iter().enumerate() {
            let fit = fit(&dataset, start);
            let covariance = fit.covariance(ResidualNoise::Estimated);
            let errors: Vec<f64> = (covariance.standard_errors.iter())
                .map(|error| error.unwrap_or(f64::NAN))
                .collect();
            let [values, deviations, squares] = [
                worst(&fit.values, &dataset.certified),
                worst(&errors, &dataset.standard_deviations),
                digits(fit.sum_of_squares(), dataset.sum_of_squares),
            ];
            let what = format!(
                "{} start {}: {:?}, digits {values:.1} {deviations:.1} {squares:.1}, {:?}, condition {:.1e}",
                dataset.name,
                number + 1,
                fit.status,
                fit.work,
                fit.identifiability.condition
            );
            eprintln!("{what}");
            assert_eq!(fit.status, Status::Converged, "{what}");
            let attainable = attainable_digits(&dataset);
            assert!(values >= 8.0, "{what}");
            assert!(deviations >= attainable.min(8.0), "{what}");
            assert!(squares >= attainable.min(9.0), "{what}");
        }
    }
}
