//! Constrained optima of a mass–damper–spring fit against an independent solver.
//!
//! The references were made with SciPy 1.17: the active constraints eliminated by hand (for example c = 2 √(K I)/l²
//! on the light-damping cone), the rest fitted with `least_squares(method="lm")` to 1e-15; SLSQP on the constrained
//! problem found the same optima to its accuracy, and refits with a constraint moved inwards cost more.

#![allow(clippy::unwrap_used)]

use snug_least_squares::{
    Affine, Constraints, DenseResidual, DifferenceResidual, EvaluationError, Fit, Settings, Status,
    solve,
};

const SQUARE: f64 = 0.33 * 0.33;
const TOOL_INERTIA: f64 = 0.275;
const TORQUE: f64 = 20.0;
const NOISE: f64 = 1e-3;

/// Angle after a torque step: I θ″ + C θ′ + K θ = T, any damping.
fn angle(p: &[f64], t: f64) -> f64 {
    let inertia = TOOL_INERTIA + p[0] * SQUARE;
    let (decay, stiffness) = (p[1] * SQUARE / (2.0 * inertia), p[2] * SQUARE);
    let discriminant = stiffness / inertia - decay * decay;
    let root = discriminant.abs().sqrt();
    let (cosine, sine) = match root * t {
        0.0 => (1.0, t),
        x if discriminant > 0.0 => (x.cos(), x.sin() / root),
        x => (x.cosh(), x.sinh() / root),
    };
    TORQUE / stiffness * (1.0 - (-decay * t).exp() * (cosine + decay * sine))
}

fn measured(truth: [f64; 3]) -> Vec<(f64, f64)> {
    let times = (0..301).map(|i| 0.3 * f64::from(i) / 300.0);
    times
        .map(|t| (t, angle(&truth, t) + 2e-4 * (900.0 * t * t).sin()))
        .collect()
}

fn light_damping() -> Constraints {
    let mut set = Constraints::new(3);
    for (index, name) in ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"]
        .iter()
        .enumerate()
    {
        set.bound(index, 1e-9, f64::INFINITY, *name);
    }
    set.rotated_cone(
        "light_damping",
        Affine::term(3, 2, SQUARE, 0.0),
        Affine::term(3, 0, SQUARE, TOOL_INERTIA),
        Affine::term(3, 1, SQUARE, 0.0),
    );
    set
}

fn fit(truth: [f64; 3], set: &Constraints, start: &[f64; 3]) -> Fit {
    let data = measured(truth);
    let residual = DifferenceResidual::new(data.len(), &[1.0, 10.0, 100.0], |p, r| {
        for (r, (t, y)) in r.iter_mut().zip(&data) {
            *r = (y - angle(p, *t)) / NOISE;
        }
        match r.iter().all(|value| value.is_finite()) {
            true => Ok(()),
            false => Err(EvaluationError::NotFinite),
        }
    });
    solve(
        &mut DenseResidual::new(residual),
        start,
        set,
        &Settings::default(),
    )
    .unwrap()
}

const STARTS: [[f64; 3]; 4] = [
    [1.76, 38.26, 1837.27],
    // On two walls at once.
    [1e-9, 1e-9, 1500.0],
    // On the cone, to rounding.
    [2.0, 190.24, 2000.0],
    // Outside: far overdamped and of negative mass.
    [-1.0, 900.0, 700.0],
];

#[track_caller]
fn assert_optimum(
    truth: [f64; 3],
    set: &Constraints,
    optimum: [f64; 3],
    cost: f64,
    active: &[&str],
) {
    for start in &STARTS {
        let fit = fit(truth, set, start);
        let what = format!("from {start:?}: {fit:?}");
        for (found, reference) in fit.values.iter().zip(&optimum) {
            assert!(
                (found - reference).abs() <= 2e-6 * reference.abs() + 1e-12,
                "{what}"
            );
        }
        assert!((fit.cost / cost - 1.0).abs() < 1e-9, "{what}");
        let names: Vec<_> = fit
            .active
            .iter()
            .map(|constraint| constraint.name.as_str())
            .collect();
        assert_eq!(names, active, "{what}");
        let expected = match active.is_empty() {
            true => Status::Converged,
            false => Status::ConvergedAtConstraint,
        };
        assert_eq!(fit.status, expected, "{what}");
        assert!(set.contains(&fit.values), "{what}");
        assert!(fit.work.iterations < 60, "{what}");
    }
}

#[test]
fn inside_nothing_is_active() {
    let optimum = [2.2962922532897037, 100.00848157375121, 2299.779634450301];
    assert_optimum(
        [2.3, 100.0, 2300.0],
        &light_damping(),
        optimum,
        2.8508646106818634,
        &[],
    );
}

#[test]
fn a_damping_ratio_just_below_one_is_not_bound() {
    // ζ = 0.992 at the optimum.
    let truth = [2.0, 163.12923336324434, 1500.0];
    let optimum = [1.9875287090877545, 163.22726617801155, 1499.2744347955522];
    assert_optimum(truth, &light_damping(), optimum, 2.8217798266286236, &[]);
}

#[test]
fn overdamped_data_end_on_the_cone() {
    let names = ["light_damping"];
    let optimum = [4.261293048259853, 216.03852018041624, 1719.3112107445736];
    let truth = [2.0, 247.16550509582476, 1500.0];
    assert_optimum(truth, &light_damping(), optimum, 422.0906247458579, &names);
    let optimum = [12.364442477175462, 328.48902469446284, 1811.743879530616];
    let truth = [4.0, 459.8018692681147, 900.0];
    assert_optimum(truth, &light_damping(), optimum, 598.4312890546246, &names);
}

#[test]
fn negative_parameters_end_on_their_minimum() {
    let optimum = [1.8838910431400626, 1e-9, 2184.5310269416987];
    let names = ["damping_kg_per_s minimum"];
    assert_optimum(
        [2.3, -8.0, 2300.0],
        &light_damping(),
        optimum,
        10180.039126067772,
        &names,
    );
    let optimum = [1e-9, 60.677214771694295, 1554.9383978308006];
    let names = ["mass_kg minimum"];
    assert_optimum(
        [-1.0, 60.0, 1500.0],
        &light_damping(),
        optimum,
        9795.474070016535,
        &names,
    );
}

#[test]
fn two_constraints_at_once() {
    let mut set = light_damping();
    set.bound(0, 0.0, 3.0, "mass_kg");
    let optimum = [3.0, 200.45635071287577, 1818.144452358048];
    let names = ["mass_kg maximum", "light_damping"];
    let truth = [2.0, 247.16550509582476, 1500.0];
    assert_optimum(truth, &set, optimum, 1424.0718382096018, &names);
}

#[test]
fn a_linear_inequality() {
    let mut set = light_damping();
    set.linear("sum", &[1.0, 0.0, 1e-3], 4.0);
    let optimum = [1.7473096515246662, 103.31474707897324, 2252.690348475334];
    assert_optimum(
        [2.3, 100.0, 2300.0],
        &set,
        optimum,
        292.34579974905944,
        &["sum"],
    );
}

#[test]
fn standard_errors_vanish_across_active_constraints() {
    let set = light_damping();
    let fit = fit([-1.0, 60.0, 1500.0], &set, &STARTS[0]);
    let covariance = fit.covariance(snug_least_squares::ResidualNoise::Unit);
    assert_eq!(covariance.standard_errors[0], None);
    // With the mass fixed at zero: c and k alone, by finite differences of the angle at the optimum.
    let data = measured([-1.0, 60.0, 1500.0]);
    let mut normal = [0.0; 3];
    for (t, _) in &data {
        let slope = |index: usize| {
            let width = 1e-5 * fit.values[index];
            let at = |sign: f64| {
                let mut p = fit.values.clone();
                p[index] += sign * width;
                angle(&p, *t) / NOISE
            };
            (at(1.0) - at(-1.0)) / (2.0 * width)
        };
        let (c, k) = (slope(1), slope(2));
        normal[0] += c * c;
        normal[1] += c * k;
        normal[2] += k * k;
    }
    let determinant = normal[0] * normal[2] - normal[1] * normal[1];
    for (index, entry) in [(1, normal[2]), (2, normal[0])] {
        let reference = (entry / determinant).sqrt();
        let found = covariance.standard_errors[index].unwrap();
        assert!(
            (found / reference - 1.0).abs() < 1e-5,
            "{found} {reference}"
        );
    }
}
