//! Window times to sample ranges; the original keeps one sample fewer than its length calls for.

use std::ops::Range;

/// Samples kept by the `snug` preset: as many as the length calls for, 0-based \[start, start + length).
pub(crate) fn snug(start_s: f64, length_s: f64, interval_s: f64) -> Range<usize> {
    let start = samples(start_s, interval_s);
    start..start + samples(length_s, interval_s)
}

/// Samples kept by the original program: one fewer, because it removes everything *from* its end index on.
///
/// At 10 kHz with 1.48 s and 0.3 s: 0-based \[14800, 17799), 2999 samples.
pub(crate) fn thesis(start_s: f64, length_s: f64, interval_s: f64) -> Range<usize> {
    let start = samples(start_s, interval_s);
    start..start + samples(length_s, interval_s).saturating_sub(1)
}

/// Number of sampling intervals in `duration_s`, rounded.
pub(crate) fn samples(duration_s: f64, interval_s: f64) -> usize {
    (duration_s / interval_s).round() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_original_keeps_2999_samples_from_14801() {
        let kept = thesis(1.48, 0.3, 1e-4);
        assert_eq!(kept, 14_800..17_799);
        assert_eq!(kept.len(), 2999);
        assert_eq!(snug(1.48, 0.3, 1e-4), 14_800..17_800);
    }

    #[test]
    fn scales_with_the_rate() {
        assert_eq!(snug(1.48, 0.3, 1.0 / 5000.0), 7400..8900);
        assert_eq!(thesis(0.0, 0.0, 1e-4), 0..0);
    }
}
