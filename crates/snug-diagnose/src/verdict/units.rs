//! Whether some recordings stand in units of their own, or move another load.
//!
//! An input or an output that is a thousand times too large makes mass, damping and stiffness all a thousand times as large, or small:
//! every recording by itself is fitted as well as ever, so that no error tells of it.

use crate::pooled::fitted::Fitted;
use crate::pooled::sharing::Groups;
use crate::verdict::thresholds::{
    FEWEST_OF_GROUP, NO_RIG_DIFFERS, NO_UNIT_DIFFERS, SAME_FACTOR, THREE_QUARTERS, UNIT_PREFIXES,
};
use snug_campaign::Factor;
use snug_campaign::words::suspicion::OtherUnits;
use snug_identify::FitTask;
use snug_statistics::descriptive::quantile;

/// Two files, else two people, whose masses, dampings and stiffnesses stand apart by a factor that hardly any rig explains: those that
/// share it most nearly.
pub(crate) fn in_other_units(cases: &[FitTask<'_>], fitted: &Fitted) -> Option<OtherUnits> {
    let factors = [Factor::File, Factor::Participant];
    let mut groups = factors.iter().filter_map(|one| Groups::of(cases, one));
    groups.find_map(|groups| of_groups(&groups, fitted))
}

fn of_groups(groups: &Groups, fitted: &Fitted) -> Option<OtherUnits> {
    let members = groups.members();
    let is_judged =
        |members: &Vec<usize>| fitted.are_stretches() || members.len() >= FEWEST_OF_GROUP;
    let sizes: Vec<(&str, OwnSizes)> = (groups.levels.iter().zip(&members))
        .filter(|(_, members)| is_judged(members))
        .map(|(group, members)| (group.name.as_str(), OwnSizes::of(fitted, members)))
        .collect();
    apart(&sizes)
}

fn apart(sizes: &[(&str, OwnSizes)]) -> Option<OtherUnits> {
    let pairs = sizes.iter().flat_map(|one| {
        let others = sizes.iter();
        others.filter_map(move |other| {
            let common = common_factor(&other.1.low, &one.1.high)?;
            (NO_RIG_DIFFERS..=NO_UNIT_DIFFERS)
                .contains(&common.factor)
                .then_some((other, one, common))
        })
    });
    let (larger, smaller, _) =
        pairs.min_by(|a, b| a.2.agree_within.total_cmp(&b.2.agree_within))?;
    let factor = common_factor(&larger.1.middle, &smaller.1.middle)?.factor;
    let is_prefix = |prefix: &f64| (factor / prefix).ln().abs() <= SAME_FACTOR.ln();
    Some(OtherUnits {
        larger: larger.0.to_owned(),
        smaller: smaller.0.to_owned(),
        factor,
        is_prefix: UNIT_PREFIXES.iter().any(is_prefix),
    })
}

/// What mass, damping and stiffness tightenings have of their own: the value in the middle of each, and those that three quarters of
/// them exceed and fall short of.
struct OwnSizes {
    low: Vec<f64>,
    middle: Vec<f64>,
    high: Vec<f64>,
}

impl OwnSizes {
    fn of(fitted: &Fitted, members: &[usize]) -> Self {
        let columns = (members.first()).map_or(0, |&first| fitted.own_base(first).len());
        let column = |column: usize| {
            let own = members
                .iter()
                .map(|&member| fitted.own_base(member)[column].ln());
            own.collect()
        };
        Self::of_logarithms(&(0..columns).map(column).collect::<Vec<_>>())
    }

    /// From a list of logarithms for each of the three; a size is 0 where none is known.
    fn of_logarithms(columns: &[Vec<f64>]) -> Self {
        let at = |share: f64| -> Vec<f64> {
            let of = |logarithms: &Vec<f64>| quantile(logarithms, share).map_or(0.0, f64::exp);
            columns.iter().map(of).collect()
        };
        Self {
            low: at(1.0 - THREE_QUARTERS),
            middle: at(0.5),
            high: at(THREE_QUARTERS),
        }
    }
}

/// A factor that two sizes share.
struct CommonFactor {
    factor: f64,
    /// By what factor theirs differ.
    agree_within: f64,
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

    /// m, c, k of each tightening.
    fn sizes(of: &[[f64; 3]]) -> OwnSizes {
        let column = |column: usize| of.iter().map(|sizes| sizes[column].ln()).collect();
        OwnSizes::of_logarithms(&(0..3).map(column).collect::<Vec<_>>())
    }

    fn hand(times: f64) -> [f64; 3] {
        [2.0, 90.0, 2200.0].map(|size| size * times)
    }

    #[test]
    fn two_tightenings_in_millinewtonmetres_are_a_prefix_and_a_flywheel_is_none() {
        let usual = || sizes(&[hand(1.0), hand(1.5), hand(0.8)]);
        let found = apart(&[("a", usual()), ("b", sizes(&[hand(900.0), hand(1500.0)]))]);
        let found = found.expect("a thousandfold");
        assert_eq!((found.larger.as_str(), found.is_prefix), ("b", true));
        assert!((found.factor / 1162.0 - 1.0).abs() < 0.01, "{found}");
        let flywheel = apart(&[("a", usual()), ("b", sizes(&[hand(146.0); 2]))]);
        assert!(!flywheel.expect("another load").is_prefix);
    }

    #[test]
    fn a_fit_that_went_astray_is_no_unit() {
        let usual = sizes(&[hand(1.0), hand(1.5)]);
        let one_astray = sizes(&[hand(1e4), hand(1.0)]);
        assert_eq!(apart(&[("a", usual), ("b", one_astray)]), None);
        // That nothing was determined of.
        let anything = sizes(&[hand(1e11)]);
        assert_eq!(apart(&[("a", sizes(&[hand(1.0)])), ("b", anything)]), None);
    }

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
