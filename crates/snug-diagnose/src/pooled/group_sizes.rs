//! Sizes that differ between groups of tightenings: each with its interval, which groups have the effect at all, and what they
//! have in common.

use crate::data::clusters::student;
use crate::pooled::change_point::change_point;
use crate::pooled::fitted::Fitted;
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
    /// Where there is nothing of it, as far as that is known.
    nothing: Option<f64>,
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
        nothing: effect.description().parameters[offset].vanishes_at,
        limits: (parameter.minimum, parameter.maximum),
        quantile: student(fitted.blocks.len()),
        change,
    })
}

impl OfGroups {
    /// Says it of the parameter: mean and its interval, spread, and every group.
    pub fn tell(&self, size: &mut EffectParameter) {
        let count = self.values.len() as f64;
        size.value = self.values.iter().sum::<f64>() / count;
        let variances: Option<Vec<f64>> =
            (self.errors.as_ref()).map(|errors| errors.iter().map(|error| error * error).collect());
        let mut shrunk = self.values.clone();
        if !self.groups.factor.is_sample() {
            // Conditions are all there are: their mean is as well known as they are.
            let error = variances.map(|known| known.iter().sum::<f64>().sqrt() / count);
            let reach = error.map(|error| self.quantile * error);
            size.standard_error = error;
            size.low = reach.map(|reach| (size.value - reach).max(self.limits.0));
            size.high = reach.map(|reach| (size.value + reach).min(self.limits.1));
        } else if let Some(all) =
            variances.and_then(|known| random_effects(&self.values, &known).ok())
        {
            size.value = all.mean;
            size.standard_error = Some(all.standard_error);
            size.low = Some(all.interval.low.max(self.limits.0));
            size.high = Some(all.interval.high.min(self.limits.1));
            size.spread = Some(all.spread);
            shrunk = all.shrunk;
        }
        let present = self.present();
        let members = self.groups.members();
        let group = |group: usize| {
            let error = self
                .errors
                .as_ref()
                .map(|errors| self.quantile * errors[group]);
            let value = self.values[group];
            GroupSize {
                group: self.groups.levels[group].name.clone(),
                tightenings: members[group].len(),
                value,
                standard_error: self.errors.as_ref().map(|errors| errors[group]),
                shrunk: shrunk[group],
                low: error.map(|error| (value - error).max(self.limits.0)),
                high: error.map(|error| (value + error).min(self.limits.1)),
                present: present[group],
            }
        };
        size.by_group = Some(GroupSizes {
            factor: self.groups.factor.clone(),
            groups: (0..self.values.len()).map(group).collect(),
            change: self.change.clone(),
        });
    }

    /// Which groups have it: further from nothing than chance, by the false-discovery rate over groups.
    fn present(&self) -> Vec<bool> {
        let normal = Normal::standard();
        let p = |(group, &value): (usize, &f64)| {
            let error = self
                .errors
                .as_ref()
                .map_or(f64::INFINITY, |errors| errors[group]);
            let nothing = self
                .nothing
                .unwrap_or(0.0)
                .clamp(self.limits.0, self.limits.1);
            let away = (value - nothing).abs();
            // A size that may lie on one side of nothing only is tested on that side.
            let sides = match nothing <= self.limits.0 || nothing >= self.limits.1 {
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
        adjusted
            .into_iter()
            .map(|p| p <= FALSE_DISCOVERIES)
            .collect()
    }
}
