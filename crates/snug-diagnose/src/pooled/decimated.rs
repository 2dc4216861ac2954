//! Long records at a lower rate, on a coarser grid or in part, to look for effects in: what moves slowly for its rate, or goes on as it began, says
//! as much in a fraction of the points.

use crate::data::cases::{Cases, Tally};
use crate::data::machine::is_machine;
use crate::data::simulation::{Asked, simulate};
use crate::pooled::equation::values;
use crate::pooled::fitted::Fitted;
use crate::pooled::long_record::take_long;
use crate::pooled::thresholds::{
    AS_FAR, AS_MUCH, ENOUGH_TO_SEARCH, FEWEST_BETWEEN_RESTARTS, GRIDS, LOST, LOST_OF_GRID,
    MOST_TO_SEARCH, SHORTEST_DECIMATED, WHITE,
};
use snug_identify::FitTask;
use snug_model::Model;

/// The records at the lowest rate that is needed, or on the coarsest grid, and no more of them than says the same, where they take long and
/// hardly anything is lost; `fitted` is the study's own model at the full rate, whose error is what effects are looked for in.
pub(crate) fn decimated(records: &[FitTask<'_>], fitted: &Fitted) -> Option<Vec<FitTask<'static>>> {
    let is_possible = fitted.are_stretches() && !fitted.is_weighted;
    if !is_possible || !take_long(records) || !records.iter().all(is_machine) {
        return None;
    }
    let slow = at_lower_rate(records, fitted).or_else(|| on_coarser_grid(records, fitted));
    let there = slow.as_deref().unwrap_or(records);
    let share = MOST_TO_SEARCH as f64 / count(there) as f64;
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

fn count(records: &[FitTask<'_>]) -> usize {
    records.iter().map(|one| one.measured().len()).sum()
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
    let most = (count(records) / ENOUGH_TO_SEARCH)
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
    let finest = records.iter().map(|one| one.input.substeps()).min()?;
    if GRIDS.iter().all(|&substeps| substeps >= finest) {
        return None;
    }
    let exact = simulated(records, fitted)?;
    let coarser = GRIDS.into_iter().filter(|&substeps| substeps < finest);
    let mut coarser = coarser.map(|substeps| -> Vec<FitTask<'static>> {
        records.iter().map(|one| one.on_grid(substeps)).collect()
    });
    coarser.find(|coarser| {
        let Some(rough) = simulated(coarser, fitted) else {
            return false;
        };
        let pairs = exact.iter().flatten().zip(rough.iter().flatten());
        let lost: f64 = pairs.map(|(exact, rough)| (exact - rough).powi(2)).sum();
        tracing::debug!(share = lost / fitted.squares(), "lost on a coarser grid");
        lost <= LOST_OF_GRID * fitted.squares()
    })
}

/// What the model says of each record.
fn simulated(records: &[FitTask<'_>], fitted: &Fitted) -> Option<Vec<Vec<f64>>> {
    let models: Result<Vec<Model>, _> = (records.iter())
        .map(|one| one.model_with(&fitted.effects))
        .collect();
    let models = models.ok()?;
    let values = values(Cases::new(records, &Tally::default()), fitted)?;
    let asked = records.iter().zip(&values).enumerate();
    let asked: Vec<Asked<'_>> = asked
        .map(|(member, (one, values))| Asked {
            member,
            input: &one.input,
            values,
        })
        .collect();
    let mut simulated = Vec::new();
    simulate(records, &models, &asked, &[], &mut simulated);
    Some(simulated.into_iter().map(|one| one.output).collect())
}

/// Whether that share of every record, from its beginning on, moves as far as the whole, as much, and misses the model by as much.
fn is_alike(records: &[FitTask<'_>], fitted: &Fitted, share: f64) -> bool {
    let Some(simulated) = simulated(records, fitted) else {
        return false;
    };
    let (mut whole, mut first) = ([0.0_f64; 3], [0.0_f64; 3]);
    for (record, simulated) in records.iter().zip(&simulated) {
        let pairs = record.measured().iter().zip(simulated).enumerate();
        for (sample, (measured, simulated)) in pairs.skip(record.unscored()) {
            let square = measured * measured;
            let says = [square, (measured - simulated).powi(2)];
            let is_first = sample < part(record, share);
            for sums in [Some(&mut whole), is_first.then_some(&mut first)]
                .into_iter()
                .flatten()
            {
                sums[0] += says[0];
                sums[1] += says[1];
                sums[2] = sums[2].max(square);
            }
        }
    }
    let as_much = |index: usize| {
        let ratio = first[index] / (share * whole[index]);
        (1.0 / AS_MUCH..=AS_MUCH).contains(&ratio)
    };
    as_much(0) && as_much(1) && first[2] >= AS_FAR * AS_FAR * whole[2]
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
    use crate::tests::made_up::on_machine;
    use snug_campaign::{Intersample, Quantity};
    use snug_model::{Input, Scale};
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

    /// What a machine of 0.4 kg m², 1.9 Nm s/rad and 30 Nm/rad is moved by along two sines, beside dry friction, and fitted without that.
    fn with_friction(interval_s: f64, friction_nm: f64) -> (FitTask<'static>, Fitted) {
        let scale = Scale::Rig {
            torque_nm: 15.0,
            angle_rad: 0.8,
            time_s: 0.15,
        };
        let (mut torque_nm, mut measured) = (Vec::new(), Vec::new());
        for sample in 0..1500 {
            let (x, y) = (
                5.0 * interval_s * f64::from(sample),
                11.0 * interval_s * f64::from(sample),
            );
            let (angle, velocity) = (x.sin() + 0.5 * y.sin(), 5.0 * x.cos() + 5.5 * y.cos());
            let acceleration = -25.0 * x.sin() - 60.5 * y.sin();
            let friction = friction_nm * velocity.signum();
            torque_nm.push(0.4 * acceleration + 1.9 * velocity + 30.0 * angle + friction);
            measured.push(velocity);
        }
        let input = Input::new(&torque_nm, interval_s, Intersample::BandLimited);
        let task = on_machine(scale, interval_s, torque_nm, Quantity::Velocity, measured);
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
        measured[1200] *= 2.0;
        assert!(!is_alike(&[as_much_and_farther], &fitted, 0.5));
        let motion = &mut task.tightening.to_mut().motion;
        let measured = motion.velocity_rad_per_s.as_mut().expect("it was measured");
        measured[750..].iter_mut().for_each(|speed| *speed *= 1.1);
        assert!(
            !is_alike(&[task.lent()], &fitted, 0.5),
            "it misses the model by more"
        );
    }
}
