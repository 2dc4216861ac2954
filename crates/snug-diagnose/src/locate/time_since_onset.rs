//! The misfit over the time since the pulse began.

use super::aspect::{View, sums};
use super::grid::{Grid, round_up};
use super::residual::Residuals;
use crate::locate::thresholds::{MOST_TIME_BINS, WIDTH_S};
use rayon::prelude::*;

/// Earliest and latest time since the onset that any tightening has \[s\].
pub fn range_s(residuals: &Residuals<'_>) -> Option<(f64, f64)> {
    residuals
        .all
        .iter()
        .filter(|one| residuals.is_timed(one))
        .map(|one| {
            let samples = one.samples();
            (one.time_s(samples.start), one.time_s(samples.end - 1))
        })
        .reduce(|(low, high), (from, to)| (low.min(from), high.max(to)))
}

/// Bins of 20 ms, the time before the onset included; wider where there would be more than 40.
pub fn view(residuals: &Residuals<'_>) -> Option<View> {
    let (low, high) = range_s(residuals)?;
    let width = if (high - low) / WIDTH_S <= MOST_TIME_BINS {
        WIDTH_S
    } else {
        round_up((high - low) / MOST_TIME_BINS)
    };
    let grid = Grid::of_width(low, high, width);
    let sums = residuals
        .all
        .par_iter()
        .map(|one| {
            let timed = residuals.is_timed(one);
            sums(one, grid.bins, |index| {
                grid.bin(one.time_s(index)).filter(|_| timed)
            })
        })
        .collect();
    Some(View {
        aspect: "time_since_onset_s",
        parts: grid.parts("s"),
        sums,
    })
}
