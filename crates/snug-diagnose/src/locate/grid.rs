//! Equal bins along one coordinate, and how their edges are written.

use super::aspect::Part;
use crate::locate::thresholds::EDGE;
use snug_campaign::words::number::without_last_digits;

/// `bins` bins of `width` from `origin` on.
#[derive(Debug, Clone, Copy)]
pub struct Grid {
    pub origin: f64,
    pub width: f64,
    pub bins: usize,
}

impl Grid {
    /// Bins whose edges are whole multiples of `width`, over all of `low` to `high`.
    pub fn of_width(low: f64, high: f64, width: f64) -> Self {
        let first = (low / width + EDGE).floor();
        let last = (high / width + EDGE).floor();
        Self {
            origin: first * width,
            width,
            bins: (last - first) as usize + 1,
        }
    }

    /// Exactly `bins` bins from `low` to `high`; `None` when these are not a range.
    pub fn of_count(low: f64, high: f64, bins: usize) -> Option<Self> {
        let width = (high - low) / bins as f64;
        (width > 0.0 && width.is_finite()).then_some(Self {
            origin: low,
            width,
            bins,
        })
    }

    /// The bin that holds `value`; the last one holds its upper edge as well.
    pub fn bin(&self, value: f64) -> Option<usize> {
        let position = (value - self.origin) / self.width + EDGE;
        if !(0.0..=self.bins as f64 + 2.0 * EDGE).contains(&position) {
            return None;
        }
        Some((position as usize).min(self.bins - 1))
    }

    /// Lower and upper edge of a bin.
    pub fn edges(&self, bin: usize) -> (f64, f64) {
        let from = self.origin + bin as f64 * self.width;
        (
            without_last_digits(from),
            without_last_digits(from + self.width),
        )
    }

    /// Every bin as a part of the campaign, named by its edges.
    pub fn parts(&self, unit: &str) -> Vec<Part> {
        let part = |bin| {
            let (from, to) = self.edges(bin);
            Part {
                name: format!("{from}..{to} {unit}"),
                from: Some(from),
                to: Some(to),
            }
        };
        (0..self.bins).map(part).collect()
    }

    /// Middle of every bin.
    pub fn centres(&self) -> Vec<f64> {
        (0..self.bins)
            .map(|bin| self.origin + (bin as f64 + 0.5) * self.width)
            .collect()
    }
}

/// The smallest 1, 2 or 5 times a power of ten that is not below `least` (positive).
pub fn round_up(least: f64) -> f64 {
    let power = 10_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0]
        .into_iter()
        .map(|step| step * power)
        .find(|step| *step >= least * (1.0 - EDGE))
        .unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn edges_are_round_and_every_value_has_its_bin() {
        let grid = Grid::of_width(-0.0021, 0.2979, 0.02);
        assert_eq!((grid.bins, grid.edges(0)), (16, (-0.02, 0.0)));
        assert_eq!(grid.edges(3), (0.04, 0.06));
        // 0.06 / 0.02 is 2.9999…96 in floating point.
        assert_eq!(grid.bin(0.06), Some(4));
        assert_eq!(grid.bin(-0.0001), Some(0));
        assert_eq!(grid.bin(0.3), Some(15));
        assert_eq!((grid.bin(-0.03), grid.bin(0.31)), (None, None));
        let count = Grid::of_count(1.0, 3.0, 4).unwrap();
        assert_eq!((count.bin(3.0), count.bin(1.0)), (Some(3), Some(0)));
        assert!(Grid::of_count(1.0, 1.0, 4).is_none());
    }

    #[test]
    fn steps_are_one_two_or_five() {
        for (least, step) in [(0.011, 0.02), (0.02, 0.02), (3.0, 5.0), (6.0, 10.0)] {
            assert!((round_up(least) / step - 1.0).abs() < 1e-12, "{least}");
        }
    }
}
