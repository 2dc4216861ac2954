//! Pooled fits against the same problem stacked into one, which the general solver solves without knowing its structure.
#![allow(clippy::unwrap_used)]

use snug_least_squares::{
    Constraints, DenseResidual, EvaluationError, PooledResidual, PooledSettings, Residual,
    ResidualNoise, Settings, Trial, solve, solve_pooled, solve_pooled_followed,
};
use std::ops::ControlFlow;

const MEMBERS: usize = 5;
const SAMPLES: usize = 40;

/// y_i(t) = a_i exp(−b t) + c_i + d t² with own a_i, c_i and shared b, d.
struct Decays {
    measured: Vec<Vec<f64>>,
    /// Whether the members from the third on have a d of their own, which is the third shared parameter then.
    by_group: bool,
}

impl Decays {
    fn new() -> Self {
        let wobble = |k: usize| (78.233 * k as f64).sin() * 0.02;
        let measured = (0..MEMBERS).map(|i| {
            let (a, c) = (1.0 + 0.4 * i as f64, 0.3 * i as f64 - 0.5);
            (0..SAMPLES)
                .map(|k| value(a, c, 1.3, 0.2, time(k)) + wobble(k + SAMPLES * i))
                .collect()
        });
        Self {
            measured: measured.collect(),
            by_group: false,
        }
    }

    fn by_group() -> Self {
        Self {
            by_group: true,
            ..Self::new()
        }
    }

    /// Which of the shared parameters is a member's d.
    fn place_of_d(&self, member: usize) -> usize {
        1 + usize::from(self.by_group && member >= 2)
    }

    /// Residual and Jacobian of one member over (a, c, b, d).
    fn member(&self, i: usize, p: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (a, c, b, d) = (p[0], p[1], p[2], p[3]);
        let mut residual = Vec::new();
        let mut jacobian = vec![0.0; 4 * SAMPLES];
        for (k, measured) in self.measured[i].iter().enumerate() {
            let t = time(k);
            residual.push(measured - value(a, c, b, d, t));
            let slopes = [(-b * t).exp(), 1.0, -a * t * (-b * t).exp(), t * t];
            for (column, slope) in slopes.iter().enumerate() {
                jacobian[column * SAMPLES + k] = -slope;
            }
        }
        (residual, jacobian)
    }
}

fn time(k: usize) -> f64 {
    0.05 * k as f64
}

fn value(a: f64, c: f64, b: f64, d: f64, t: f64) -> f64 {
    a * (-b * t).exp() + c + d * t * t
}

impl PooledResidual for Decays {
    fn member_count(&self) -> usize {
        MEMBERS
    }

    fn own_count(&self) -> usize {
        2
    }

    fn shared_count(&self) -> usize {
        2 + usize::from(self.by_group)
    }

    fn shared_of(&self, member: usize) -> Vec<usize> {
        vec![0, self.place_of_d(member)]
    }

    fn linearize(&mut self, trials: &mut [Trial<'_>]) -> Result<(), EvaluationError> {
        for trial in trials {
            let (mut residual, mut jacobian) = self.member(trial.member, &trial.parameters);
            (trial.linearization).set_jacobian(&mut residual, &mut jacobian)?;
        }
        Ok(())
    }
}

/// The same, stacked: parameters a_0, c_0, a_1, c_1, …, b, d.
struct Stacked(Decays);

impl Residual for Stacked {
    fn residual_count(&self) -> usize {
        MEMBERS * SAMPLES
    }

    fn parameter_count(&self) -> usize {
        2 * MEMBERS + self.0.shared_count()
    }

    fn evaluate(
        &mut self,
        parameters: &[f64],
        residual: &mut [f64],
        mut jacobian: Option<&mut [f64]>,
    ) -> Result<(), EvaluationError> {
        let shared = &parameters[2 * MEMBERS..];
        if let Some(jacobian) = jacobian.as_deref_mut() {
            jacobian.fill(0.0);
        }
        for i in 0..MEMBERS {
            let d = self.0.place_of_d(i);
            let own = [&parameters[2 * i..2 * i + 2], &[shared[0], shared[d]]].concat();
            let (r, j) = self.0.member(i, &own);
            let rows = i * SAMPLES..(i + 1) * SAMPLES;
            residual[rows.clone()].copy_from_slice(&r);
            if let Some(jacobian) = jacobian.as_deref_mut() {
                let columns = [2 * i, 2 * i + 1, 2 * MEMBERS, 2 * MEMBERS + d];
                for (column, target) in columns.into_iter().enumerate() {
                    jacobian[target * MEMBERS * SAMPLES..][rows.clone()]
                        .copy_from_slice(&j[column * SAMPLES..(column + 1) * SAMPLES]);
                }
            }
        }
        Ok(())
    }
}

/// The same optimum; and where no bound holds a shared parameter, the same standard errors of these.
fn agree(shared_set: Constraints, own_set: impl Fn() -> Constraints, stacked_set: Constraints) {
    let are_shared_free = shared_set == Constraints::new(2);
    let starts = vec![vec![0.8, 0.1]; MEMBERS];
    let own_sets: Vec<Constraints> = (0..MEMBERS).map(|_| own_set()).collect();
    let settings = PooledSettings {
        cost_tolerance: 1e-14,
        ..PooledSettings::default()
    };
    let pooled = solve_pooled(
        &mut Decays::new(),
        &starts,
        &own_sets,
        &[0.5, 0.0],
        &shared_set,
        &settings,
    )
    .unwrap();
    let start = [starts.concat(), vec![0.5, 0.0]].concat();
    let mut problem = DenseResidual::new(Stacked(Decays::new()));
    let stacked = solve(&mut problem, &start, &stacked_set, &Settings::default()).unwrap();
    let found = [pooled.own.concat(), pooled.shared.clone()].concat();
    for (found_value, stacked_value) in found.iter().zip(&stacked.values) {
        assert!(
            (found_value - stacked_value).abs() < 1e-6,
            "{found:?} {:?}",
            stacked.values
        );
    }
    assert!((pooled.cost() / stacked.cost - 1.0).abs() < 1e-9);
    assert!(pooled.converged);
    if !are_shared_free {
        return;
    }
    let [bb, bd, _, dd] = pooled.curvature()[..] else {
        panic!("two shared parameters")
    };
    let determinant = bb * dd - bd * bd;
    let of_all = stacked.covariance(ResidualNoise::Unit).standard_errors;
    for (variance, place) in [(dd / determinant, 0), (bb / determinant, 1)] {
        let expected = of_all[2 * MEMBERS + place].unwrap();
        assert!(
            (variance.sqrt() / expected - 1.0).abs() < 1e-6,
            "{} {expected}",
            variance.sqrt()
        );
    }
}

#[test]
fn without_constraints_it_is_the_stacked_optimum() {
    agree(
        Constraints::new(2),
        || Constraints::new(2),
        Constraints::new(2 * MEMBERS + 2),
    );
}

/// d ≤ 0.1 holds the shared parameter, c ≥ −0.3 one of the members.
#[test]
fn on_bounds_of_shared_and_own_parameters_it_is_the_stacked_optimum() {
    let mut shared = Constraints::new(2);
    shared.bound(1, -1.0, 0.1, "d");
    let own = || {
        let mut own = Constraints::new(2);
        own.bound(1, -0.3, 10.0, "c");
        own
    };
    let mut stacked = Constraints::new(2 * MEMBERS + 2);
    stacked.bound(2 * MEMBERS + 1, -1.0, 0.1, "d");
    for i in 0..MEMBERS {
        stacked.bound(2 * i + 1, -0.3, 10.0, "c");
    }
    agree(shared, own, stacked);
}

/// A member's parameter that presses on its bound imitates nothing: what all share is known better for it.
#[test]
fn on_bounds_of_own_parameters_shared_ones_are_as_certain_as_stacked() {
    let own = || {
        let mut own = Constraints::new(2);
        own.bound(1, -0.3, 10.0, "c");
        own
    };
    let mut stacked = Constraints::new(2 * MEMBERS + 2);
    for i in 0..MEMBERS {
        stacked.bound(2 * i + 1, -0.3, 10.0, "c");
    }
    agree(Constraints::new(2), own, stacked);
}

/// Members 0 and 1 share one d, the others another; all share b.
#[test]
fn what_only_a_group_shares_is_the_stacked_optimum_too() {
    let settings = PooledSettings {
        cost_tolerance: 1e-14,
        ..PooledSettings::default()
    };
    let (starts, shared) = (vec![vec![0.8, 0.1]; MEMBERS], [0.5, 0.0, 0.0]);
    let own_sets = vec![Constraints::new(2); MEMBERS];
    let mut held = Constraints::new(3);
    held.bound(2, -1.0, 0.15, "d");
    for shared_set in [Constraints::new(3), held] {
        let mut decays = Decays::by_group();
        let pooled = solve_pooled(
            &mut decays,
            &starts,
            &own_sets,
            &shared,
            &shared_set,
            &settings,
        )
        .unwrap();
        let mut stacked_set = Constraints::new(2 * MEMBERS + 3);
        let (low, high) = shared_set.bounds_of(2);
        stacked_set.bound(2 * MEMBERS + 2, low, high, "d");
        let start = [starts.concat(), shared.to_vec()].concat();
        let mut problem = DenseResidual::new(Stacked(Decays::by_group()));
        let stacked = solve(&mut problem, &start, &stacked_set, &Settings::default()).unwrap();
        let found = [pooled.own.concat(), pooled.shared.clone()].concat();
        for (found, stacked) in found.iter().zip(&stacked.values) {
            assert!((found - stacked).abs() < 1e-6, "{found} {stacked}");
        }
        assert!(
            (found[2 * MEMBERS + 1] - found[2 * MEMBERS + 2]).abs() > 1e-4,
            "they differ"
        );
        assert!(pooled.converged);
    }
}

/// S = Σ S_i is the Schur complement: its inverse is the shared block of the stacked problem's (JᵀJ)⁻¹.
#[test]
fn the_projected_curvature_is_the_information_on_the_shared_parameters() {
    let starts = vec![vec![0.8, 0.1]; MEMBERS];
    let own_sets = vec![Constraints::new(2); MEMBERS];
    let pooled = solve_pooled(
        &mut Decays::new(),
        &starts,
        &own_sets,
        &[0.5, 0.0],
        &Constraints::new(2),
        &PooledSettings::default(),
    )
    .unwrap();
    let s = pooled.curvature();
    let determinant = s[0] * s[3] - s[1] * s[2];
    let start = [pooled.own.concat(), pooled.shared.clone()].concat();
    let mut problem = DenseResidual::new(Stacked(Decays::new()));
    let free = Constraints::new(2 * MEMBERS + 2);
    let fit = solve(&mut problem, &start, &free, &Settings::default()).unwrap();
    let covariance = fit.covariance(snug_least_squares::ResidualNoise::Unit);
    let error = covariance.standard_errors[2 * MEMBERS].unwrap();
    assert!(((s[3] / determinant).sqrt() / error - 1.0).abs() < 1e-5);
}

/// r_i = (β + α, (α − 1)/10, (β + 5)/100): a β that is free follows α with −α, and α goes to 1.
struct Coupled;

impl PooledResidual for Coupled {
    fn member_count(&self) -> usize {
        3
    }

    fn own_count(&self) -> usize {
        1
    }

    fn shared_count(&self) -> usize {
        1
    }

    fn linearize(&mut self, trials: &mut [Trial<'_>]) -> Result<(), EvaluationError> {
        for trial in trials {
            let [own, shared] = trial.parameters[..] else {
                unreachable!("one of each")
            };
            let mut residual = [own + shared, 0.1 * (shared - 1.0), 0.01 * (own + 5.0)];
            let mut jacobian = [1.0, 0.0, 0.01, 1.0, 0.1, 0.0];
            (trial.linearization).set_jacobian(&mut residual, &mut jacobian)?;
        }
        Ok(())
    }
}

#[test]
fn shared_parameters_know_that_own_ones_stand_at_a_wall() {
    let mut at_least_one = Constraints::new(1);
    at_least_one.bound(0, 1.0, f64::INFINITY, "own");
    // With β held at 1, α solves (1 + α) + 0.01 (α − 1) = 0.
    let expected = -0.99 / 1.01;
    for start in [3.0, 0.5, -1.5] {
        let fit = solve_pooled(
            &mut Coupled,
            &vec![vec![1.0]; 3],
            &vec![at_least_one.clone(); 3],
            &[start],
            &Constraints::new(1),
            &PooledSettings::default(),
        )
        .unwrap();
        assert!(fit.converged);
        assert!((fit.shared[0] - expected).abs() < 1e-6, "{:?}", fit.shared);
        assert_eq!(fit.own, vec![vec![1.0]; 3]);
    }
}

#[test]
fn whoever_follows_hears_of_every_step_and_may_end_the_fit() {
    let starts = vec![vec![0.8, 0.1]; MEMBERS];
    let own_sets = vec![Constraints::new(2); MEMBERS];
    let solved = |most: usize| {
        let mut steps = Vec::new();
        let fit = solve_pooled_followed(
            &mut Decays::new(),
            &starts,
            &own_sets,
            &[0.5, 0.0],
            &Constraints::new(2),
            &PooledSettings::default(),
            &mut |step| {
                steps.push(step);
                match steps.len() < most {
                    true => ControlFlow::Continue(()),
                    false => ControlFlow::Break(()),
                }
            },
        )
        .unwrap();
        (fit, steps)
    };
    let (whole, steps) = solved(usize::MAX);
    assert!(whole.converged && steps.len() == whole.work.iterations + 1);
    assert!(steps[0].iterations == 0 && steps[0].moved);
    assert!(
        steps
            .windows(2)
            .all(|two| two[1].moved == (two[1].cost != two[0].cost))
    );
    assert!(steps.windows(2).all(|two| two[1].cost <= two[0].cost));
    assert!((steps[steps.len() - 1].cost / whole.cost() - 1.0).abs() < 1e-12);
    let (cut, heard) = solved(2);
    assert!(!cut.converged && heard[..] == steps[..2]);
    assert!((cut.cost() / steps[1].cost - 1.0).abs() < 1e-12);
}
