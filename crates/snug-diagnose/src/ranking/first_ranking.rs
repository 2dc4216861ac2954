//! A first ranking of all candidates in milliseconds, without any simulation: the share of the equation of motion's error that each
//! takes along the measured motion, and from where its refit may begin.
//!
//! Of effects that are linear in their sizes, which is tried and not believed; numbers that shape them stand at every combination of
//! their starts, as in the score test.

use crate::data::cases::Cases;
use crate::pooled::equation::{PlainEquation, acting_terms, values};
use crate::pooled::fitted::Fitted;
use crate::ranking::sensitivity::combinations;
use crate::ranking::thresholds::{MOST_OF_FIRST_RANKING, MOST_SHAPES};
use rayon::prelude::*;
use snug_identify::{Acting, EquationFit, FitTask, MotionEquation, Term};
use snug_model::{Effect, Law, PlausibleRange, Scope};

/// What a candidate promises by the equation of motion.
#[derive(Debug, Clone)]
pub(crate) struct Promise {
    pub effect: Effect,
    /// Share of the equation error of the model without it that it takes \[–\].
    pub share: f64,
    /// m, c, k beside it.
    pub base: [f64; 3],
    /// Its own numbers.
    pub own: Vec<f64>,
    /// What the sizes of effects of the model are multiplied with beside it \[–\].
    pub times: Vec<(Effect, f64)>,
}

/// What the candidates promise beside `current`, the most promising first; none where a hand holds the rig.
pub(crate) fn first_ranking(
    cases: Cases<'_>,
    current: &Fitted,
    candidates: &[Effect],
) -> Vec<Promise> {
    let found = of_some(&cases, values(cases, current), current, candidates);
    let mut promises = found.unwrap_or_default();
    promises.sort_by(|a, b| b.share.total_cmp(&a.share));
    for promise in &promises {
        tracing::debug!(
            effect = promise.effect.name(),
            share = promise.share,
            own = ?promise.own,
            base = ?promise.base,
            "takes of the equation error"
        );
    }
    promises
}

fn of_some(
    cases: &[FitTask<'_>],
    at: Option<Vec<Vec<f64>>>,
    current: &Fitted,
    candidates: &[Effect],
) -> Option<Vec<Promise>> {
    let at = at?;
    let mut samples = 0;
    let some = cases.iter().take_while(|case| {
        samples += case.measured().len();
        samples <= MOST_OF_FIRST_RANKING
    });
    let some = &cases[..some.count().max(1)];
    let PlainEquation { equation, .. } = PlainEquation::of(some)?;
    let at = &at[..some.len()];
    let (known, terms) = acting_terms(&equation, &current.effects, at)?;
    let without = equation.fit(&terms).filter(EquationFit::is_driven)?;
    let beside = Beside {
        before: equation.acting(&current.effects, at)?,
        current: &current.effects,
        equation: &equation,
        at,
        known,
        terms,
        left: 1.0 - without.explained,
    };
    let promise = |&effect: &Effect| {
        let ranges = some[0].model.ranges(effect);
        beside.promise(effect, &ranges)
    };
    Some(candidates.par_iter().filter_map(promise).collect())
}

/// The model beside which candidates are looked at.
struct Beside<'a> {
    equation: &'a MotionEquation<'a>,
    current: &'a [Effect],
    at: &'a [Vec<f64>],
    before: Acting,
    /// Effects of that model that add something, and what each adds.
    known: Vec<Effect>,
    terms: Vec<Term>,
    /// Share of the acceleration's power that it leaves.
    left: f64,
}

impl Beside<'_> {
    /// The best of an effect's shapes; `None` where it is not linear in what is 0 without it.
    fn promise(&self, effect: Effect, ranges: &[PlausibleRange]) -> Option<Promise> {
        let specs = effect.description().parameters;
        let is_size: Vec<bool> = (specs.iter())
            .map(|spec| spec.vanishes_at == Some(0.0) || (specs.len() == 1 && spec.starts == [0.0]))
            .collect();
        if !is_size.contains(&true) || specs.iter().any(|spec| spec.scope != Scope::Shared) {
            return None;
        }
        let mut shapes: Vec<Vec<f64>> = Vec::new();
        for mut shape in combinations(ranges) {
            let sizes = shape
                .iter_mut()
                .zip(&is_size)
                .filter(|(_, is_size)| **is_size);
            sizes.for_each(|(value, _)| *value = 0.0);
            if !shapes.contains(&shape) && shapes.len() < MOST_SHAPES {
                shapes.push(shape);
            }
        }
        let of_shape = |shape: &Vec<f64>| self.of_shape(effect, ranges, &is_size, shape);
        let found = shapes.iter().filter_map(of_shape);
        found.max_by(|a, b| a.share.total_cmp(&b.share))
    }

    fn of_shape(
        &self,
        effect: Effect,
        ranges: &[PlausibleRange],
        is_size: &[bool],
        shape: &[f64],
    ) -> Option<Promise> {
        let sizes: Vec<usize> = (0..shape.len()).filter(|&index| is_size[index]).collect();
        let mut terms = self.terms.clone();
        for &size in &sizes {
            let once = self.term(effect, shape, size, 1.0)?;
            if !self.term(effect, shape, size, 2.0)?.is_twice(&once) {
                return None;
            }
            terms.push(once);
        }
        let fit = self.equation.fit(&terms)?;
        let mut own = shape.to_vec();
        let (times, own_times) = fit.times.split_at(self.terms.len());
        for (&size, &times) in sizes.iter().zip(own_times) {
            let (minimum, maximum) = ranges[size].limits;
            // What no fit may reach is no promise.
            if !(minimum..=maximum).contains(&times) {
                return None;
            }
            own[size] = times;
        }
        Some(Promise {
            effect,
            share: 1.0 - (1.0 - fit.explained) / self.left,
            base: fit.base,
            own,
            times: (self.known.iter().copied())
                .zip(times.iter().copied())
                .collect(),
        })
    }

    /// The effect with one of its sizes at `value` and the others at 0.
    fn term(&self, effect: Effect, shape: &[f64], size: usize, value: f64) -> Option<Term> {
        let mut own = shape.to_vec();
        own[size] = value;
        let at: Vec<Vec<f64>> = (self.at.iter())
            .map(|values| [values.as_slice(), &own].concat())
            .collect();
        let effects = [self.current, &[effect]].concat();
        let after = self.equation.acting(&effects, &at)?;
        Term::between(&after, &self.before, effect)
    }
}

#[cfg(test)]
mod tests;
