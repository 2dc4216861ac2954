//! The equation of motion of a few long recordings of a machine, regressed: what a simulated fit is held against, and from where
//! it is fitted again where it falls short.

use crate::data::cases::Cases;
use crate::data::machine::is_machine;
use crate::pooled::fitted::Fitted;
use crate::pooled::model::{PooledModel, Start};
use crate::pooled::parameter_place::first_parameter;
use crate::pooled::thresholds::{FALLS_SHORT, ONE_WITH_FRICTION, PROMISES};
use snug_identify::{EquationFit, FitTask, MotionEquation, Term};
use snug_model::{BASE_PARAMETERS, Effect, Law, Model};

/// The equation, and the effects of a plain regression as they act on the rig.
pub(crate) struct PlainEquation<'a> {
    pub equation: MotionEquation<'a>,
    pub plain: Vec<Effect>,
}

impl<'a> PlainEquation<'a> {
    /// `None` where somebody holds the rig, the noise is known and says more, or a regression has no answer.
    pub fn of(cases: &'a [FitTask<'a>]) -> Option<Self> {
        Self::beside(cases, &[])
    }

    /// The same averaged as a regression with these effects, each of size 1, too, explains most.
    pub fn beside(cases: &'a [FitTask<'a>], effects: &[Effect]) -> Option<Self> {
        let first = cases.first()?;
        if !cases.iter().all(is_machine) || first.whitening().is_some() {
            return None;
        }
        let rig = first.model.rig();
        let on_rig = |&effect: &Effect| first.model.scale().effect(effect, rig).ok();
        let plain: Vec<Effect> = Effect::PLAIN.iter().filter_map(on_rig).collect();
        let equation = MotionEquation::of(cases, &[&plain[..], effects].concat())?;
        Some(Self { equation, plain })
    }

    /// The same with less noise, and less of what is fast; `None` where the recordings are too short for that and so many terms.
    pub fn wider(&self, terms: usize) -> Option<Self> {
        Some(Self {
            equation: self.equation.wider(terms)?,
            plain: self.plain.clone(),
        })
    }

    /// The regression with the effects of a model as they act with these values of all its parameters, recording by recording.
    pub fn as_fitted(&self, effects: &[Effect], at: &[Vec<f64>]) -> Option<EquationFit> {
        let (_, terms) = acting_terms(&self.equation, effects, at)?;
        self.equation.fit(&terms)
    }

    /// The regression with dry friction and an offset beside the effects of a model, so far as it does not have them.
    pub fn plainly(&self, effects: &[Effect], at: &[Vec<f64>]) -> Option<EquationFit> {
        let terms = self.with_plain_terms(effects, at)?.into_iter();
        let terms: Vec<Term> = terms.map(|(_, term)| term).collect();
        self.equation.fit(&terms)
    }

    /// The regression of mass, damping, stiffness, dry friction and an offset alone.
    pub fn with_friction(&self) -> Option<EquationFit> {
        let terms = (self.plain.iter()).map(|&effect| self.equation.term(effect, &[1.0]));
        self.equation.fit(&terms.collect::<Option<Vec<_>>>()?)
    }

    /// What each of these effects adds as they act with these values of all parameters, and what dry friction and an offset of size 1 do.
    pub fn with_plain_terms(
        &self,
        effects: &[Effect],
        at: &[Vec<f64>],
    ) -> Option<Vec<(Effect, Term)>> {
        let (there, terms) = acting_terms(&self.equation, effects, at)?;
        let known = |effect: &Effect| effects.iter().any(|one| one.name() == effect.name());
        let further = self.plain.iter().filter(|effect| !known(effect));
        let further =
            further.filter_map(|&effect| Some((effect, self.equation.term(effect, &[1.0])?)));
        Some(there.into_iter().zip(terms).chain(further).collect())
    }
}

/// What a plain regression says of a machine's dry friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DryFriction {
    /// With which it holds against every motion \[N\].
    pub force_n: f64,
    /// What it slows \[kg\].
    pub mass_kg: f64,
}

impl DryFriction {
    /// `None` where a plain regression has no answer, or knows of none.
    pub fn of(cases: &[FitTask<'_>]) -> Option<Self> {
        let plain = PlainEquation::of(cases)?;
        let found = plain.with_friction()?;
        let place =
            (plain.plain.iter()).position(|one| one.name() == Effect::CoulombFriction.name())?;
        let [mass_kg, ..] = found.base;
        let force_n = *found.times.get(place)?;
        (force_n > 0.0 && mass_kg > 0.0).then_some(Self { force_n, mass_kg })
    }

    /// What a fitted model says of it, the mass that of the lightest; `None` where it has none.
    pub fn of_fitted(cases: Cases<'_>, fitted: &Fitted) -> Option<Self> {
        let name = Effect::CoulombFriction.name();
        let friction = *fitted.effects.iter().find(|one| one.name() == name)?;
        let masses = values(cases, fitted)?.into_iter();
        Some(Self {
            force_n: fitted.size(friction),
            mass_kg: masses.map(|of_one| of_one[0]).reduce(f64::min)?,
        })
    }
}

/// Whether one mass, damping and stiffness, with dry friction and an offset beside them, leave far less of the measured acceleration
/// than those of each recording by itself do without: what a rub or an offset asks of each is then no difference between machines.
/// Where both leave nothing but noise, that says nothing.
pub(crate) fn is_one_with_friction(cases: &[FitTask<'_>]) -> bool {
    let all = || {
        let plain = PlainEquation::of(cases)?;
        let (equation, together) = (&plain.equation, plain.with_friction()?);
        let left = |alone: &MotionEquation<'_>| -> f64 {
            let left = alone.fit(&[]).map_or(1.0, |fit| 1.0 - fit.explained);
            left * alone.power()
        };
        let apart: f64 = equation.apart().iter().map(left).sum();
        let left = (1.0 - together.explained) * equation.power() / apart;
        tracing::debug!(
            left,
            "one machine with friction and offset, over several without"
        );
        Some(left < ONE_WITH_FRICTION)
    };
    all().unwrap_or(false)
}

/// All parameters of every recording where `fitted` ended.
pub(crate) fn values(cases: Cases<'_>, fitted: &Fitted) -> Option<Vec<Vec<f64>>> {
    let pooled = PooledModel::shared_by(cases, &fitted.effects, &fitted.sharing).ok()?;
    Some(values_at(&pooled, &fitted.start(&pooled)))
}

/// The same at one place of a model.
pub(crate) fn values_at(pooled: &PooledModel<'_>, place: &Start) -> Vec<Vec<f64>> {
    let own = place.own.iter().enumerate();
    own.map(|(member, own)| pooled.values(member, own, &place.shared))
        .collect()
}

/// Whether numbers that explain the share `kept` of the measured acceleration fall short of what a regression promises, if that is
/// `least` or more.
pub(crate) fn falls_short(kept: f64, promised: &EquationFit, least: f64) -> bool {
    let left = 1.0 - promised.explained;
    promised.is_driven() && promised.explained >= least && 1.0 - kept > FALLS_SHORT * left.max(0.01)
}

/// Where the regression puts the numbers of a model whose fit ended at `end` and falls short of it; `None` where it does not.
pub(crate) fn regression_start(pooled: &PooledModel<'_>, end: &Start) -> Option<Start> {
    let all: &[FitTask<'_>] = &pooled.cases;
    let plain = PlainEquation::of(all)?;
    let kept = plain
        .equation
        .explained_by(&pooled.effects, &values_at(pooled, end))?;
    let (found, start) = regressed(&plain, pooled, end)?;
    falls_short(kept, &found, PROMISES).then_some(start)
}

/// Where the regression puts the numbers of a model whose effects have the shapes they have at one of `places`, of each for which it
/// has an answer.
pub(crate) fn with_shapes_of(pooled: &PooledModel<'_>, places: &[Start]) -> Vec<Start> {
    let all: &[FitTask<'_>] = &pooled.cases;
    let plain = match places {
        [] => None,
        _ => PlainEquation::of(all),
    };
    let found = plain.iter().flat_map(|plain| {
        let each = places.iter();
        each.filter_map(|place| regressed(plain, pooled, place))
    });
    found.map(|(_, start)| start).collect()
}

fn regressed(
    plain: &PlainEquation<'_>,
    pooled: &PooledModel<'_>,
    place: &Start,
) -> Option<(EquationFit, Start)> {
    let at = values_at(pooled, place);
    let (there, terms) = acting_terms(&plain.equation, &pooled.effects, &at)?;
    let found = plain.equation.fit(&terms)?;
    let times = there.into_iter().zip(found.times.iter().copied());
    let start = as_found(pooled, place, &found.base, times);
    Some((found, start))
}

/// Those of `effects` that add something there, and what each adds.
pub(crate) fn acting_terms(
    equation: &MotionEquation<'_>,
    effects: &[Effect],
    at: &[Vec<f64>],
) -> Option<(Vec<Effect>, Vec<Term>)> {
    let pairs = effects.iter().copied().zip(equation.terms(effects, at)?);
    let acting = pairs.filter_map(|(effect, term)| Some((effect, term?)));
    Some(acting.unzip())
}

/// The place with the mass, damping and stiffness that a regression found, and with sizes of effects so many times as large.
pub(crate) fn as_found(
    pooled: &PooledModel<'_>,
    place: &Start,
    base: &[f64],
    times: impl IntoIterator<Item = (Effect, f64)>,
) -> Start {
    let mut start = with_base(pooled, place, base);
    for (effect, times) in times {
        multiply(pooled, &mut start, effect, times);
    }
    start
}

/// The place with another mass, damping and stiffness, those of all recordings.
pub(crate) fn with_base(pooled: &PooledModel<'_>, place: &Start, base: &[f64]) -> Start {
    let mut start = place.clone();
    for own in &mut start.own {
        set(pooled.own.iter().copied(), own, base);
    }
    let shared = pooled.shared.iter().map(|size| size.index);
    set(shared, &mut start.shared, base);
    start
}

fn set(indices: impl Iterator<Item = usize>, values: &mut [f64], base: &[f64]) {
    for (index, value) in indices.zip(values) {
        *value = base.get(index).copied().unwrap_or(*value);
    }
}

/// The sizes of `effect`, those numbers of it that are 0 where it is not there, so many times as large.
fn multiply(pooled: &PooledModel<'_>, start: &mut Start, effect: Effect, times: f64) {
    let first = first_parameter(&pooled.effects, effect);
    let specs = effect.description().parameters;
    let is_size = |index: usize| {
        let spec = index
            .checked_sub(first)
            .and_then(|offset| specs.get(offset));
        spec.is_some_and(|spec| spec.vanishes_at == Some(0.0))
    };
    let model: &Model = &pooled.models[0];
    let scaled = |index: usize, value: f64| {
        let parameter = &model.parameters()[index];
        (times * value).clamp(parameter.minimum, parameter.maximum)
    };
    for own in &mut start.own {
        for (&index, value) in pooled.own.iter().zip(own) {
            *value = if is_size(index) {
                scaled(index, *value)
            } else {
                *value
            };
        }
    }
    for (size, value) in pooled.shared.iter().zip(&mut start.shared) {
        *value = if is_size(size.index) {
            scaled(size.index, *value)
        } else {
            *value
        };
    }
}

/// Names and values of the study's own mass, damping and stiffness as a regression puts them.
pub(crate) fn named(base: &[f64; 3]) -> Vec<(String, f64)> {
    let names = BASE_PARAMETERS.iter().map(|name| (*name).to_owned());
    names.zip(base.iter().copied()).collect()
}
