//! What a column or topic measures, and in which unit.

use crate::IngestError;
use serde::{Deserialize, Serialize};
use snug_campaign::Quantity;
use std::f64::consts::PI;

/// A measured quantity of a one-degree-of-freedom rig.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Signal {
    /// Input: torque about the joint.
    Torque,
    /// Angle of the tool, or displacement x = l θ of the grip.
    Displacement,
    /// Angular velocity of the tool, or velocity of the grip.
    Velocity,
    /// Angular acceleration of the tool, or acceleration of the grip.
    Acceleration,
    /// Force between tool and hand.
    GripForce,
}

impl Signal {
    /// Its name in messages.
    pub(crate) fn in_words(self) -> String {
        format!("{self:?}").to_lowercase()
    }

    /// The motion it belongs to; `None` for torque and force.
    pub fn quantity(self) -> Option<Quantity> {
        match self {
            Self::Displacement => Some(Quantity::Displacement),
            Self::Velocity => Some(Quantity::Velocity),
            Self::Acceleration => Some(Quantity::Acceleration),
            Self::Torque | Self::GripForce => None,
        }
    }
}

/// The unit of a column or topic. Lengths of the grip become angles by the rig's lever arm, θ = x/l.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Unit {
    /// A pure number that stands for the signal in SI units about the joint (Nm, rad, rad/s, rad/s², N) 1:1.
    One,
    /// V, a voltage that stands for the signal in SI units about the joint 1:1.
    Volt,
    /// N m
    NewtonMetre,
    /// N cm = 0.01 N m
    NewtonCentimetre,
    /// N mm = 0.001 N m
    NewtonMillimetre,
    /// kN m = 1000 N m
    KilonewtonMetre,
    /// lbf in = 0.112 984 829 N m
    PoundForceInch,
    /// lbf ft = 1.355 817 948 N m
    PoundForceFoot,
    /// rad
    Radian,
    /// mrad = 0.001 rad
    Milliradian,
    /// ° = π/180 rad
    Degree,
    /// Full turns, 2π rad
    Revolution,
    /// m
    Metre,
    /// cm = 0.01 m
    Centimetre,
    /// mm = 0.001 m
    Millimetre,
    /// rad/s
    RadianPerSecond,
    /// °/s
    DegreePerSecond,
    /// 1/min = 2π/60 rad/s
    RevolutionPerMinute,
    /// m/s
    MetrePerSecond,
    /// mm/s
    MillimetrePerSecond,
    /// rad/s²
    RadianPerSecondSquared,
    /// °/s²
    DegreePerSecondSquared,
    /// m/s²
    MetrePerSecondSquared,
    /// g = 9.806 65 m/s²
    StandardGravity,
    /// N
    Newton,
    /// kN = 1000 N
    Kilonewton,
    /// lbf = 4.448 221 615 N
    PoundForce,
}

/// lbf in N (exact: 0.453 592 37 kg · 9.806 65 m/s²).
const POUND_FORCE_N: f64 = 0.453_592_37 * STANDARD_GRAVITY_M_PER_S2;
/// g in m/s² (exact).
const STANDARD_GRAVITY_M_PER_S2: f64 = 9.806_65;
/// Inch in m (exact).
const INCH_M: f64 = 0.0254;

impl Unit {
    /// Every unit.
    pub const ALL: [Self; 27] = [
        Self::One,
        Self::Volt,
        Self::NewtonMetre,
        Self::NewtonCentimetre,
        Self::NewtonMillimetre,
        Self::KilonewtonMetre,
        Self::PoundForceInch,
        Self::PoundForceFoot,
        Self::Radian,
        Self::Milliradian,
        Self::Degree,
        Self::Revolution,
        Self::Metre,
        Self::Centimetre,
        Self::Millimetre,
        Self::RadianPerSecond,
        Self::DegreePerSecond,
        Self::RevolutionPerMinute,
        Self::MetrePerSecond,
        Self::MillimetrePerSecond,
        Self::RadianPerSecondSquared,
        Self::DegreePerSecondSquared,
        Self::MetrePerSecondSquared,
        Self::StandardGravity,
        Self::Newton,
        Self::Kilonewton,
        Self::PoundForce,
    ];

    /// What a number in this unit is multiplied with to give `signal` in SI units about the joint; `None` where the unit
    /// does not measure that signal.
    ///
    /// ```
    /// use snug_ingest::{Signal, Unit};
    ///
    /// // 33 mm at the end of a lever of 0.330 m are 0.1 rad.
    /// let factor = Unit::Millimetre.factor(Signal::Displacement, 0.330).expect("a length is a displacement");
    /// assert!((33.0 * factor - 0.1).abs() < 1e-15);
    /// assert!(Unit::Newton.factor(Signal::Torque, 0.330).is_none());
    /// ```
    pub fn factor(self, signal: Signal, lever_arm_m: f64) -> Option<f64> {
        use Signal::{Acceleration, Displacement, GripForce, Torque, Velocity};
        let (measures, factor, length) = match self {
            Self::One | Self::Volt => (signal, 1.0, false),
            Self::NewtonMetre => (Torque, 1.0, false),
            Self::NewtonCentimetre => (Torque, 0.01, false),
            Self::NewtonMillimetre => (Torque, 0.001, false),
            Self::KilonewtonMetre => (Torque, 1000.0, false),
            Self::PoundForceInch => (Torque, POUND_FORCE_N * INCH_M, false),
            Self::PoundForceFoot => (Torque, POUND_FORCE_N * 12.0 * INCH_M, false),
            Self::Radian => (Displacement, 1.0, false),
            Self::Milliradian => (Displacement, 0.001, false),
            Self::Degree => (Displacement, PI / 180.0, false),
            Self::Revolution => (Displacement, 2.0 * PI, false),
            Self::Metre => (Displacement, 1.0, true),
            Self::Centimetre => (Displacement, 0.01, true),
            Self::Millimetre => (Displacement, 0.001, true),
            Self::RadianPerSecond => (Velocity, 1.0, false),
            Self::DegreePerSecond => (Velocity, PI / 180.0, false),
            Self::RevolutionPerMinute => (Velocity, 2.0 * PI / 60.0, false),
            Self::MetrePerSecond => (Velocity, 1.0, true),
            Self::MillimetrePerSecond => (Velocity, 0.001, true),
            Self::RadianPerSecondSquared => (Acceleration, 1.0, false),
            Self::DegreePerSecondSquared => (Acceleration, PI / 180.0, false),
            Self::MetrePerSecondSquared => (Acceleration, 1.0, true),
            Self::StandardGravity => (Acceleration, STANDARD_GRAVITY_M_PER_S2, true),
            Self::Newton => (GripForce, 1.0, false),
            Self::Kilonewton => (GripForce, 1000.0, false),
            Self::PoundForce => (GripForce, POUND_FORCE_N, false),
        };
        let per_length = if length { 1.0 / lever_arm_m } else { 1.0 };
        (measures == signal).then_some(factor * per_length)
    }
}

/// The default of a channel's factor.
pub(crate) fn as_it_is() -> f64 {
    1.0
}

/// Checks a set of declared channels: units fit, torque and a motion are there, nothing is declared twice.
pub(crate) fn check(channels: &[(Signal, Unit, f64)]) -> Result<(), IngestError> {
    let refused = |value: String, allowed| IngestError::setting("channels", value, allowed);
    for (index, &(signal, unit, scale)) in channels.iter().enumerate() {
        if unit.factor(signal, 1.0).is_none() {
            let measures = |one: &Unit| one.factor(signal, 1.0).is_some();
            return Err(IngestError::UnitOfSignal {
                signal,
                unit,
                allowed: Unit::ALL.into_iter().filter(measures).collect(),
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
    let declared = |wanted: fn(Signal) -> bool| channels.iter().any(|&(signal, ..)| wanted(signal));
    if !declared(|signal| signal == Signal::Torque)
        || !declared(|signal| signal.quantity().is_some())
    {
        let present: Vec<String> = channels
            .iter()
            .map(|(signal, ..)| format!("{signal:?}"))
            .collect();
        return Err(refused(
            format!("[{}]", present.join(", ")),
            "Torque (the input) and at least one of Displacement, Velocity, Acceleration",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn conversions_agree_with_published_factors() {
        // NIST SP 811, appendix B.8, to its seven digits.
        for (unit, signal, factor) in [
            (Unit::PoundForceInch, Signal::Torque, 1.129_848e-1),
            (Unit::PoundForceFoot, Signal::Torque, 1.355_818),
            (Unit::PoundForce, Signal::GripForce, 4.448_222),
            (Unit::Degree, Signal::Displacement, 1.745_329e-2),
            (Unit::RevolutionPerMinute, Signal::Velocity, 1.047_198e-1),
            (Unit::StandardGravity, Signal::Acceleration, 9.806_65),
        ] {
            let found = unit.factor(signal, 1.0).unwrap();
            assert!((found / factor - 1.0).abs() < 5e-7, "{unit:?}: {found}");
        }
    }

    #[test]
    fn no_unit_is_left_out_of_the_list() {
        let read: Result<Unit, _> = ron::from_str("Furlong");
        let Err(ron::error::SpannedError {
            code: ron::Error::NoSuchEnumVariant { expected, .. },
            ..
        }) = read
        else {
            panic!("{read:?}");
        };
        assert_eq!(Unit::ALL.map(|unit| format!("{unit:?}")), expected);
    }

    #[test]
    fn lengths_become_angles_by_the_lever_arm() {
        assert_eq!(Unit::Metre.factor(Signal::Displacement, 0.5), Some(2.0));
        assert_eq!(
            Unit::MetrePerSecondSquared.factor(Signal::Acceleration, 0.25),
            Some(4.0)
        );
        assert_eq!(Unit::Radian.factor(Signal::Displacement, 0.25), Some(1.0));
    }

    #[test]
    fn channels_must_make_a_rig() {
        use Signal::{Displacement, GripForce, Torque};
        let ok = |list: &[(Signal, Unit, f64)]| check(list).is_ok();
        let torque = (Torque, Unit::NewtonMetre, 1.0);
        let angle = (Displacement, Unit::Degree, -1.0);
        assert!(ok(&[torque, angle]));
        assert!(!ok(&[torque]), "no motion");
        assert!(!ok(&[angle, (GripForce, Unit::Newton, 1.0)]), "no input");
        assert!(!ok(&[torque, angle, angle]), "twice");
        let wrong = check(&[(Torque, Unit::Newton, 1.0), angle]).unwrap_err();
        assert!(
            wrong
                .to_string()
                .contains("Torque is in Newton; allowed: One, Volt, NewtonMetre")
        );
        assert!(!ok(&[(Torque, Unit::NewtonMetre, 0.0), angle]), "scale 0");
    }
}
