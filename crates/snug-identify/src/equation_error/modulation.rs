//! Averages with a smooth weight that is 0 at both ends, so that what was not measured comes of what was by parts
//! (modulating functions): ∫ φ α = −∫ φ' ω = ∫ φ'' θ, and no noisy derivative is taken.
//!
//! Source: Shinbrot 1957; Preisig and Rippin 1993.

/// φ(u) = (1 − u²)⁴ between −1 and 1 over some samples, of mean 1, and what stands for it under derivatives.
#[derive(Debug, Clone)]
pub struct Modulation {
    /// φ \[–\]: makes the mean of what it weighs.
    pub of_value: Vec<f64>,
    /// −φ' \[1/s\]: makes the mean rate of what it weighs.
    pub of_slope: Vec<f64>,
    /// φ'' \[1/s²\]: makes the mean of its second derivative.
    pub of_curvature: Vec<f64>,
}

impl Modulation {
    /// Over `half_width` samples to either side, `interval_s` apart.
    pub fn new(half_width: usize, interval_s: f64) -> Self {
        let (half, per_s) = (half_width as f64, 1.0 / (half_width as f64 * interval_s));
        let places: Vec<f64> = (0..=2 * half_width)
            .map(|index| index as f64 / half - 1.0)
            .collect();
        let each = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            places.iter().map(|&u| f(u, 1.0 - u * u)).collect()
        };
        let of_value = each(&|_, w| w.powi(4));
        let sum: f64 = of_value.iter().sum();
        let of_value: Vec<f64> = of_value.iter().map(|value| value / sum).collect();
        let of_slope = each(&|u, w| 8.0 * u * w.powi(3));
        let of_curvature = each(&|u, w| 48.0 * u * u * w * w - 8.0 * w.powi(3));
        // As sums of few samples they are not quite what they are as integrals: a constant has no rate and no curvature, however
        // large it is, a straight line has its slope, and a parabola its curvature.
        let constant: f64 = of_curvature.iter().sum();
        let of_curvature: Vec<f64> = (of_curvature.iter().zip(&of_value))
            .map(|(curvature, value)| curvature - constant * value)
            .collect();
        let moment = |of: &[f64], power: i32| -> f64 {
            let terms = of.iter().zip(&places);
            terms.map(|(weight, u)| weight * u.powi(power)).sum()
        };
        let (slope, curvature) = (moment(&of_slope, 1), moment(&of_curvature, 2));
        let scaled = |of: Vec<f64>, by: f64| of.into_iter().map(|value| value * by).collect();
        Self {
            of_value,
            of_slope: scaled(of_slope, per_s / slope),
            of_curvature: scaled(of_curvature, 2.0 * per_s * per_s / curvature),
        }
    }
}

/// Value and slope, in the middle of some samples, of the cubic that fits them best (Savitzky and Golay 1964).
#[derive(Debug, Clone)]
pub(crate) struct CubicWeights {
    /// Makes the value.
    pub of_value: Vec<f64>,
    /// Makes the slope per sample.
    pub of_slope: Vec<f64>,
}

impl CubicWeights {
    /// Over `half_width` samples to either side, two at least.
    pub fn new(half_width: usize) -> Self {
        let h = half_width as f64;
        let places = || (0..=2 * half_width).map(|index| index as f64 - h);
        let odd = (2.0 * h - 1.0) * (2.0 * h + 1.0) * (2.0 * h + 3.0);
        let value = |i: f64| 3.0 * (3.0 * h * h + 3.0 * h - 1.0 - 5.0 * i * i) / odd;
        let first = 5.0 * (3.0 * h.powi(4) + 6.0 * h.powi(3) - 3.0 * h + 1.0);
        let third = 7.0 * (3.0 * h * h + 3.0 * h - 1.0);
        let all = (h - 1.0) * h * (h + 1.0) * (h + 2.0) * odd;
        let slope = |i: f64| 5.0 * (first * i - third * i.powi(3)) / all;
        Self {
            of_value: places().map(value).collect(),
            of_slope: places().map(slope).collect(),
        }
    }
}

/// ∫ by trapezoids, from 0.
pub fn integral(rate: &[f64], interval_s: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let mut before = None;
    let next = |&rate: &f64| {
        sum += before.map_or(0.0, |before: f64| 0.5 * interval_s * (before + rate));
        before = Some(rate);
        sum
    };
    rate.iter().map(next).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use snug_least_squares::matrix::dot;

    /// 1000 + x² on a grid of 0.5 s: the mean of its second derivative is 2, of its first 2 x, by parts, however few samples.
    #[test]
    fn derivatives_come_by_parts() {
        for half_width in [3_u32, 4, 9] {
            let weights = Modulation::new(half_width as usize, 0.5);
            let x = |index: u32| 0.5 * f64::from(index);
            let signal: Vec<f64> = (0..=2 * half_width)
                .map(|index| 1000.0 + x(index).powi(2))
                .collect();
            let slope = dot(&signal, &weights.of_slope);
            assert!((slope - 2.0 * x(half_width)).abs() < 1e-9);
            assert!((dot(&signal, &weights.of_curvature) - 2.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_cubic_is_found_with_its_slope() {
        for half_width in [2, 3, 10] {
            let weights = CubicWeights::new(half_width);
            let at = |index: usize| index as f64 - half_width as f64;
            let cubic = |x: f64| 0.3 - 0.2 * x + 0.01 * x * x - 2e-3 * x.powi(3);
            let signal: Vec<f64> = (0..=2 * half_width).map(|index| cubic(at(index))).collect();
            assert!((dot(&signal, &weights.of_value) - 0.3).abs() < 1e-12);
            assert!((dot(&signal, &weights.of_slope) + 0.2).abs() < 1e-12);
        }
    }

    #[test]
    fn a_straight_line_is_integrated_exactly() {
        let line: Vec<f64> = (0..5).map(|index| 3.0 + f64::from(index)).collect();
        assert_eq!(integral(&line, 2.0), [0.0, 7.0, 16.0, 27.0, 40.0]);
    }
}
