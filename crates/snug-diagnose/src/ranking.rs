//! Every candidate scored, refitted and held out; best first.

use crate::DiagnoseError;
use crate::family::Family;
use crate::fitted::Fitted;
use crate::hypothesis::{Hypothesis, Start};
use crate::score::{Column, Scorer};
use crate::units::Units;
use crate::{Case, DiagnoseSettings};
use rayon::prelude::*;
use snug_identify::PooledSettings;
use snug_model::{BASE_PARAMETERS, Effect, Law, Scope};

/// A candidate after its refit.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    pub effect: Effect,
    /// T of its best column.
    pub score: f64,
    pub p_family: f64,
    pub fitted: Fitted,
    /// Decrease of the squared residual of each unit with sizes that were fixed without it.
    pub gains: Vec<f64>,
}

impl Candidate {
    /// Σ of the held-out decreases.
    pub fn gain(&self) -> f64 {
        self.gains.iter().sum()
    }

    /// Its standard error over units.
    pub fn gain_error(&self) -> f64 {
        spread_of_sum(&self.gains)
    }
}

/// Standard error of Σ x over independent units.
pub(crate) fn spread_of_sum(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    if n < 2.0 {
        return f64::INFINITY;
    }
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
    (squares * n / (n - 1.0)).sqrt()
}

/// The fitted model and its candidates, best first.
pub(crate) struct Ranking {
    pub candidates: Vec<Candidate>,
}

/// Fits exactly these effects, from where `from` ended where it is given.
pub(crate) fn fit_effects(
    cases: &[Case],
    effects: &[Effect],
    from: Option<&Fitted>,
    units: Units,
) -> Result<Fitted, DiagnoseError> {
    let mut hypothesis = Hypothesis::new(cases, effects)?;
    let start = match from {
        Some(fitted) => hypothesis.start_from(fitted),
        None => hypothesis.usual_start(),
    };
    let end = hypothesis.fit(&start, &PooledSettings::default())?;
    hypothesis.finish(end, &units)
}

/// Scores and refits every effect of `candidates` beside those of `current`.
pub(crate) fn rank(
    cases: &[Case],
    current: &Fitted,
    candidates: &[Effect],
    units: Units,
    settings: &DiagnoseSettings,
) -> Result<Ranking, DiagnoseError> {
    let mut hypothesis = Hypothesis::new(cases, &current.effects)?;
    let columns = Scorer::new(&mut hypothesis, current, units).columns(candidates)?;
    let family = Family::new(&columns, settings.sign_flips, settings.seed);
    let heldout = current.heldout(&|unit| unit);
    let refitted: Vec<Result<Candidate, DiagnoseError>> = candidates
        .par_iter()
        .map(|&effect| {
            let fitted = refit(cases, current, effect, &columns, units, settings)?;
            let gains = gains(&heldout, &fitted);
            let own = columns.iter().filter(|column| column.effect == effect);
            Ok(Candidate {
                effect,
                score: own.map(Column::statistic).fold(0.0, f64::max),
                p_family: family.p(&columns, effect),
                fitted,
                gains,
            })
        })
        .collect();
    let mut candidates = refitted.into_iter().collect::<Result<Vec<_>, _>>()?;
    candidates.sort_by(|a, b| b.gain().total_cmp(&a.gain()));
    Ok(Ranking { candidates })
}

/// What held-out units lose in squared residual.
fn gains(heldout: &[f64], fitted: &Fitted) -> Vec<f64> {
    let with = fitted.heldout(&|unit| unit);
    heldout.iter().zip(with).map(|(before, after)| before - after).collect()
}

/// Refits one effect from its most promising starts; the lowest cost wins.
fn refit(
    cases: &[Case],
    current: &Fitted,
    effect: Effect,
    columns: &[Column],
    units: Units,
    settings: &DiagnoseSettings,
) -> Result<Fitted, DiagnoseError> {
    let mut effects = current.effects.clone();
    effects.push(effect);
    let mut hypothesis = Hypothesis::new(cases, &effects)?;
    let mut own: Vec<&Column> = columns.iter().filter(|column| column.effect == effect).collect();
    own.sort_by(|a, b| b.predicted_gain().total_cmp(&a.predicted_gain()));
    let mut starts: Vec<&[f64]> = Vec::new();
    for column in own {
        if !starts.contains(&column.start.as_slice()) && starts.len() < settings.starts {
            starts.push(&column.start);
        }
    }
    let rough = PooledSettings {
        max_iterations: 25,
        cost_tolerance: 1e-5,
    };
    let mut best: Option<crate::hypothesis::PooledEnd> = None;
    for values in starts {
        let start = with_effect(&hypothesis, current, effect, values);
        let end = hypothesis.fit(&start, &rough)?;
        if best.as_ref().is_none_or(|best| end.fit.cost() < best.fit.cost()) {
            best = Some(end);
        }
    }
    let Some(best) = best else {
        return Err(snug_identify::IdentifyError::NoStart.into());
    };
    let from = Start {
        own: best.fit.own,
        shared: best.fit.shared,
    };
    let end = hypothesis.fit(&from, &PooledSettings::default())?;
    hypothesis.finish(end, &units)
}

/// The current fit with one effect's parameters at `values`.
fn with_effect(
    hypothesis: &Hypothesis<'_>,
    current: &Fitted,
    effect: Effect,
    values: &[f64],
) -> Start {
    let mut start = hypothesis.start_from(current);
    let before: usize = current
        .effects
        .iter()
        .map(|effect| effect.description().parameters.len())
        .sum();
    let first = BASE_PARAMETERS.len() + before;
    for (offset, (&value, spec)) in values.iter().zip(effect.description().parameters).enumerate() {
        let index = first + offset;
        match spec.scope {
            Scope::Shared => {
                if let Some(column) = hypothesis.shared.iter().position(|&i| i == index) {
                    start.shared[column] = value;
                }
            }
            Scope::PerTightening => {
                if let Some(column) = hypothesis.own.iter().position(|&i| i == index) {
                    start.own.iter_mut().for_each(|own| own[column] = value);
                }
            }
        }
    }
    start
}
