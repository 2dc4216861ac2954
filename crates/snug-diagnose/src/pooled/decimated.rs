//! Long records at a lower rate, on a coarser grid or in part, to look for effects in: what moves slowly for its rate, or goes on as it began, says
//! as much in a fraction of the points.

use crate::data::cases::{Cases, Tally};
use crate::data::machine::is_machine;
use crate::data::simulation::Asked;
use crate::pooled::equation::values_at;
use crate::pooled::fitted::Fitted;
use crate::pooled::long_record::{samples, take_long};
use crate::pooled::model::PooledModel;
use crate::pooled::thresholds::{
    AS_FAR, AS_MUCH, ENOUGH_TO_SEARCH, FEWEST_BETWEEN_RESTARTS, GRIDS, LOST, LOST_OF_GRID,
    MOST_TO_SEARCH, SHORTEST_DECIMATED, WHITE,
};
use snug_identify::FitTask;

/// The records at the lowest rate that is needed, or on the coarsest grid, and no more of them than says the same, where they take long and
/// hardly anything is lost; `fitted` is the study's own model at the full rate, whose error is what effects are looked for in.
pub(crate) fn decimated(records: &[FitTask<'_>], fitted: &Fitted) -> Option<Vec<FitTask<'static>>> {
    let is_possible = fitted.are_stretches() && !fitted.is_weighted;
    if !is_possible || !take_long(records) || !records.iter().all(is_machine) {
        return None;
    }
    let slow = at_lower_rate(records, fitted).or_else(|| on_coarser_grid(records, fitted));
    let there = slow.as_deref().unwrap_or(records);
    let share = MOST_TO_SEARCH as f64 / samples(there) as f64;
    match share < 1.0 && is_alike(records, fitted, share) {
        true => Some(
            there
                .iter()
                .map(|one| one.beginning(part(one, share)))
                .collect(),
        ),
        false => slow,
    }
}

/// Samples of a record's first part, a `share` of those that are scored.
fn part(record: &FitTask<'_>, share: f64) -> usize {
    let unscored = record.unscored();
    unscored + (share * record.measured().len().saturating_sub(unscored) as f64).ceil() as usize
}

fn at_lower_rate(records: &[FitTask<'_>], fitted: &Fitted) -> Option<Vec<FitTask<'static>>> {
    let shortest = records.iter().map(|one| one.measured().len()).min()?;
    let apart = records
        .iter()
        .filter_map(|one| one.input.samples_between_restarts());
    let most = (samples(records) / ENOUGH_TO_SEARCH)
        .min(shortest / SHORTEST_DECIMATED)
        .min(apart.min().unwrap_or(usize::MAX) / FEWEST_BETWEEN_RESTARTS);
    let halves = std::iter::successors(Some(most), |factor| Some(factor / 2));
    let factor = halves
        .take_while(|&factor| factor >= 2)
        .find(|&factor| keeps_what_matters(records, fitted, factor))?;
    Some(records.iter().map(|one| one.decimated(factor)).collect())
}

/// The records on the coarsest grid of their inputs on which the model ends hardly elsewhere; `None` where that is the one they have.
fn on_coarser_grid(records: &[FitTask<'_>], fitted: &Fitted) -> Option<Vec<FitTask<'static>>> {
    if !records.iter().all(|one| one.input.is_band_limited()) {
        return None;
    }
    let finest = records.iter().map(|one| one.input.substeps()).min()?;
    let mut grids = GRIDS
        .into_iter()
        .filter(|&substeps| substeps < finest)
        .peekable();
    grids.peek()?;
    let exact = outputs(records, fitted)?;
    let mut coarser = grids.map(|substeps| -> Vec<FitTask<'static>> {
        records.iter().map(|one| one.on_grid(substeps)).collect()
    });
    coarser.find(|coarser| {
        let Some(rough) = outputs(coarser, fitted) else {
            return false;
        };
        let pairs = exact.iter().flatten().zip(rough.iter().flatten());
        let lost: f64 = pairs.map(|(exact, rough)| (exact - rough).powi(2)).sum();
        tracing::debug!(share = lost / fitted.squares(), "lost on a coarser grid");
        lost <= LOST_OF_GRID * fitted.squares()
    })
}

/// What the model says of each record.
fn outputs(records: &[FitTask<'_>], fitted: &Fitted) -> Option<Vec<Vec<f64>>> {
    let tally = Tally::default();
    let cases = Cases::new(records, &tally);
    let pooled = PooledModel::shared_by(cases, &fitted.effects, &fitted.sharing).ok()?;
    let values = values_at(&pooled, &fitted.start(&pooled));
    let asked = records.iter().zip(&values).enumerate();
    let asked = asked.map(|(member, (one, values))| Asked {
        member,
        input: &one.input,
        values,
    });
    Some(pooled.outputs(&asked.collect::<Vec<_>>()))
}

/// What samples of records say of them.
#[derive(Default)]
struct Sums {
    moved: f64,
    missed: f64,
    farthest: f64,
}

impl Sums {
    fn add(&mut self, measured: f64, simulated: f64) {
        self.moved += measured * measured;
        self.missed += (measured - simulated).powi(2);
        self.farthest = self.farthest.max(measured.abs());
    }
}

/// Whether that share of every record, from its beginning on, moves as far as the whole, as much, and misses the model by as much.
fn is_alike(records: &[FitTask<'_>], fitted: &Fitted, share: f64) -> bool {
    let Some(simulated) = outputs(records, fitted) else {
        return false;
    };
    let (mut whole, mut first) = (Sums::default(), Sums::default());
    for (record, simulated) in records.iter().zip(&simulated) {
        let end = part(record, share);
        let pairs = record.measured().iter().zip(simulated).enumerate();
        for (sample, (&measured, &simulated)) in pairs.skip(record.unscored()) {
            whole.add(measured, simulated);
            if sample < end {
                first.add(measured, simulated);
            }
        }
    }
    let is_as_much =
        |first: f64, whole: f64| (1.0 / AS_MUCH..=AS_MUCH).contains(&(first / (share * whole)));
    is_as_much(first.moved, whole.moved)
        && is_as_much(first.missed, whole.missed)
        && first.farthest >= AS_FAR * whole.farthest
}

/// Whether what means over `factor` samples lose of the output is little beside the error, or white.
fn keeps_what_matters(records: &[FitTask<'_>], fitted: &Fitted, factor: usize) -> bool {
    let lost: Vec<Vec<f64>> = (records.iter())
        .map(|one| between_means(&one.measured()[one.unscored()..], factor))
        .collect();
    let products = |lag: usize| -> f64 {
        let of_one =
            |lost: &Vec<f64>| -> f64 { lost.iter().zip(&lost[lag..]).map(|(a, b)| a * b).sum() };
        lost.iter().map(of_one).sum()
    };
    let squares = products(0);
    let is_white = || {
        let expected = 1.0 / factor as f64;
        (1..=3).all(|lag| products(lag).abs() < (WHITE + expected) * squares)
    };
    squares <= LOST * fitted.squares() || is_white()
}

/// A signal less the straight lines between the means of every `factor` samples, from the middle of the first to that of the last.
fn between_means(signal: &[f64], factor: usize) -> Vec<f64> {
    let means: Vec<f64> = (signal.chunks_exact(factor))
        .map(|part| part.iter().sum::<f64>() / factor as f64)
        .collect();
    let middle = 0.5 * (factor - 1) as f64;
    let end = (means.len().saturating_sub(1)) * factor;
    let first = middle.ceil() as usize;
    (first..(first + end).min(signal.len()))
        .filter_map(|sample| {
            let place = (sample as f64 - middle) / factor as f64;
            let (before, part) = (place as usize, place.fract());
            let (a, b) = (means.get(before)?, means.get(before + 1)?);
            Some(signal[sample] - a - part * (b - a))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::clusters::Clusters;
    use crate::pooled::fit::fit_effects;
    use crate::tests::made_up::machine_sampled;
    use snug_campaign::Intersample;
    use snug_model::Input;
    use std::borrow::Cow;

    fn correlation(lost: &[f64]) -> f64 {
        let squares: f64 = lost.iter().map(|x| x * x).sum();
        lost.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / squares
    }

    /// A straight line loses nothing; of sin t the second difference over 8 h is lost, (8 h)² / 8 at most, and a bit by the means.
    #[test]
    fn what_bends_is_lost() {
        let line: Vec<f64> = (0..400).map(|k| 3.0 + 0.5 * f64::from(k)).collect();
        let lost = between_means(&line, 8);
        assert!(lost.len() > 380 && lost.iter().all(|x| x.abs() < 1e-9));
        let sine: Vec<f64> = (0..4000).map(|k| (0.01 * f64::from(k)).sin()).collect();
        let lost = between_means(&sine, 8);
        let largest = lost.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(
            (0.4..1.6).contains(&(largest / (0.08_f64.powi(2) / 8.0))),
            "{largest}"
        );
        assert!(correlation(&lost) > 0.9);
    }

    #[test]
    fn noise_is_lost_but_stays_white() {
        let mut state = 1_u64;
        let noise: Vec<f64> = (0..8000)
            .map(|_| {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                (state >> 33) as f64 / 2.0_f64.powi(31) - 0.5
            })
            .collect();
        let lost = between_means(&noise, 8);
        assert!(correlation(&lost).abs() < WHITE + 0.125);
    }

    /// The machine with dry friction, its input band-limited, fitted without that.
    fn with_friction(interval_s: f64, friction_nm: f64) -> (FitTask<'static>, Fitted) {
        let task = machine_sampled(interval_s, friction_nm);
        let torque_nm = task.input.logged_nm();
        let input = Input::new(torque_nm, interval_s, Intersample::BandLimited);
        let task = FitTask {
            input: Cow::Owned(input),
            ..task
        };
        let tally = Tally::default();
        let cases = [task.lent()];
        let cases = Cases::new(&cases, &tally);
        let clusters = Clusters::of(&cases);
        let fitted = fit_effects(cases, &[], None, clusters).expect("it can be fitted");
        (task, fitted)
    }

    /// From sample to sample the faster sine goes on by 0.055 rad, or by 1.1, where little but that is left, too.
    #[test]
    fn a_grid_is_as_coarse_as_the_motion_allows() {
        let substeps = |(task, fitted): &(FitTask<'_>, Fitted)| {
            let coarser = on_coarser_grid(&[task.lent()], fitted);
            coarser.map(|coarser| coarser[0].input.substeps())
        };
        let slow = with_friction(5e-3, 2.0);
        assert_eq!(substeps(&slow), Some(2));
        let fast = with_friction(0.1, 1e-3);
        assert_ne!(substeps(&fast), Some(2));
        let (mut straight, fitted) = slow;
        let torque_nm = straight.input.logged_nm();
        let input = Input::new(torque_nm, 5e-3, Intersample::Linear);
        straight.input = Cow::Owned(input);
        assert_eq!(substeps(&(straight, fitted)), None);
    }

    #[test]
    fn a_beginning_that_moves_less_than_the_whole_does_not_stand_for_it() {
        let (mut task, fitted) = with_friction(5e-3, 2.0);
        // The simulation begins at rest.
        task.settings.to_mut().unscored_samples = 400;
        assert!(is_alike(&[task.lent()], &fitted, 0.5));
        let mut as_much_and_farther = task.lent();
        let motion = &mut as_much_and_farther.tightening.to_mut().motion;
        let measured = motion.velocity_rad_per_s.as_mut().expect("it was measured");
        measured[2513] *= 2.0;
        assert!(!is_alike(&[as_much_and_farther], &fitted, 0.5));
        let motion = &mut task.tightening.to_mut().motion;
        let measured = motion.velocity_rad_per_s.as_mut().expect("it was measured");
        measured[1500..].iter_mut().for_each(|speed| *speed *= 1.1);
        assert!(
            !is_alike(&[task.lent()], &fitted, 0.5),
            "it misses the model by more"
        );
    }
}
