//! How large an effect would have to be to be found where only some of the groups have it.
//!
//! Of a family of effects asked in each of G groups the largest z exceeds Φ⁻¹(1 − 0.054 / 40 G) by chance as often as the 3.0 of
//! the effects alone.

use crate::pooled::sharing::Groups;
use crate::ranking::sensitivity::Column;
use crate::verdict::thresholds::{FAMILY_Z, POWER_Z};
use snug_campaign::{Factor, InSomeGroups};
use snug_identify::FitTask;
use snug_statistics::descriptive::median;
use statrs::distribution::{ContinuousCDF, Normal};

/// The groups that may have an effect or not: people, else files.
pub(crate) fn groups(cases: &[FitTask<'_>]) -> Option<Groups> {
    let several = |factor: &Factor| {
        Groups::of(cases, factor).filter(|groups| (2..cases.len()).contains(&groups.levels.len()))
    };
    several(&Factor::Participant).or_else(|| several(&Factor::File))
}

/// What the data would show of an effect that some of the groups have: `noise` is the mean squared residual, `least` what must fall of
/// the squared residual to matter, `unit_size` the size of which a tightening has the column's information.
pub(crate) fn in_some_groups(
    column: &Column,
    groups: &Groups,
    (noise, least): (f64, f64),
    unit_size: f64,
    largest: f64,
) -> Option<InSomeGroups> {
    let count = groups.levels.len();
    let all: f64 = column.variances.iter().sum();
    let of_groups: Vec<f64> = (groups.members().iter())
        .map(|members| {
            let own: f64 = members.iter().map(|&member| column.variances[member]).sum();
            column.information * own / all
        })
        .collect();
    let usual = median(&of_groups).ok().filter(|usual| *usual > 0.0)?;
    let normal = Normal::standard();
    let beyond = normal.sf(FAMILY_Z) / count as f64;
    let needed = ((normal.inverse_cdf(1.0 - beyond) + POWER_Z).powi(2) * noise).max(least);
    let in_one = (needed / usual).sqrt() * unit_size;
    let fewest = (needed / usual * (unit_size / largest).powi(2)).ceil();
    Some(InSomeGroups {
        factor: groups.factor.clone(),
        groups: count,
        in_one: (in_one <= largest).then_some(in_one),
        fewest: (fewest <= count as f64).then_some(fewest.max(1.0) as usize),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{close, exact};
    use snug_model::Effect::CubicStiffness;

    /// Four people with two tightenings each, all of which know as much.
    fn of_people(information: f64, least: f64, largest: f64) -> InSomeGroups {
        let mut cases: Vec<FitTask> = (0..8).map(|number| exact(number, &[], &[])).collect();
        for (number, case) in cases.iter_mut().enumerate() {
            let who = format!("TP{}", number % 4);
            case.tightening.to_mut().conditions.participant = Some(who);
        }
        let mut column = Column::with_scores(CubicStiffness, vec![0.0; 8]);
        column.information = information;
        let groups = groups(&cases).expect("there are four");
        in_some_groups(&column, &groups, (1.0, least), 1.0, largest).expect("it is known")
    }

    /// SciPy 1.17.1: `norm.isf(norm.sf(3) / 4)` = 3.39956; (3.39956 + 1.645)² = 25.4476, of which a group of four knows 1 per unit.
    #[test]
    fn one_group_alone_must_have_more_of_it() {
        let found = of_people(4.0, 0.0, 100.0);
        close(found.in_one.expect("it can be"), 25.4476_f64.sqrt(), 1e-3);
        assert_eq!((found.groups, found.fewest), (4, Some(1)));
        assert_eq!(found.factor, Factor::Participant);
    }

    /// 25.4 units are needed, a group has at most 3² = 9: three groups.
    #[test]
    fn what_one_group_cannot_show_three_can() {
        let found = of_people(4.0, 0.0, 3.0);
        assert_eq!((found.in_one, found.fewest), (None, Some(3)));
        assert_eq!(of_people(4.0, 0.0, 2.0).fewest, None);
    }

    #[test]
    fn it_must_matter_too() {
        close(
            of_people(4.0, 100.0, 100.0).in_one.expect("it can be"),
            10.0,
            1e-12,
        );
    }
}
