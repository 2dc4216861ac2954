//! Errors and intervals of sizes from a few curvatures and pulls, by the textbook.

use super::*;
use crate::tests::made_up::{close, exact};
use snug_model::Effect::{AccelerationBias, Backlash, CubicStiffness, SecondMass};

/// 97.5 % quantiles of Student's t with 3 and 2 degrees of freedom, SciPy 1.17.1.
const OF_FOUR_UNITS: f64 = 3.182_446_305_283_708;
const OF_THREE_UNITS: f64 = 4.302_652_729_749_462;

/// Four tightenings that each know a cubic stiffness of 1000 with curvature 1, and pull at it so hard to either side.
fn cubic(pull: f64) -> Fitted {
    Fitted::made_up(&[CubicStiffness], &[100.0; 4], 100).with_shared(
        ("k3_n_per_m3", 3, 1000.0),
        &[(1.0, pull), (1.0, -pull), (1.0, pull), (1.0, -pull)],
    )
}

fn error(fitted: &Fitted) -> f64 {
    fitted
        .shared_errors()
        .expect("the curvature can be inverted")[0]
}

/// S = 4; noise gives 1/√4 whatever the clusters say, as long as they pull less than that.
#[test]
fn noise_alone_makes_at_least_the_error_of_the_curvature() {
    close(error(&cubic(0.1)), 0.5, 1e-12);
}

/// S⁻¹ Σ g² S⁻¹ = 16/16, times 4 / (4 − 1) for the parameter that was fitted.
#[test]
fn units_that_pull_apart_widen_the_error_beyond_that_of_noise() {
    close(error(&cubic(2.0)), (4.0_f64 / 3.0).sqrt(), 1e-12);
}

#[test]
fn without_a_known_noise_the_error_is_what_units_pull_alone() {
    let expected = (0.04 / 16.0 * 4.0 / 3.0_f64).sqrt();
    close(error(&cubic(0.1).unweighted()), expected, 1e-12);
}

#[test]
fn a_shared_size_has_student_s_interval_over_units() {
    let sizes = parameters(&[exact(0, &[], &[])], &cubic(0.1), CubicStiffness);
    let [size] = sizes.as_slice() else {
        panic!("a cubic spring has one number")
    };
    assert_eq!((size.name.as_str(), size.value), ("k3_n_per_m3", 1000.0));
    let (low, high) = (size.low.expect("low"), size.high.expect("high"));
    close(high - low, 2.0 * 0.5 * OF_FOUR_UNITS, 1e-9);
    close(high + low, 2000.0, 1e-12);
    assert!(!size.per_tightening && size.spread.is_none());
    assert_eq!(
        (size.minimum, size.maximum),
        (-5e6, 5e6),
        "what is plausible"
    );
}

/// A gap cannot be negative: the fit may reach 0 to 50 mm.
#[test]
fn an_interval_ends_where_the_parameter_does_and_a_size_on_its_limit_has_none() {
    let cases = [exact(0, &[], &[])];
    let gap = |value: f64| {
        // A standard error of 1 mm.
        let fitted = Fitted::made_up(&[Backlash], &[100.0; 4], 100)
            .with_shared(("gap_m", 3, value), &[(2.5e5, 0.0); 4]);
        parameters(&cases, &fitted, Backlash).remove(0)
    };
    let small = gap(0.001);
    assert_eq!(small.low, Some(0.0));
    close(
        small.high.expect("high"),
        0.001 + 0.001 * OF_FOUR_UNITS,
        1e-9,
    );
    let none = gap(0.0);
    assert_eq!(
        (none.standard_error, none.low, none.high),
        (None, None, None)
    );
}

/// Four units of curvature c each: a standard error of 1/√(4 c), and 3.18 of them to either side.
#[test]
fn a_size_is_told_from_nothing_where_its_interval_excludes_it() {
    let cases = [exact(0, &[], &[])];
    let cubic = |value: f64, curvature: f64| {
        let fitted = Fitted::made_up(&[CubicStiffness], &[100.0; 4], 100)
            .with_shared(("k3_n_per_m3", 3, value), &[(curvature, 0.0); 4]);
        is_told_from_nothing(&cases, &fitted, CubicStiffness)
    };
    assert!(cubic(1.6, 1.0) && cubic(-1.6, 1.0));
    assert!(!cubic(1.58, 1.0) && !cubic(-1.58, 1.0));
    assert!(!cubic(1e6, 0.0), "of which the data know nothing");
    // A rigid forearm is out of reach of a second mass' limits (50 g to 1000 t): the interval must lie within them.
    let second = |value: f64, error: f64| {
        let fitted = Fitted::made_up(&[SecondMass], &[100.0; 4], 100)
            .with_shared(("m2_kg", 3, value), &[(0.25 / (error * error), 0.0); 4]);
        is_told_from_nothing(&cases, &fitted, SecondMass)
    };
    assert!(second(9.0, 1.0) && second(90.0, 4.0));
    assert!(!second(9.0, 4.0) && !second(9e5, 4e4));
}

/// 1, 2, 6: mean 3, standard deviation √7.
#[test]
fn a_size_of_every_tightening_s_own_is_a_mean_with_its_spread() {
    let own = [1.0, 2.0, 6.0].map(|bias| vec![2.0, 90.0, 2200.0, bias]);
    let names = [
        "mass_kg",
        "damping_kg_per_s",
        "stiffness_n_per_m",
        "bias_rad_per_s2",
    ];
    let fitted =
        Fitted::made_up(&[AccelerationBias], &[100.0; 3], 100).with_own(&names, own.to_vec(), 1);
    let size = parameters(&[exact(0, &[], &[])], &fitted, AccelerationBias).remove(0);
    assert!(size.per_tightening);
    close(size.value, 3.0, 1e-12);
    close(
        size.spread.expect("three have a spread"),
        7.0_f64.sqrt(),
        1e-12,
    );
    let error = (7.0_f64 / 3.0).sqrt();
    close(size.standard_error.expect("an error"), error, 1e-12);
    close(size.high.expect("high"), 3.0 + OF_THREE_UNITS * error, 1e-9);
}

#[test]
fn one_tightening_alone_has_no_interval_of_its_own_size() {
    let names = [
        "mass_kg",
        "damping_kg_per_s",
        "stiffness_n_per_m",
        "bias_rad_per_s2",
    ];
    let own = vec![vec![2.0, 90.0, 2200.0, 0.5]];
    let fitted = Fitted::made_up(&[AccelerationBias], &[100.0], 100).with_own(&names, own, 1);
    let size = parameters(&[exact(0, &[], &[])], &fitted, AccelerationBias).remove(0);
    assert_eq!(
        (size.value, size.standard_error, size.high),
        (0.5, None, None)
    );
}

#[test]
fn what_all_share_is_held_in_each_model_and_known_as_well_as_stated() {
    let case = exact(0, &[], &[]);
    let model = held(&case, &cubic(0.1), 0, Some(&[0.5])).expect("the effects go together");
    let cubic = &model.parameters()[3];
    assert_eq!((cubic.value, cubic.fixed), (1000.0, true));
    assert_eq!(cubic.standard_error, Some(0.5));
    assert_eq!(model.free(), [0, 1, 2], "m, c, k stay its own");
}
