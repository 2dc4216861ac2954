//! A candidate's refit to a few long records, where mass, damping and stiffness are no matter of each tightening.

use crate::error::DiagnoseError;
use crate::pooled::equation::regression_start;
use crate::pooled::model::{PooledModel, Start};
use crate::pooled::thresholds::{
    A_FEW_STEPS, BEGINNING, GROWN, SAME_END, SHORTEST_BEGINNING, SHORTEST_GROWN, SIEVE, SIEVED,
    SOON, TRIAL_OF_A_START,
};
use snug_identify::{FitTask, convex_set};
use snug_least_squares::{DenseResidual, PooledFit, PooledSettings, Settings, solve};

/// Fits from each of `starts`; the lowest cost goes on to the end. Where the records [take long](take_long) to simulate, that is done on
/// their beginnings, and from where it leads a few steps are taken on the whole.
///
/// A model without the effect may be led far astray by what it lacks, to where no step leads back: the same sizes are begun with where
/// the study's own mass, damping and stiffness begin, too.
pub(crate) fn best_of(
    pooled: &mut PooledModel<'_>,
    starts: &[Start],
    is_astray: bool,
    settings: &PooledSettings,
) -> Result<PooledFit, DiagnoseError> {
    let starts = match is_astray {
        true => with_own_afresh(pooled, starts),
        false => starts.to_vec(),
    };
    if !take_long(&pooled.cases) {
        return lowest(pooled, &starts, settings);
    }
    let beginnings: Vec<FitTask<'_>> = pooled.cases.iter().map(beginning).collect();
    let mut there = PooledModel::new(pooled.cases.others(&beginnings), &pooled.effects)?;
    let start = sieved(&mut there, &starts)?;
    pooled.fit(&start, &A_FEW_STEPS)
}

/// Takes a few steps from each of `starts`: where the lowest leads.
pub(crate) fn lowest_nearby(
    pooled: &mut PooledModel<'_>,
    starts: &[Start],
) -> Result<PooledFit, DiagnoseError> {
    Ok(ends(pooled, starts, &A_FEW_STEPS)?.swap_remove(0))
}

/// Whether the records together take so long to simulate that not every candidate is followed to its end.
pub(crate) fn take_long(records: &[FitTask<'_>]) -> bool {
    samples(records) > SOON
}

/// Samples of all records together.
pub(crate) fn samples(records: &[FitTask<'_>]) -> usize {
    records.iter().map(|one| one.measured().len()).sum()
}

/// What comes first and holds enough of the motion.
fn beginning(record: &FitTask<'_>) -> FitTask<'static> {
    let measured = record.measured();
    let squares = |samples: &[f64]| samples.iter().map(|y| y * y).sum::<f64>();
    let enough = BEGINNING * squares(&measured[record.unscored()..]);
    let mut sum = 0.0;
    let more = measured[record.unscored()..].iter().take_while(|&&y| {
        sum += y * y;
        sum < enough
    });
    record.beginning(record.unscored() + more.count().max(SHORTEST_BEGINNING))
}

/// Each start, and the same sizes from where the study's own mass, damping and stiffness begin.
fn with_own_afresh(pooled: &PooledModel<'_>, starts: &[Start]) -> Vec<Start> {
    (starts.iter())
        .flat_map(|start| [start.clone(), pooled.with_base_afresh(start)])
        .collect()
}

/// Fits from `start` to ever longer beginnings, up to the whole. Of a motion that a stop throws back and forth, whatever is a little wrong
/// grows with every blow: a fit of the whole finds its way from next to the minimum only, and a beginning's leads there.
pub(crate) fn grown(
    pooled: &mut PooledModel<'_>,
    start: &Start,
) -> Result<PooledFit, DiagnoseError> {
    let mut start = start.clone();
    for parts in GROWN {
        let part = |record: &FitTask<'_>| {
            let scored = record.measured().len() - record.unscored();
            let samples = (scored / parts).max(SHORTEST_GROWN).min(scored);
            record.beginning(record.unscored() + samples)
        };
        let beginnings: Vec<FitTask<'_>> = pooled.cases.iter().map(part).collect();
        let mut there = pooled.with_cases(&beginnings)?;
        start = Start::at(&there.fit(&start, &PooledSettings::default())?);
    }
    to_the_end(pooled, &start)
}

/// Fits from the starts that the records themselves give.
pub(crate) fn from_the_records(pooled: &mut PooledModel<'_>) -> Result<PooledFit, DiagnoseError> {
    let starts = pooled.usual_starts();
    let start = match starts.as_slice() {
        [only] => only.clone(),
        several => Start::at(&ends(pooled, several, &TRIAL_OF_A_START)?[0]),
    };
    let end = to_the_end(pooled, &start)?;
    no_less_than_a_regression(pooled, end)
}

/// The fit that ended at `end`, or where it falls short of a regression of the equation of motion, one from where that puts the
/// numbers, if it is lower.
fn no_less_than_a_regression(
    pooled: &mut PooledModel<'_>,
    end: PooledFit,
) -> Result<PooledFit, DiagnoseError> {
    let Some(start) = regression_start(pooled, &Start::at(&end)) else {
        return Ok(end);
    };
    match to_the_end(pooled, &start) {
        Ok(other) if other.cost() < end.cost() => Ok(other),
        _ => Ok(end),
    }
}

/// Takes a few steps from each start, follows those that led lowest farther, and goes on to the end from where the lowest led.
fn lowest(
    pooled: &mut PooledModel<'_>,
    starts: &[Start],
    settings: &PooledSettings,
) -> Result<PooledFit, DiagnoseError> {
    let best = sieved(pooled, starts)?;
    pooled.fit(&best, settings)
}

/// Takes a few steps from each start and follows those that led lowest, and elsewhere, farther: where the lowest led.
fn sieved(pooled: &mut PooledModel<'_>, starts: &[Start]) -> Result<Start, DiagnoseError> {
    let mut sieved = ends(pooled, starts, &SIEVE)?;
    sieved.dedup_by(|other, lower| other.cost() <= (1.0 + SAME_END) * lower.cost());
    sieved.truncate(SIEVED);
    let sieved: Vec<Start> = sieved.iter().map(Start::at).collect();
    let best = &ends(pooled, &sieved, &TRIAL_OF_A_START)?[0];
    Ok(Start::at(best))
}

/// Where fits from the starts end, the lowest first; an error where none has an end.
fn ends(
    pooled: &mut PooledModel<'_>,
    starts: &[Start],
    settings: &PooledSettings,
) -> Result<Vec<PooledFit>, DiagnoseError> {
    let (mut ends, mut refused) = (Vec::new(), None);
    for start in starts {
        match pooled.fit(start, settings) {
            Ok(end) => ends.push(end),
            Err(error) => refused = Some(error),
        }
    }
    if ends.is_empty() {
        let none = || snug_least_squares::SolveError::NoStart.into();
        return Err(refused.unwrap_or_else(none));
    }
    ends.sort_by(|a, b| a.cost().total_cmp(&b.cost()));
    Ok(ends)
}

/// Fits from one start until nothing more is to be had: with little noise the way along a valley is long. One record
/// alone is a problem of few parameters, which the solver for single tightenings follows further.
pub(crate) fn to_the_end(
    pooled: &mut PooledModel<'_>,
    start: &Start,
) -> Result<PooledFit, DiagnoseError> {
    let end = pooled.fit(start, &PooledSettings::default())?;
    let Some(further) = further(pooled, &Start::at(&end)) else {
        return Ok(end);
    };
    match pooled.fit(&further, &PooledSettings::default()) {
        Ok(other) if other.cost() < end.cost() => Ok(other),
        _ => Ok(end),
    }
}

/// Where the solver for single tightenings ends; nothing where there are several records.
fn further(pooled: &PooledModel<'_>, from: &Start) -> Option<Start> {
    let ([case], [model]) = (&*pooled.cases, pooled.models.as_slice()) else {
        return None;
    };
    let values = pooled.values(0, &from.own[0], &from.shared);
    let free = model.free();
    let mut problem = DenseResidual::new(case.residual(model).ok()?);
    let start: Vec<f64> = free.iter().map(|&index| values[index]).collect();
    let set = convex_set(model, &case.settings.constraints);
    let settings = Settings {
        max_iterations: 300,
        gradient_tolerance: 1e-6,
        ..Settings::default()
    };
    let found = solve(&mut problem, &start, &set, &settings).ok()?;
    let pick = |indices: &[usize]| -> Option<Vec<f64>> {
        let places = indices.iter();
        places
            .map(|index| free.iter().position(|at| at == index))
            .map(|column| Some(found.values[column?]))
            .collect()
    };
    Some(Start {
        own: vec![pick(&pooled.own)?],
        shared: pick(&pooled.common)?,
    })
}
