//! Sizes that differ between groups of tightenings: each with its interval, which groups have the effect at all, and what they
//! have in common.

use crate::data::clusters::student;
use crate::pooled::change_point::change_point;
use crate::pooled::fitted::Fitted;
use crate::pooled::groups::nothing::Nothing;
use crate::pooled::sharing::Groups;
use crate::pooled::thresholds::FALSE_DISCOVERIES;
use snug_campaign::{ChangePoint, EffectParameter, GroupSize, GroupSizes};
use snug_identify::FitTask;
use snug_model::{Effect, Law};
use snug_statistics::multiplicity::benjamini_hochberg;
use snug_statistics::random_effects::random_effects;
use statrs::distribution::{ContinuousCDF, Normal};

/// One parameter of an effect, group by group.
pub(crate) struct OfGroups {
    groups: Groups,
    values: Vec<f64>,
    errors: Option<Vec<f64>>,
    nothing: Nothing,
    limits: (f64, f64),
    quantile: f64,
    change: Option<ChangePoint>,
}

/// The parameter number `index` of the model, which is number `offset` of `effect`; `None` where all share it.
pub(crate) fn of(
    cases: &[FitTask<'_>],
    fitted: &Fitted,
    index: usize,
    effect: Effect,
    offset: usize,
) -> Option<OfGroups> {
    let places: Vec<usize> = (0..fitted.shared.len())
        .filter(|&place| {
            let size = &fitted.shared_sizes()[place];
            size.index == index && size.level.is_some()
        })
        .collect();
    let groups = Groups::of(cases, fitted.sharing.factor(effect)?)?;
    if places.len() != groups.levels.len() {
        return None;
    }
    let model = cases[0].model_with(&fitted.effects).ok()?;
    let parameter = &model.parameters()[index];
    let change = change_point(cases, fitted, &groups.factor, &places);
    Some(OfGroups {
        groups,
        values: places.iter().map(|&place| fitted.shared[place]).collect(),
        errors: fitted.group_errors(&places),
        nothing: Nothing::of(
            effect.description().parameters[offset].vanishes_at,
            (parameter.minimum, parameter.maximum),
        ),
        limits: (parameter.minimum, parameter.maximum),
        quantile: student(fitted.blocks.len()),
        change,
    })
}

impl OfGroups {
    /// Says it of the parameter: mean and its interval, spread, and every group.
    pub fn tell(&self, size: &mut EffectParameter) {
        let present = self.present();
        let among = self.among(&present);
        let of_those =
            |all: &[f64]| -> Vec<f64> { among.iter().map(|&group| all[group]).collect() };
        let values = of_those(&self.values);
        let count = values.len() as f64;
        size.value = values.iter().sum::<f64>() / count;
        let variances: Option<Vec<f64>> = (self.errors.as_ref())
            .map(|errors| of_those(errors).iter().map(|error| error * error).collect());
        let mut shrunk = self.values.clone();
        if !self.groups.factor.is_sample() {
            // Conditions are all there are: their mean is as well known as they are.
            let error = variances.map(|known| known.iter().sum::<f64>().sqrt() / count);
            let reach = error.map(|error| self.quantile * error);
            size.standard_error = error;
            size.low = reach.map(|reach| (size.value - reach).max(self.limits.0));
            size.high = reach.map(|reach| (size.value + reach).min(self.limits.1));
        } else if let Some(all) = variances.and_then(|known| random_effects(&values, &known).ok()) {
            size.value = all.mean;
            size.standard_error = Some(all.standard_error);
            size.low = Some(all.interval.low.max(self.limits.0));
            size.high = Some(all.interval.high.min(self.limits.1));
            size.spread = Some(all.spread);
            for (&group, one) in among.iter().zip(all.shrunk) {
                shrunk[group] = one;
            }
        }
        let members = self.groups.members();
        let group = |group: usize| {
            let (low, high) = self.interval(group);
            GroupSize {
                group: self.groups.levels[group].name.clone(),
                tightenings: members[group].len(),
                value: self.values[group],
                standard_error: self.errors.as_ref().map(|errors| errors[group]),
                shrunk: shrunk[group],
                low,
                high,
                present: present[group],
            }
        };
        size.by_group = Some(GroupSizes {
            factor: self.groups.factor.clone(),
            groups: (0..self.values.len()).map(group).collect(),
            change: self.change.clone(),
        });
    }

    /// The groups whose mean is told: all, but of a size without end where there is nothing of it those that have it, if any has.
    fn among(&self, present: &[bool]) -> Vec<usize> {
        let all = 0..self.values.len();
        match self.nothing {
            Nothing::Beyond if present.contains(&true) => all.filter(|&one| present[one]).collect(),
            _ => all.collect(),
        }
    }

    /// The ends of a group's interval, as far as it has any.
    fn interval(&self, group: usize) -> (Option<f64>, Option<f64>) {
        let Some(errors) = &self.errors else {
            return (None, None);
        };
        let reach = self.quantile * errors[group];
        let (low, high) = (self.nothing).interval_within(self.values[group], reach, self.limits);
        (Some(low), high)
    }

    /// Which groups have it: further from nothing than chance, by the false-discovery rate over groups, and where it is the less the larger,
    /// with an upper end.
    fn present(&self) -> Vec<bool> {
        let normal = Normal::standard();
        let p = |(group, &value): (usize, &f64)| {
            let error = self
                .errors
                .as_ref()
                .map_or(f64::INFINITY, |errors| errors[group]);
            let away = self.nothing.distance(value).abs();
            // A size that may lie on one side of nothing only is tested on that side.
            let sides = match self.nothing.is_an_end_of(self.limits) {
                true => 1.0,
                false => 2.0,
            };
            match away > 0.0 && error > 0.0 {
                true => (sides * normal.sf(away / error)).min(1.0),
                false => 1.0,
            }
        };
        let all: Vec<f64> = self.values.iter().enumerate().map(p).collect();
        let adjusted = benjamini_hochberg(&all).unwrap_or(all);
        let may_be_without_end = |group: usize| self.nothing.is_reached(self.interval(group).1);
        (adjusted.into_iter().enumerate())
            .map(|(group, p)| p <= FALSE_DISCOVERIES && !may_be_without_end(group))
            .collect()
    }
}
