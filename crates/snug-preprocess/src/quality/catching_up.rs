//! Stretches of one repeated value after which a motion jumps: a logger that dropped out and caught up, not a rig that rested.

use super::spikes::typical_difference;
use super::stuck;
use std::ops::Range;

/// Runs of at least `shortest` identical samples that end in a jump of more than `threshold_sd` standard deviations of the differences between
/// neighbours: a rig that rested sets out from where it stood.
pub(crate) fn find(samples: &[f64], shortest: usize, threshold_sd: f64) -> Vec<Range<usize>> {
    let typical = typical_difference(samples, 0..samples.len());
    let jumps = |run: &Range<usize>| {
        let next = samples.get(run.end);
        next.is_some_and(|next| (next - samples[run.start]).abs() > threshold_sd * typical)
    };
    let mut runs = stuck::find(samples, shortest, &[]);
    runs.retain(jumps);
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sine of 100 samples a period.
    fn swing() -> Vec<f64> {
        (0..2000)
            .map(|k| (f64::from(k) * std::f64::consts::TAU / 100.0).sin())
            .collect()
    }

    #[test]
    fn what_was_held_while_it_went_on_is_found() {
        let mut samples = swing();
        let held = samples[500];
        samples[500..550].fill(held);
        assert!(find(&samples, 2, 12.0).is_empty(), "it came back by then");
        samples[1000..1030].fill(held);
        assert_eq!(find(&samples, 2, 12.0), vec![1000..1030]);
    }

    #[test]
    fn a_rig_that_rests_sets_out_from_where_it_stood() {
        let mut samples = swing();
        let (before, after) = (samples[..525].to_vec(), samples[525..].to_vec());
        samples = [before, vec![1.0; 300], after].concat();
        assert!(find(&samples, 2, 12.0).is_empty());
    }
}
