//! Whether a model leaves much of some recordings and hardly anything of the others: what happened there it does not know, and those
//! that it explains do not make it adequate.

use super::outliers;
use crate::data::clusters::Clusters;
use crate::data::neighbours::correlation;
use crate::data::power::power;
use crate::locate::Seen;
use crate::verdict::changes::name;
use crate::verdict::thresholds::{APART, APART_SHARE};
use snug_campaign::words::explained::is_a_motion;
use snug_campaign::words::suspicion::StandsApart;
use snug_identify::FitTask;
use std::slice;

/// What is left of one recording.
struct Left {
    place: usize,
    squares: f64,
    /// Per sample, in the output's unit squared.
    mean_square: f64,
    /// Over what there is to explain \[–\].
    share: f64,
    /// Whether that is a motion, or the trace of something sudden in a few samples, and no noise.
    has_a_cause: bool,
}

/// Fewer than half of a few long recordings, each of which leaves many times what any of the others leaves, no trifle of what was measured
/// and no noise.
pub(crate) fn stands_apart(cases: &[FitTask<'_>], seen: &[Seen<'_>]) -> Option<StandsApart> {
    if Clusters::of(cases).are_whole() || cases.len() != seen.len() {
        return None;
    }
    let mut all: Vec<Left> = (cases.iter().zip(seen).enumerate())
        .map(|(place, (case, seen))| Left::of(place, case, seen))
        .collect::<Option<_>>()?;
    let count = apart(&mut all)?;
    let (apart, others) = all.split_at(count);
    let squares = |some: &[Left]| some.iter().map(|one| one.squares).sum::<f64>();
    let mut places: Vec<usize> = apart.iter().map(|one| one.place).collect();
    places.sort_unstable();
    Some(StandsApart {
        recordings: places.iter().map(|&place| name(cases, place)).collect(),
        of: cases.len(),
        share: squares(apart) / squares(&all),
        times: (apart[count - 1].mean_square / others[0].mean_square).sqrt(),
    })
}

/// How many stand apart, once sorted, most first.
fn apart(all: &mut [Left]) -> Option<usize> {
    all.sort_by(|a, b| b.mean_square.total_cmp(&a.mean_square));
    let stands = |count: usize| all[count - 1].mean_square > APART * APART * all[count].mean_square;
    let count = (1..all.len().div_ceil(2)).find(|&count| stands(count))?;
    let is_unexplained = |one: &Left| one.share > APART_SHARE && one.has_a_cause;
    all[..count].iter().all(is_unexplained).then_some(count)
}

impl Left {
    /// `None` where nothing was simulated.
    fn of(place: usize, case: &FitTask<'_>, seen: &Seen<'_>) -> Option<Self> {
        let simulated = seen.simulated.get(case.quantity())?;
        // All of it, straight lines from restart to restart, too: a sensor that slips makes some.
        let left = case.missed(simulated).split_off(case.unscored());
        let squares: f64 = left.iter().map(|left| left * left).sum();
        Some(Self {
            place,
            squares,
            mean_square: squares / left.len() as f64,
            share: squares / power(slice::from_ref(case)),
            has_a_cause: outliers(&left).is_some() || is_a_motion(correlation(&[left]), false),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of so many samples each, of an output of power 1.
    fn left(rms: &[f64], has_a_cause: bool) -> Vec<Left> {
        let of_one = |(place, rms): (usize, &f64)| Left {
            place,
            squares: 1000.0 * rms * rms,
            mean_square: rms * rms,
            share: rms * rms,
            has_a_cause,
        };
        rms.iter().enumerate().map(of_one).collect()
    }

    #[test]
    fn fewer_than_half_that_leave_many_times_as_much_and_no_noise_stand_apart() {
        let found = |rms: &[f64]| apart(&mut left(rms, true));
        assert_eq!(found(&[0.02, 0.3, 0.02]), Some(1));
        assert_eq!(found(&[0.25, 0.3, 0.02, 0.03, 0.02]), Some(2));
        assert_eq!(found(&[0.3, 0.02]), None, "either may be the odd one");
        assert_eq!(found(&[0.3, 0.3, 0.02, 0.02]), None);
        assert_eq!(found(&[0.02, 0.08, 0.02]), None, "four times as much");
        assert_eq!(found(&[0.002, 0.05, 0.002]), None, "a good model of it");
        assert_eq!(apart(&mut left(&[0.02, 0.3, 0.02], false)), None, "noise");
    }

    #[test]
    fn those_that_stand_apart_come_first() {
        let mut all = left(&[0.02, 0.03, 0.3], true);
        assert_eq!(apart(&mut all), Some(1));
        assert_eq!(all[0].place, 2);
    }
}
