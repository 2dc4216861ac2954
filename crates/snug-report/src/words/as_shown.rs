//! A result in the units in which the rig's own input and output are shown: m where it slides, V where volts were measured.

use snug_campaign::words::vocabulary::Vocabulary;
use snug_campaign::{CampaignResult, Diagnosis, Estimate, Location, Misfit, Moments, SignalUnits};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The same result: misfits, places and sizes of effects in the rig's units, about its own axis; mass, damping and stiffness as they are.
pub fn as_shown(result: &CampaignResult) -> Cow<'_, CampaignResult> {
    if result.vocabulary == Vocabulary::Hand && result.units == SignalUnits::default() {
        return Cow::Borrowed(result);
    }
    let mut shown = result.clone();
    shown.diagnosis = (result.diagnosis.as_ref()).map(|one| diagnosis(one, result));
    let mut factors = BTreeMap::new();
    let estimates = shown.tightenings.iter_mut();
    for estimate in estimates.filter_map(|one| one.estimate.as_mut()) {
        about_own_axis(estimate, result, &mut factors);
    }
    for summary in shown
        .conditions
        .iter_mut()
        .flat_map(|one| &mut one.quantities)
    {
        let Some(&factor) = factors.get(&summary.quantity) else {
            continue;
        };
        let both = [&mut summary.selected, &mut summary.rejected];
        both.into_iter()
            .flatten()
            .for_each(|one| multiply(one, factor));
    }
    Cow::Owned(shown)
}

fn diagnosis(told: &Diagnosis, result: &CampaignResult) -> Diagnosis {
    let mut told = result.vocabulary.told(told);
    let units = &result.units;
    let of_each = told.comparison.tightenings.iter_mut();
    let of_each = of_each.flat_map(|one| &mut one.misfits);
    for one in told.comparison.pooled.iter_mut().chain(of_each) {
        misfit(one, units);
    }
    for rung in &mut told.ladder {
        rung.rms_fitted_output *= units.output_per_rad;
        rung.rms_displacement_rad =
            (rung.rms_displacement_rad).map(|rms| rms * units.output_per_rad);
    }
    let finally = told.final_location.iter_mut();
    for location in finally.chain([&mut told.location]) {
        places(location, units);
    }
    told
}

fn misfit(one: &mut Misfit, units: &SignalUnits) {
    let unit = units.motion_called(&one.quantity);
    if !unit.is_empty() {
        one.rms *= units.output_per_rad;
        one.largest *= units.output_per_rad;
        one.unit = unit;
    }
}

fn places(location: &mut Location, units: &SignalUnits) {
    for aspect in &mut location.aspects {
        match aspect.aspect.as_str() {
            "amplitude_rad" => {
                let edges = aspect.parts.iter_mut();
                for edge in edges.flat_map(|part| [&mut part.from, &mut part.to]) {
                    *edge = edge.map(|edge| edge * units.output_per_rad);
                }
            }
            "target_torque_nm" => {
                let parts = aspect.parts.iter_mut();
                parts.for_each(|part| part.part = input(&part.part, units));
            }
            _ => {}
        }
    }
}

/// A torque as text, `25 Nm`, in the unit of the input.
fn input(torque: &str, units: &SignalUnits) -> String {
    let number = torque
        .strip_suffix(" Nm")
        .and_then(|number| number.parse::<f64>().ok());
    match number {
        Some(torque_nm) => format!("{} {}", torque_nm * units.input_per_nm, units.input),
        None => torque.to_owned(),
    }
}

/// The sizes of effects about the rig's own axis; `factors` learns by what each was multiplied.
fn about_own_axis(
    estimate: &mut Estimate,
    result: &CampaignResult,
    factors: &mut BTreeMap<String, f64>,
) {
    for parameter in &mut estimate.parameters {
        if !result
            .meanings
            .iter()
            .any(|told| told.name == parameter.name)
        {
            continue;
        }
        let (factor, unit) = result.vocabulary.about(&parameter.unit);
        parameter.value *= factor;
        parameter.standard_error = parameter.standard_error.map(|error| error * factor);
        parameter.interval = parameter.interval.map(|interval| interval.times(factor));
        parameter.unit = unit;
        factors.insert(parameter.name.clone(), factor);
    }
}

fn multiply(moments: &mut Moments, factor: f64) {
    moments.mean *= factor;
    moments.median *= factor;
    moments.standard_deviation = moments.standard_deviation.map(|one| one * factor);
    moments.mean_interval = (moments.mean_interval).map(|interval| interval.times(factor));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slide about a lever arm of 0.5 m.
    fn slide() -> SignalUnits {
        SignalUnits {
            input: "N".into(),
            input_per_nm: 2.0,
            output: "m".into(),
            output_per_rad: 0.5,
        }
    }

    fn missed_by(quantity: &str, unit: &str) -> Misfit {
        Misfit {
            quantity: quantity.into(),
            unit: unit.into(),
            rms: 0.2,
            largest: 0.6,
            fit_percent: None,
            relative_percent: None,
            over_noise: None,
        }
    }

    #[test]
    fn what_a_slide_is_missed_by_is_told_in_metres_and_forces_stay() {
        let mut speed = missed_by("velocity", "rad/s");
        misfit(&mut speed, &slide());
        assert_eq!((speed.rms, speed.largest), (0.1, 0.3));
        assert_eq!(speed.unit, "m/s");
        let mut force = missed_by("force", "N");
        misfit(&mut force, &slide());
        assert_eq!(force, missed_by("force", "N"));
    }

    #[test]
    fn a_torque_is_the_force_that_it_stands_for() {
        assert_eq!(input("-25 Nm", &slide()), "-50 N");
        assert_eq!(input("not stated", &slide()), "not stated");
    }
}
