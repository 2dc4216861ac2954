//! What tests presume of the groups that they compare, checked beside them: a check replaces no test.

use super::stated::Stated;
use snug_campaign::AssumptionCheck;
use snug_statistics::assumptions::{brown_forsythe, replicated, residuals, shapiro_wilk, tied};
use snug_statistics::{StatisticsError, TestResult};

/// Something that a test presumes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Assumption {
    /// Residuals about the groups' means are near normal.
    NormalResiduals,
    /// Every group varies as much as the others.
    EqualVariances,
}

/// Every check of these groups, in the order of the page.
pub fn checks(groups: &[Vec<f64>]) -> [(Assumption, AssumptionCheck); 2] {
    let groups = replicated(groups);
    let residuals = residuals(&groups);
    let check = |assumption: &str, method: &str, outcome: Result<TestResult, StatisticsError>| {
        let stated = Stated::from(outcome);
        AssumptionCheck {
            assumption: assumption.to_owned(),
            method: method.to_owned(),
            statistic_name: stated.statistic_name,
            statistic: stated.statistic,
            degrees_of_freedom: stated.degrees_of_freedom,
            p: stated.p,
            values: residuals.len(),
            groups: groups.len(),
            tied: tied(&residuals),
            note: stated.note,
        }
    };
    [
        (
            Assumption::NormalResiduals,
            check("normal_residuals", "shapiro_wilk", shapiro_wilk(&residuals)),
        ),
        (
            Assumption::EqualVariances,
            check("equal_variances", "brown_forsythe", brown_forsythe(&groups)),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn alternating(count: usize, size: f64) -> Vec<f64> {
        (0..count)
            .map(|i| size * (i as f64 * std::f64::consts::SQRT_2 % 1.0))
            .collect()
    }

    #[test]
    fn a_group_of_one_value_takes_no_part() {
        let mut groups = vec![alternating(9, 1.0), alternating(12, 5.0), vec![4.0]];
        let with = checks(&groups);
        assert_eq!((with[0].1.values, with[0].1.groups), (21, 2));
        assert_eq!(with[1].1.degrees_of_freedom, [1.0, 19.0]);
        groups.pop();
        assert_eq!(with, checks(&groups));
    }

    #[test]
    fn a_check_that_cannot_be_made_says_why_and_leaves_the_other() {
        let many = checks(&[alternating(2501, 1.0), alternating(2500, 1.0)]);
        assert!(
            many[0]
                .1
                .note
                .as_ref()
                .is_some_and(|why| why.contains("5000"))
        );
        assert_eq!((many[0].1.p, many[0].1.values), (None, 5001));
        assert!(many[1].1.p.is_some_and(|p| p > 0.05));
        for (_, check) in checks(&[vec![1.0], vec![2.0]]) {
            assert_eq!((check.p, check.values, check.groups), (None, 0, 0));
            assert!(check.note.is_some());
        }
    }

    #[test]
    fn estimates_on_a_bound_are_counted_as_tied() {
        let found = checks(&[vec![0.0, 0.0, 0.0, 1.2, 3.1], vec![2.0, 2.5, 3.5]]);
        assert_eq!(found[0].1.tied, 3);
    }
}
