//! What counts as one independent piece of evidence: a tightening, or, where there are few, a stretch of one.

use crate::data::machine::is_machine;
use crate::data::thresholds::{FEWEST_WHOLE, LONG_RECORD, SHORTEST_STRETCH, STRETCHES_WANTED};
use snug_campaign::words::reason::Cluster;
use snug_identify::FitTask;
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::ops::Range;

/// How tightenings are cut into clusters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Clusters {
    /// Clusters per tightening.
    pub per_case: usize,
}

impl Clusters {
    pub fn of(cases: &[FitTask<'_>]) -> Self {
        let scored = |case: &FitTask<'_>| case.measured().len().saturating_sub(case.unscored());
        Self::of_residuals(
            cases.iter().map(scored).collect(),
            cases.iter().all(is_machine),
        )
    }

    /// Of tightenings with so many residuals each. The usual one says how finely all are cut: one that broke off tells nothing of the others.
    fn of_residuals(mut residuals: Vec<usize>, are_of_machine: bool) -> Self {
        residuals.sort_unstable();
        let count = residuals.len();
        // Of an even number the fewer of the middle ones.
        let usual = residuals.get(count.saturating_sub(1) / 2);
        let usual = usual.copied().unwrap_or(0);
        // Hands differ from one tightening to the next; of a machine's recordings each is as good a part of all as a stretch is.
        let fewest_whole = match are_of_machine {
            true => STRETCHES_WANTED,
            false => FEWEST_WHOLE,
        };
        if count >= fewest_whole && usual < LONG_RECORD {
            return Self { per_case: 1 };
        }
        let room = usual / SHORTEST_STRETCH;
        Self {
            per_case: STRETCHES_WANTED
                .div_ceil(count.max(1))
                .min(room)
                .max(2.min(room))
                .max(1),
        }
    }

    /// Whether each cluster is a whole tightening, so that its own parameters can follow.
    pub fn are_whole(self) -> bool {
        self.per_case == 1
    }

    /// What each of them is.
    pub fn cluster(self) -> Cluster {
        match self.are_whole() {
            true => Cluster::Tightening,
            false => Cluster::Stretch,
        }
    }

    /// The clusters of one tightening with `samples` residuals.
    pub fn ranges(self, samples: usize) -> impl Iterator<Item = Range<usize>> {
        let length = samples.div_ceil(self.per_case).max(1);
        (0..self.per_case).map(move |cluster| {
            (cluster * length).min(samples)..((cluster + 1) * length).min(samples)
        })
    }
}

/// 97.5 % quantile of Student's t with one degree of freedom less than there are clusters.
pub(crate) fn student(clusters: usize) -> f64 {
    student_among(clusters, 1)
}

/// The same that none of so many exceeds in 95 % (Bonferroni).
pub(crate) fn student_among(clusters: usize, family: usize) -> f64 {
    let freedom = clusters.saturating_sub(1).max(1) as f64;
    let tail = 0.025 / family as f64;
    StudentsT::new(0.0, 1.0, freedom).map_or(1.96, |t| t.inverse_cdf(1.0 - tail))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::exact;

    /// So many tightenings of so many samples, of which the first `unscored` count for nothing.
    fn cases(count: usize, samples: usize, unscored: usize) -> Vec<FitTask<'static>> {
        let mut case = exact(0, &[], &[]).beginning(samples);
        case.settings.to_mut().unscored_samples = unscored;
        vec![case; count]
    }

    #[test]
    fn eight_tightenings_are_units_seven_are_cut() {
        assert!(Clusters::of(&cases(8, 250, 0)).are_whole());
        assert_eq!(
            Clusters::of(&cases(8, 250, 0)).cluster().plural(),
            "tightenings"
        );
        // 24 stretches are wanted: four of each of seven are 28, three would be 21.
        assert_eq!(Clusters::of(&cases(7, 250, 0)).per_case, 4);
        assert_eq!(
            Clusters::of(&cases(7, 250, 0)).cluster().plural(),
            "stretches of the record"
        );
    }

    #[test]
    fn stretches_are_no_shorter_than_forty_scored_samples() {
        assert_eq!(Clusters::of(&cases(1, 250, 0)).per_case, 6);
        assert_eq!(Clusters::of(&cases(1, 250, 11)).per_case, 5);
        assert_eq!(Clusters::of(&cases(1, 30, 0)).per_case, 1);
    }

    #[test]
    fn one_that_broke_off_changes_nothing_for_the_others() {
        let per_case =
            |residuals: &[usize]| Clusters::of_residuals(residuals.to_vec(), true).per_case;
        assert_eq!(per_case(&[4000, 4000, 4000]), 8);
        for short in [1, 39, 79] {
            assert_eq!(per_case(&[4000, short, 4000]), 8, "{short}");
        }
        let mut many = vec![LONG_RECORD; 30];
        assert_eq!(per_case(&many), 2);
        many.push(200);
        assert_eq!(per_case(&many), 2);
    }

    #[test]
    fn stretches_follow_each_other_and_leave_nothing_out() {
        for samples in [0, 5, 239, 240, 241, 250] {
            let ranges: Vec<Range<usize>> = Clusters { per_case: 6 }.ranges(samples).collect();
            assert_eq!(ranges.len(), 6);
            assert_eq!((ranges[0].start, ranges[5].end), (0, samples));
            assert!(ranges.windows(2).all(|pair| pair[0].end == pair[1].start));
        }
    }
}
