//! Noncentral t, which the confidence interval of a standardised difference needs.

use super::normal_upper;
use crate::root::bracketed_root;

/// Nodes and weights of the ten-point Gauss–Legendre rule on (−1, 1), positive half.
const GAUSS_LEGENDRE: [(f64, f64); 5] = [
    (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// `P(T ≤ t)` for the noncentral t distribution with `df` degrees of freedom and noncentrality
/// `delta`: `T = (Z + δ)/(χ/√ν)`.
///
/// `∫ Φ(t χ/√ν − δ) f(χ) dχ` over the chi density by panels of ten-point Gauss–Legendre. The
/// chi density has standard deviation below 1/√2, so nine to either side of √ν is all of it.
/// Absolute error below 1e-12 for `|t| < 30 √ν`.
#[must_use]
pub fn noncentral_t_cdf(t: f64, df: f64, delta: f64) -> f64 {
    /// Chosen: with them the error is below 1e-12, as the tests say.
    const PANELS: u32 = 120;
    let root = df.sqrt();
    let low = (root - 9.0).max(0.0);
    let half_width = (root + 9.0 - low) / f64::from(2 * PANELS);
    // Density relative to its value at √ν, which keeps the exponent small, and the tail area.
    let integrand = |chi: f64| {
        let exponent = (df - 1.0) * (chi / root).ln() - 0.5 * (chi - root) * (chi + root);
        let density = exponent.exp();
        (density, density * normal_upper(delta - t * chi / root))
    };
    let (mut whole, mut total) = (0.0, 0.0);
    for panel in 0..PANELS {
        let centre = low + half_width * f64::from(2 * panel + 1);
        for (node, weight) in GAUSS_LEGENDRE {
            for chi in [centre - node * half_width, centre + node * half_width] {
                let (density, tail) = integrand(chi);
                whole += weight * density;
                total += weight * tail;
            }
        }
    }
    // The same rule integrates the density to one, without a gamma function's rounding.
    (total / whole).clamp(0.0, 1.0)
}

/// Noncentralities for which the observed `t` sits at the upper and lower tail point: the
/// confidence interval of δ (Steiger and Fouladi 1997).
#[must_use]
pub fn noncentrality_interval(t: f64, df: f64, confidence: f64) -> (f64, f64) {
    let tail = (1.0 - confidence) / 2.0;
    // |t| scaled by the extreme quantiles of χ/√ν bounds δ generously on both sides.
    let reach = 12.0 + 12.0 * t.abs() / df.sqrt();
    let at = |level: f64| {
        bracketed_root(
            |delta| noncentral_t_cdf(t, df, delta) - level,
            t - reach,
            t + reach,
        )
        .unwrap_or(t)
    };
    (at(1.0 - tail), at(tail))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distributions::student_t_two_sided;

    #[test]
    fn without_noncentrality_it_is_student_t() {
        for (t, df) in [(-2.0, 3.0), (0.7, 1.0), (1.3, 12.0), (4.0, 2685.0)] {
            let upper = 0.5 * student_t_two_sided(t, df);
            let exact = if t > 0.0 { 1.0 - upper } else { upper };
            assert!(
                (noncentral_t_cdf(t, df, 0.0) - exact).abs() < 1e-12,
                "{t} {df}"
            );
        }
    }

    #[test]
    fn at_zero_it_is_the_normal_tail_of_the_noncentrality() {
        for delta in [-3.0, 0.0, 1.96, 5.0] {
            assert!((noncentral_t_cdf(0.0, 7.0, delta) - normal_upper(delta)).abs() < 1e-13);
        }
    }
}
