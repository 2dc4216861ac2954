//! What a solver must survive: undetermined parameters, values that are not finite, units, impossible input.

#![allow(clippy::unwrap_used)]

use snug_least_squares::{
    Constraints, DenseResidual, DifferenceResidual, EvaluationError, Fit, LeastSquares,
    Linearization, Residual, ResidualNoise, Settings, SolveError, Status, Work, solve,
    solve_from_starts,
};

/// y = a exp(−b t) at ten times, with a small alternating disturbance; parameters in units of `unit`.
struct Decay {
    unit: [f64; 2],
}

impl Decay {
    fn observation(i: usize) -> (f64, f64) {
        let t = 0.2 * i as f64;
        let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        (t, 3.0 * (-1.3 * t).exp() + 0.01 * sign)
    }
}

impl Residual for Decay {
    fn residual_count(&self) -> usize {
        10
    }

    fn parameter_count(&self) -> usize {
        2
    }

    fn evaluate(
        &mut self,
        p: &[f64],
        r: &mut [f64],
        j: Option<&mut [f64]>,
    ) -> Result<(), EvaluationError> {
        let (a, b) = (p[0] * self.unit[0], p[1] * self.unit[1]);
        let mut slopes = [0.0; 20];
        for i in 0..10 {
            let (t, y) = Self::observation(i);
            let e = (-b * t).exp();
            r[i] = y - a * e;
            slopes[i] = -e * self.unit[0];
            slopes[10 + i] = a * t * e * self.unit[1];
        }
        if let Some(j) = j {
            j.copy_from_slice(&slopes);
        }
        Ok(())
    }
}

fn fit_decay(unit: [f64; 2], set: &Constraints) -> Fit {
    let start = [1.0 / unit[0], 0.5 / unit[1]];
    solve(
        &mut DenseResidual::new(Decay { unit }),
        &start,
        set,
        &Settings::default(),
    )
    .unwrap()
}

#[test]
fn units_do_not_matter() {
    let plain = fit_decay([1.0, 1.0], &Constraints::new(2));
    assert_eq!(plain.status, Status::Converged);
    for unit in [[1e6, 1.0], [1.0, 1e-6], [1e-6, 1e6], [1e6, 1e6]] {
        let scaled = fit_decay(unit, &Constraints::new(2));
        assert_eq!(scaled.work, plain.work, "the way there is the same");
        for (index, unit) in unit.iter().enumerate() {
            let back = scaled.values[index] * unit;
            assert!((back / plain.values[index] - 1.0).abs() < 1e-11);
            let error =
                |fit: &Fit| fit.covariance(ResidualNoise::Unit).standard_errors[index].unwrap();
            assert!((error(&scaled) * unit / error(&plain) - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn units_do_not_matter_on_a_constraint() {
    // b ≤ 1 is active (the free optimum is near 1.3).
    for unit in [[1.0, 1.0], [1e6, 1e-6], [1e-6, 1e6]] {
        let mut set = Constraints::new(2);
        set.bound(1, f64::NEG_INFINITY, 1.0 / unit[1], "b");
        let fit = fit_decay(unit, &set);
        assert_eq!(fit.status, Status::ConvergedAtConstraint);
        assert_eq!(fit.values[1], 1.0 / unit[1], "a bound holds exactly");
        // With b = 1 the best a is linear regression on exp(−t).
        let (mut above, mut below) = (0.0, 0.0);
        for (t, y) in (0..10).map(Decay::observation) {
            above += y * (-t).exp();
            below += (-2.0 * t).exp();
        }
        assert!((fit.values[0] * unit[0] / (above / below) - 1.0).abs() < 1e-10);
        // Its multiplier is the slope of ½‖r‖² across the bound.
        let slope: f64 = (0..10)
            .map(Decay::observation)
            .map(|(t, y)| (y - above / below * (-t).exp()) * above / below * t * (-t).exp())
            .sum();
        assert!((fit.active[0].multiplier / (-slope * unit[1]) - 1.0).abs() < 1e-8);
    }
}

#[test]
fn both_ways_of_linearizing_agree() {
    /// JᵀJ and Jᵀr accumulated without storing J.
    struct Fused(Decay);
    impl LeastSquares for Fused {
        fn parameter_count(&self) -> usize {
            2
        }
        fn residual_count(&self) -> usize {
            10
        }
        fn cost(&mut self, p: &[f64]) -> Result<f64, EvaluationError> {
            let mut r = [0.0; 10];
            self.0.evaluate(p, &mut r, None)?;
            Ok(0.5 * r.iter().map(|r| r * r).sum::<f64>())
        }
        fn linearize(
            &mut self,
            p: &[f64],
            linearization: &mut Linearization,
        ) -> Result<(), EvaluationError> {
            let (mut r, mut j) = ([0.0; 10], [0.0; 20]);
            self.0.evaluate(p, &mut r, Some(&mut j))?;
            let inner = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let (first, second) = j.split_at(10);
            let normal = [
                inner(first, first),
                0.0,
                inner(first, second),
                inner(second, second),
            ];
            let gradient = [inner(first, &r), inner(second, &r)];
            linearization.set_normal_equations(0.5 * inner(&r, &r), &gradient, &normal)
        }
    }
    let unit = [1.0, 1.0];
    let dense = fit_decay(unit, &Constraints::new(2));
    let start = [1.0, 0.5];
    let fused = solve(
        &mut Fused(Decay { unit }),
        &start,
        &Constraints::new(2),
        &Settings::default(),
    )
    .unwrap();
    for (a, b) in dense.values.iter().zip(&fused.values) {
        assert!((a / b - 1.0).abs() < 1e-9);
    }
    assert_eq!(dense.status, fused.status);
}

#[test]
fn the_work_of_a_fit_does_not_grow_unnoticed() {
    let work = fit_decay([1.0, 1.0], &Constraints::new(2)).work;
    let expected = Work {
        iterations: 7,
        evaluations: 0,
        linearizations: 8,
        conic_solves: 0,
        polish_steps: 0,
    };
    assert_eq!(work, expected);
    let mut set = Constraints::new(2);
    set.bound(1, f64::NEG_INFINITY, 1.0, "b");
    let work = fit_decay([1.0, 1.0], &set).work;
    assert_eq!(
        work.conic_solves, 1,
        "Clarabel is asked once, then its active set is known: {work:?}"
    );
}

/// Two parameters of which only the product counts, and a third by itself.
fn product(p: &[f64], r: &mut [f64]) -> Result<(), EvaluationError> {
    for (i, r) in r.iter_mut().enumerate() {
        *r = 6.0 - p[0] * p[2] + (p[1] - 2.0) * i as f64;
    }
    Ok(())
}

#[test]
fn undetermined_parameters_are_named() {
    let residual = DifferenceResidual::new(8, &[1.0; 3], product);
    let start = [1.0, 1.0, 1.0];
    let set = Constraints::new(3);
    let fit = solve(
        &mut DenseResidual::new(residual),
        &start,
        &set,
        &Settings::default(),
    )
    .unwrap();
    assert_eq!(fit.status, Status::NotIdentifiable);
    assert_eq!((fit.identifiability.rank, fit.identifiability.free), (2, 3));
    let (first, second, correlation) = fit.identifiability.strongest.unwrap();
    assert_eq!((first, second), (0, 2));
    assert!(
        (correlation + 1.0).abs() < 1e-6,
        "more of one is less of the other: {correlation}"
    );
    assert!(
        (fit.values[0] * fit.values[2] - 6.0).abs() < 1e-6,
        "the product is known"
    );
    let errors = fit.covariance(ResidualNoise::Unit).standard_errors;
    assert!(errors[0].is_none() && errors[2].is_none());
    // σ(p1) for r = … + p1 i with a free constant: 1/√Σ(i − 3.5)² = 1/√42.
    assert!((errors[1].unwrap() * 42.0_f64.sqrt() - 1.0).abs() < 1e-6);
}

#[test]
fn undetermined_parameters_are_named_on_a_constraint_too() {
    let residual = DifferenceResidual::new(8, &[1.0; 3], product);
    let mut set = Constraints::new(3);
    set.bound(1, 0.0, 1.5, "slope");
    let start = [1.0, 1.0, 1.0];
    let fit = solve(
        &mut DenseResidual::new(residual),
        &start,
        &set,
        &Settings::default(),
    )
    .unwrap();
    assert_eq!(fit.status, Status::NotIdentifiable);
    assert_eq!((fit.identifiability.rank, fit.identifiability.free), (1, 2));
    assert_eq!(fit.active[0].name, "slope maximum");
    assert_eq!(fit.values[1], 1.5);
    // With the slope 0.5 short of its value, the mean of the rest is best: p0 p2 = 6 − 0.5 · 3.5.
    assert!(
        (fit.values[0] * fit.values[2] - 4.25).abs() < 1e-6,
        "{fit:?}"
    );
    assert_eq!(
        fit.identifiability.strongest.map(|pair| (pair.0, pair.1)),
        Some((0, 2))
    );
}

#[test]
fn without_parameters_the_residual_is_the_result() {
    let constant = |_: &[f64], r: &mut [f64]| {
        r.copy_from_slice(&[3.0, 4.0]);
        Ok(())
    };
    let mut problem = DenseResidual::new(DifferenceResidual::new(2, &[], constant));
    let fit = solve(
        &mut problem,
        &[],
        &Constraints::new(0),
        &Settings::default(),
    )
    .unwrap();
    assert_eq!(
        (fit.status, fit.sum_of_squares()),
        (Status::Converged, 25.0)
    );
    assert!(fit.covariance(ResidualNoise::Unit).matrix.is_empty());
}

#[test]
fn a_parameter_without_effect_is_not_identifiable() {
    let ignored = |p: &[f64], r: &mut [f64]| {
        r.iter_mut()
            .enumerate()
            .for_each(|(i, r)| *r = p[0] - i as f64);
        Ok(())
    };
    let residual = DifferenceResidual::new(5, &[1.0; 2], ignored);
    let set = Constraints::new(2);
    let fit = solve(
        &mut DenseResidual::new(residual),
        &[9.0, 4.0],
        &set,
        &Settings::default(),
    )
    .unwrap();
    assert_eq!(fit.status, Status::NotIdentifiable);
    assert!((fit.values[0] - 2.0).abs() < 1e-9, "the mean of 0 to 4");
    assert_eq!(fit.values[1], 4.0, "nothing moves it");
    assert_eq!(fit.identifiability.condition, f64::INFINITY);
    assert_eq!(fit.covariance(ResidualNoise::Unit).standard_errors[1], None);
}

#[test]
fn values_that_are_not_finite_fail_at_the_start_and_are_avoided_later() {
    // ln needs p > 0; from 10 the full Gauss–Newton step for ln p = 0 goes to 10 − 10 ln 10 < 0.
    let logarithm = |p: &[f64], r: &mut [f64]| {
        r.fill(p[0].ln());
        Ok(())
    };
    let run = |start: f64| {
        let residual = DifferenceResidual::new(3, &[1e-3], logarithm);
        let set = Constraints::new(1);
        solve(
            &mut DenseResidual::new(residual),
            &[start],
            &set,
            &Settings::default(),
        )
        .unwrap()
    };
    let fit = run(10.0);
    assert!(
        fit.status.is_converged() && (fit.values[0] - 1.0).abs() < 1e-9,
        "{fit:?}"
    );
    assert_eq!(run(-1.0).status, Status::Failed);
}

#[test]
fn the_best_start_wins() {
    // ½(p² − 1)² + … : the minimum near 1 is deeper than the one near −1.
    let wells = |p: &[f64], r: &mut [f64]| {
        r[0] = 4.0 * (p[0] * p[0] - 1.0);
        r[1] = p[0] - 1.0;
        Ok(())
    };
    let mut problem = DenseResidual::new(DifferenceResidual::new(2, &[1.0], wells));
    let set = Constraints::new(1);
    let settings = Settings::default();
    let one = solve(&mut problem, &[-2.0], &set, &settings).unwrap();
    assert!(one.values[0] < 0.0);
    let best = solve_from_starts(&mut problem, &[[-2.0], [3.0]], &set, &settings).unwrap();
    assert!((best.values[0] - 1.0).abs() < 1e-7 && best.work.iterations > one.work.iterations);
    let none: [[f64; 1]; 0] = [];
    let refused = solve_from_starts(&mut problem, &none, &set, &settings);
    assert_eq!(refused.unwrap_err(), SolveError::NoStart);
}

#[test]
fn impossible_input_is_an_error_with_numbers() {
    let mut problem = DenseResidual::new(Decay { unit: [1.0, 1.0] });
    let settings = Settings::default();
    let mut run = |start: &[f64], set: &Constraints, settings: &Settings| {
        solve(&mut problem, start, set, settings).unwrap_err()
    };
    let free = Constraints::new(2);
    assert!(matches!(
        run(&[1.0], &free, &settings),
        SolveError::Dimension {
            expected: 2,
            found: 1,
            ..
        }
    ));
    assert!(matches!(
        run(&[1.0, f64::NAN], &free, &settings),
        SolveError::Start { parameter: 1, .. }
    ));
    let mut empty = Constraints::new(2);
    empty
        .bound(0, 0.0, 1.0, "a")
        .linear("far", &[-1.0, 0.0], -2.0);
    let refused = run(&[0.5, 0.5], &empty, &settings);
    assert!(
        matches!(refused, SolveError::NoFeasiblePoint { .. }),
        "{refused}"
    );
    let wrong = Settings {
        gradient_tolerance: -1.0,
        ..Settings::default()
    };
    assert!(matches!(
        run(&[1.0, 1.0], &free, &wrong),
        SolveError::Setting {
            name: "gradient_tolerance",
            ..
        }
    ));
}

#[test]
fn the_same_input_gives_the_same_bits() {
    let mut set = Constraints::new(2);
    set.bound(1, f64::NEG_INFINITY, 1.0, "b");
    let bits = |fit: &Fit| {
        fit.values
            .iter()
            .map(|value| value.to_bits())
            .collect::<Vec<_>>()
    };
    let first = bits(&fit_decay([1.0, 1.0], &set));
    assert!((0..5).all(|_| bits(&fit_decay([1.0, 1.0], &set)) == first));
}
