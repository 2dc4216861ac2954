//! The root of a function of one variable between two bounds.

/// Root of a continuous function that changes sign between `low` and `high` (Brent 1973).
///
/// Runs until the bracket is a few units in the last place wide, so the root is as good as
/// `function` is. `None` when the ends have the same sign.
pub(crate) fn bracketed_root(
    mut function: impl FnMut(f64) -> f64,
    low: f64,
    high: f64,
) -> Option<f64> {
    let (mut previous, mut best) = (low, high);
    let (mut f_previous, mut f_best) = (function(previous), function(best));
    if f_previous != 0.0 && f_best != 0.0 && f_previous.signum() == f_best.signum() {
        return None;
    }
    let (mut opposite, mut f_opposite) = (previous, f_previous);
    let (mut step, mut step_before) = (best - previous, best - previous);
    for _ in 0..200 {
        if f_best.signum() == f_opposite.signum() {
            (opposite, f_opposite) = (previous, f_previous);
            step = best - previous;
            step_before = step;
        }
        if f_opposite.abs() < f_best.abs() {
            (previous, best, opposite) = (best, opposite, best);
            (f_previous, f_best, f_opposite) = (f_best, f_opposite, f_best);
        }
        let tolerance = 2.0 * f64::EPSILON * best.abs() + f64::MIN_POSITIVE;
        let half = 0.5 * (opposite - best);
        if half.abs() <= tolerance || f_best == 0.0 {
            break;
        }
        let (numerator, denominator) = interpolation(
            (previous, f_previous),
            (best, f_best),
            (opposite, f_opposite),
        );
        let limit = (3.0 * half * denominator - (tolerance * denominator).abs())
            .min((step_before * denominator).abs());
        if f_previous.abs() > f_best.abs() && 2.0 * numerator < limit {
            step_before = step;
            step = numerator / denominator;
        } else {
            step = half;
            step_before = half;
        }
        (previous, f_previous) = (best, f_best);
        best += if step.abs() > tolerance {
            step
        } else {
            tolerance.copysign(half)
        };
        f_best = function(best);
    }
    Some(best)
}

/// Secant or inverse quadratic step as a fraction with a non-negative numerator.
fn interpolation((a, f_a): (f64, f64), (b, f_b): (f64, f64), (c, f_c): (f64, f64)) -> (f64, f64) {
    let s = f_b / f_a;
    let (p, q) = if a == c {
        ((c - b) * s, 1.0 - s)
    } else {
        let (q, r) = (f_a / f_c, f_b / f_c);
        (
            s * ((c - b) * q * (q - r) - (b - a) * (r - 1.0)),
            (q - 1.0) * (r - 1.0) * (s - 1.0),
        )
    };
    if p > 0.0 { (p, -q) } else { (-p, q) }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn finds_known_roots_to_the_last_digits() {
        let root = bracketed_root(|x| x * x - 2.0, 0.0, 2.0).unwrap();
        assert!((root - 2.0_f64.sqrt()).abs() < 1e-15);
        let root = bracketed_root(|x| x.cos() - x, 0.0, 1.0).unwrap();
        assert!((root - 0.739_085_133_215_160_6).abs() < 1e-15);
        let root = bracketed_root(|x| (x - 1.0).powi(9), 0.0, 3.0).unwrap();
        assert!((root - 1.0).abs() < 1e-9);
    }

    #[test]
    fn refuses_a_bracket_without_sign_change() {
        assert!(bracketed_root(|x| x * x + 1.0, -1.0, 1.0).is_none());
    }
}
