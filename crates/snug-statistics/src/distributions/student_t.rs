//! Student's t: tails and quantiles.

use super::{LARGE_FREEDOM, normal_quantile, normal_two_sided, regularized_beta};
use crate::root::bracketed_root;

/// `P(|T| ≥ |t|)` for Student's t with `df` degrees of freedom.
#[must_use]
pub fn student_t_two_sided(t: f64, df: f64) -> f64 {
    if df > LARGE_FREEDOM {
        normal_two_sided(t)
    } else {
        regularized_beta(df / 2.0, 0.5, df / (df + t * t))
    }
}

/// The t with `P(T ≤ t) = p` for Student's t with `df` degrees of freedom, p strictly between
/// 0 and 1.
#[must_use]
pub fn student_t_quantile(p: f64, df: f64) -> f64 {
    let tails = 2.0 * p.min(1.0 - p);
    if tails >= 1.0 {
        return 0.0;
    }
    if df > LARGE_FREEDOM {
        return normal_quantile(p);
    }
    let mut high = 1.0;
    while student_t_two_sided(high, df) > tails && high < 1e150 {
        high *= 2.0;
    }
    // The logarithm keeps the root well scaled far out in the tail.
    let excess = |t: f64| (student_t_two_sided(t, df) / tails).ln();
    let t = bracketed_root(excess, 0.0, high).unwrap_or(high);
    if p < 0.5 { -t } else { t }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_degree_of_freedom_is_cauchy() {
        for t in [1e-3_f64, 0.5, 1.0, 12.7, 1e6] {
            let exact = 2.0 * (1.0 / t).atan() / std::f64::consts::PI;
            assert!(
                (student_t_two_sided(t, 1.0) / exact - 1.0).abs() < 1e-12,
                "{t}"
            );
        }
        for p in [1e-9_f64, 0.025, 0.4, 0.975] {
            let exact = -(std::f64::consts::PI * p).tan().recip();
            assert!(
                (student_t_quantile(p, 1.0) / exact - 1.0).abs() < 1e-11,
                "{p}"
            );
        }
    }

    #[test]
    fn two_degrees_of_freedom_have_a_closed_form() {
        for p in [0.001_f64, 0.05, 0.5, 0.9, 0.995] {
            let exact = (2.0 * p - 1.0) / (2.0 * p * (1.0 - p)).sqrt();
            assert!((student_t_quantile(p, 2.0) - exact).abs() < 1e-11 * exact.abs().max(1.0));
        }
    }
}
