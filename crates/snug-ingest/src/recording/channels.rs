//! Whether the channels that a study declares make a rig.

use crate::error::IngestError;
use crate::signal::Signal;
use crate::unit::Unit;

/// Checks a set of declared channels: units fit, one input and a motion are there, nothing is declared twice.
pub(crate) fn check(channels: &[(Signal, Unit, f64)]) -> Result<(), IngestError> {
    let refused = |value: String, allowed| IngestError::setting("channels", value, allowed);
    for (index, &(signal, unit, scale)) in channels.iter().enumerate() {
        if unit.factor(signal, 1.0).is_none() {
            let measures = |one: &Unit| one.factor(signal, 1.0).is_some();
            return Err(IngestError::UnitOfSignal {
                signal,
                unit,
                allowed: Unit::ALL.iter().copied().filter(measures).collect(),
            });
        }
        if !scale.is_finite() || scale == 0.0 {
            return Err(refused(
                format!("{signal:?} with scale {scale}"),
                "a finite scale other than 0",
            ));
        }
        if channels[..index].iter().any(|&(other, ..)| other == signal) {
            return Err(refused(
                format!("{signal:?} twice"),
                "every signal at most once",
            ));
        }
    }
    let declared = |wanted: fn(Signal) -> bool| {
        let signals = channels.iter().map(|&(signal, ..)| signal);
        signals.filter(|&signal| wanted(signal)).count()
    };
    if declared(Signal::is_input) != 1 || declared(|signal| signal.quantity().is_some()) == 0 {
        let present: Vec<String> = channels
            .iter()
            .map(|(signal, ..)| format!("{signal:?}"))
            .collect();
        return Err(refused(
            format!("[{}]", present.join(", ")),
            "one input (Torque, or Force for a linear rig) and at least one of Displacement, Velocity, Acceleration",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn channels_must_make_a_rig() {
        use Signal::{Displacement, Force, GripForce, Torque};
        let ok = |list: &[(Signal, Unit, f64)]| check(list).is_ok();
        let torque = (Torque, Unit::NewtonMetre, 1.0);
        let angle = (Displacement, Unit::Degree, -1.0);
        assert!(ok(&[torque, angle]));
        assert!(!ok(&[torque]), "no motion");
        assert!(!ok(&[angle, (GripForce, Unit::Newton, 1.0)]), "no input");
        assert!(!ok(&[torque, angle, angle]), "twice");
        let force = (Force, Unit::Newton, 1.0);
        assert!(ok(&[force, angle]) && ok(&[(Torque, Unit::Newton, 1.0), angle]));
        assert!(!ok(&[force, torque, angle]), "two inputs");
        let wrong = check(&[(Force, Unit::NewtonMetre, 1.0), angle]).unwrap_err();
        assert!(
            wrong.to_string().contains(
                "Force is in NewtonMetre; allowed: One, Volt, Ampere, Newton, Millinewton"
            ),
            "{wrong}"
        );
        assert!(!ok(&[(Torque, Unit::NewtonMetre, 0.0), angle]), "scale 0");
    }
}
