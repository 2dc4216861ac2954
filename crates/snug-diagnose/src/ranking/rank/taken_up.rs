//! What a model that is restarted leaves beside errors of the motion it is taken up with, and beside loads that nobody recorded.
//!
//! The motion at a restart is measured with noise, and read off samples on either side with a bend of its own. An effect whose states run on
//! over restarts is driven by that motion, and foretells its errors better than any force of the rig. It foretells loads, too, as an observer
//! does: what moved the rig before a restart goes on after it.

use crate::data::cases::Cases;
use crate::pooled::equation::values;
use crate::pooled::fitted::Fitted;
use crate::ranking::rank::Candidate;
use crate::settings::DiagnoseSettings;
use rayon::prelude::*;
use snug_campaign::Quantity;
use snug_identify::FitTask;
use snug_least_squares::matrix::inner_product as dot;
use snug_model::{Input, Law, Model};
use std::borrow::Cow;
use std::ops::Range;

/// Of the measured displacement, or of the input, root mean square, by which the motion at restarts or the load is moved to see what that
/// changes \[–\]. Chosen: small beside the motion, large beside rounding.
const MOVED_BY: f64 = 1e-4;

/// Share of what a candidate takes away of all that is left, which it must take of what no other motion at a restart takes away, too \[–\].
/// Chosen: an attached mass that two rigs did not have took 48 and 59 % of all and 0.04 and 0 times as much of that; dry friction, gravity, a
/// stiffening spring and half an interval that others had, 0.3 times or more. A steady force beside as much white noise takes 0.08 times.
const TAKEN_BESIDE: f64 = 0.05;

/// The same of what no load takes away either that is steady or grows evenly from one restart to the next, for a candidate with states of its
/// own \[–\]. Chosen: an attached mass and a second mode that five rigs did not have took 0.14 times as much or less, a load that swings below a
/// trolley in gusts 0.6 to 1.0 times, the lag of a drive in gusts 0.9 times.
const TAKEN_BESIDE_LOADS: f64 = 0.35;

/// Looks which of the candidates that take enough to matter take no more than another motion at restarts would.
pub(super) fn look_beside_restarts(
    cases: Cases<'_>,
    current: &Fitted,
    candidates: &mut [Candidate],
    settings: &DiagnoseSettings,
) {
    if !cases.are_restarted() {
        return;
    }
    let all = current.heldout_beyond_torque_noise().iter().sum::<f64>();
    let gains = candidates.iter_mut().map(|one| (one.gain() / all, one));
    let that_matter: Vec<_> = gains
        .filter(|(gain, _)| *gain > settings.smallest_gain)
        .collect();
    if that_matter.is_empty() {
        return;
    }
    let Some(without) = runs(&cases, current, MOTIONS + LOADS) else {
        return;
    };
    that_matter.into_par_iter().for_each(|(gain, one)| {
        let (own, unknown, least) = match one.effect.description().states {
            [] => (MOTIONS, MOTIONS, TAKEN_BESIDE),
            _ => (0, MOTIONS + LOADS, TAKEN_BESIDE_LOADS),
        };
        if let Some(with) = runs(&cases, &one.fitted, own) {
            let taken = taken_beside_restarts(&without, &with, unknown);
            one.shows_beside_restarts = taken.is_none_or(|taken| taken > least * gain);
            tracing::debug!(effect = one.effect.name(), taken, gain, "beside restarts");
        }
    });
}

/// Share of what is left without an effect that it takes away beside the [changes](Run::changes), with it those that its runs have and without
/// it so many; `None` where that is no number.
///
/// What another motion changes with the effect and what it changes without are taken off both: an effect that bends what comes after a restart
/// otherwise would be judged by another measure, and where dry friction holds, another velocity changes nothing. What goes on over restarts
/// makes of another motion there whatever it makes of the rig's, so that of such an effect only those without it count.
fn taken_beside_restarts(without: &[Run<'_>], with: &[Run<'_>], unknown: usize) -> Option<f64> {
    let (mut left_without, mut left_with) = (0.0, 0.0);
    for (without, with) in without.iter().zip(with) {
        let changes = [&with.changes[..], &without.changes[..unknown]];
        left_without += without.left_beside(changes);
        left_with += with.left_beside(changes);
    }
    Some(1.0 - left_with / left_without).filter(|share| share.is_finite())
}

/// A recording as a model runs from restart to restart.
struct Run<'a> {
    case: FitTask<'a>,
    simulated: Vec<f64>,
    /// What another angle and another velocity at every restart change of that, and what a load that is steady and one that grows evenly from
    /// restart to restart.
    changes: Vec<Vec<f64>>,
}

/// Changes of the motion at restarts.
const MOTIONS: usize = 2;
/// Changes of the load.
const LOADS: usize = 2;

/// Every recording; `None` where nothing is restarted, or one cannot be simulated.
fn runs<'a>(cases: &'a Cases<'_>, fitted: &Fitted, unknown: usize) -> Option<Vec<Run<'a>>> {
    let values = values(*cases, fitted)?;
    let of_one = |(case, values): (&'a FitTask<'_>, Vec<f64>)| {
        let model = case.model_with(&fitted.effects).ok()?;
        Run::of(case.lent(), &model, &values, unknown)
    };
    cases.iter().zip(values).map(of_one).collect()
}

impl<'a> Run<'a> {
    /// With so many of the changes.
    fn of(case: FitTask<'a>, model: &Model, values: &[f64], unknown: usize) -> Option<Self> {
        let apart = case.input.samples_between_restarts()?;
        let simulated = case.simulated(model, values).ok()?;
        let angles = case.tightening.motion.get(Quantity::Displacement)?;
        let angle = MOVED_BY * root_mean_square(angles);
        let velocity = angle / (apart as f64 * case.tightening.time_base.interval_s);
        let torques = case.input.logged_nm();
        let load = MOVED_BY * root_mean_square(torques);
        let growing = |k: usize| load * (k % apart) as f64 / apart as f64;
        let growing: Vec<f64> = (0..torques.len()).map(growing).collect();
        let changed = |input: Input| -> Option<Vec<f64>> {
            let other = FitTask {
                input: Cow::Owned(input),
                ..case.lent()
            };
            let other = other.simulated(model, values).ok()?;
            Some(other.iter().zip(&simulated).map(|(a, b)| a - b).collect())
        };
        let moved = |by| changed(case.input.clone().into_owned().with_restarts_moved(by));
        let loaded = |by: &[f64]| changed(case.input.with_added(by));
        let change = |number: usize| match number {
            0 => moved([angle, 0.0]),
            1 => moved([0.0, velocity]),
            2 => loaded(&vec![load; torques.len()]),
            _ => loaded(&growing),
        };
        let changes = (0..unknown).map(change).collect::<Option<_>>()?;
        Some(Self {
            case,
            simulated,
            changes,
        })
    }

    /// Σ r² that nothing takes away which makes these `changes` with a model and with another \[the output's unit squared\].
    fn left_beside(&self, changes: [&[Vec<f64>]; 2]) -> f64 {
        let left = self.case.missed(&self.simulated);
        let of_stretch = |stretch: Range<usize>| {
            let of_model = |changes: &[Vec<f64>]| {
                changes
                    .iter()
                    .map(|one| one[stretch.clone()].to_vec())
                    .collect()
            };
            squares_beside(&left[stretch.clone()], changes.map(of_model))
        };
        let stretches = self.case.input.stretches(self.case.unscored());
        stretches.map(of_stretch).sum()
    }
}

/// Share that the first model's changes must leave of what another's change has beside that model's others, for a direction of its own \[–\]: what
/// two models change nearly alike would take what tells them apart. Chosen: of what another velocity changes with a spring half as stiff again,
/// a few hundred-thousandths are left, and those took from that spring what it bends; of what it changes without a friction that stops it at
/// once, 0.15 or more.
const OWN_DIRECTION: f64 = 0.01;

/// The same of a model's own changes, of which less is left by rounding only \[–\]. Chosen.
const ROUNDING: f64 = 1e-9;

fn root_mean_square(values: &[f64]) -> f64 {
    (dot(values, values) / values.len() as f64).sqrt()
}

/// Σ r² of what is left of `r` beside the nearest sum of these `changes` of a model and of those of another that are directions of their own.
fn squares_beside(r: &[f64], changes: [Vec<Vec<f64>>; 2]) -> f64 {
    let take = |from: &mut [f64], along: &[f64]| {
        let size = dot(from, along) / dot(along, along);
        let pairs = from.iter_mut().zip(along);
        pairs.for_each(|(value, along)| *value -= size * along);
    };
    let mut r = r.to_vec();
    let mut known: Vec<Vec<f64>> = Vec::new();
    for (changes, least) in changes.into_iter().zip([ROUNDING, OWN_DIRECTION]) {
        let mut of_model: Vec<Vec<f64>> = Vec::new();
        for mut change in changes {
            let whole = dot(&change, &change);
            of_model.iter().for_each(|one| take(&mut change, one));
            let further = dot(&change, &change);
            if further > ROUNDING * whole {
                of_model.push(change.clone());
                known.iter().for_each(|one| take(&mut change, one));
                if dot(&change, &change) > least * further {
                    take(&mut r, &change);
                    known.push(change);
                }
            }
        }
    }
    dot(&r, &r)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::tests::made_up::on_machine;
    use snug_model::{Effect, Scale};

    /// Σ over t = 0 … n − 1 of what no straight line takes of t²: n (n² − 1) (n² − 4) / 180, the square of the discrete Legendre polynomial.
    #[test]
    fn what_a_line_takes_of_a_parabola_is_not_counted() {
        let times: Vec<f64> = (0..9).map(f64::from).collect();
        let parabola: Vec<f64> = times.iter().map(|t| 5.0 - 3.0 * t + t * t).collect();
        let line = [vec![vec![1.0; 9], times.clone()], vec![vec![2.0; 9]]];
        let left = squares_beside(&parabola, line);
        let expected = 9.0 * 80.0 * 77.0 / 180.0;
        assert!((left / expected - 1.0).abs() < 1e-12, "{left}");
        let nothing = [vec![vec![0.0; 9]], vec![vec![0.0; 9]]];
        assert_eq!(squares_beside(&parabola, nothing), 4017.0);
    }

    /// x = 0.01 m · cos ωt of a mass on a spring that is taken up wrongly every tenth sample.
    #[test]
    fn a_wrong_motion_at_restarts_is_not_counted_and_a_wrong_spring_is() {
        let (mass, stiffness, apart, interval_s) = (0.5, 800.0, 10, 1e-3);
        let omega = f64::sqrt(stiffness / mass);
        let at = |k: usize| (omega * k as f64 * interval_s).sin_cos();
        let measured: Vec<f64> = (0..1000).map(|k| 0.01 * at(k).1).collect();
        let scale = Scale::Rig {
            torque_nm: 5.0,
            angle_rad: 0.01,
            time_s: 0.025,
        };
        let free = on_machine(
            scale,
            interval_s,
            vec![0.0; 1000],
            Quantity::Displacement,
            measured,
        );
        let wrongly = |k: usize| {
            let (sine, cosine) = at(k);
            let error = 1e-3 * (k as f64).sin();
            [0.01 * cosine + error, -0.01 * omega * sine - 50.0 * error]
        };
        let motions = (0..1000).step_by(apart).map(wrongly).collect();
        let restarted = FitTask {
            input: Cow::Owned(
                free.input
                    .clone()
                    .into_owned()
                    .with_restarts(apart, motions),
            ),
            ..free.clone()
        };
        let run = |case: &'_ FitTask<'static>, stiffness: f64| {
            let model = case.model.clone().into_owned();
            Run::of(case.clone(), &model, &[mass, 0.0, stiffness], MOTIONS)
        };
        let taken = |one: f64, other: f64| {
            let runs = [one, other].map(|stiffness| [run(&restarted, stiffness).unwrap()]);
            taken_beside_restarts(&runs[0], &runs[1], MOTIONS).unwrap()
        };
        assert!(taken(1.5 * stiffness, stiffness) > 0.999);
        assert!(taken(stiffness, 1.5 * stiffness) < -100.0);
        assert!(run(&free, stiffness).is_none());
    }

    /// A body that rests, with what its sensor adds, is taken up with velocities that it does not have. Dry friction stops each at once, and no
    /// other velocity changes that.
    #[test]
    fn friction_that_stops_wrong_motions_at_restarts_takes_nothing_away() {
        let (apart, interval_s) = (10, 1e-3);
        let added = |k: usize| 1e-6 * ((k * k) as f64).sin();
        let scale = Scale::Rig {
            torque_nm: 5.0,
            angle_rad: 0.01,
            time_s: 0.025,
        };
        let measured: Vec<f64> = (0..1000).map(added).collect();
        let mut case = on_machine(
            scale,
            interval_s,
            vec![0.0; 1000],
            Quantity::Displacement,
            measured,
        );
        let wrongly = |k: usize| [0.0, 0.01 * (k as f64).sin()];
        let motions = (0..1000).step_by(apart).map(wrongly).collect();
        case.input = Cow::Owned(case.input.into_owned().with_restarts(apart, motions));
        let plain = case.model.clone().into_owned();
        let rubs = plain.with_effect(Effect::CoulombFriction).unwrap();
        let run =
            |model: &Model, values: &[f64]| [Run::of(case.lent(), model, values, MOTIONS).unwrap()];
        let slides = run(&plain, &[0.5, 0.0, 0.0]);
        let stops = run(&rubs, &[0.5, 0.0, 0.0, 10.0]);
        let left = |run: &Run<'_>| -> f64 {
            let pairs = run.case.measured().iter().zip(&run.simulated);
            pairs.map(|(y, s)| (y - s).powi(2)).sum()
        };
        assert!(left(&stops[0]) < 0.1 * left(&slides[0]));
        let taken = taken_beside_restarts(&slides, &stops, MOTIONS).unwrap();
        assert!(taken.abs() < 0.05, "{taken}");
    }

    /// A body that is pulled by 1 N more than was recorded and rests at every restart: beside loads, no offset of the force is told.
    #[test]
    fn what_a_steady_load_takes_away_is_not_counted_beside_loads() {
        let (mass, apart, interval_s) = (0.5, 20, 1e-3);
        let scale = Scale::Rig {
            torque_nm: 5.0,
            angle_rad: 0.01,
            time_s: 0.025,
        };
        let pulled = |k: usize| 0.5 * 2.0 / mass * ((k % apart) as f64 * interval_s).powi(2);
        let measured = (0..1000).map(|k| pulled(k) + 1e-6 * ((k * k) as f64).sin());
        let mut case = on_machine(
            scale,
            interval_s,
            vec![1.0; 1000],
            Quantity::Displacement,
            measured.collect(),
        );
        let motions = vec![[0.0; 2]; 1000 / apart];
        case.input = Cow::Owned(case.input.into_owned().with_restarts(apart, motions));
        let plain = case.model.clone().into_owned();
        let offset = plain.with_effect(Effect::TorqueOffset).unwrap();
        let run = |model: &Model, values: &[f64], unknown| {
            [Run::of(case.lent(), model, values, unknown).unwrap()]
        };
        let without = run(&plain, &[mass, 0.0, 0.0], MOTIONS + LOADS);
        let with = run(&offset, &[mass, 0.0, 0.0, -1.0], 0);
        let beside = |unknown| taken_beside_restarts(&without, &with, unknown).unwrap();
        assert!(beside(MOTIONS) > 0.9, "{}", beside(MOTIONS));
        let beside_loads = beside(MOTIONS + LOADS);
        assert!(beside_loads.abs() < 1e-3, "{beside_loads}");
    }
}
