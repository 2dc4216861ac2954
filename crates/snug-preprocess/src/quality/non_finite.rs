//! Bridges short runs of missing samples, and says where the runs are that are too long for it.

use std::ops::Range;

/// Missing samples of one channel.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Missing {
    /// Runs that were short enough to be bridged.
    pub(crate) bridged: Vec<Range<usize>>,
    /// Runs too long for that; their samples are filled too, but must not be used.
    pub(crate) gaps: Vec<Range<usize>>,
}

impl Missing {
    /// Bridged samples inside `window`.
    pub(crate) fn bridged_in(&self, window: &Range<usize>) -> usize {
        self.bridged.iter().map(|run| overlap(run, window)).sum()
    }

    /// The first gap that reaches into `window`.
    pub(crate) fn gap_in(&self, window: &Range<usize>) -> Option<&Range<usize>> {
        self.gaps.iter().find(|gap| overlap(gap, window) > 0)
    }
}

fn overlap(run: &Range<usize>, window: &Range<usize>) -> usize {
    run.end
        .min(window.end)
        .saturating_sub(run.start.max(window.start))
}

/// Replaces every run of not-a-number or infinite samples by a straight line between its neighbours (by the one
/// neighbour at an end, by 0 without any), and says where they were; runs longer than `longest` are gaps.
pub(crate) fn bridge(samples: &mut [f64], longest: usize) -> Missing {
    let mut missing = Missing::default();
    let mut index = 0;
    while index < samples.len() {
        if samples[index].is_finite() {
            index += 1;
            continue;
        }
        let length = samples[index..]
            .iter()
            .take_while(|x| !x.is_finite())
            .count();
        let run = index..index + length;
        fill(samples, &run);
        index = run.end;
        if length <= longest {
            missing.bridged.push(run);
        } else {
            missing.gaps.push(run);
        }
    }
    missing
}

/// Puts a straight line between its neighbours in the place of a run.
pub(super) fn fill(samples: &mut [f64], run: &Range<usize>) {
    let before = run.start.checked_sub(1).map(|index| samples[index]);
    let after = samples.get(run.end).copied();
    let from = before.or(after).unwrap_or(0.0);
    let to = after.or(before).unwrap_or(0.0);
    let steps = (run.len() + 1) as f64;
    for (step, sample) in samples[run.clone()].iter_mut().enumerate() {
        *sample = from + (to - from) * (step + 1) as f64 / steps;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bridges_short_runs_and_names_long_ones() {
        let mut samples: Vec<f64> = (0..100).map(f64::from).collect();
        samples[0] = f64::NAN;
        samples[10] = f64::INFINITY;
        samples[11] = f64::NAN;
        for sample in &mut samples[50..70] {
            *sample = f64::NEG_INFINITY;
        }
        samples[99] = f64::NAN;
        let missing = bridge(&mut samples, 5);
        assert_eq!(missing.bridged, vec![0..1, 10..12, 99..100]);
        assert_eq!(missing.gaps, vec![50..70]);
        assert_eq!(samples[0], 1.0);
        assert_eq!(samples[99], 98.0);
        for index in (1..99).filter(|i| !(50..70).contains(i)) {
            assert!(
                (samples[index] - index as f64).abs() < 1e-12,
                "a line through a line"
            );
        }
        assert_eq!(missing.bridged_in(&(11..100)), 2);
        assert_eq!(missing.gap_in(&(0..51)), Some(&(50..70)));
        assert_eq!(missing.gap_in(&(70..90)), None);
    }

    #[test]
    fn nothing_but_missing_samples_is_one_gap() {
        let mut samples = vec![f64::NAN; 10];
        assert_eq!(bridge(&mut samples, 5).gaps, vec![0..10]);
        assert_eq!(samples, vec![0.0; 10]);
        assert_eq!(bridge(&mut [], 5), Missing::default());
    }
}
