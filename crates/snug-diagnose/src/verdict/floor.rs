//! The plain regression is the floor: a simulated fit whose numbers explain far less of the measured acceleration than a regression
//! of the equation of motion does is a failed fit, and no physics.

use crate::data::cases::Cases;
use crate::data::power::bent_power;
use crate::pooled::equation::{PlainEquation, falls_short, named, values};
use crate::pooled::fitted::Fitted;
use crate::verdict::earned::share;
use crate::verdict::thresholds::PLAIN_PROMISE;
use snug_campaign::words::suspicion::FailedFit;
use snug_identify::EquationFit;

/// What is wrong with `fitted`, if it falls short of the `plain` regression with its own effects or, where candidates were tried as well,
/// of one with dry friction and an offset.
pub(crate) fn shortfall(
    plain: &PlainEquation<'_>,
    cases: Cases<'_>,
    fitted: &Fitted,
    were_tried: bool,
) -> Option<FailedFit> {
    if fitted.is_weighted {
        return None;
    }
    let at = values(cases, fitted)?;
    let kept = plain.equation.explained_by(&fitted.effects, &at)?;
    let own = plain.as_fitted(&fitted.effects, &at);
    let plainly = || plain.plainly(&fitted.effects, &at);
    let further = were_tried.then(plainly).flatten();
    for (with, found) in [("own effects", &own), ("friction and offset", &further)] {
        if let Some(found) = found {
            tracing::debug!(
                with,
                promised = found.explained,
                kept,
                by_torque = found.by_torque,
                half_width = plain.equation.half_width,
                "plain regression"
            );
        }
    }
    let effects: Vec<String> = fitted
        .effects
        .iter()
        .map(|one| one.name().to_owned())
        .collect();
    let told = |found: EquationFit, is_plain: bool| FailedFit {
        effects: effects.clone(),
        is_plain,
        promised: found.explained,
        kept,
        sizes: named(&found.base),
    };
    // A fit that explains as much of the output itself keeps the promise: high up, an acceleration is the coarseness of a logged angle; low
    // down, where force and spring all but cancel, hardly one is left.
    let of_output = match cases.are_restarted() {
        true => share_of_bend(cases, fitted),
        false => share(&cases, fitted),
    };
    let keeps = |found: &EquationFit| {
        of_output.is_some_and(|share| !falls_short(share, found, PLAIN_PROMISE))
    };
    let fails = |found: &EquationFit| !keeps(found) && falls_short(kept, found, PLAIN_PROMISE);
    let own = own.filter(fails).map(|found| told(found, false));
    own.or_else(|| further.filter(fails).map(|found| told(found, true)))
}

/// Share that a restarted model explains of what bends the motion from one restart to the next \[–\]: of all of it, any model explains nearly
/// everything. `None` where it cannot be simulated.
fn share_of_bend(cases: Cases<'_>, fitted: &Fitted) -> Option<f64> {
    let (mut whole, mut left) = (0.0, 0.0);
    for (case, simulated) in cases.iter().zip(fitted.simulated(cases)?) {
        whole += bent_power(case, case.measured());
        left += bent_power(case, &case.missed(&simulated));
    }
    Some(1.0 - left / whole).filter(|share| !share.is_nan())
}

#[cfg(test)]
mod tests;
