//! Whether some recordings stand in units of their own.
//!
//! An input or an output that is a thousand times too large makes mass, damping and stiffness all a thousand times as large, or small:
//! every recording by itself is fitted as well as ever, so that no error tells of it.

use crate::pooled::fitted::Fitted;
use crate::pooled::sharing::Groups;
use crate::verdict::thresholds::{FEWEST_OF_FILE, NO_RIG_DIFFERS, SAME_FACTOR};
use snug_campaign::Factor;
use snug_campaign::words::suspicion::OtherUnits;
use snug_identify::FitTask;
use snug_statistics::descriptive::median;

/// Two files whose masses, dampings and stiffnesses stand apart by a factor that no rig explains, those that share it most nearly.
pub(crate) fn in_other_units(cases: &[FitTask<'_>], fitted: &Fitted) -> Option<OtherUnits> {
    let files = Groups::of(cases, &Factor::File)?;
    let members = files.members();
    let is_judged =
        |members: &Vec<usize>| fitted.are_stretches() || members.len() >= FEWEST_OF_FILE;
    let sizes: Vec<(&str, Vec<f64>)> = (files.levels.iter().zip(&members))
        .filter(|(_, members)| is_judged(members))
        .map(|(file, members)| (file.name.as_str(), typical(fitted, members)))
        .collect();
    let pairs = sizes.iter().flat_map(|one| {
        let others = sizes.iter();
        others.filter_map(move |other| Some((other.0, one.0, common_factor(&other.1, &one.1)?)))
    });
    let apart = pairs.filter(|(_, _, common)| common.factor >= NO_RIG_DIFFERS);
    let plainest = apart.min_by(|a, b| a.2.agree_within.total_cmp(&b.2.agree_within));
    plainest.map(|(larger, smaller, common)| OtherUnits {
        larger: larger.to_owned(),
        smaller: smaller.to_owned(),
        factor: common.factor,
    })
}

/// A factor that two sizes share.
struct CommonFactor {
    factor: f64,
    /// By what factor theirs differ.
    agree_within: f64,
}

/// The median of each of mass, damping and stiffness that these tightenings have of their own.
fn typical(fitted: &Fitted, members: &[usize]) -> Vec<f64> {
    let columns = (members.first()).map_or(0, |&first| fitted.own_base(first).len());
    let of = |column: usize| {
        let own = |&member: &usize| fitted.own_base(member)[column];
        let sizes: Vec<f64> = members.iter().map(own).collect();
        median(&sizes).unwrap_or(0.0)
    };
    (0..columns).map(of).collect()
}

/// The factor that two of the sizes share most nearly: one that a record hardly shows is anything, and so is its factor.
fn common_factor(of: &[f64], over: &[f64]) -> Option<CommonFactor> {
    let pairs = of.iter().zip(over);
    let mut factors: Vec<f64> = pairs
        .filter(|(of, over)| **of > 0.0 && **over > 0.0)
        .map(|(of, over)| of / over)
        .collect();
    factors.sort_by(f64::total_cmp);
    let common = factors.windows(2).map(|pair| CommonFactor {
        factor: (pair[0] * pair[1]).sqrt(),
        agree_within: pair[1] / pair[0],
    });
    let nearest = common.min_by(|a, b| a.agree_within.total_cmp(&b.agree_within));
    nearest.filter(|common| common.agree_within <= SAME_FACTOR)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_is_that_of_two_sizes_that_agree() {
        let base = [2.0, 30.0, 400.0];
        let factor = |of: [f64; 3]| common_factor(&of, &base).map(|common| common.factor.round());
        assert_eq!(factor([2e6, 30e6, 400e6]), Some(1e6));
        // Without a spring, the third is anything.
        assert_eq!(factor([2e6, 30e6, 1e-9]), Some(1e6));
        // Heavier and stiffer, not in other units.
        assert_eq!(factor([6.0, 30.0, 400.0]), Some(1.0));
        assert_eq!(factor([6000.0, 30.0, 0.0]), None);
    }
}
