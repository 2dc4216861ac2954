//! How clearly a sum over clusters differs from zero, when a few loud clusters may carry most of it.

use crate::pooled::fitted::Fitted;
use crate::ranking::thresholds::CHANCE;
use snug_least_squares::matrix::inner_product as dot;
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// What held-out clusters lose in squared residual.
pub(crate) fn gains(heldout: &[f64], fitted: &Fitted) -> Vec<f64> {
    let with = fitted.heldout_beyond_torque_noise();
    heldout
        .iter()
        .zip(with)
        .map(|(before, after)| before - after)
        .collect()
}

/// Standard error of Σ x over independent clusters.
pub(crate) fn spread_of_sum(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    if n < 2.0 {
        return f64::INFINITY;
    }
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
    (squares * n / (n - 1.0)).sqrt()
}

/// Standard deviations by which Σ x exceeds 0: the larger of the plain one and that of x bounded at `CHANCE` times
/// `scale`, which one loud cluster cannot hide. Vuong's statistic where x are differences between two models.
pub(crate) fn clearness(values: &[f64], scale: f64) -> f64 {
    let (plain, bounded) = statistics(values, scale);
    plain.max(bounded)
}

/// Standard deviations by which most x exceed 0, whatever a loud one says: Σ of the bounded x over their length.
pub(crate) fn agreement(values: &[f64], scale: f64) -> f64 {
    let within_chance = CHANCE * scale;
    let bounded: Vec<f64> = values
        .iter()
        .map(|x| x / (x * x + within_chance * within_chance).sqrt())
        .collect();
    match dot(&bounded, &bounded).sqrt() {
        0.0 => 0.0,
        length => bounded.iter().sum::<f64>() / length,
    }
}

/// Chance of a Σ x so clearly above 0 where each x is as likely to be below as above.
pub(crate) fn chance(values: &[f64], scale: f64) -> f64 {
    let (plain, bounded) = statistics(values, scale);
    let freedom = values.len().saturating_sub(1).max(1) as f64;
    let of_plain = StudentsT::new(0.0, 1.0, freedom).map_or(1.0, |t| t.sf(plain));
    // A sum of bounded symmetric terms over its length is as a normal one at most (Efron 1969).
    let of_bounded = Normal::standard().sf(bounded);
    of_plain.min(of_bounded)
}

/// Σ x over its standard error, and Σ of the bounded x over their length; the second only where Σ x is positive. Both are 0
/// where Σ x or its error is beyond all numbers: a model that runs away says nothing.
fn statistics(values: &[f64], scale: f64) -> (f64, f64) {
    let sum: f64 = values.iter().sum();
    let plain = sum / spread_of_sum(values);
    if sum == 0.0 || plain.is_nan() {
        return (0.0, 0.0);
    }
    match sum > 0.0 {
        true => (plain, agreement(values, scale)),
        false => (plain, plain),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::close;

    /// 1, 2, 3, 4: variance 5/3, of the sum of four 20/3.
    #[test]
    fn a_sum_scatters_by_the_root_of_n_times_the_standard_deviation() {
        close(
            spread_of_sum(&[1.0, 2.0, 3.0, 4.0]),
            (20.0_f64 / 3.0).sqrt(),
            1e-12,
        );
        assert_eq!(
            spread_of_sum(&[7.0]),
            f64::INFINITY,
            "one cluster has no scatter"
        );
        assert_eq!(spread_of_sum(&[]), f64::INFINITY);
    }

    /// Bounded at 4 · 0.75 = 3: 4 becomes 0.8, −4 as much the other way, 0 nothing.
    #[test]
    fn loud_units_count_hardly_more_than_once() {
        close(agreement(&[4.0, 4.0, 4.0, -4.0], 0.75), 1.0, 1e-12);
        close(agreement(&[4e9, 4e9, 4e9, -4e9], 0.75), 1.0, 1e-9);
        // Far within chance they count by their size: 10 / √30.
        close(
            agreement(&[1.0, 2.0, 3.0, 4.0], 1e9),
            10.0 / 30.0_f64.sqrt(),
            1e-9,
        );
        assert_eq!(agreement(&[0.0; 4], 1.0), 0.0);
    }

    #[test]
    fn the_clearer_of_both_statistics_speaks_for_a_gain_the_plain_one_against() {
        let plain = 10.0 / (20.0_f64 / 3.0).sqrt();
        close(clearness(&[1.0, 2.0, 3.0, 4.0], 1e9), plain, 1e-9);
        close(clearness(&[-1.0, -2.0, -3.0, -4.0], 1e9), -plain, 1e-9);
        assert_eq!(clearness(&[0.0; 4], 1.0), 0.0);
    }

    /// SciPy 1.17.1: `t.sf(10 / sqrt(20 / 3), 3)` = 0.01523; `norm.sf(10 / sqrt(30))` = 0.0339 is more.
    /// Eight of eight loud ones: `norm.sf(sqrt(8))` = 0.002339, where Student's t sees one only.
    #[test]
    fn chance_is_student_s_of_the_sum_or_the_normal_one_of_the_bounded() {
        close(
            chance(&[1.0, 2.0, 3.0, 4.0], 1e9),
            0.015_233_145_831_085_489,
            1e-9,
        );
        let mut loud = [1e5; 8];
        loud[0] = 1e9;
        close(chance(&loud, 1.0), 0.002_338_867_490_523_6, 1e-6);
    }

    #[test]
    fn what_is_beyond_all_numbers_says_nothing() {
        for values in [
            [f64::INFINITY, 1.0],
            [f64::NAN, 1.0],
            [1e200, -1e180],
            [1e308; 2],
        ] {
            let (chance, clearness) = (chance(&values, 1.0), clearness(&values, 1.0));
            assert!(
                chance >= 0.5 && clearness <= 0.0,
                "{values:?}: {chance} {clearness}"
            );
        }
    }

    #[test]
    fn one_loud_unit_does_not_hide_what_all_agree_on() {
        let mut values = vec![20.0; 20];
        values[0] = 1e5;
        assert!(
            spread_of_sum(&values) > 9e4,
            "the plain statistic sees one cluster only"
        );
        assert!(clearness(&values, 1.0) > 4.0);
    }

    #[test]
    fn what_most_say_is_heard_beside_one_loud_unit_that_says_the_contrary() {
        let mut values = vec![20.0; 20];
        values[0] = -1e5;
        assert!(clearness(&values, 1.0) < 0.0);
        assert!(agreement(&values, 1.0) > 3.0);
    }

    #[test]
    fn one_loud_unit_alone_is_no_evidence() {
        let mut values: Vec<f64> = (0..20)
            .map(|i| if i % 2 == 0 { 9.0 } else { -9.0 })
            .collect();
        values[0] = 1e5;
        assert!(clearness(&values, 1.0) < 1.5);
    }

    /// 22 of 24 clusters gain much: a chance of 1.8e-5 for fair coins (300 / 2²⁴).
    #[test]
    fn the_chance_of_what_nearly_all_agree_on_is_that_of_coins() {
        let mut values: Vec<f64> = (0..24).map(|i| 1e3 * f64::from(i * i)).collect();
        values[0] = -500.0;
        values[1] = -500.0;
        let found = chance(&values, 1.0);
        assert!((0.3e-5..4e-5).contains(&found), "{found:e}");
        assert!(chance(&[-1.0, -2.0, -3.0], 1.0) > 0.5);
    }
}
