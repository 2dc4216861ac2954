//! Values between samples, as a signal without anything above half the sampling rate has them.

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::cell::RefCell;
use std::f64::consts::PI;
use std::sync::Arc;

/// Grid values, `factor` per sample, whose straight-line interpolation has the samples' own spectrum below half the
/// sampling rate.
///
/// The record is continued by reflection at both ends, so that it has no jump for the Fourier transform to ring on; each
/// spectral line is divided by sinc²(f Δ), which is what drawing straight lines between grid points Δ apart costs it.
/// Returns `factor · (n − 1) + 1` values; the images beyond the grid's own half rate are weakened by at least
/// (2·factor − 1)² and then filtered by the plant.
pub fn straight_pieces(samples: &[f64], factor: usize) -> Vec<f64> {
    refined(samples, factor, |angle| {
        let sinc = if angle == 0.0 {
            1.0
        } else {
            angle.sin() / angle
        };
        1.0 / (sinc * sinc)
    })
}

/// The samples and, `factor − 1` between each two, what a signal without anything above half the sampling rate has there.
pub fn between_samples(samples: &[f64], factor: usize) -> Vec<f64> {
    refined(samples, factor, |_| 1.0)
}

/// A grid `factor` times as fine; a spectral line of π f Δ, Δ its interval, is weighed by `lift`.
fn refined(samples: &[f64], factor: usize, lift: impl Fn(f64) -> f64) -> Vec<f64> {
    let n = samples.len();
    if n < 2 {
        return samples.to_vec();
    }
    let period = 2 * (n - 1);
    let mut periodic: Vec<f64> = samples
        .iter()
        .chain(samples[1..n - 1].iter().rev())
        .copied()
        .collect();
    let Plan { forward, fine, .. } = Plan::of(period, period * factor);
    let mut lines = forward.make_output_vec();
    forward
        .process(&mut periodic, &mut lines)
        .expect("buffers were made by the plan");

    let mut fine_lines = fine.make_input_vec();
    for (index, line) in lines.iter().enumerate() {
        let angle = PI * index as f64 / (period * factor) as f64;
        let half = if index == period / 2 { 0.5 } else { 1.0 };
        fine_lines[index] = line * (half * lift(angle) / period as f64);
    }
    // A reflected record is even, so its lines are real; rounding may leave an imaginary rest where none is allowed.
    fine_lines[0].im = 0.0;
    if let Some(last) = fine_lines.last_mut() {
        last.im = 0.0;
    }
    let mut grid = fine.make_output_vec();
    fine.process(&mut fine_lines, &mut grid)
        .expect("buffers were made by the plan and the real lines are real");
    grid.truncate(factor * (n - 1) + 1);
    // Kept for as long as the input is: without the room of its reflection.
    grid.shrink_to_fit();
    grid
}

/// How records of one length are transformed, and finer ones back.
#[derive(Clone)]
struct Plan {
    lengths: (usize, usize),
    forward: Arc<dyn RealToComplex<f64>>,
    fine: Arc<dyn ComplexToReal<f64>>,
}

thread_local! {
    /// The last one: tightenings of one campaign have the same length, and a plan takes longer to make than to use.
    static LATEST: RefCell<Option<Plan>> = const { RefCell::new(None) };
}

impl Plan {
    fn of(period: usize, fine: usize) -> Self {
        let lengths = (period, fine);
        LATEST.with_borrow_mut(|latest| match latest {
            Some(plan) if plan.lengths == lengths => plan.clone(),
            _ => {
                let mut planner = RealFftPlanner::new();
                let plan = Self {
                    lengths,
                    forward: planner.plan_fft_forward(period),
                    fine: planner.plan_fft_inverse(fine),
                };
                latest.insert(plan).clone()
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cosine that reflection continues exactly: the grid values must be the cosine over sinc² of its frequency.
    #[test]
    fn a_cosine_comes_back_as_the_cosine_that_straight_lines_flatten_to_it() {
        let (n, cycles, factor) = (129, 50.0, 8);
        let cosine = |position: f64| (2.0 * PI * cycles * position / 256.0).cos();
        let samples: Vec<f64> = (0..n).map(|i| cosine(i as f64)).collect();
        let grid = straight_pieces(&samples, factor);
        let angle = PI * cycles / (256.0 * factor as f64);
        let lift = (angle / angle.sin()).powi(2);
        assert_eq!(grid.len(), factor * (n - 1) + 1);
        for (index, value) in grid.iter().enumerate() {
            let expected = lift * cosine(index as f64 / factor as f64);
            assert!((value - expected).abs() < 1e-12, "grid point {index}");
        }
    }
}
