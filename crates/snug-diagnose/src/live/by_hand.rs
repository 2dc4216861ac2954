//! One tightening with numbers that somebody sets: what the model makes of them, and the fit from there.

use super::cases::LiveCases;
use super::fit::LiveFit;
use super::step::step_response;
use crate::data::cases::{Cases, Tally};
use crate::data::follower::{FitStep, Follower};
use crate::data::simulation::Asked;
use crate::error::DiagnoseError;
use crate::pooled::fitted::Fitted;
use crate::pooled::model::PooledModel;
use snug_campaign::Interval;
use snug_least_squares::PooledSettings;
use snug_model::Effect;
use std::ops::RangeInclusive;
use std::sync::atomic::AtomicBool;

/// A number of a tightening's model that somebody may set.
#[derive(Debug, Clone, PartialEq)]
pub struct HandNumber {
    /// As in files.
    pub name: String,
    /// Of value, interval and range.
    pub unit: String,
    /// As fitted.
    pub value: f64,
    /// 95 %; `None` where it is not known or the number is not free.
    pub interval: Option<Interval>,
    /// Where it makes sense to set it: nothing, twice and a half what was fitted, the ends of the interval, as far as it may go.
    pub range: RangeInclusive<f64>,
    /// The effect that it belongs to; `None` for mass, damping and stiffness.
    pub effect: Option<Effect>,
}

/// What a tightening looks like with numbers that were set by hand.
#[derive(Debug, Clone, PartialEq)]
pub struct ByHand {
    /// The compared output in its SI unit, a value for each sample of the window.
    pub output: Vec<f64>,
    /// As [`LiveTightening::step`](super::tightening::LiveTightening), in its SI unit.
    pub step: Option<Vec<f64>>,
    /// Root mean square of the residual, in the unit of [`LiveFit::error`].
    pub error: f64,
}

/// How far a number can be set, over its fitted value. Chosen: room to see the curve go wrong on either side.
const REACH: f64 = 2.5;

/// Where it makes sense to set a number that may lie within `bounds`.
pub(super) fn range(
    value: f64,
    interval: Option<Interval>,
    bounds: [f64; 2],
) -> RangeInclusive<f64> {
    let ends = interval.map(|interval| [interval.low, interval.high]);
    let all = [0.0, REACH * value]
        .into_iter()
        .chain(ends.into_iter().flatten());
    let finite = all.filter(|end| end.is_finite());
    let (low, high) = finite.fold((0.0_f64, 0.0_f64), |(low, high), end| {
        (low.min(end), high.max(end))
    });
    if low < high {
        return low.max(bounds[0])..=high.min(bounds[1]);
    }
    // Nothing was found: as far as it may be, or else anything near nothing.
    let or = |bound: f64, other: f64| if bound.is_finite() { bound } else { other };
    or(bounds[0], -1.0)..=or(bounds[1], 1.0)
}

impl LiveCases {
    /// Simulates tightening number `member` with these values of [`LiveTightening::numbers`](super::tightening::LiveTightening).
    ///
    /// # Errors
    /// What the model refuses.
    ///
    /// # Panics
    /// Where there is no such tightening, or not a value for each number.
    pub fn by_hand(
        &self,
        fit: &LiveFit,
        member: usize,
        values: &[f64],
    ) -> Result<ByHand, DiagnoseError> {
        let tally = Tally::default();
        let one = [self.cases[member].lent()];
        let pooled = PooledModel::new(Cases::new(&one, &tally), fit.effects())?;
        assert_eq!(values.len(), pooled.models[0].parameters().len());
        let asked = [Asked {
            member: 0,
            input: &one[0].input,
            values,
        }];
        let output = pooled.outputs(&asked).swap_remove(0);
        let left = one[0].missed(&output);
        let residual = pooled.weigh_signal(0, &left);
        let squares: f64 = residual.iter().map(|r| r * r).sum();
        Ok(ByHand {
            step: step_response(&self.cases[member], &pooled.models[0], values),
            output,
            error: (squares / residual.len().max(1) as f64).sqrt(),
        })
    }

    /// Fits the effects of `fit` to all tightenings, from where that ended but for tightening number `member`, which begins with
    /// `values`, as what all share does; `tell` and `end` as in [`LiveCases::fit`].
    ///
    /// # Errors
    /// As [`LiveCases::fit`].
    ///
    /// # Panics
    /// As [`LiveCases::by_hand`].
    pub fn fit_from(
        &self,
        fit: &LiveFit,
        member: usize,
        values: &[f64],
        tell: &(dyn Fn(FitStep) + Sync),
        end: &AtomicBool,
    ) -> Result<LiveFit, DiagnoseError> {
        let tally = Tally::default();
        let follower = Follower::new(self.cases.len(), tell, end);
        let cases = self.counted(&tally).followed_by(&follower);
        let (effects, sharing) = (fit.effects(), &fit.fitted.sharing);
        let mut pooled = PooledModel::shared_by(cases, effects, sharing)?;
        let mut start = fit.fitted.start(&pooled);
        for (to, &index) in start.own[member].iter_mut().zip(&pooled.own) {
            *to = values[index];
        }
        for &place in &pooled.shared_of[member] {
            start.shared[place] = values[pooled.shared[place].index];
        }
        let ended = pooled.fit(&start, &PooledSettings::default());
        follower.go_on()?;
        self.ended(Fitted::new(&pooled, ended?, &self.clusters))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_can_be_set_from_nothing_to_well_beyond_what_was_fitted() {
        let free = [f64::NEG_INFINITY, f64::INFINITY];
        assert_eq!(range(2.0, None, free), 0.0..=5.0);
        assert_eq!(range(-2.0, None, free), -5.0..=0.0);
        let wide = Interval {
            low: -1.0,
            high: 9.0,
        };
        assert_eq!(range(2.0, Some(wide), free), -1.0..=9.0);
        assert_eq!(range(2.0, Some(wide), [0.0, 4.0]), 0.0..=4.0);
        assert_eq!(range(0.0, None, [0.0, 30.0]), 0.0..=30.0);
        assert_eq!(range(0.0, None, free), -1.0..=1.0);
    }
}
