//! Whether the input of some recordings has the other sign than that of the others: a sensor that was mounted the other way round, or a
//! cable that was swapped between them.

use super::{FAR_BETTER, LEAST_EXPLAINED, promised, turned};
use crate::data::machine::is_machine;
use crate::verdict::changes::name;
use snug_campaign::words::suspicion::TurnedRound;
use snug_identify::FitTask;

/// More recordings of a machine than anybody looks at one by one. Chosen.
const MOST_RECORDINGS: usize = 50;

/// Those that mass, damping and stiffness explain with the input's other sign and hardly as they are, where they explain others as
/// they are.
pub(crate) fn turned_round(cases: &[FitTask<'_>]) -> Option<TurnedRound> {
    if cases.len() < 2 || cases.len() > MOST_RECORDINGS || !cases.iter().all(is_machine) {
        return None;
    }
    let explained = |case: &FitTask<'_>| promised(&[case.lent()]).unwrap_or(0.0);
    let as_they_are: Vec<f64> = cases.iter().map(explained).collect();
    if as_they_are.iter().all(|share| *share >= LEAST_EXPLAINED) {
        return None;
    }
    let shares: Vec<[f64; 2]> = (as_they_are.into_iter().zip(cases))
        .map(|(as_it_is, case)| [as_it_is, explained(&turned(case))])
        .collect();
    let is_right = |[as_is, turned]: &[f64; 2]| *as_is >= LEAST_EXPLAINED && as_is > turned;
    let is_turned = |[as_is, turned]: &[f64; 2]| {
        *as_is < LEAST_EXPLAINED && *turned >= LEAST_EXPLAINED.max(as_is + FAR_BETTER)
    };
    let places: Vec<usize> = (0..cases.len())
        .filter(|&place| is_turned(&shares[place]))
        .collect();
    let least = places.iter().map(|&place| shares[place][1]);
    let share = least.reduce(f64::min)?;
    shares.iter().any(is_right).then(|| TurnedRound {
        recordings: places.iter().map(|&place| name(cases, place)).collect(),
        of: cases.len(),
        share,
    })
}
