//! Every candidate scored, refitted and held out; best first.

use crate::DiagnoseError;
use crate::cases::Cases;
use crate::column::Column;
use crate::evidence::{chance, clearness, spread_of_sum};
use crate::family::Family;
use crate::fitted::Fitted;
use crate::hypothesis::{Hypothesis, Start};
use crate::long_record;
use crate::score::{Control, Scored, Scorer};
use crate::units::Units;
use crate::{Case, DiagnoseSettings, Watch};
use rayon::prelude::*;
use snug_identify::{PooledFit, PooledSettings};
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

    /// Standard deviations by which that sum exceeds 0.
    pub fn clearness(&self) -> f64 {
        clearness(&self.gains, self.fitted.scale())
    }

    /// Standard deviations by which it explains more than `other`.
    pub fn ahead_of(&self, other: &Self) -> f64 {
        let pairs = self.gains.iter().zip(&other.gains);
        let differences: Vec<f64> = pairs.map(|(own, other)| own - other).collect();
        clearness(&differences, self.fitted.scale())
    }

    /// Chance of so clear a gain in held-out units, among `family` candidates (Bonferroni): for effects that push
    /// elsewhere once the model follows them, so that no score against the model without them sees them.
    fn p_of_gain(&self, family: usize) -> f64 {
        (chance(&self.gains, self.fitted.scale()) * family as f64).min(1.0)
    }

    /// Standard error over units of the share of `misfit` (per unit) that it removes: that of the ratio of two sums.
    pub fn share_error(&self, misfit: &[f64]) -> f64 {
        let whole: f64 = misfit.iter().sum();
        let share = self.gain() / whole;
        let pairs = self.gains.iter().zip(misfit);
        let rest: Vec<f64> = pairs.map(|(gain, misfit)| gain - share * misfit).collect();
        spread_of_sum(&rest) / whole.abs()
    }
}

/// The candidates, best first.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ranking {
    pub candidates: Vec<Candidate>,
    /// Effects whose starts this rig cannot be simulated with.
    pub impossible: Vec<Effect>,
    /// What every candidate was scored with.
    pub columns: Vec<Column>,
    /// Campaigns of nothing but noise, and in how many of them something was called supported.
    pub control: (usize, usize),
}

/// How many times stricter the chance of a gain is judged, so that the score remains what decides as a rule.
const STRICTER: usize = 10;

/// Sign flips behind a p in the negative control.
const CONTROL_FLIPS: usize = 199;

/// Fits exactly these effects, from where `from` ended where it is given.
pub(crate) fn fit_effects(
    cases: Cases<'_>,
    effects: &[Effect],
    from: Option<&Fitted>,
    units: Units,
) -> Result<Fitted, DiagnoseError> {
    let mut hypothesis = Hypothesis::new(cases, effects)?;
    let start = match from {
        Some(fitted) => fitted.start(&hypothesis),
        None => hypothesis.usual_start(),
    };
    let end = match units.are_whole() {
        true => hypothesis.fit(&start, &PooledSettings::default())?,
        false => long_record::to_the_end(&mut hypothesis, &start)?,
    };
    Ok(Fitted::new(&hypothesis, end, &units))
}

/// Scores and refits every effect of `candidates` beside those of `current`.
pub(crate) fn rank(
    cases: Cases<'_>,
    current: &Fitted,
    candidates: &[Effect],
    units: Units,
    settings: &DiagnoseSettings,
    control_campaigns: usize,
    watch: &Watch<'_>,
) -> Result<Ranking, DiagnoseError> {
    cases.tally().ranking();
    let hypothesis = Hypothesis::new(cases, &current.effects)?;
    let control = Control {
        campaigns: control_campaigns,
        seed: settings.seed,
    };
    let Scored { columns, control } =
        Scorer::new(&hypothesis, current, units, control).score(candidates)?;
    cases.tally().signatures(cases.len() * columns.len());
    let family = Family::new(&columns, settings.sign_flips, settings.seed);
    let false_alarms = control
        .par_iter()
        .filter(|columns| {
            let family = Family::new(columns, CONTROL_FLIPS, settings.seed);
            candidates
                .iter()
                .any(|&effect| family.p(columns, effect) <= settings.level)
        })
        .count();
    let heldout = current.heldout_beyond_torque_noise();
    let refitted: Vec<Result<Option<Candidate>, DiagnoseError>> = candidates
        .par_iter()
        .map(|&effect| {
            watch.go_on()?;
            let fitted = refit(cases, current, effect, &columns, units, settings);
            let Some(fitted) = possible(fitted)? else {
                return Ok(None);
            };
            let gains = gains(&heldout, &fitted);
            let own = columns.iter().filter(|column| column.effect == effect);
            Ok(Some(Candidate {
                effect,
                score: own.map(Column::statistic).fold(0.0, f64::max),
                p_family: family.p(&columns, effect),
                fitted,
                gains,
            }))
        })
        .collect();
    let refitted = refitted.into_iter().collect::<Result<Vec<_>, _>>()?;
    let outcomes = candidates.iter().zip(&refitted);
    let impossible = outcomes.filter(|(_, outcome)| outcome.is_none());
    let impossible = impossible.map(|(&effect, _)| effect).collect();
    let mut candidates: Vec<Candidate> = refitted.into_iter().flatten().collect();
    let family_size = candidates.len() * STRICTER;
    for candidate in &mut candidates {
        candidate.p_family = candidate.p_family.min(candidate.p_of_gain(family_size));
    }
    candidates.sort_by(|a, b| b.gain().total_cmp(&a.gain()));
    Ok(Ranking {
        candidates,
        impossible,
        columns,
        control: (control.len(), false_alarms),
    })
}

/// A refit, or nothing where this rig cannot be simulated with the effect's starts: they are meant for a hand on a tool.
fn possible(refitted: Result<Fitted, DiagnoseError>) -> Result<Option<Fitted>, DiagnoseError> {
    match refitted {
        Ok(fitted) if fitted.squares().is_finite() => Ok(Some(fitted)),
        Ok(_) | Err(DiagnoseError::Identify(_)) => Ok(None),
        Err(other) => Err(other),
    }
}

/// What held-out units lose in squared residual.
pub(crate) fn gains(heldout: &[f64], fitted: &Fitted) -> Vec<f64> {
    let with = fitted.heldout_beyond_torque_noise();
    heldout
        .iter()
        .zip(with)
        .map(|(before, after)| before - after)
        .collect()
}

/// Refits one effect from its most promising starts, first roughly on a few tightenings; the lowest cost wins.
fn refit(
    cases: Cases<'_>,
    current: &Fitted,
    effect: Effect,
    columns: &[Column],
    units: Units,
    settings: &DiagnoseSettings,
) -> Result<Fitted, DiagnoseError> {
    let mut effects = current.effects.clone();
    effects.push(effect);
    let mut own: Vec<&Column> = columns
        .iter()
        .filter(|column| column.effect == effect)
        .collect();
    own.sort_by(|a, b| b.predicted_gain().total_cmp(&a.predicted_gain()));
    let most = match units.are_whole() {
        true => settings.starts,
        false => long_record::most_starts(&cases, settings),
    };
    let mut starts: Vec<&[f64]> = Vec::new();
    for column in own {
        if !starts.contains(&column.start.as_slice()) && starts.len() < most {
            starts.push(&column.start);
        }
    }
    let mut hypothesis = Hypothesis::new(cases, &effects)?;
    let [first, rest @ ..] = starts.as_slice() else {
        return fit_effects(cases, &effects, Some(current), units);
    };
    let mut start = with_effect(&hypothesis, current, effect, first);
    if !units.are_whole() {
        let begin = |values: &[f64]| with_effect(&hypothesis, current, effect, values);
        let starts: Vec<Start> = starts.iter().map(|values| begin(values)).collect();
        let end = long_record::best_of(&mut hypothesis, &starts, &CANDIDATE)?;
        return Ok(Fitted::new(&hypothesis, end, &units));
    }
    if !rest.is_empty() {
        let rough = rough(cases, current, effect, &effects, &starts)?;
        start.shared = rough.shared;
        for own in &mut start.own {
            let factors = own.iter_mut().zip(&rough.astray);
            factors.for_each(|(own, factor)| *own *= factor);
        }
        for reach in [AFAR, NEARBY] {
            start = Start::at(&hypothesis.fit_blurred(&start, &CANDIDATE, reach)?);
        }
    }
    let end = hypothesis.fit(&start, &CANDIDATE)?;
    Ok(Fitted::new(&hypothesis, end, &units))
}

/// When the refit of a candidate stops: its gain is then known to a fraction of what chance does. An effect that is not
/// there leaves its timing undetermined, and a strict fit would follow that for long.
const CANDIDATE: PooledSettings = PooledSettings {
    max_iterations: 40,
    cost_tolerance: 1e-6,
};

/// Samples to either side over which residuals are averaged where starts are tried, and on the way from there to the end:
/// 8 and 2 ms at 10 kHz.
const AFAR: usize = 80;
const NEARBY: usize = 20;

/// Tightenings on which starts are tried.
const FEW: usize = 8;

/// What a few tightenings say of an effect.
struct Rough {
    /// Where the start that led to the lowest cost led the shared parameters.
    shared: Vec<f64>,
    /// By how much m, c and k are larger there than without the effect, which led them astray; 1 for other parameters.
    astray: Vec<f64>,
}

fn rough(
    cases: Cases<'_>,
    current: &Fitted,
    effect: Effect,
    effects: &[Effect],
    starts: &[&[f64]],
) -> Result<Rough, DiagnoseError> {
    let few = current.spread(FEW);
    let some: Vec<Case> = few.iter().map(|&index| cases[index].clone()).collect();
    let mut hypothesis = Hypothesis::new(cases.others(&some), effects)?;
    let settings = PooledSettings {
        max_iterations: 20,
        cost_tolerance: 1e-4,
    };
    let there = current.only(&few);
    let mut best: Option<PooledFit> = None;
    for values in starts {
        let start = with_effect(&hypothesis, &there, effect, values);
        let Ok(end) = hypothesis.fit_blurred(&start, &settings, AFAR) else {
            continue;
        };
        if best.as_ref().is_none_or(|best| end.cost() < best.cost()) {
            best = Some(end);
        }
    }
    let end = best.ok_or(snug_identify::IdentifyError::NoStart)?;
    let without = there.start(&hypothesis).own;
    let median_factor = |column: usize| {
        let pairs = end.own.iter().zip(&without);
        let mut factors: Vec<f64> = pairs
            .map(|(with, without)| with[column] / without[column])
            .collect();
        factors.sort_by(f64::total_cmp);
        factors[factors.len() / 2]
    };
    let columns = hypothesis.own.iter().enumerate();
    let factors = columns.map(|(column, &index)| match index < BASE_PARAMETERS.len() {
        true => median_factor(column),
        false => 1.0,
    });
    Ok(Rough {
        astray: factors.collect(),
        shared: end.shared,
    })
}

/// The current fit with one effect's parameters at `values`.
fn with_effect(
    hypothesis: &Hypothesis<'_>,
    current: &Fitted,
    effect: Effect,
    values: &[f64],
) -> Start {
    let mut start = current.start(hypothesis);
    let before: usize = current
        .effects
        .iter()
        .map(|effect| effect.description().parameters.len())
        .sum();
    let first = BASE_PARAMETERS.len() + before;
    for (offset, (&value, spec)) in values
        .iter()
        .zip(effect.description().parameters)
        .enumerate()
    {
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
