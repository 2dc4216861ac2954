//! Whether a machine's input is held from sample to sample, as a controller's is, where the study says nothing of it.
//!
//! Taken as running straight from sample to sample, a held input comes half a sampling interval early, and a search finds a delay,
//! a lag or a fast mode that is none. The model that needs fewer effects for the same error is the likelier story.

use crate::error::StudyError;
use crate::study::Study;
use crate::tasks::cases::with_settled;
use snug_campaign::words::reason::Reason;
use snug_campaign::{Diagnosis, EffectParameter, Intersample, Rung};
use snug_diagnose::RungModel;
use snug_identify::{FitTask, identify_all};
use snug_model::{BASE_PARAMETERS, Law, ParameterSettings, Scale};
use std::borrow::Cow;

/// The effect whose size is a delay.
const DELAY: &str = "torque_delay";
/// Its size \[s\].
const DELAY_SIZE: &str = "delay_s";
/// Effects that stand in for half a sampling interval.
const STAND_INS: [&str; 5] = [
    DELAY,
    "torque_lag",
    "acceleration_lag",
    "actuator_lag",
    "second_mode",
];
/// Samples of all recordings up to which everything is searched twice. Chosen: a minute more.
const MOST_SAMPLES: usize = 60_000;
/// Root mean square of the error, over that with a straight input, up to which a model of fewer effects leaves as little \[–\].
/// Chosen.
const AS_LITTLE: f64 = 1.1;
/// The same where all that it spares are effects that stand in for half a sampling interval \[–\]. Chosen: a positioner in closed loop,
/// whose input follows the noise of its place, leaves 1.12 without the second mode that it was given for a hold.
const AS_LITTLE_WITHOUT_STAND_INS: f64 = 1.25;
/// The same below which one of as many effects leaves plainly less \[–\]. Chosen.
const PLAINLY_LESS: f64 = 0.95;
/// The same below which what a search finds is the likelier story, of how many effects ever \[–\]. Chosen: of a fan a search with a
/// straight input ended at 2.7 times the error, since no effect alone does what a held input does.
const FAR_LESS: f64 = 0.5;

/// Squares that the study's own model, of which mass, damping and stiffness are fitted to each recording, leaves with a held input over those
/// with a straight one from which that is looked into before anything else \[–\]. Chosen: of eleven rigs with a held input four leave 0.94 to
/// 0.99, the others more.
const SOMEWHAT_LESS: f64 = 0.99;
/// Share of the error that one effect must take for the half of a sampling interval to show beside it \[–\]. Chosen.
const NEARLY_ALL: f64 = 0.99;

/// Delays, in sampling intervals, that are half of one: a held input's, taken as running straight \[–\]. Chosen.
const HALF_AN_INTERVAL: std::ops::RangeInclusive<f64> = 0.35..=0.65;

/// Whether the study leaves it open, and so few samples were recorded that a search may be made again with a held input.
pub(crate) fn is_open(study: &Study, cases: &[FitTask<'_>]) -> bool {
    is_unsaid(study) && samples(cases) <= MOST_SAMPLES
}

/// What is told where the study leaves it open and a search found a delay that looks like a held input, but so many samples were recorded
/// that it is not made again.
pub(crate) fn not_tried(
    study: &Study,
    cases: &[FitTask<'_>],
    diagnosis: &Diagnosis,
) -> Option<Reason> {
    let interval_s = cases.first()?.tightening.time_base.interval_s;
    let looks_like_it = is_unsaid(study) && is_half_an_interval_late(diagnosis, interval_s);
    (looks_like_it && samples(cases) > MOST_SAMPLES).then_some(Reason::HeldNotTried)
}

/// Whether the study says nothing of how a machine's input runs between samples.
fn is_unsaid(study: &Study) -> bool {
    study.model.intersample.is_none() && matches!(study.model.scale, Scale::Rig { .. })
}

fn samples(cases: &[FitTask<'_>]) -> usize {
    cases.iter().map(|case| case.measured().len()).sum()
}

/// Whether the study's own model leaves somewhat less with a held input, so that it is worth to be looked into before the search.
pub(crate) fn is_likely(study: &Study, cases: &[FitTask<'_>]) -> Result<bool, StudyError> {
    let (_, held) = held(study, cases)?;
    Ok(leaves_less(&held, cases, SOMEWHAT_LESS))
}

/// Whether with a held input one effect takes nearly all of the error: what `diagnosis` is missing.
pub(crate) fn takes_nearly_all(diagnosis: &Diagnosis) -> bool {
    best_gain(diagnosis) > NEARLY_ALL
}

/// Whether beside its best effect `held` leaves far less than `straight` does beside its own.
pub(crate) fn leaves_far_less(held: &Diagnosis, straight: &Diagnosis) -> bool {
    let left = |diagnosis: &Diagnosis| {
        let error = diagnosis.ladder.last()?.rms_fitted_output;
        Some(error * (1.0 - best_gain(diagnosis)).sqrt())
    };
    let both = left(held).zip(left(straight));
    both.is_some_and(|(with, without)| with < FAR_LESS * without)
}

/// Share of the error that the best effect takes of stretches that took no part in finding its size.
fn best_gain(diagnosis: &Diagnosis) -> f64 {
    let supported = diagnosis.ranking.iter().filter(|one| one.supported);
    supported.map(|one| one.heldout_gain).fold(0.0, f64::max)
}

/// Whether a search that found `diagnosis`, whose last model is that of `last`, is worth to be made again with a held input: the study's
/// own model needs nothing then, or that last model, its stand-ins for half a sampling interval nothing, leaves less with that input where
/// it has such a stand-in, and plainly less where it has none.
pub(crate) fn is_worth_it(
    diagnosis: &Diagnosis,
    study: &Study,
    last: &Study,
    cases: &[FitTask<'_>],
) -> Result<bool, StudyError> {
    if !diagnosis.added.is_empty() && needs_nothing(study, last, cases)? {
        return Ok(true);
    }
    let rest = with_no_stand_in(last, cases)?;
    let straight = of_model(&rest, cases)?;
    let (_, held) = held(&rest, cases)?;
    let least = match stand_ins(diagnosis).next() {
        Some(_) => 1.0,
        None => PLAINLY_LESS * PLAINLY_LESS,
    };
    Ok(leaves_less(&held, &straight, least))
}

/// Whether with a held input the study's own model leaves less than with a straight one, and as little as the last model does with that:
/// any effect that does what a hold does may have been found, not only a delay.
fn needs_nothing(study: &Study, last: &Study, cases: &[FitTask<'_>]) -> Result<bool, StudyError> {
    let (_, held) = held(study, cases)?;
    let last = of_model(last, cases)?;
    Ok(
        leaves_less(&held, cases, SOMEWHAT_LESS)
            && leaves_less(&held, &last, AS_LITTLE * AS_LITTLE),
    )
}

/// Whether a delay of half a sampling interval among a rung's listed effects is a hold: the others of its study leave less with that than all
/// of them with a straight input.
pub(crate) fn is_a_hold(
    rung: &RungModel,
    study: &Study,
    cases: &[FitTask<'_>],
) -> Result<bool, StudyError> {
    let has_delay = rung.effects.iter().any(|name| name == DELAY);
    let Some(first) = cases.first().filter(|_| has_delay) else {
        return Ok(false);
    };
    let interval_s = first.tightening.time_base.interval_s;
    let mut delays = rung.parameters.iter().filter(|one| one.name == DELAY_SIZE);
    let is_late = delays.any(|delay| is_half_an_interval(delay, interval_s));
    if !is_late {
        return Ok(false);
    }
    let (_, held) = held(&with_no_stand_in(study, cases)?, cases)?;
    let straight = of_model(study, cases)?;
    Ok(leaves_less(&held, &straight, 1.0))
}

/// That a held input does without what stands in for half a sampling interval in `straight`.
pub(crate) fn spares_stand_ins(straight: &Diagnosis) -> Reason {
    Reason::Held {
        spared: stand_ins(straight).map(str::to_owned).collect(),
        is_half_an_interval: false,
    }
}

/// Whether the last model of `held` leaves plainly less than its like `without` that input, and as little as the `last` model does.
pub(crate) fn leaves_as_little(held: &Diagnosis, without: &Rung, last: &Rung) -> bool {
    let left = held.ladder.last().map(|held| held.rms_fitted_output);
    left.is_some_and(|left| {
        left < PLAINLY_LESS * without.rms_fitted_output
            && left <= AS_LITTLE * last.rms_fitted_output
    })
}

/// Whether less than `share` of what is left `without` is left `with` a held input.
fn leaves_less(with: &[FitTask<'_>], without: &[FitTask<'_>], share: f64) -> bool {
    let both = squares_left(with).zip(squares_left(without));
    both.is_some_and(|(with, without)| with < share * without)
}

/// The study, those sizes of its model's stand-ins at which they do nothing.
fn with_no_stand_in(study: &Study, cases: &[FitTask<'_>]) -> Result<Study, StudyError> {
    let mut rest = study.clone();
    let Some(first) = cases.first() else {
        return Ok(rest);
    };
    let model = study.model_for(&first.tightening)?;
    let specs = model.effects().flat_map(|effect| {
        let stands_in = STAND_INS.contains(&effect.name());
        let parameters = effect.description().parameters.iter();
        parameters.map(move |spec| spec.vanishes_at.filter(|_| stands_in))
    });
    let parameters = &model.parameters()[BASE_PARAMETERS.len()..];
    for (parameter, vanishes_at) in parameters.iter().zip(specs) {
        if vanishes_at.is_some() {
            let told = rest.model.parameters.entry(parameter.name.clone());
            *told.or_default() = ParameterSettings {
                value: vanishes_at,
                fixed: true,
                ..ParameterSettings::default()
            };
        }
    }
    Ok(rest)
}

/// Σ (measured − simulated)² of all recordings, of each of which only mass, damping and stiffness are fitted again; `None` where one
/// has no fit.
fn squares_left(cases: &[FitTask<'_>]) -> Option<f64> {
    let mut squares = 0.0;
    for (estimate, case) in identify_all(cases).into_iter().zip(cases) {
        let values: Vec<f64> = estimate.ok()?.parameters.iter().map(|p| p.value).collect();
        squares += case.squares_left(&case.model, &values).ok()?;
    }
    Some(squares)
}

/// The recordings with the model of `study`.
fn of_model<'a>(study: &Study, cases: &'a [FitTask<'_>]) -> Result<Vec<FitTask<'a>>, StudyError> {
    with_settled(study, cases.iter().map(FitTask::lent).collect())
}

/// The study and its recordings with a held input.
pub(crate) fn held<'a>(
    study: &Study,
    cases: &'a [FitTask<'_>],
) -> Result<(Study, Vec<FitTask<'a>>), StudyError> {
    let mut study = study.clone();
    study.model.intersample = Some(Intersample::ZeroOrder);
    let held = cases.iter().map(|case| {
        let interval_s = case.tightening.time_base.interval_s;
        let torque_nm = &case.tightening.torque_nm;
        let input = &case.input;
        FitTask {
            input: Cow::Owned(input.of_others(torque_nm, interval_s, Intersample::ZeroOrder)),
            ..case.lent()
        }
    });
    let held = with_settled(&study, held.collect())?;
    Ok((study, held))
}

/// What speaks for a held input, if that does: with it a search found `held`, without it `straight`.
pub(crate) fn speaks_for_it(
    held: &Diagnosis,
    straight: &Diagnosis,
    interval_s: f64,
) -> Option<Reason> {
    let error = |diagnosis: &Diagnosis| diagnosis.ladder.last().map(|rung| rung.rms_fitted_output);
    let (with, without) = (error(held)?, error(straight)?);
    let (fewer, more) = (held.added.len(), straight.added.len());
    let is_needed = |effect: &str| held.added.iter().any(|other| other.effect == effect);
    let found = straight.added.iter().map(|one| one.effect.as_str());
    let spared: Vec<&str> = found.filter(|&effect| !is_needed(effect)).collect();
    let most = match spared.iter().all(|effect| STAND_INS.contains(effect)) {
        true => AS_LITTLE_WITHOUT_STAND_INS,
        false => AS_LITTLE,
    };
    let is_simpler = fewer < more && with <= most * without;
    // More effects are no likelier where one of them stands in for a hold, too.
    let spares = stand_ins(held).all(|one| stand_ins(straight).any(|other| other == one));
    let is_far_better = spares && with < FAR_LESS * without;
    let does_as_well = fewer <= more && with <= AS_LITTLE * without;
    let is_better = is_far_better
        || (does_as_well && (with < PLAINLY_LESS * without || is_ahead(held, straight)));
    let is_the_hold = does_as_well && is_half_an_interval_late(straight, interval_s);
    (!held.interrupted && (is_simpler || is_better || is_the_hold)).then(|| Reason::Held {
        spared: (spared.into_iter().filter(|_| is_simpler))
            .map(str::to_owned)
            .collect(),
        is_half_an_interval: is_the_hold && !is_simpler && !is_better,
    })
}

/// Whether `held` leaves plainly less than `straight` beside the same effects, before that takes the first stand-in.
fn is_ahead(held: &Diagnosis, straight: &Diagnosis) -> bool {
    let stands_in = |effect: &String| STAND_INS.contains(&effect.as_str());
    let mut rungs = straight.ladder.iter().zip(straight.ladder.iter().skip(1));
    let first = rungs.find(|(_, next)| next.effects.iter().any(stands_in));
    let beside = first.and_then(|(before, _)| {
        let mut rungs = held.ladder.iter();
        let same = rungs.find(|rung| rung.effects == before.effects)?;
        Some((same.rms_fitted_output, before.rms_fitted_output))
    });
    beside.is_some_and(|(with, without)| with < PLAINLY_LESS * without)
}

/// The effects of a model that takes half a sampling interval for a delay, without those that stand in for it; `None` where it takes none
/// or has nothing else.
pub(crate) fn without_stand_ins(straight: &Diagnosis, interval_s: f64) -> Option<Vec<String>> {
    let added = straight.added.iter().map(|added| added.effect.as_str());
    let rest: Vec<String> = added
        .filter(|effect| !STAND_INS.contains(effect))
        .map(str::to_owned)
        .collect();
    let is_late = is_half_an_interval_late(straight, interval_s);
    (is_late && !rest.is_empty()).then_some(rest)
}

/// Whether one of the effects is a delay of half a sampling interval.
fn is_half_an_interval_late(straight: &Diagnosis, interval_s: f64) -> bool {
    let delays = straight.added.iter().filter(|one| one.effect == DELAY);
    let mut delays = delays.flat_map(|one| &one.parameters);
    delays.any(|delay| is_half_an_interval(delay, interval_s))
}

fn is_half_an_interval(delay: &EffectParameter, interval_s: f64) -> bool {
    HALF_AN_INTERVAL.contains(&(delay.value / interval_s))
}

fn stand_ins(diagnosis: &Diagnosis) -> impl Iterator<Item = &str> {
    let added = diagnosis.added.iter().map(|added| added.effect.as_str());
    added.filter(|effect| STAND_INS.contains(effect))
}
