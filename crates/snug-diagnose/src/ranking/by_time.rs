//! Whether the size of an effect changes at some number or place of the campaign, or grows evenly with the number.
//!
//! Every place between two tightenings is looked at (the score test of two groups, a sum over those before and one over
//! those after); the best of them counts as the best of so many.

use crate::data::cases::Cases;
use crate::pooled::fitted::Fitted;
use crate::pooled::sharing::Groups;
use crate::ranking::score_of_groups::{Promise, promise};
use crate::ranking::thresholds::FEWEST_BESIDE_A_CHANGE;
use snug_campaign::{Factor, TighteningId};
use snug_identify::FitTask;
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};

/// How the tightenings of a campaign follow each other.
#[derive(Debug, Clone, Copy)]
enum Order {
    /// By the number within a file, whatever the file.
    Number,
    /// By the place in the campaign.
    Place,
}

impl Order {
    /// Those that are not the same.
    fn worth_trying(cases: &[FitTask<'_>]) -> &'static [Self] {
        let is_one_file = cases
            .windows(2)
            .all(|pair| pair[0].tightening.id.file == pair[1].tightening.id.file);
        match is_one_file {
            true => &[Self::Number],
            false => &[Self::Number, Self::Place],
        }
    }

    fn key(self, id: &TighteningId) -> TighteningId {
        match self {
            Self::Number => TighteningId {
                file: String::new(),
                number: id.number,
            },
            Self::Place => id.clone(),
        }
    }

    fn factor(self, from: TighteningId) -> Factor {
        match self {
            Self::Number => Factor::FromNumber(from.number),
            Self::Place => Factor::Since(from),
        }
    }

    /// The tightenings in this order, and every place at which a size may change: how many come before, and the first after it.
    fn changes(self, cases: &[FitTask<'_>]) -> (Vec<usize>, Vec<(usize, TighteningId)>) {
        let id = |member: usize| self.key(&cases[member].tightening.id);
        let mut order: Vec<usize> = (0..cases.len()).collect();
        order.sort_by_key(|&member| id(member));
        let last = (order.len() + 1).saturating_sub(FEWEST_BESIDE_A_CHANGE);
        let places = (FEWEST_BESIDE_A_CHANGE..last)
            .map(|count| (count, id(order[count])))
            .filter(|(count, from)| *from != id(order[count - 1]))
            .collect();
        (order, places)
    }
}

/// Every change by the number within a file, and every one by the place in the campaign, as groups of before and after.
pub(super) fn changes(cases: &[FitTask<'_>]) -> Vec<Vec<Groups>> {
    let of_order = |order: &Order| {
        let places = order.changes(cases).1.into_iter();
        let groups = places.map(|(_, from)| Groups::of(cases, &order.factor(from)));
        groups.flatten().collect()
    };
    let orders = Order::worth_trying(cases).iter();
    orders.map(of_order).collect()
}

/// The best change by the number within a file, the best by the place in the campaign, and the even course over the number.
pub(super) fn promises(cases: &Cases<'_>, fitted: &Fitted, places: &[usize]) -> Vec<Promise> {
    let mut found = Vec::new();
    for &order in Order::worth_trying(cases) {
        if let Some((from, tried)) = change(cases, fitted, places, order)
            && let Some(groups) = Groups::of(cases, &order.factor(from))
        {
            found.extend(promise(fitted, places, groups, tried));
        }
    }
    if let Some(groups) = course(cases) {
        found.extend(promise(fitted, places, groups, 1));
    }
    found
}

/// The even course over the numbers; `None` where there are not three of them: two make a change.
fn course(cases: &[FitTask<'_>]) -> Option<Groups> {
    let mut numbers: Vec<u32> = cases.iter().map(|one| one.tightening.id.number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    match numbers.as_slice() {
        &[first, _, .., last] => Groups::of(cases, &Factor::Course { first, last }),
        _ => None,
    }
}

/// The first tightening, in this order, from which on a size of its own promises most, and among how many it was chosen.
fn change(
    cases: &[FitTask<'_>],
    fitted: &Fitted,
    places: &[usize],
    order: Order,
) -> Option<(TighteningId, usize)> {
    let (order, changes) = order.changes(cases);
    let (all, pull) = fitted.of_sizes(&order, places)?;
    let (mut before, mut pull_before) =
        (SymmetricMatrix::zero(places.len()), vec![0.0; places.len()]);
    let mut best: Option<(f64, TighteningId)> = None;
    let (mut summed, tried) = (0, changes.len());
    for (count, from) in changes {
        let (own, g) = fitted.of_sizes(&order[summed..count], places)?;
        summed = count;
        before.add(&own);
        pull_before
            .iter_mut()
            .zip(&g)
            .for_each(|(sum, g)| *sum += g);
        let mut after = all.clone();
        after.subtract(&before);
        let pull_after: Vec<f64> = pull
            .iter()
            .zip(&pull_before)
            .map(|(all, own)| all - own)
            .collect();
        let gain = fall(&before, &pull_before) + fall(&after, &pull_after);
        if best.as_ref().is_none_or(|(known, _)| gain > *known) {
            best = Some((gain, from));
        }
    }
    best.map(|(_, from)| (from, tried))
}

/// gᵀ S⁻¹ g.
fn fall(curvature: &SymmetricMatrix, gradient: &[f64]) -> f64 {
    let step = curvature.solve_scaled(gradient);
    step.map_or(0.0, |step| dot(&step, gradient))
}

#[cfg(test)]
mod tests {
    use crate::data::cases::{Cases, Tally};
    use crate::data::clusters::Clusters;
    use crate::pooled::fit::fit_effects;
    use crate::pooled::fitted::Fitted;
    use crate::pooled::sharing::Groups;
    use crate::ranking::by_group::by_group;
    use crate::tests::made_up::{WHOLE, close, noisy, quick};
    use snug_campaign::Factor;
    use snug_identify::FitTask;
    use snug_model::Effect::CubicStiffness;

    /// Three files of six tightenings of one person each, whose springs stiffen as `size` says of file and number.
    fn campaign(size: impl Fn(usize, u32) -> f64) -> Vec<FitTask<'static>> {
        (0..18)
            .map(|place| {
                let (file, number) = (place / 6, place as u32 % 6 + 1);
                let mut case = noisy(place, &[CubicStiffness], &[size(file, number)]);
                let tightening = case.tightening.to_mut();
                tightening.id.file = format!("{file}.mat");
                tightening.id.number = number;
                tightening.conditions.participant = Some(format!("TP{file}"));
                case
            })
            .collect()
    }

    /// The fit whose sizes differ, if the data ask for it.
    fn asked(cases: &[FitTask<'_>]) -> Option<Fitted> {
        let tally = Tally::default();
        let counted = Cases::new(cases, &tally);
        let one = fit_effects(counted, &[CubicStiffness], None, WHOLE).expect("it can be fitted");
        let groupings = Groups::worth_trying(cases);
        let (clusters, settings): (Clusters, _) = (WHOLE, quick(99));
        by_group(
            counted,
            &one,
            CubicStiffness,
            &groupings,
            1,
            clusters,
            &settings,
        )
        .expect("it can be fitted")
    }

    fn sizes(fitted: &Fitted, truth: [f64; 2]) {
        for (found, truth) in fitted.shared.iter().zip(truth) {
            close(found + 1e6, truth + 1e6, 0.05);
        }
        assert!(fitted.is_at_floor(), "{}", fitted.error());
    }

    #[test]
    fn an_effect_that_comes_with_a_number_of_every_file_is_found() {
        let cases = campaign(|_, number| if number >= 4 { 3e6 } else { 0.0 });
        let fitted = asked(&cases).expect("it changes");
        let factor = fitted.sharing.factor(CubicStiffness);
        assert_eq!(factor, Some(&Factor::FromNumber(4)));
        sizes(&fitted, [0.0, 3e6]);
    }

    #[test]
    fn an_effect_that_goes_in_the_middle_of_the_campaign_is_found() {
        let cases = campaign(|file, number| if (file, number) >= (1, 3) { 0.0 } else { 3e6 });
        let fitted = asked(&cases).expect("it changes");
        let Some(Factor::Since(id)) = fitted.sharing.factor(CubicStiffness) else {
            panic!("{:?}", fitted.sharing)
        };
        assert_eq!(id.to_string(), "1.mat #3");
        sizes(&fitted, [3e6, 0.0]);
    }

    #[test]
    fn an_effect_that_grows_evenly_is_found() {
        let cases = campaign(|_, number| 8e5 * f64::from(number));
        let fitted = asked(&cases).expect("it grows");
        let factor = fitted.sharing.factor(CubicStiffness);
        assert_eq!(factor, Some(&Factor::Course { first: 1, last: 6 }));
        sizes(&fitted, [8e5, 4.8e6]);
    }

    /// The last person alone has it, which is also from the third file on: people come first.
    #[test]
    fn what_people_and_time_explain_alike_is_told_of_people() {
        let cases = campaign(|file, _| if file == 2 { 3e6 } else { 0.0 });
        let fitted = asked(&cases).expect("they differ");
        let factor = fitted.sharing.factor(CubicStiffness);
        assert_eq!(factor, Some(&Factor::Participant));
    }
}
