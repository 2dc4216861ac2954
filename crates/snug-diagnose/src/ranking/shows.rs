//! Which tightenings a model fits badly and which to the noise: those of some groups, or those of some part of the campaign's time.

use crate::pooled::fitted::Fitted;
use crate::pooled::sharing::Groups;
use crate::pooled::thresholds::AT_FLOOR;
use crate::ranking::by_time::changes;
use crate::ranking::thresholds::{BEYOND_QUIET_ONES, BEYOND_THE_QUIET, FEWEST_WHERE_IT_SHOWS};
use snug_campaign::Factor;
use snug_identify::FitTask;
use snug_statistics::descriptive::{median, standard_deviation};

/// Groups of which some are fitted badly.
#[derive(Debug, PartialEq)]
pub(super) struct Shows {
    pub groups: Groups,
    /// Whether a group is one of them.
    pub in_group: Vec<bool>,
    /// Their tightenings.
    pub members: Vec<usize>,
}

impl Shows {
    /// `None` where those are too few to look for an effect in, or all there are.
    fn of(groups: Groups, in_group: Vec<bool>) -> Option<Self> {
        let members: Vec<usize> = (0..groups.of.len())
            .filter(|&member| in_group[groups.of[member]])
            .collect();
        let parts = members.len() >= FEWEST_WHERE_IT_SHOWS && members.len() < groups.of.len();
        parts.then_some(Self {
            groups,
            in_group,
            members,
        })
    }
}

/// The groups of the condition that best parts what `current` fits badly from what it fits to the noise, those in the fewest
/// tightenings; then the files and the parts of time that do. Of a condition's files some may show it hardly, so that those that
/// do are fewer and yet not all.
pub(super) fn where_it_shows(
    cases: &[FitTask<'_>],
    current: &Fitted,
    groupings: &[Groups],
) -> Vec<Shows> {
    if !current.is_weighted {
        return Vec::new();
    }
    let fewest = |all: Vec<Shows>| {
        all.into_iter()
            .min_by_key(|shows| (shows.members.len(), shows.groups.levels.len()))
    };
    let (files, conditions): (Vec<&Groups>, Vec<&Groups>) =
        (groupings.iter()).partition(|groups| groups.factor == Factor::File);
    let parting = |all: Vec<&Groups>| {
        let parting = all.into_iter().filter_map(|one| parts(current, one));
        fewest(parting.collect())
    };
    let (of_condition, of_files) = (parting(conditions), parting(files));
    let times = changes(cases).into_iter().flatten();
    let times = times.filter_map(|groups| parts_in_time(current, groups));
    let of_time = times.min_by_key(|(wrong, shows)| (*wrong, shows.members.len()));
    let of_time = of_time.map(|(_, shows)| shows);
    let found = of_condition.into_iter().chain(of_files).chain(of_time);
    found.collect()
}

/// The side of a change on which `current` leaves more than chance does where the other is left at the noise, and how many
/// tightenings are not as their side is: what is there may show in some more than in others, and in some not at all.
fn parts_in_time(current: &Fitted, groups: Groups) -> Option<(usize, Shows)> {
    let left: Vec<Vec<f64>> = (groups.members().iter())
        .map(|members| {
            members
                .iter()
                .map(|&one| mean_square(current, one))
                .collect()
        })
        .collect();
    let [before, after] = left.as_slice() else {
        return None;
    };
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
    let shows_after = mean(after) > mean(before);
    let (quiet, loud) = match shows_after {
        true => (before, after),
        false => (after, before),
    };
    let (level, spread) = (mean(quiet), standard_deviation(quiet).ok()?);
    let beyond = level + BEYOND_QUIET_ONES * spread;
    let wrong = quiet.iter().filter(|one| **one > beyond).count()
        + loud.iter().filter(|one| **one <= beyond).count();
    let is_plain = mean(loud) > level + BEYOND_THE_QUIET * spread / (loud.len() as f64).sqrt();
    let parts = level < AT_FLOOR * AT_FLOOR && is_plain;
    let shows = parts.then(|| Shows::of(groups, vec![!shows_after, shows_after]));
    Some((wrong, shows.flatten()?))
}

/// Mean squared residual of one tightening.
fn mean_square(current: &Fitted, member: usize) -> f64 {
    let block = &current.blocks[member];
    block.squares / block.count.max(1) as f64
}

/// The groups in which `current` leaves more than chance puts between groups, where the others together are left at the noise.
fn parts(current: &Fitted, groups: &Groups) -> Option<Shows> {
    let members = groups.members();
    let left = |members: &Vec<usize>| {
        let blocks = || members.iter().map(|&member| &current.blocks[member]);
        let count = blocks().map(|block| block.count).sum::<usize>().max(1) as f64;
        let squares = blocks().map(|block| block.squares).sum::<f64>();
        (squares / count, count)
    };
    let left: Vec<(f64, f64)> = members.iter().map(left).collect();
    let quiet = left
        .iter()
        .map(|(scale, _)| *scale)
        .fold(f64::INFINITY, f64::min);
    let spread = usual_spread(current, &members)?;
    let by_chance = |count: usize| BEYOND_THE_QUIET * spread / (count as f64).sqrt();
    let in_group: Vec<bool> = (left.iter().zip(&members))
        .map(|((scale, _), members)| *scale > quiet + by_chance(members.len()))
        .collect();
    let rest = left.iter().zip(&in_group).filter(|(_, shows)| !**shows);
    let (squares, count) = rest.fold((0.0, 0.0), |(squares, all), ((scale, count), _)| {
        (squares + scale * count, all + count)
    });
    let is_rest_quiet = squares < AT_FLOOR * AT_FLOOR * count;
    is_rest_quiet
        .then(|| Shows::of(groups.clone(), in_group))
        .flatten()
}

/// Standard deviation of the tightenings' mean squares within a group, the median over groups: of the noise each knows a little more
/// or less than it has. `None` where no group has two.
fn usual_spread(current: &Fitted, groups: &[Vec<usize>]) -> Option<f64> {
    let of_group = |members: &Vec<usize>| {
        let scales: Vec<f64> = members
            .iter()
            .map(|&one| mean_square(current, one))
            .collect();
        standard_deviation(&scales).ok()
    };
    let spreads: Vec<f64> = groups.iter().filter_map(of_group).collect();
    median(&spreads).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::exact;

    /// Twelve tightenings of three people under two joints that leave these mean squares.
    fn of(left: impl Fn(usize, usize) -> f64) -> Option<Shows> {
        let mut cases: Vec<FitTask> = (0..12).map(|number| exact(number, &[], &[])).collect();
        let mut squares = Vec::new();
        for (number, case) in cases.iter_mut().enumerate() {
            let (person, joint) = (number % 3, number / 3 % 2);
            let conditions = &mut case.tightening.to_mut().conditions;
            conditions.participant = Some(format!("TP{person}"));
            conditions.joint = Some(["Soft", "Hard"][joint].to_owned());
            squares.push(100.0 * left(person, joint));
        }
        let current = Fitted::made_up(&[], &squares, 100);
        where_it_shows(&cases, &current, &Groups::worth_trying(&cases))
            .into_iter()
            .next()
    }

    #[test]
    fn people_who_fit_badly_are_where_it_shows() {
        let shows = of(|person, _| if person == 1 { 1.5 } else { 1.0 }).expect("one does");
        assert_eq!(shows.groups.factor, Factor::Participant);
        assert_eq!(shows.members, [1, 4, 7, 10]);
        let shows = of(|_, joint| if joint == 1 { 1.5 } else { 1.0 }).expect("one does");
        assert_eq!(shows.groups.factor, Factor::Joint);
        assert_eq!(shows.members.len(), 6);
    }

    #[test]
    fn where_all_fit_badly_or_none_there_is_no_such_place() {
        assert_eq!(of(|_, _| 1.0), None);
        assert_eq!(of(|person, _| 1.2 + person as f64), None);
    }

    /// Three files of six tightenings, from the third of the second on with more than noise: file by file the second is both.
    #[test]
    fn what_came_in_the_middle_of_the_campaign_shows_from_there_on() {
        let mut cases: Vec<FitTask> = (0..18).map(|number| exact(number, &[], &[])).collect();
        for (place, case) in cases.iter_mut().enumerate() {
            let tightening = case.tightening.to_mut();
            tightening.id.file = format!("{}.mat", place / 6);
            tightening.id.number = place as u32 % 6 + 1;
        }
        let wobble = |place: usize| 0.02 * (place % 3) as f64;
        let squares: Vec<f64> = (0..18)
            .map(|place| 100.0 * (wobble(place) + if place < 8 { 1.0 } else { 1.5 }))
            .collect();
        let current = Fitted::made_up(&[], &squares, 100);
        let shows = where_it_shows(&cases, &current, &Groups::worth_trying(&cases));
        let of_time = shows.last().expect("it does");
        let Factor::Since(id) = &of_time.groups.factor else {
            panic!("{:?}", of_time.groups.factor)
        };
        assert_eq!(id.to_string(), "1.mat #3");
        assert_eq!(of_time.members, (8..18).collect::<Vec<_>>());
    }
}
