//! Whether the input of some recordings has the other sign than that of the others: a sensor that was mounted the other way round, or a
//! cable that was swapped between them.

use super::{FAR_BETTER, LEAST_EXPLAINED, promised, turned};
use crate::data::machine::is_machine;
use crate::verdict::changes::name;
use snug_campaign::words::suspicion::TurnedRound;
use snug_identify::FitTask;
use std::ops::Range;

/// More recordings of a machine than anybody looks at one by one. Chosen.
const MOST_RECORDINGS: usize = 50;

/// Parts of a recording that are asked each by itself. Chosen: where a zero jumps once, two of three know nothing of it.
const PARTS: usize = 3;

/// Those that mass, damping and stiffness explain with the input's other sign and hardly as they are, where they explain others as
/// they are.
pub(crate) fn turned_round(cases: &[FitTask<'_>]) -> Option<TurnedRound> {
    if cases.len() < 2 || cases.len() > MOST_RECORDINGS || !cases.iter().all(is_machine) {
        return None;
    }
    let as_they_are: Vec<f64> = cases.iter().map(explained).collect();
    if as_they_are.iter().all(|share| *share >= LEAST_EXPLAINED) {
        return None;
    }
    let both: Vec<BothWays> = (as_they_are.into_iter().zip(cases))
        .map(|(as_it_is, case)| BothWays::of(case, as_it_is))
        .collect();
    let places: Vec<usize> = (0..cases.len())
        .filter(|&place| both[place].is_turned() && is_turned_in_parts(&cases[place]))
        .collect();
    let least = places.iter().map(|&place| both[place].turned);
    let share = least.reduce(f64::min)?;
    both.iter().any(BothWays::is_right).then(|| TurnedRound {
        recordings: places.iter().map(|&place| name(cases, place)).collect(),
        of: cases.len(),
        share,
    })
}

/// Share of the output's power that mass, damping and stiffness alone explain \[–\].
fn explained(case: &FitTask<'_>) -> f64 {
    promised(&[case.lent()]).unwrap_or(0.0)
}

/// That with the input as it is, and with its other sign \[–\].
struct BothWays {
    as_it_is: f64,
    turned: f64,
}

impl BothWays {
    fn of(case: &FitTask<'_>, as_it_is: f64) -> Self {
        Self {
            as_it_is,
            turned: explained(&turned(case)),
        }
    }

    fn is_right(&self) -> bool {
        self.as_it_is >= LEAST_EXPLAINED && self.as_it_is > self.turned
    }

    fn is_turned(&self) -> bool {
        let least = LEAST_EXPLAINED.max(self.as_it_is + FAR_BETTER);
        self.as_it_is < LEAST_EXPLAINED && self.turned >= least
    }
}

/// Whether no more of a recording's parts are right as they are than are turned: a zero that jumps far may look like either sign over the
/// whole, and does not in the parts before and behind it.
fn is_turned_in_parts(case: &FitTask<'_>) -> bool {
    let each = case.measured().len().div_ceil(PARTS).max(1);
    let parts: Vec<BothWays> = (0..PARTS)
        .map(|part| part_of(case, part * each..(part + 1) * each))
        .map(|part| BothWays::of(&part, explained(&part)))
        .collect();
    let count = |is: fn(&BothWays) -> bool| parts.iter().filter(|part| is(part)).count();
    count(BothWays::is_right) <= count(BothWays::is_turned)
}

/// Input and output of some of its samples.
fn part_of<'a>(case: &FitTask<'a>, samples: Range<usize>) -> FitTask<'a> {
    let mut case = case.clone();
    let cut = |signal: &[f64]| -> Vec<f64> {
        let some = signal.iter().skip(samples.start).take(samples.len());
        some.copied().collect()
    };
    let (quantity, output) = (case.quantity(), cut(case.measured()));
    let tightening = case.tightening.to_mut();
    tightening.torque_nm = cut(&tightening.torque_nm);
    tightening.motion.set(quantity, output);
    case
}
