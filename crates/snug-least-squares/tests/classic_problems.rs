//! Classic hard problems with published minima, and regressions like the hardest NIST ones with known parameters.

#![allow(clippy::unwrap_used)]
#![allow(clippy::print_stderr)]

#[allow(dead_code)]
mod certified;

use certified::dual::Dual;
use certified::models::{Model, model};
use certified::regression::Regression;
use snug_least_squares::{Constraints, DenseResidual, Fit, Settings, Status, solve};

fn fit(regression: &Regression, start: &[f64]) -> Fit {
    let mut problem = DenseResidual::new(regression.clone());
    let free = Constraints::new(start.len());
    solve(&mut problem, start, &free, &Settings::default()).expect("a well-posed problem")
}

/// Residuals that depend on their number only: y = 0, x = (number).
fn numbered(model: Model, parameter_count: usize, residual_count: usize) -> Regression {
    Regression {
        model,
        parameter_count,
        observations: (1..=residual_count)
            .map(|i| (vec![i as f64], 0.0))
            .collect(),
    }
}

fn measured(
    model: Model,
    parameter_count: usize,
    x: impl Fn(usize) -> f64,
    y: &[f64],
) -> Regression {
    let pairs = y.iter().enumerate();
    Regression {
        model,
        parameter_count,
        observations: pairs.map(|(i, y)| (vec![x(i)], *y)).collect(),
    }
}

#[track_caller]
fn assert_minimum(fit: &Fit, published: f64, what: &str) {
    eprintln!(
        "{what}: {:?} {:?} {:e}",
        fit.status,
        fit.work,
        fit.sum_of_squares()
    );
    let error = (fit.sum_of_squares() - published).abs();
    assert!(
        error <= 6e-6 * published,
        "{what}: {:?} {}",
        fit.status,
        fit.sum_of_squares()
    );
    assert!(fit.status.is_converged(), "{what}: {:?}", fit.status);
}

const MEYER: [f64; 16] = [
    34780.0, 28610.0, 23650.0, 19630.0, 16370.0, 13720.0, 11540.0, 9744.0, 8261.0, 7030.0, 6005.0,
    5147.0, 4427.0, 3820.0, 3307.0, 2872.0,
];

const OSBORNE: [f64; 33] = [
    0.844, 0.908, 0.932, 0.936, 0.925, 0.908, 0.881, 0.850, 0.818, 0.784, 0.751, 0.718, 0.685,
    0.658, 0.628, 0.603, 0.580, 0.558, 0.538, 0.522, 0.506, 0.490, 0.478, 0.467, 0.457, 0.448,
    0.438, 0.431, 0.424, 0.420, 0.414, 0.411, 0.406,
];

/// Moré, Garbow, Hillstrom, Testing unconstrained optimization software, ACM TOMS 7 (1981), problems 10, 17, 6, 16;
/// the sums of squares are those printed there. The second starts lie far outside.
#[test]
fn published_minima_are_reached() {
    let meyer = measured(
        model("MGH10").unwrap(),
        3,
        |i| 50.0 + 5.0 * i as f64,
        &MEYER,
    );
    for start in [[0.02, 4000.0, 250.0], [2.0, 4e5, 2.5e4]] {
        assert_minimum(&fit(&meyer, &start), 87.9458, "Meyer");
    }
    let osborne = measured(model("MGH17").unwrap(), 5, |i| 10.0 * i as f64, &OSBORNE);
    for start in [
        [0.5, 1.5, -1.0, 0.01, 0.02],
        [50.0, 150.0, -100.0, 1.0, 2.0],
    ] {
        assert_minimum(&fit(&osborne, &start), 5.46489e-5, "Osborne 1");
    }
    let jennrich_sampson =
        |b: &[Dual], x: &[f64]| 2.0 + 2.0 * x[0] - (x[0] * b[0]).exp() - (x[0] * b[1]).exp();
    // At its minimum both parameters are equal, J has rank 1, and the residual is large: only the cost is well defined.
    let start = [0.3, 0.4];
    let squares = fit(&numbered(jennrich_sampson, 2, 10), &start).sum_of_squares();
    assert!(
        (squares - 124.362).abs() < 5e-4,
        "Jennrich–Sampson: {squares}"
    );
    let brown_dennis = |b: &[Dual], x: &[f64]| {
        let t = x[0] / 5.0;
        (b[0] + t * b[1] - t.exp()).square() + (b[2] + t.sin() * b[3] - t.cos()).square()
    };
    let start = [25.0, 5.0, -5.0, -1.0];
    assert_minimum(
        &fit(&numbered(brown_dennis, 4, 20), &start),
        85822.2,
        "Brown–Dennis",
    );
}

/// Problems 3, 4, 1: two of them badly scaled by 1e6 and more; the residual vanishes at the printed solution.
#[test]
fn vanishing_residuals_are_reached() {
    type Case = (&'static str, Model, usize, &'static [f64], &'static [f64]);
    let cases: [Case; 3] = [
        (
            "Brown badly scaled",
            |b, x| match x[0] as usize {
                1 => b[0] - 1e6,
                2 => b[1] - 2e-6,
                _ => b[0] * b[1] - 2.0,
            },
            3,
            &[1.0, 1.0],
            &[1e6, 2e-6],
        ),
        (
            "Powell badly scaled",
            |b, x| match x[0] as usize {
                1 => 1e4 * b[0] * b[1] - 1.0,
                _ => (-b[0]).exp() + (-b[1]).exp() - 1.0001,
            },
            2,
            &[0.0, 1.0],
            &[1.098159e-5, 9.106146],
        ),
        (
            "Rosenbrock",
            |b, x| match x[0] as usize {
                1 => 10.0 * (b[1] - b[0].square()),
                _ => 1.0 - b[0],
            },
            2,
            &[-1.2, 1.0],
            &[1.0, 1.0],
        ),
    ];
    for (name, model, count, start, solution) in cases {
        let fit = fit(&numbered(model, start.len(), count), start);
        eprintln!("{name}: {:?} {:?} {:?}", fit.status, fit.values, fit.work);
        for (found, published) in fit.values.iter().zip(solution) {
            assert!(
                (found / published - 1.0).abs() < 1e-6,
                "{name}: {:?} {:?}",
                fit.status,
                fit.values
            );
        }
        assert!(fit.status.is_converged(), "{name}: {:?}", fit.status);
    }
}

/// Regression functions of NIST's, observed at made-up points without noise: the parameters themselves are the truth.
/// The starts are as far away as NIST's.
#[test]
fn far_starts_recover_the_parameters() {
    type Case = (
        &'static str,
        &'static [f64],
        fn(usize) -> f64,
        usize,
        &'static [&'static [f64]],
    );
    let cases: [Case; 8] = [
        (
            "Bennett5",
            &[-2500.0, 46.0, 0.93],
            |i| 7.4 + 0.15 * i as f64,
            154,
            &[&[-2000.0, 50.0, 0.8], &[-1500.0, 45.0, 0.85]],
        ),
        (
            "BoxBOD",
            &[210.0, 0.55],
            |i| 1.0 + 1.5 * i as f64,
            6,
            &[&[1.0, 1.0], &[100.0, 0.75]],
        ),
        (
            "Lanczos1",
            &[0.1, 1.0, 0.9, 3.0, 1.6, 5.0],
            |i| 0.05 * i as f64,
            24,
            &[
                &[1.2, 0.3, 5.6, 5.5, 6.5, 7.6],
                &[0.5, 0.7, 3.6, 4.2, 4.0, 6.3],
            ],
        ),
        (
            "Hahn1",
            &[1.08, -0.123, 4.09e-3, -1.43e-6, -5.76e-3, 2.41e-4, -1.23e-7],
            |i| 14.0 + 3.5 * i as f64,
            236,
            &[
                &[10.0, -1.0, 0.05, -1e-5, -0.05, 0.001, -1e-6],
                &[1.0, -0.1, 0.005, -1e-6, -0.005, 1e-4, -1e-7],
            ],
        ),
        (
            "ENSO",
            &[10.5, 3.08, 0.53, 44.3, -1.62, 0.53, 26.9, 0.21, 1.5],
            |i| 1.0 + i as f64,
            168,
            &[
                &[11.0, 3.0, 0.5, 40.0, -0.7, -1.3, 25.0, -0.3, 1.4],
                &[10.0, 3.0, 0.5, 44.0, -1.5, 0.5, 26.0, -0.1, 1.5],
            ],
        ),
        (
            "Gauss3",
            &[98.9, 0.011, 100.7, 111.6, 23.3, 73.7, 147.8, 19.7],
            |i| 1.0 + i as f64,
            250,
            &[
                &[94.9, 0.009, 90.1, 113.0, 20.0, 73.8, 140.0, 20.0],
                &[96.0, 0.0096, 80.0, 110.0, 25.0, 74.0, 139.0, 25.0],
            ],
        ),
        (
            "Roszman1",
            &[0.2, -6e-6, 1200.0, -180.0],
            |i| -4900.0 + 190.0 * i as f64,
            25,
            &[&[0.1, -1e-5, 1000.0, -100.0], &[0.2, -5e-6, 1200.0, -150.0]],
        ),
        (
            "Rat42",
            &[72.0, 2.6, 0.067],
            |i| 9.0 + 8.0 * i as f64,
            9,
            &[&[100.0, 1.0, 0.1], &[75.0, 2.5, 0.07]],
        ),
    ];
    for (name, truth, x, count, starts) in cases {
        let function = model(name).unwrap();
        let variables: Vec<Dual> = truth.iter().map(|&value| Dual::from(value)).collect();
        let y: Vec<f64> = (0..count)
            .map(|i| function(&variables, &[x(i)]).value)
            .collect();
        let regression = measured(function, truth.len(), x, &y);
        for start in starts {
            let fit = fit(&regression, start);
            let error = fit
                .values
                .iter()
                .zip(truth)
                .map(|(f, t)| (f / t - 1.0).abs());
            let worst = error.fold(0.0, f64::max);
            eprintln!(
                "{name}: {:?} {worst:.1e} {:?} {:.0e}",
                fit.status, fit.work, fit.identifiability.condition
            );
            assert!(
                worst < 1e-6,
                "{name}: {:?} {:?} {worst:e}",
                fit.status,
                fit.values
            );
        }
    }
}

/// Three exponentials whose 24 values carry 13 digits (as NIST's Lanczos1): residuals of 1e-13, where the cost itself is
/// mostly rounding.
#[test]
fn residuals_of_rounding_size_are_no_obstacle() {
    let truth = [0.0951, 1.0, 0.8607, 3.0, 1.5576, 5.0];
    let function = model("Lanczos1").unwrap();
    let variables = truth.map(Dual::from);
    let exact = |i: usize| function(&variables, &[0.05 * i as f64]).value;
    let y: Vec<f64> = (0..24)
        .map(|i| format!("{:.12e}", exact(i)).parse().unwrap())
        .collect();
    let regression = measured(function, 6, |i| 0.05 * i as f64, &y);
    for start in [
        [1.2, 0.3, 5.6, 5.5, 6.5, 7.6],
        [0.5, 0.7, 3.6, 4.2, 4.0, 6.3],
    ] {
        let fit = fit(&regression, &start);
        let errors = fit
            .values
            .iter()
            .zip(&truth)
            .map(|(f, t)| (f / t - 1.0).abs());
        assert!(errors.fold(0.0, f64::max) < 1e-8, "{fit:?}");
        assert_eq!(fit.status, Status::Converged);
    }
}
