//! The misfit over how far the tool has turned.

use super::aspect::{View, sums};
use super::grid::{Grid, round_up};
use super::residual::{Residuals, White};
use crate::locate::thresholds::MOST_AMPLITUDE_BINS;
use rayon::prelude::*;

/// The measured angle \[rad\]; the simulated one where none is measured.
fn angle<'a>(one: &White<'a>) -> Option<&'a [f64]> {
    let measured = one.seen.tightening.motion.displacement_rad.as_deref();
    measured.or(one.seen.simulated.displacement_rad.as_deref())
}

/// Bins of |θ|.
pub fn view(residuals: &Residuals<'_>) -> Option<View> {
    let largest = residuals
        .all
        .iter()
        .filter_map(angle)
        .flatten()
        .map(|angle| angle.abs())
        .filter(|angle| angle.is_finite())
        .reduce(f64::max)
        .filter(|largest| *largest > 0.0)?;
    let grid = Grid::of_width(0.0, largest, round_up(largest / MOST_AMPLITUDE_BINS));
    let sums = residuals
        .all
        .par_iter()
        .map(|one| {
            let angle = angle(one);
            sums(one, grid.bins, |index| grid.bin(angle?.get(index)?.abs()))
        })
        .collect();
    Some(View {
        aspect: "amplitude_rad",
        parts: grid.parts("rad"),
        sums,
    })
}
