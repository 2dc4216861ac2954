//! A candidate's refit: from its most promising starts, found on a few tightenings, to all of them.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::data::power::power;
use crate::error::DiagnoseError;
use crate::library::is_unlisted;
use crate::pooled::equation::{as_found, with_shapes_of};
use crate::pooled::fitted::Fitted;
use crate::pooled::long_record;
use crate::pooled::model::{PooledModel, Start, pick};
use crate::pooled::parameter_place::{effect_of, first_parameter};
use crate::pooled::thresholds::A_FEW_STEPS;
use crate::ranking::first_ranking::Promise;
use crate::ranking::in_place_of_damping;
use crate::ranking::resonances;
use crate::ranking::sensitivity::Column;
use crate::ranking::simulable::simulable;
use crate::ranking::thresholds::{
    CANDIDATE, CANDIDATE_OF_LONG, FARTHER, FEW, FREELY, GLANCE, LED, LED_REACH, LEFT_BEHIND,
    LITTLE, MOST_ROUNDS, NEARLY_NONE, ROUGH_REFIT, WORTH_A_START,
};
use crate::ranking::wavelengths;
use crate::settings::DiagnoseSettings;
use snug_campaign::Parameter;
use snug_identify::{FitTask, HALF_WIDTHS, SIDE_BY_SIDE};
use snug_least_squares::{PooledFit, PooledSettings, SolveError};
use snug_model::{BASE_PARAMETERS, Effect, Law, ParameterSpec};
use snug_statistics::descriptive::median;

/// How far a candidate is followed.
#[derive(Clone, Copy)]
pub(crate) enum Way<'a> {
    /// To its end, and from where the equation of motion puts the numbers, if the effect promises much there.
    Far(Option<&'a Promise>),
    /// A few steps: beside a model that leaves white noise of a few long records nothing is led astray, and they tell all that could be gained.
    Nearby,
}

/// Refits one effect from its most promising starts, first roughly on a few tightenings; the lowest cost wins.
pub(crate) fn refit(
    cases: Cases<'_>,
    current: &Fitted,
    effect: Effect,
    columns: &[Column],
    way: Way<'_>,
    clusters: Clusters,
    settings: &DiagnoseSettings,
) -> Result<Fitted, DiagnoseError> {
    let mut effects = current.effects.clone();
    effects.push(effect);
    let mut read_off = wavelengths::starts(cases, current, effect);
    read_off.extend(resonances::starts(cases, current, effect));
    let is_nearby = matches!(way, Way::Nearby);
    // A term describes; which of its starts promises most is near enough to begin with.
    let most = match is_unlisted(effect) || !read_off.is_empty() || is_nearby {
        true => 1,
        false => settings.starts,
    };
    let starts = promising(effect, columns, most);
    let mut pooled = PooledModel::shared_by(cases, &effects, &current.sharing)?;
    let nothing = nothing_of(&pooled, effect, starts.first().copied());
    let begun = |values: &[f64]| pooled.with_effect(current.start(&pooled), effect, values);
    let mut starts: Vec<Start> = (read_off.iter().map(Vec::as_slice).chain(starts))
        .map(begun)
        .collect();
    let is_astray = !is_nearby && may_be_astray(&cases, current);
    if is_astray {
        // What the model lacks may have led its mass and damping so far off that the rig passes other waves than it did.
        starts.extend(with_shapes_of(&pooled, &starts[..read_off.len()]));
        starts.extend(in_place_of_damping::start(&pooled, current, effect));
    }
    let simulable = |start: Start| simulable(&pooled, start);
    let starts: Vec<Start> = starts.into_iter().map(simulable).collect();
    let nothing: Vec<Start> = (nothing.iter())
        .map(|values| simulable(begun(values)))
        .collect();
    let end = match way {
        Way::Far(_) => led_by(&mut pooled, current, &starts, is_astray, clusters),
        Way::Nearby => nearby(&mut pooled, current, &starts),
    };
    let mut end = no_worse(&mut pooled, current, &nothing, end)?;
    if let Way::Far(promise) = way
        && !clusters.are_whole()
    {
        end = as_promised(&mut pooled, current, promise, end)?;
    }
    Ok(Fitted::new(&pooled, end, &clusters))
}

/// A few steps from each start; where there is none, from the usual one.
fn nearby(
    pooled: &mut PooledModel<'_>,
    current: &Fitted,
    starts: &[Start],
) -> Result<PooledFit, DiagnoseError> {
    match starts {
        [] => long_record::lowest_nearby(pooled, &[current.start(pooled)]),
        starts => long_record::lowest_nearby(pooled, starts),
    }
}

/// Where the starts lead to, all of the effect's parameters free; `current` may have been led astray.
fn led_by(
    pooled: &mut PooledModel<'_>,
    current: &Fitted,
    starts: &[Start],
    is_astray: bool,
    clusters: Clusters,
) -> Result<PooledFit, DiagnoseError> {
    match starts {
        [] if clusters.are_whole() => {
            let usual = current.start(pooled);
            pooled.fit(&usual, &PooledSettings::default())
        }
        [] => {
            let usual = current.start(pooled);
            long_record::to_the_end(pooled, &usual)
        }
        starts if !clusters.are_whole() => {
            long_record::best_of(pooled, starts, is_astray, &CANDIDATE)
        }
        // Beside an effect that lets go, what another one changes moves every instant of contact.
        [only]
            if !current.is_at_floor()
                && current
                    .effects
                    .iter()
                    .any(|one| one.has_unilateral_contact()) =>
        {
            let end = from_afar(pooled, only, &CANDIDATE)?;
            catch_up(pooled, current, end)
        }
        [only] => pooled.fit(only, steps(current)),
        several => {
            let start = rough(pooled, current, several)?;
            if current.is_at_floor() {
                return pooled.fit(&start, steps(current));
            }
            let end = from_afar(pooled, &start, &CANDIDATE)?;
            catch_up(pooled, current, end)
        }
    }
}

/// Whether what the model lacks may have led it so far off that no step leads back: a few long records, unless they take long and it
/// explains nearly all of them. Many tightenings lead each other.
pub(crate) fn may_be_astray(records: &[FitTask<'_>], current: &Fitted) -> bool {
    let explains_all = || !current.is_weighted && current.squares() < NEARLY_NONE * power(records);
    current.are_stretches() && !(long_record::take_long(records) && explains_all())
}

/// How far a candidate is followed from one start: beside a model that leaves but noise nothing is led astray, and a few steps tell all
/// that could be gained.
fn steps(current: &Fitted) -> &'static PooledSettings {
    match current.is_at_floor() {
        true => &A_FEW_STEPS,
        false => &CANDIDATE,
    }
}

/// A refit, or nothing where this rig cannot be simulated with the effect's starts: they are meant for a hand on a tool.
pub(super) fn possible(
    refitted: Result<Fitted, DiagnoseError>,
) -> Result<Option<Fitted>, DiagnoseError> {
    match refitted {
        Ok(fitted) if fitted.squares().is_finite() => Ok(Some(fitted)),
        Ok(_) | Err(DiagnoseError::Identify(_) | DiagnoseError::Solve(_)) => Ok(None),
        Err(other) => Err(other),
    }
}

/// A candidate of a few long records, from where a few steps led.
pub(crate) fn followed(
    cases: Cases<'_>,
    fitted: &Fitted,
    clusters: Clusters,
) -> Result<Fitted, DiagnoseError> {
    let mut pooled = PooledModel::shared_by(cases, &fitted.effects, &fitted.sharing)?;
    let settings = match long_record::take_long(&pooled.cases) {
        true => &CANDIDATE_OF_LONG,
        false => &CANDIDATE,
    };
    let end = pooled.fit(&fitted.start(&pooled), settings)?;
    Ok(Fitted::new(&pooled, end, &clusters))
}

/// The fit that ended at `end`, or where that is worse than without the effect, or came to nothing, one from where `nothing` of it
/// is there: a larger model that fits worse was led astray.
fn no_worse(
    pooled: &mut PooledModel<'_>,
    current: &Fitted,
    nothing: &[Start],
    end: Result<PooledFit, DiagnoseError>,
) -> Result<PooledFit, DiagnoseError> {
    let is_no_worse = |end: &PooledFit| 2.0 * end.cost() <= current.squares();
    if end.as_ref().is_ok_and(is_no_worse) {
        return end;
    }
    let nested = match nothing {
        [only] => pooled.fit(only, steps(current)),
        several => {
            let tried = several
                .iter()
                .filter_map(|start| pooled.fit(start, &GLANCE).ok());
            match tried.min_by(|a, b| a.cost().total_cmp(&b.cost())) {
                Some(lowest) => pooled.fit(&Start::at(&lowest), &CANDIDATE),
                None => Err(SolveError::NoStart.into()),
            }
        }
    };
    match (nested, end) {
        (Ok(nested), Ok(end)) if end.cost() <= nested.cost() => Ok(end),
        (Ok(nested), _) => Ok(nested),
        (Err(_), end) => end,
    }
}

/// Values of an effect's parameters with which it is as good as not there; its shape is that of `start`, or the usual one.
///
/// Where it is not there only beyond its limits, as a support that is ever heavier, these are all corners of what is near to that:
/// a shape tells how near, and which of them can be simulated at all.
fn nothing_of(pooled: &PooledModel<'_>, effect: Effect, start: Option<&[f64]>) -> Vec<Vec<f64>> {
    let first = first_parameter(&pooled.effects, effect);
    let parameters = &pooled.models[0].parameters()[first..];
    let specs = effect.description().parameters;
    let is_beyond = |spec: &ParameterSpec, parameter: &Parameter| {
        let limits = parameter.minimum..=parameter.maximum;
        spec.vanishes_at.is_some_and(|at| !limits.contains(&at))
    };
    let pairs = || specs.iter().zip(parameters);
    let is_any_beyond = pairs().any(|(spec, parameter)| is_beyond(spec, parameter));
    let mut all = vec![Vec::new()];
    for (place, (spec, parameter)) in pairs().enumerate() {
        let (minimum, maximum) = (parameter.minimum, parameter.maximum);
        let usual = start.map_or(parameter.value, |start| start[place]);
        let values = match spec.vanishes_at {
            Some(at) if is_beyond(spec, parameter) => {
                let nearest = at.clamp(minimum, maximum);
                vec![nearest, (FARTHER * nearest).clamp(minimum, maximum)]
            }
            Some(at) => vec![at],
            None if is_any_beyond => vec![minimum, usual, maximum],
            None => vec![usual],
        };
        all = (all.iter())
            .flat_map(|begun: &Vec<f64>| values.iter().map(|&value| [begun, &[value][..]].concat()))
            .collect();
    }
    all
}

/// The fit that ended at `end`, or where that is lower, one from where the equation of motion puts the numbers, if the effect
/// promises much there.
fn as_promised(
    pooled: &mut PooledModel<'_>,
    current: &Fitted,
    promise: Option<&Promise>,
    end: PooledFit,
) -> Result<PooledFit, DiagnoseError> {
    let Some(promise) = promise.filter(|promise| promise.share >= WORTH_A_START) else {
        return Ok(end);
    };
    let start = as_regressed(pooled, current, promise);
    let settings = match long_record::take_long(&pooled.cases) {
        true => &A_FEW_STEPS,
        false => &CANDIDATE,
    };
    match pooled.fit(&start, settings) {
        Ok(other) if other.cost() < end.cost() => Ok(other),
        _ => Ok(end),
    }
}

/// The place to which a regression of the equation of motion puts the numbers of the current model with one effect more. How each recording
/// begins, of which a regression knows nothing, begins as usual: the current model may have bent it to what it lacks.
pub(crate) fn as_regressed(pooled: &PooledModel<'_>, current: &Fitted, promise: &Promise) -> Start {
    let mut start = pooled.with_effect(current.start(pooled), promise.effect, &promise.own);
    let usual = pooled.usual_start();
    for (column, &index) in pooled.own.iter().enumerate() {
        let effect = effect_of(&pooled.effects, index).map(|(effect, _)| effect);
        if effect == Some(Effect::InitialMotion) {
            for (to, usual) in start.own.iter_mut().zip(&usual.own) {
                to[column] = usual[column];
            }
        }
    }
    let times = promise.times.iter().copied();
    simulable(pooled, as_found(pooled, &start, &promise.base, times))
}

/// At most `most` different starts of an effect, those whose columns promise most.
fn promising(effect: Effect, columns: &[Column], most: usize) -> Vec<&[f64]> {
    let own = columns.iter().filter(|column| column.effect == effect);
    let mut own: Vec<&Column> = own.collect();
    own.sort_by(|a, b| b.predicted_gain().total_cmp(&a.predicted_gain()));
    let mut starts: Vec<&[f64]> = Vec::new();
    for column in own {
        if !starts.contains(&column.start.as_slice()) && starts.len() < most {
            starts.push(&column.start);
        }
    }
    starts
}

/// Fits what is seen from afar, then as it is; by way of ever nearer where the acceleration jumps as an effect lets go. What is
/// only a place to go on from is fitted roughly.
fn from_afar(
    pooled: &mut PooledModel<'_>,
    start: &Start,
    settings: &PooledSettings,
) -> Result<PooledFit, DiagnoseError> {
    let mut start = start.clone();
    let jumps = pooled
        .effects
        .iter()
        .any(|effect| effect.has_unilateral_contact());
    let reaches = if jumps {
        &HALF_WIDTHS[..]
    } else {
        &HALF_WIDTHS[..1]
    };
    for &reach in reaches {
        start = Start::at(&pooled.fit_averaged(&start, &ROUGH_REFIT, reach)?);
    }
    pooled.fit(&start, settings)
}

/// The start that leads lowest on a few tightenings, as seen from afar: their shared sizes, and every tightening's own
/// parameters corrected by what the few had to correct theirs. Where only noise is left to find, nothing is led astray.
fn rough(
    pooled: &PooledModel<'_>,
    current: &Fitted,
    starts: &[Start],
) -> Result<Start, DiagnoseError> {
    let few = current.spread(FEW);
    let some = pooled.cases.some(&few);
    let mut there = pooled.with_cases(&some)?;
    let of_few: Vec<Start> = (starts.iter())
        .map(|start| {
            let mut of_few = Start {
                own: pick(&start.own, &few),
                ..there.usual_start()
            };
            there.take_shared(&mut of_few.shared, pooled, &start.shared);
            of_few
        })
        .collect();
    let led = match current.is_at_floor() {
        true => None,
        false => led_along_motion(&there, &of_few)?,
    };
    let ends = of_few.iter().take(FREELY).chain(&led).filter_map(|start| {
        let end = there.fit_averaged(start, &ROUGH_REFIT, HALF_WIDTHS[0]);
        end.ok()
    });
    let lowest = ends.min_by(|a, b| a.cost().total_cmp(&b.cost()));
    let end = lowest.ok_or(SolveError::NoStart)?;
    let factors = astray(pooled, &end.own, &of_few[0].own);
    let mut start = starts[0].clone();
    start.own.iter_mut().for_each(|own| times(own, &factors));
    pooled.take_shared(&mut start.shared, &there, &end.shared);
    Ok(start)
}

/// Where the starts lead to along the measured motion, if that can be said: the lowest.
///
/// A model without the effect may have been led astray by what it lacks, and in the cost of a free run valley lies beside
/// valley. Where the simulation takes up the measured motion every few milliseconds, no error grows beyond the next
/// restart, and most starts lead to the same place.
fn led_along_motion(
    pooled: &PooledModel<'_>,
    starts: &[Start],
) -> Result<Option<Start>, DiagnoseError> {
    let led: Option<Vec<FitTask<'_>>> = pooled.cases.iter().map(FitTask::along_motion).collect();
    let Some(led) = led else {
        return Ok(None);
    };
    let mut there = pooled.with_cases(&led)?;
    let ends = starts
        .iter()
        .filter_map(|start| there.fit_averaged(start, &LED, LED_REACH).ok());
    let lowest = ends.min_by(|a, b| a.cost().total_cmp(&b.cost()));
    Ok(lowest.map(|end| Start::at(&end)))
}

/// The tightenings that were left behind, each fitted by itself with what all share where the others put it and, where that
/// is lower, all on from there; again while others are left behind then.
fn catch_up(
    pooled: &mut PooledModel<'_>,
    current: &Fitted,
    mut end: PooledFit,
) -> Result<PooledFit, DiagnoseError> {
    let begun = current.start(pooled).own;
    for _ in 0..MOST_ROUNDS {
        let (behind, ahead) = left_behind(pooled, current, &end);
        let little = LITTLE * end.cost();
        let (with, without) = (pick(&end.own, &ahead), pick(&begun, &ahead));
        let factors = astray(pooled, &with, &without);
        let mut start = Start::at(&end);
        let mut lowered = 0.0;
        for some in behind.chunks(SIDE_BY_SIDE) {
            let before = lowered;
            let mut again = pick(&begun, some);
            again.iter_mut().for_each(|own| times(own, &factors));
            let alone = pooled.fit_alone(some, &again, &end.shared);
            for (&member, found) in some.iter().zip(alone) {
                if let Some((own, cost)) = found
                    && cost < end.profiles[member].cost
                {
                    lowered += end.profiles[member].cost - cost;
                    start.own[member] = own;
                }
            }
            // Nobody of these was left behind, it is their model that is wrong; and so it is for the others.
            if lowered - before <= little {
                break;
            }
        }
        if lowered <= little {
            return Ok(end);
        }
        end = pooled.fit(&start, &CANDIDATE)?;
    }
    Ok(end)
}

/// The tightenings that were left behind, which keep more of their error than the others and have more, and the others.
fn left_behind(
    pooled: &PooledModel<'_>,
    current: &Fitted,
    end: &PooledFit,
) -> (Vec<usize>, Vec<usize>) {
    let squares = || end.profiles.iter().map(|one| 2.0 * one.cost).enumerate();
    let errors: Vec<f64> = squares()
        .map(|(member, squares)| (squares / pooled.residual_count(member) as f64).sqrt())
        .collect();
    let kept: Vec<f64> = squares()
        .map(|(member, squares)| (squares / current.blocks[member].squares).sqrt())
        .collect();
    let is_far =
        |of: &[f64], member: usize| median(of).is_ok_and(|usual| of[member] > LEFT_BEHIND * usual);
    (0..errors.len()).partition(|&member| is_far(&errors, member) && is_far(&kept, member))
}

/// By how much m, c and k are larger in `with` than in `without`, the median over tightenings; 1 for other parameters.
fn astray(pooled: &PooledModel<'_>, with: &[Vec<f64>], without: &[Vec<f64>]) -> Vec<f64> {
    let columns = pooled.own.iter().enumerate();
    columns
        .map(|(column, &index)| match index < BASE_PARAMETERS.len() {
            true => {
                let pairs = with.iter().zip(without);
                let factors: Vec<f64> = pairs.map(|(a, b)| a[column] / b[column]).collect();
                median(&factors).unwrap_or(1.0)
            }
            false => 1.0,
        })
        .collect()
}

fn times(own: &mut [f64], factors: &[f64]) {
    let pairs = own.iter_mut().zip(factors);
    pairs.for_each(|(own, factor)| *own *= factor);
}

#[cfg(test)]
mod tests;
