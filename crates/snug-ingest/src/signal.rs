//! What a column or topic measures, and in which unit.

use serde::{Deserialize, Serialize};
use snug_campaign::Quantity;
use std::f64::consts::PI;

/// A measured quantity of a one-degree-of-freedom rig.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Signal {
    /// Input: torque about the joint. Given in units of force, it acts at the grip, through the lever arm: T = l F.
    Torque,
    /// Angle of the tool, or displacement x = l θ of the grip.
    Displacement,
    /// Angular velocity of the tool, or velocity of the grip.
    Velocity,
    /// Angular acceleration of the tool, or acceleration of the grip.
    Acceleration,
    /// Force between tool and hand.
    GripForce,
    /// Input of a linear rig: force at the grip along its motion, T = l F.
    Force,
}

impl Signal {
    /// Its name in messages.
    pub(crate) fn in_words(self) -> String {
        format!("{self:?}").to_lowercase()
    }

    /// Whether it drives the rig; a rig has one input.
    pub fn is_input(self) -> bool {
        matches!(self, Self::Torque | Self::Force)
    }

    /// The motion it belongs to; `None` for torque and forces.
    pub fn quantity(self) -> Option<Quantity> {
        match self {
            Self::Displacement => Some(Quantity::Displacement),
            Self::Velocity => Some(Quantity::Velocity),
            Self::Acceleration => Some(Quantity::Acceleration),
            Self::Torque | Self::GripForce | Self::Force => None,
        }
    }
}

/// The unit of a column or topic. Lengths at the grip become angles by the rig's lever arm, θ = x/l, and forces that drive
/// the rig torques, T = l F. So mass, damping and stiffness of a linear rig, whose known inertia is 0, are the same whatever its
/// lever arm.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Unit {
    /// A pure number that stands for the signal in SI units (Nm, rad, rad/s, rad/s²; N for forces) 1:1.
    One,
    /// V, a voltage that stands for the signal as a pure number does.
    Volt,
    /// A, a current that stands for the signal as a pure number does.
    Ampere,
    /// N m
    NewtonMetre,
    /// N cm = 0.01 N m
    NewtonCentimetre,
    /// N mm = 0.001 N m
    NewtonMillimetre,
    /// mN m = 0.001 N m
    MillinewtonMetre,
    /// kN m = 1000 N m
    KilonewtonMetre,
    /// kgf m = 9.806 65 N m
    KilogramForceMetre,
    /// kgf cm = 0.098 066 5 N m
    KilogramForceCentimetre,
    /// lbf in = 0.112 984 829 N m
    PoundForceInch,
    /// lbf ft = 1.355 817 948 N m
    PoundForceFoot,
    /// ozf in = 0.007 061 552 N m
    OunceForceInch,
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
    /// µm = 0.000 001 m
    Micrometre,
    /// in = 0.0254 m
    Inch,
    /// ft = 0.3048 m
    Foot,
    /// rad/s
    RadianPerSecond,
    /// mrad/s
    MilliradianPerSecond,
    /// °/s
    DegreePerSecond,
    /// 1/s = 2π rad/s
    RevolutionPerSecond,
    /// 1/min = 2π/60 rad/s
    RevolutionPerMinute,
    /// m/s
    MetrePerSecond,
    /// cm/s
    CentimetrePerSecond,
    /// mm/s
    MillimetrePerSecond,
    /// m/min
    MetrePerMinute,
    /// km/h
    KilometrePerHour,
    /// in/s = 0.0254 m/s
    InchPerSecond,
    /// ft/s = 0.3048 m/s
    FootPerSecond,
    /// rad/s²
    RadianPerSecondSquared,
    /// °/s²
    DegreePerSecondSquared,
    /// 1/s² = 2π rad/s²
    RevolutionPerSecondSquared,
    /// m/s²
    MetrePerSecondSquared,
    /// mm/s²
    MillimetrePerSecondSquared,
    /// ft/s² = 0.3048 m/s²
    FootPerSecondSquared,
    /// g = 9.806 65 m/s²
    StandardGravity,
    /// mg = 0.009 806 65 m/s²
    MilliStandardGravity,
    /// N
    Newton,
    /// mN = 0.001 N
    Millinewton,
    /// kN = 1000 N
    Kilonewton,
    /// kgf = 9.806 65 N
    KilogramForce,
    /// lbf = 4.448 221 615 N
    PoundForce,
}

/// What a unit measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Dimension {
    /// Whatever it is declared as.
    Any,
    Torque,
    Force,
    Angle,
    Length,
    AngularVelocity,
    Velocity,
    AngularAcceleration,
    Acceleration,
}

impl Dimension {
    /// By how many powers of the lever arm a number in SI units is multiplied to give `signal` about the joint; `None`
    /// where it does not measure that signal.
    fn lever_arms(self, signal: Signal) -> Option<i32> {
        match (self, signal) {
            (Self::Any | Self::Force, Signal::Force) | (Self::Force, Signal::Torque) => Some(1),
            (Self::Any, _)
            | (Self::Torque, Signal::Torque)
            | (Self::Force, Signal::GripForce)
            | (Self::Angle, Signal::Displacement)
            | (Self::AngularVelocity, Signal::Velocity)
            | (Self::AngularAcceleration, Signal::Acceleration) => Some(0),
            (Self::Length, Signal::Displacement)
            | (Self::Velocity, Signal::Velocity)
            | (Self::Acceleration, Signal::Acceleration) => Some(-1),
            _ => None,
        }
    }
}

/// kgf in N (exact).
const KILOGRAM_FORCE_N: f64 = STANDARD_GRAVITY_M_PER_S2;
/// lbf in N (exact: 0.453 592 37 kg · 9.806 65 m/s²).
const POUND_FORCE_N: f64 = 0.453_592_37 * STANDARD_GRAVITY_M_PER_S2;
/// g in m/s² (exact).
const STANDARD_GRAVITY_M_PER_S2: f64 = 9.806_65;
/// Inch in m (exact).
const INCH_M: f64 = 0.0254;
/// Foot in m (exact).
const FOOT_M: f64 = 12.0 * INCH_M;

impl Unit {
    /// Every unit.
    pub const ALL: [Self; 48] = [
        Self::One,
        Self::Volt,
        Self::Ampere,
        Self::NewtonMetre,
        Self::NewtonCentimetre,
        Self::NewtonMillimetre,
        Self::MillinewtonMetre,
        Self::KilonewtonMetre,
        Self::KilogramForceMetre,
        Self::KilogramForceCentimetre,
        Self::PoundForceInch,
        Self::PoundForceFoot,
        Self::OunceForceInch,
        Self::Radian,
        Self::Milliradian,
        Self::Degree,
        Self::Revolution,
        Self::Metre,
        Self::Centimetre,
        Self::Millimetre,
        Self::Micrometre,
        Self::Inch,
        Self::Foot,
        Self::RadianPerSecond,
        Self::MilliradianPerSecond,
        Self::DegreePerSecond,
        Self::RevolutionPerSecond,
        Self::RevolutionPerMinute,
        Self::MetrePerSecond,
        Self::CentimetrePerSecond,
        Self::MillimetrePerSecond,
        Self::MetrePerMinute,
        Self::KilometrePerHour,
        Self::InchPerSecond,
        Self::FootPerSecond,
        Self::RadianPerSecondSquared,
        Self::DegreePerSecondSquared,
        Self::RevolutionPerSecondSquared,
        Self::MetrePerSecondSquared,
        Self::MillimetrePerSecondSquared,
        Self::FootPerSecondSquared,
        Self::StandardGravity,
        Self::MilliStandardGravity,
        Self::Newton,
        Self::Millinewton,
        Self::Kilonewton,
        Self::KilogramForce,
        Self::PoundForce,
    ];

    /// What a number in this unit is multiplied with to give `signal` in SI units about the joint; `None` where the unit
    /// does not measure that signal.
    ///
    /// ```
    /// use snug_ingest::{Signal, Unit};
    ///
    /// // 33 mm at the end of a lever of 0.330 m are 0.1 rad, and 10 N there 3.3 Nm.
    /// let factor = Unit::Millimetre.factor(Signal::Displacement, 0.330).expect("a length is a displacement");
    /// assert!((33.0 * factor - 0.1).abs() < 1e-15);
    /// assert_eq!(Unit::Newton.factor(Signal::Force, 0.330), Some(0.330));
    /// assert!(Unit::NewtonMetre.factor(Signal::Force, 0.330).is_none());
    /// ```
    pub fn factor(self, signal: Signal, lever_arm_m: f64) -> Option<f64> {
        let (dimension, factor) = self.in_si();
        Some(match dimension.lever_arms(signal)? {
            1 => factor * lever_arm_m,
            -1 => factor * (1.0 / lever_arm_m),
            _ => factor,
        })
    }

    /// Whether it is a length at the grip, or one of its derivatives.
    pub(crate) fn is_length(self) -> bool {
        use Dimension::{Acceleration, Length, Velocity};
        matches!(self.in_si().0, Length | Velocity | Acceleration)
    }

    /// What it measures, and what a number in it is multiplied with to be in SI units.
    fn in_si(self) -> (Dimension, f64) {
        use Dimension::{
            Acceleration, Angle, AngularAcceleration, AngularVelocity, Any, Force, Length, Torque,
            Velocity,
        };
        match self {
            Self::One | Self::Volt | Self::Ampere => (Any, 1.0),
            Self::NewtonMetre => (Torque, 1.0),
            Self::NewtonCentimetre => (Torque, 0.01),
            Self::NewtonMillimetre => (Torque, 0.001),
            Self::MillinewtonMetre => (Torque, 0.001),
            Self::KilonewtonMetre => (Torque, 1000.0),
            Self::KilogramForceMetre => (Torque, KILOGRAM_FORCE_N),
            Self::KilogramForceCentimetre => (Torque, KILOGRAM_FORCE_N * 0.01),
            Self::PoundForceInch => (Torque, POUND_FORCE_N * INCH_M),
            Self::PoundForceFoot => (Torque, POUND_FORCE_N * FOOT_M),
            Self::OunceForceInch => (Torque, POUND_FORCE_N / 16.0 * INCH_M),
            Self::Radian => (Angle, 1.0),
            Self::Milliradian => (Angle, 0.001),
            Self::Degree => (Angle, PI / 180.0),
            Self::Revolution => (Angle, 2.0 * PI),
            Self::Metre => (Length, 1.0),
            Self::Centimetre => (Length, 0.01),
            Self::Millimetre => (Length, 0.001),
            Self::Micrometre => (Length, 1e-6),
            Self::Inch => (Length, INCH_M),
            Self::Foot => (Length, FOOT_M),
            Self::RadianPerSecond => (AngularVelocity, 1.0),
            Self::MilliradianPerSecond => (AngularVelocity, 0.001),
            Self::DegreePerSecond => (AngularVelocity, PI / 180.0),
            Self::RevolutionPerSecond => (AngularVelocity, 2.0 * PI),
            Self::RevolutionPerMinute => (AngularVelocity, 2.0 * PI / 60.0),
            Self::MetrePerSecond => (Velocity, 1.0),
            Self::CentimetrePerSecond => (Velocity, 0.01),
            Self::MillimetrePerSecond => (Velocity, 0.001),
            Self::MetrePerMinute => (Velocity, 1.0 / 60.0),
            Self::KilometrePerHour => (Velocity, 1.0 / 3.6),
            Self::InchPerSecond => (Velocity, INCH_M),
            Self::FootPerSecond => (Velocity, FOOT_M),
            Self::RadianPerSecondSquared => (AngularAcceleration, 1.0),
            Self::DegreePerSecondSquared => (AngularAcceleration, PI / 180.0),
            Self::RevolutionPerSecondSquared => (AngularAcceleration, 2.0 * PI),
            Self::MetrePerSecondSquared => (Acceleration, 1.0),
            Self::MillimetrePerSecondSquared => (Acceleration, 0.001),
            Self::FootPerSecondSquared => (Acceleration, FOOT_M),
            Self::StandardGravity => (Acceleration, STANDARD_GRAVITY_M_PER_S2),
            Self::MilliStandardGravity => (Acceleration, STANDARD_GRAVITY_M_PER_S2 * 0.001),
            Self::Newton => (Force, 1.0),
            Self::Millinewton => (Force, 0.001),
            Self::Kilonewton => (Force, 1000.0),
            Self::KilogramForce => (Force, KILOGRAM_FORCE_N),
            Self::PoundForce => (Force, POUND_FORCE_N),
        }
    }
}

/// The default of a channel's factor.
pub(crate) fn as_it_is() -> f64 {
    1.0
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
            (Unit::OunceForceInch, Signal::Torque, 7.061_552e-3),
            (Unit::KilogramForceCentimetre, Signal::Torque, 9.806_65e-2),
            (Unit::KilogramForce, Signal::Force, 9.806_65),
            (Unit::Foot, Signal::Displacement, 3.048e-1),
            (Unit::KilometrePerHour, Signal::Velocity, 2.777_778e-1),
            (Unit::InchPerSecond, Signal::Velocity, 2.54e-2),
            (Unit::FootPerSecondSquared, Signal::Acceleration, 3.048e-1),
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
    fn forces_that_drive_become_torques_by_the_lever_arm() {
        for (unit, signal, expected) in [
            (Unit::Newton, Signal::Force, Some(0.5)),
            (Unit::Newton, Signal::Torque, Some(0.5)),
            (Unit::Kilonewton, Signal::Force, Some(500.0)),
            (Unit::Volt, Signal::Force, Some(0.5)),
            (Unit::Ampere, Signal::Torque, Some(1.0)),
            (Unit::Newton, Signal::GripForce, Some(1.0)),
            (Unit::NewtonMetre, Signal::Force, None),
            (Unit::Newton, Signal::Displacement, None),
            (Unit::NewtonMetre, Signal::GripForce, None),
        ] {
            assert_eq!(unit.factor(signal, 0.5), expected, "{unit:?} {signal:?}");
        }
    }
}
