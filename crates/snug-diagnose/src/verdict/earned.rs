//! Whether there is a model at all that a verdict could be about, and what to check where there is none.

use crate::data::neighbours::correlation;
use crate::data::power::power;
use crate::data::white_noise::is_white_noise;
use crate::locate::Seen;
use crate::pooled::equation::PlainEquation;
use crate::pooled::fitted::Fitted;
use crate::ranking::rank::Candidate;
use crate::selection::path::SelectionPath;
use crate::selection::thresholds::{MOST, SMALL};
use crate::settings::DiagnoseSettings;
use crate::verdict::pushed_away::{is_a_weight, may_be_held_back, may_push_away, pushed_away};
use crate::verdict::thresholds::{
    FAR_BETTER, FEW_SAMPLES, LEAST_EXPLAINED, MOST_IN_FEW, MOSTLY_EXPLAINED, SHORTFALL,
};
use crate::verdict::unsigned::lost_their_sign;
use snug_campaign::Quantity;
use snug_campaign::words::explained::{Explained, is_white};
use snug_campaign::words::suspicion::Suspicion;
use snug_identify::{EquationFit, FitTask, spectral_start};
use snug_signal::without_trend;
use std::borrow::Cow;

/// Share of the fitted output's power that `fitted` explains, all tightenings together \[–\]; `None` where the noise is known and
/// says more.
pub(crate) fn share(cases: &[FitTask<'_>], fitted: &Fitted) -> Option<f64> {
    (!fitted.is_weighted).then(|| 1.0 - fitted.squares() / power(cases))
}

/// The same in words, with how far from noise is what is left.
pub(crate) fn explained(
    cases: &[FitTask<'_>],
    fitted: &Fitted,
    seen: &[Seen<'_>],
) -> Option<Explained> {
    let first = cases.first()?;
    Some(Explained {
        output: first.quantity().name(),
        share: share(cases, fitted)?,
        neighbours: correlation(&left(cases, seen)),
        is_exact: fitted.is_exact,
        beside_lines: first.is_beside_lines(),
    })
}

/// What no model could explain of what a model leaves, if that is nearly all of it: a few samples, or noise.
pub(crate) fn left_over(
    cases: &[FitTask<'_>],
    explained: Option<&Explained>,
    seen: &[Seen<'_>],
) -> Option<Suspicion> {
    let explained = explained?;
    let is_white = is_white(explained.neighbours) && explained.share > 0.0;
    outliers(&left(cases, seen).concat()).or(is_white.then_some(Suspicion::Noise))
}

/// The few samples that hold most of the squared error, if they do.
fn outliers(left: &[f64]) -> Option<Suspicion> {
    let mut squares: Vec<f64> = left.iter().map(|left| left * left).collect();
    squares.sort_by(|a, b| b.total_cmp(a));
    let of = squares.len();
    let samples = (FEW_SAMPLES * of as f64).ceil() as usize;
    let all: f64 = squares.iter().sum();
    let share = squares.iter().take(samples).sum::<f64>() / all;
    (share > MOST_IN_FEW).then_some(Suspicion::Outliers { samples, of, share })
}

/// What is left of each that was measured, see [`FitTask::left`].
fn left(cases: &[FitTask<'_>], seen: &[Seen<'_>]) -> Vec<Vec<f64>> {
    let measured = (cases.iter().zip(seen)).filter(|(case, _)| !case.measured().is_empty());
    let of_one = |(case, one): (&FitTask<'_>, &Seen<'_>)| {
        let simulated = one.simulated.get(case.quantity())?;
        Some(case.left(simulated))
    };
    measured.filter_map(of_one).collect()
}

/// Whether what is left is white noise, however long it is looked at.
pub(crate) fn leaves_noise(cases: &[FitTask<'_>], seen: &[Seen<'_>]) -> bool {
    is_white_noise(&left(cases, seen))
}

/// Whether what is left is a motion of which no promising candidate explains much, where nobody knows the noise.
pub(crate) fn leaves_a_motion(
    path: &SelectionPath,
    settings: &DiagnoseSettings,
    explained: Option<&Explained>,
) -> bool {
    let last = path.last();
    let promising = path.is_promising(settings);
    let explains_much = |one: &Candidate| one.gain_beside(last) > MOST * last.squares();
    explained.is_some_and(Explained::leaves_a_motion) && !promising.is_some_and(explains_much)
}

/// Whether the model `after` leaves more than noise, or where nobody knows that a motion that is no small part of what `before` left.
pub(crate) fn leaves_more_than_noise(
    before: &Fitted,
    after: &Fitted,
    explained: Option<&Explained>,
) -> bool {
    let is_part = after.squares() > SMALL * before.squares();
    after.is_beyond_noise() || (is_part && explained.is_some_and(Explained::leaves_a_motion))
}

/// Whether a model that explains so much deserves a question about effects.
pub(crate) fn is_a_model(share: Option<f64>) -> bool {
    share.is_none_or(|share| share >= LEAST_EXPLAINED)
}

/// Whether it may be called adequate: m, c, k alone do no better from where the spectra put them.
pub(crate) fn keeps_the_promise(share: Option<f64>, cases: &[FitTask<'_>]) -> bool {
    let is_kept = |share| from_the_spectra(cases).is_none_or(|other| share >= other - SHORTFALL);
    share.is_none_or(is_kept)
}

/// Share that m, c, k alone explain where the spectra put them, as the fit simulates them.
fn from_the_spectra(cases: &[FitTask<'_>]) -> Option<f64> {
    let start = spectral_start(cases)?;
    let mut left = 0.0;
    for case in cases {
        let base = case.model.with_effects(&[]).ok()?;
        left += case.squares_left(&base, &start.values).ok()?;
    }
    Some(1.0 - left / power(cases)).filter(|share| share.is_finite())
}

/// Share of the output's power that m, c, k explain where they are fitted to the spectra.
fn promised(cases: &[FitTask<'_>]) -> Option<f64> {
    spectral_start(cases).map(|start| 1.0 - start.unexplained)
}

/// The recording with its input's other sign.
fn turned<'a>(case: &FitTask<'a>) -> FitTask<'a> {
    let mut case = case.clone();
    let torques = &mut case.tightening.to_mut().torque_nm;
    torques.iter_mut().for_each(|torque| *torque = -*torque);
    case
}

/// The recording without the straight line in its output.
fn level<'a>(case: &FitTask<'a>) -> FitTask<'a> {
    let mut case = case.clone();
    let output = without_trend(case.measured().to_vec());
    let quantity = case.quantity();
    case.tightening.to_mut().motion.set(quantity, output);
    case
}

/// How well m, c, k alone explain the records with a channel changed, where that is far better than as they are, dry friction and an
/// offset beside them in a plain regression, or an output's drift: what makes a rate of it takes the drift away, too.
struct Changed<'a> {
    cases: &'a [FitTask<'a>],
    as_it_is: f64,
}

impl<'a> Changed<'a> {
    fn of(cases: &'a [FitTask<'a>]) -> Self {
        let level: Vec<FitTask<'_>> = cases.iter().map(level).collect();
        let promises = [cases, &level].map(|some| promised(some).unwrap_or(0.0));
        let alone = promises[0].max(promises[1]);
        let regressed = PlainEquation::of(cases).and_then(|plain| plain.with_friction());
        let regressed = regressed.filter(EquationFit::is_driven);
        tracing::debug!(alone, ?regressed, "the channels as they are declared");
        Self {
            cases,
            as_it_is: regressed.map_or(alone, |found| found.explained.max(alone)),
        }
    }

    fn share(&self, change: impl Fn(&mut FitTask<'_>)) -> Option<f64> {
        let changed: Vec<FitTask<'_>> = (self.cases.iter())
            .map(|case| {
                let mut case = case.lent();
                change(&mut case);
                case
            })
            .collect();
        let share = promised(&changed).unwrap_or(0.0);
        (share >= LEAST_EXPLAINED && share > self.as_it_is + FAR_BETTER).then_some(share)
    }

    fn sign(&self) -> Option<Suspicion> {
        let share = self.share(|case| *case = turned(case));
        share.map(Suspicion::Sign)
    }

    fn swapped(&self) -> Option<Suspicion> {
        let share = self.share(|case| {
            let quantity = case.quantity();
            let output = case.measured().to_vec();
            let tightening = case.tightening.to_mut();
            let input = std::mem::replace(&mut tightening.torque_nm, output);
            tightening.motion.set(quantity, input);
        });
        share.map(Suspicion::Swapped)
    }

    fn derivatives(&self) -> impl Iterator<Item = Suspicion> {
        let declared = self.cases.first().map(FitTask::quantity);
        let others = Quantity::ALL.into_iter();
        others
            .filter(move |other| Some(*other) != declared)
            .filter_map(move |other| {
                let share = self.share(|case| {
                    let output = case.measured().to_vec();
                    case.tightening.to_mut().motion.set(other, output);
                    let mut settings = case.settings.clone().into_owned();
                    settings.fitted_output = other;
                    case.settings = Cow::Owned(settings);
                })?;
                Some(Suspicion::Derivative {
                    declared: declared?.name(),
                    other: other.name(),
                    share,
                })
            })
    }
}

/// Whether a channel is not what it is declared to be: `own`, the study's own model, explains too little, and m, c, k alone would explain
/// enough of another derivative of the angle, or most with the input's other sign or the columns swapped, or a speed lost its sign (a place may
/// be held back by a wall). What effects make of that is no rig. Of a rig that pushes itself away gravity may be what is missing, or its
/// stiffness be held back.
pub(crate) fn is_declared_wrong(cases: &[FitTask<'_>], own: &Fitted) -> bool {
    let is_a_model = is_a_model(share(cases, own));
    let may_be_held_back = may_be_held_back(cases, own);
    if is_a_model && !may_be_held_back {
        return false;
    }
    if pushed_away(cases).is_some() {
        return may_be_held_back && !is_a_weight(cases);
    }
    if is_a_model {
        return false;
    }
    let changed = Changed::of(cases);
    let explains_most = |one: &Suspicion| matches!(one, Suspicion::Sign(share) | Suspicion::Swapped(share) if *share >= MOSTLY_EXPLAINED);
    changed.derivatives().next().is_some()
        || changed.sign().as_ref().is_some_and(explains_most)
        || changed.swapped().as_ref().is_some_and(explains_most)
        || are_speeds(cases) && lost_their_sign(cases)
}

fn are_speeds(cases: &[FitTask<'_>]) -> bool {
    cases
        .iter()
        .all(|case| case.quantity() == Quantity::Velocity)
}

/// Whether no torque acts in any recording, and nothing is known of what moves, so that ratios show only.
pub(crate) fn is_undriven(cases: &[FitTask<'_>]) -> bool {
    let is_unknown = |case: &FitTask<'_>| case.known_torque(1.0, 1.0).is_none();
    (cases.iter()).all(|case| case.is_undriven() && is_unknown(case))
}

/// Whether what was measured is white about its mean, in every recording.
fn is_still(cases: &[FitTask<'_>]) -> bool {
    cases.iter().all(|case| {
        let scored = &case.measured()[case.unscored()..];
        let mean = scored.iter().sum::<f64>() / scored.len() as f64;
        let about_mean: Vec<f64> = scored.iter().map(|y| y - mean).collect();
        is_white(correlation(&[about_mean]))
    })
}

/// What to check, the likeliest first; what is `left_over` where nothing else is.
pub(crate) fn suspicions(
    cases: &[FitTask<'_>],
    explained: Explained,
    left_over: Option<Suspicion>,
) -> Vec<Suspicion> {
    if let Some(pushes) = pushed_away(cases) {
        // Where the fit was free to have such a stiffness, it is no answer to why it does not.
        return match may_push_away(cases) {
            true => vec![left_over.unwrap_or(Suspicion::NoOscillator)],
            false => vec![Suspicion::PushesAway(pushes)],
        };
    }
    let elsewhere = from_the_spectra(cases).unwrap_or(0.0);
    let is_elsewhere = elsewhere >= LEAST_EXPLAINED.max(explained.share + SHORTFALL);
    let changed = Changed::of(cases);
    let mut found: Vec<Suspicion> = (is_elsewhere.then_some(Suspicion::PoorMinimum(elsewhere)))
        .into_iter()
        .chain(changed.sign())
        .chain(changed.swapped())
        .chain(changed.derivatives())
        .collect();
    if found.is_empty() {
        // A spike hides whatever moves beside it, and is as white as what does not.
        found.push(match left_over {
            Some(spikes @ Suspicion::Outliers { .. }) => spikes,
            _ if is_still(cases) => Suspicion::Still,
            _ if lost_their_sign(cases) => Suspicion::NoSign(explained.output),
            left_over => left_over.unwrap_or(Suspicion::NoOscillator),
        });
    }
    found
}

mod restarted_too_seldom;
mod stands_apart;
mod turned_round;

pub(crate) use restarted_too_seldom::restarted_too_seldom;
pub(crate) use stands_apart::stands_apart;
pub(crate) use turned_round::turned_round;

#[cfg(test)]
mod tests;
