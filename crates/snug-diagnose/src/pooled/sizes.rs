//! The sizes of a fitted pooled model's effects, with intervals that survive coloured noise and a little misfit.
//!
//! Its sandwich is S⁻¹ (Σ g gᵀ) S⁻¹ times U/(U − p) over U clusters (CR1), whole tightenings or stretches of few, never below
//! the S⁻¹ of unit noise; Student's t with U − 1. That of one tightening's samples is snug-identify's (M of known noise or of
//! scores over time), that of regressions on what was fitted snug-statistics' (CR2).

use crate::data::clusters::{student, student_among};
use crate::library::is_unlisted;
use crate::pooled::fitted::Fitted;
use crate::pooled::groups;
use crate::pooled::parameter_place::first_parameter;
use BesideNothing::{Held, Told, Unknown};
use snug_campaign::{EffectParameter, ParameterSource};
use snug_identify::FitTask;
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use snug_model::{BASE_PARAMETERS, Effect, Law, Model, ParameterSpec, Scope};

/// Every parameter of one of the model's effects.
///
/// Shared: variance S⁻¹ of unit noise, or, where larger, S⁻¹ (Σ g gᵀ) S⁻¹ over clusters (sandwich), Student's t over clusters.
/// Of each tightening's own: mean, its interval over tightenings, and the spread between them; of one record alone as if it were
/// shared.
pub(crate) fn parameters(
    cases: &[FitTask<'_>],
    fitted: &Fitted,
    effect: Effect,
) -> Vec<EffectParameter> {
    let Ok(model) = cases[0].model_with(&fitted.effects) else {
        return Vec::new();
    };
    let errors = fitted.shared_errors();
    let of_one_record = fitted.errors_of_one_record();
    let first = first_parameter(&fitted.effects, effect);
    let specs = effect.description().parameters.iter();
    (specs.zip(model.ranges(effect)).enumerate())
        .map(|(offset, (spec, range))| {
            let index = first + offset;
            let parameter = &model.parameters()[index];
            let column = |of: &[usize]| of.iter().position(|&known| known == index);
            let limits = (parameter.minimum, parameter.maximum);
            let mut size = EffectParameter {
                name: parameter.name.clone(),
                unit: spec.unit_where(cases[0].quantity()).to_owned(),
                value: parameter.value,
                minimum: range.minimum.max(limits.0),
                maximum: range.maximum.min(limits.1),
                ..described(spec)
            };
            let mut shared = (0..fitted.shared.len())
                .filter(|&column| fitted.shared_sizes()[column].index == index);
            if let Some(several) = groups::sizes::of(cases, fitted, index, effect, offset) {
                several.tell(&mut size);
            } else if let Some(column) = shared.next() {
                size.value = fitted.shared[column];
                let inside = size.value > limits.0 && size.value < limits.1;
                let error = errors.as_ref().map(|e| e[column]);
                size.standard_error = error.filter(|&error| inside && is_known(error));
                let quantile = student(fitted.blocks.len());
                size.widen(quantile, limits);
            } else if let Some(column) = column(fitted.own_indices()) {
                let values: Vec<f64> = fitted.own.iter().map(|own| own[column]).collect();
                size.summarise(&values, limits);
                if let Some(errors) = &of_one_record {
                    size.standard_error = Some(errors[column]).filter(|&error| is_known(error));
                    size.widen(student(fitted.blocks.len()), limits);
                }
            }
            size
        })
        .collect()
}

/// What the data say of an effect's size beside nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BesideNothing {
    /// An interval excludes the value at which the effect is not there.
    Told,
    /// Every interval holds it.
    Held,
    /// There is no interval, or a shape that ends where it may go no further.
    Unknown,
}

/// Whether the data know an effect's size well enough to tell it from nothing: an interval that excludes the value at which the
/// effect is not there. Where that lies beyond all it may be, the interval must lie within what it may be; a law of the study's
/// own says nowhere where it vanishes and is believed.
pub(crate) fn is_told_from_nothing(cases: &[FitTask<'_>], fitted: &Fitted, effect: Effect) -> bool {
    beside_nothing(cases, fitted, effect) == BesideNothing::Told
}

/// The same with what is not told: whether it may be nothing, or nobody knows.
pub(crate) fn beside_nothing(
    cases: &[FitTask<'_>],
    fitted: &Fitted,
    effect: Effect,
) -> BesideNothing {
    let Ok(model) = cases[0].model_with(&fitted.effects) else {
        return BesideNothing::Unknown;
    };
    let first = first_parameter(&fitted.effects, effect);
    let specs = effect.description().parameters;
    let nothing = |offset: usize| match (specs[offset].vanishes_at, offset) {
        (None, 0) if is_unlisted(effect) => Some(0.0),
        (told, _) => told,
    };
    let sizes = parameters(cases, fitted, effect);
    let told = |(offset, size): (usize, &EffectParameter)| {
        let nothing = nothing(offset)?;
        // What some group has is there, whatever the mean.
        if let Some(by_group) = &size.by_group {
            let is_there = by_group.groups.iter().any(|group| group.present);
            return Some(if is_there { Told } else { Held });
        }
        let index = first + offset;
        if size.per_tightening && fitted.own.len() > 1 {
            return Some(fitted.own_beside(nothing, index));
        }
        let parameter = &model.parameters()[index];
        let (Some(low), Some(high)) = (size.low, size.high) else {
            return Some(Unknown);
        };
        let is_told = match nothing >= parameter.minimum && nothing <= parameter.maximum {
            true => low > nothing || high < nothing,
            false => low > parameter.minimum && high < parameter.maximum,
        };
        Some(if is_told { Told } else { Held })
    };
    // A law whose shape or size ends where it may go no further, and not in nothing, is another law.
    let is_at_its_end = |(offset, size): (usize, &EffectParameter)| {
        let parameter = &model.parameters()[first + offset];
        let ends = [parameter.minimum, parameter.maximum];
        let is_nothing = nothing(offset) == Some(size.value);
        !is_nothing && !size.per_tightening && ends.contains(&size.value)
    };
    if fitted.are_stretches() && sizes.iter().enumerate().any(is_at_its_end) {
        return Unknown;
    }
    let all: Vec<BesideNothing> = sizes.iter().enumerate().filter_map(told).collect();
    match all.as_slice() {
        [] => Told,
        all if all.contains(&Told) => Told,
        all if all.contains(&Unknown) => Unknown,
        _ => Held,
    }
}

/// Whether a standard error is one: of a direction of which the data know nothing it comes out as 0.
fn is_known(standard_error: f64) -> bool {
    standard_error > 0.0 && standard_error.is_finite()
}

/// A parameter as its effect describes it, at its usual start and without an interval.
pub(crate) fn described(spec: &ParameterSpec) -> EffectParameter {
    EffectParameter {
        name: spec.name.to_owned(),
        meaning: spec.meaning.to_owned(),
        unit: spec.unit.to_owned(),
        value: spec.starts[0],
        low: None,
        high: None,
        standard_error: None,
        per_tightening: spec.scope == Scope::PerTightening,
        spread: None,
        minimum: spec.minimum,
        maximum: spec.maximum,
        by_group: None,
    }
}

trait Summary {
    fn widen(&mut self, quantile: f64, limits: (f64, f64));
    fn summarise(&mut self, values: &[f64], limits: (f64, f64));
}

impl Summary for EffectParameter {
    fn widen(&mut self, quantile: f64, limits: (f64, f64)) {
        if let Some(error) = self.standard_error {
            self.low = Some((self.value - quantile * error).max(limits.0));
            self.high = Some((self.value + quantile * error).min(limits.1));
        }
    }

    fn summarise(&mut self, values: &[f64], limits: (f64, f64)) {
        let n = values.len() as f64;
        self.value = values.iter().sum::<f64>() / n;
        if n < 2.0 {
            return;
        }
        let squares: f64 = values.iter().map(|x| (x - self.value).powi(2)).sum();
        let spread = (squares / (n - 1.0)).sqrt();
        self.spread = Some(spread);
        self.standard_error = Some(spread / n.sqrt());
        self.widen(student(values.len()), limits);
    }
}

impl Fitted {
    /// Standard errors of the shared parameters.
    pub fn shared_errors(&self) -> Option<Vec<f64>> {
        let (curvature, gradients) = self.shared_evidence();
        let skipped = curvature.size() - self.shared.len();
        let errors = self.errors(&curvature, &gradients)?;
        Some(errors[skipped..].to_vec())
    }

    /// Standard errors of one shared parameter that differs between groups, in their order, at `places`: that of unit noise,
    /// times what the scatter of the tightenings within all groups together adds to it. A group alone has too few.
    pub fn group_errors(&self, places: &[usize]) -> Option<Vec<f64>> {
        let (curvature, gradients) = self.shared_evidence();
        let inverse = curvature.inverse()?;
        let sandwich = |place: usize| -> f64 {
            let row: Vec<f64> = (0..curvature.size())
                .map(|j| inverse.at(place, j))
                .collect();
            gradients.iter().map(|g| dot(&row, g).powi(2)).sum()
        };
        let known: Vec<usize> = (places.iter().copied())
            .filter(|&place| inverse.at(place, place) > 0.0)
            .collect();
        let ratios = known
            .iter()
            .map(|&place| sandwich(place) / inverse.at(place, place));
        let clusters = gradients.len() as f64;
        let correction = clusters / (clusters - self.shared.len() as f64).max(1.0);
        let ratio = correction * ratios.sum::<f64>() / known.len().max(1) as f64;
        let factor = if self.is_weighted {
            ratio.max(1.0)
        } else {
            ratio
        };
        let error = |&place: &usize| (factor * inverse.at(place, place)).sqrt();
        Some(places.iter().map(error).collect())
    }

    /// Standard errors of a single long record's own parameters; `None` of whole tightenings and of several records, where the
    /// scatter between them says it.
    fn errors_of_one_record(&self) -> Option<Vec<f64>> {
        let ([_], Some((errors, _))) = (self.own.as_slice(), self.errors_of_record(0)) else {
            return None;
        };
        Some(errors)
    }

    /// Standard errors of one long record's parameters, its own first, and of how many stretches; `None` of whole tightenings.
    fn errors_of_record(&self, member: usize) -> Option<(Vec<f64>, usize)> {
        let curvature = self.member_curvature.get(member)?;
        let blocks = self.members.iter().zip(&self.blocks);
        let gradients: Vec<Vec<f64>> = blocks
            .filter(|(of, _)| **of == member)
            .map(|(_, block)| block.gradient.clone())
            .collect();
        let errors = self.errors(curvature, &gradients)?;
        Some((errors, gradients.len()))
    }

    /// What several tightenings say of a parameter that each has of its own, the model's at `index`. What scatters between whole
    /// tightenings is there, whatever its mean; of long records one must know its own, beyond what chance does in any of them.
    fn own_beside(&self, nothing: f64, index: usize) -> BesideNothing {
        let Some(column) = self.own_indices().iter().position(|&one| one == index) else {
            return Unknown;
        };
        if !self.are_stretches() {
            return Told;
        }
        let records = self.own.len();
        let of_one = |(member, own): (usize, &Vec<f64>)| {
            let (errors, stretches) = self.errors_of_record(member)?;
            let error = errors
                .get(column)
                .copied()
                .filter(|&error| is_known(error))?;
            Some((own[column] - nothing).abs() > student_among(stretches, records) * error)
        };
        let known: Vec<bool> = (self.own.iter().enumerate()).filter_map(of_one).collect();
        match known.as_slice() {
            [] => Unknown,
            known if known.contains(&true) => Told,
            _ => Held,
        }
    }

    /// Of every parameter of `curvature`, by the sandwich over clusters.
    fn errors(&self, curvature: &SymmetricMatrix, gradients: &[Vec<f64>]) -> Option<Vec<f64>> {
        let p = self.shared.len();
        let inverse = curvature.inverse()?;
        let clusters = gradients.len() as f64;
        let correction = clusters / (clusters - p as f64).max(1.0);
        let floor = if self.is_weighted { 1.0 } else { 0.0 };
        Some(
            (0..curvature.size())
                .map(|column| {
                    let row: Vec<f64> = (0..curvature.size())
                        .map(|j| inverse.at(column, j))
                        .collect();
                    let sandwich: f64 = gradients.iter().map(|g| dot(&row, g).powi(2)).sum();
                    (floor * inverse.at(column, column))
                        .max(correction * sandwich)
                        .sqrt()
                })
                .collect(),
        )
    }
}

/// The model of one case with everything but its own parameters held, known as well as `errors` say, and those where all tightenings
/// together put them: what is fitted from there fits no worse.
pub(crate) fn held(
    case: &FitTask<'_>,
    fitted: &Fitted,
    member: usize,
    errors: Option<&[f64]>,
) -> Option<Model> {
    let mut model = case.model_with(&fitted.effects).ok()?;
    for (&index, &value) in fitted.own_indices().iter().zip(&fitted.own[member]) {
        let parameter = &mut model.parameters_mut()[index];
        parameter.value = value;
        parameter.source = ParameterSource::Identified;
    }
    for part in fitted.parts(member, errors) {
        let parameter = &mut model.parameters_mut()[part.index];
        parameter.value = part.value;
        // Of one machine's recordings each has its own mass, damping and stiffness again once it is looked at alone.
        if part.index < BASE_PARAMETERS.len() {
            continue;
        }
        parameter.fixed = true;
        parameter.standard_error = part.standard_error;
    }
    Some(model)
}

#[cfg(test)]
mod tests;
