//! Units of columns and topics: one line each.

use crate::signal::Signal;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

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

/// Of each unit its name, what it measures, what a number in it is multiplied with to be in SI units, and how files write it.
macro_rules! units {
    ($($(#[$told:meta])+ $name:ident: ($dimension:ident, $factor:expr), [$($written:literal),*];)+) => {
        /// The unit of a column or topic. Lengths at the grip become angles by the rig's lever arm, θ = x/l, and forces that drive
        /// the rig torques, T = l F. So mass, damping and stiffness of a linear rig, whose known inertia is 0, are the same whatever its
        /// lever arm.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
        #[non_exhaustive]
        pub enum Unit {
            $($(#[$told])+ $name,)+
        }

        impl Unit {
            /// Every unit.
            pub const ALL: &'static [Self] = &[$(Self::$name),+];

            /// What it measures, and what a number in it is multiplied with to be in SI units.
            fn in_si(self) -> (Dimension, f64) {
                match self {
                    $(Self::$name => (Dimension::$dimension, $factor),)+
                }
            }

            /// How files write it: in small letters, unless a capital tells it from another.
            pub fn written(self) -> &'static [&'static str] {
                match self {
                    $(Self::$name => &[$($written),*],)+
                }
            }
        }
    };
}

units! {
    /// A pure number that stands for the signal in SI units (Nm, rad, rad/s, rad/s²; N for forces) 1:1.
    One: (Any, 1.0), [];
    /// V, a voltage that stands for the signal as a pure number does.
    Volt: (Any, 1.0), ["v", "volt", "volts"];
    /// A, a current that stands for the signal as a pure number does.
    Ampere: (Any, 1.0), ["a", "amp", "ampere"];
    /// N m
    NewtonMetre: (Torque, 1.0), ["nm", "n·m", "n*m", "n m", "n.m"];
    /// N cm = 0.01 N m
    NewtonCentimetre: (Torque, 0.01), ["ncm"];
    /// N mm = 0.001 N m
    NewtonMillimetre: (Torque, 0.001), ["nmm", "n mm", "n·mm"];
    /// mN m = 0.001 N m
    MillinewtonMetre: (Torque, 0.001), ["mnm"];
    /// µN m = 10⁻⁶ N m
    MicronewtonMetre: (Torque, 1e-6), ["unm", "µnm", "μnm"];
    /// kN m = 1000 N m
    KilonewtonMetre: (Torque, 1000.0), ["knm"];
    /// kgf m = 9.806 65 N m
    KilogramForceMetre: (Torque, KILOGRAM_FORCE_N), ["kgfm", "kgf m", "kgf·m", "kgm"];
    /// kgf cm = 0.098 066 5 N m
    KilogramForceCentimetre: (Torque, KILOGRAM_FORCE_N * 0.01), ["kgfcm", "kgf cm", "kgf·cm", "kgcm"];
    /// lbf in = 0.112 984 829 N m
    PoundForceInch: (Torque, POUND_FORCE_N * INCH_M), ["lbfin", "lbf in", "lbf·in", "in-lb", "inlb", "in lb", "lb-in"];
    /// lbf ft = 1.355 817 948 N m
    PoundForceFoot: (Torque, POUND_FORCE_N * FOOT_M), ["lbfft", "lbf ft", "lbf·ft", "ft-lb", "ftlb", "ft lb", "lb-ft"];
    /// ozf in = 0.007 061 552 N m
    OunceForceInch: (Torque, POUND_FORCE_N / 16.0 * INCH_M), ["ozfin", "ozf in", "ozf·in", "oz-in", "ozin"];
    /// rad
    Radian: (Angle, 1.0), ["rad"];
    /// mrad = 0.001 rad
    Milliradian: (Angle, 0.001), ["mrad"];
    /// ° = π/180 rad
    Degree: (Angle, PI / 180.0), ["deg", "°", "degree", "degrees", "grad"];
    /// Full turns, 2π rad
    Revolution: (Angle, 2.0 * PI), ["rev", "turns", "u"];
    /// m
    Metre: (Length, 1.0), ["m"];
    /// cm = 0.01 m
    Centimetre: (Length, 0.01), ["cm"];
    /// mm = 0.001 m
    Millimetre: (Length, 0.001), ["mm"];
    /// µm = 0.000 001 m
    Micrometre: (Length, 1e-6), ["um", "µm", "μm"];
    /// nm = 10⁻⁹ m
    Nanometre: (Length, 1e-9), ["nm"];
    /// in = 0.0254 m
    Inch: (Length, INCH_M), ["in", "inch", "\""];
    /// ft = 0.3048 m
    Foot: (Length, FOOT_M), ["ft", "feet"];
    /// rad/s
    RadianPerSecond: (AngularVelocity, 1.0), ["rad/s", "rad s^-1", "rad*s^-1"];
    /// mrad/s
    MilliradianPerSecond: (AngularVelocity, 0.001), ["mrad/s"];
    /// °/s
    DegreePerSecond: (AngularVelocity, PI / 180.0), ["deg/s", "°/s"];
    /// 1/s = 2π rad/s
    RevolutionPerSecond: (AngularVelocity, 2.0 * PI), ["rps", "rev/s"];
    /// 1/min = 2π/60 rad/s
    RevolutionPerMinute: (AngularVelocity, 2.0 * PI / 60.0), ["rpm", "1/min", "min^-1", "u/min", "rev/min", "r/min"];
    /// m/s
    MetrePerSecond: (Velocity, 1.0), ["m/s"];
    /// cm/s
    CentimetrePerSecond: (Velocity, 0.01), ["cm/s"];
    /// mm/s
    MillimetrePerSecond: (Velocity, 0.001), ["mm/s"];
    /// µm/s
    MicrometrePerSecond: (Velocity, 1e-6), ["um/s", "µm/s", "μm/s"];
    /// m/min
    MetrePerMinute: (Velocity, 1.0 / 60.0), ["m/min"];
    /// km/h
    KilometrePerHour: (Velocity, 1.0 / 3.6), ["km/h", "kmh", "kph"];
    /// in/s = 0.0254 m/s
    InchPerSecond: (Velocity, INCH_M), ["in/s", "ips"];
    /// ft/s = 0.3048 m/s
    FootPerSecond: (Velocity, FOOT_M), ["ft/s", "fps"];
    /// rad/s²
    RadianPerSecondSquared: (AngularAcceleration, 1.0), ["rad/s^2", "rad/s2", "rad/s²"];
    /// °/s²
    DegreePerSecondSquared: (AngularAcceleration, PI / 180.0), ["deg/s^2", "deg/s2", "deg/s²", "°/s²", "°/s^2"];
    /// 1/s² = 2π rad/s²
    RevolutionPerSecondSquared: (AngularAcceleration, 2.0 * PI), ["rev/s^2", "rev/s2", "rev/s²"];
    /// m/s²
    MetrePerSecondSquared: (Acceleration, 1.0), ["m/s^2", "m/s2", "m/s²"];
    /// mm/s²
    MillimetrePerSecondSquared: (Acceleration, 0.001), ["mm/s^2", "mm/s2", "mm/s²"];
    /// ft/s² = 0.3048 m/s²
    FootPerSecondSquared: (Acceleration, FOOT_M), ["ft/s^2", "ft/s2", "ft/s²"];
    /// g = 9.806 65 m/s²
    StandardGravity: (Acceleration, STANDARD_GRAVITY_M_PER_S2), ["g"];
    /// mg = 0.009 806 65 m/s²
    MilliStandardGravity: (Acceleration, STANDARD_GRAVITY_M_PER_S2 * 0.001), ["mg"];
    /// N
    Newton: (Force, 1.0), ["n"];
    /// mN = 0.001 N
    Millinewton: (Force, 0.001), ["mn"];
    /// µN = 10⁻⁶ N
    Micronewton: (Force, 1e-6), ["un", "µn", "μn"];
    /// kN = 1000 N
    Kilonewton: (Force, 1000.0), ["kn"];
    /// MN = 10⁶ N
    Meganewton: (Force, 1e6), ["MN"];
    /// kgf = 9.806 65 N
    KilogramForce: (Force, KILOGRAM_FORCE_N), ["kgf", "kp"];
    /// lbf = 4.448 221 615 N
    PoundForce: (Force, POUND_FORCE_N), ["lbf", "lb"];
}

impl Unit {
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
            (Unit::Micronewton, Signal::Force, 1e-6),
            (Unit::Meganewton, Signal::Force, 1e6),
            (Unit::Nanometre, Signal::Displacement, 1e-9),
            (Unit::MicrometrePerSecond, Signal::Velocity, 1e-6),
            (Unit::MicronewtonMetre, Signal::Torque, 1e-6),
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
        assert_eq!(
            Unit::ALL
                .iter()
                .map(|unit| format!("{unit:?}"))
                .collect::<Vec<_>>(),
            expected
        );
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

    /// What is written twice would be read as whichever stands first.
    #[test]
    fn no_two_units_of_a_signal_are_written_alike() {
        let all = [
            Signal::Torque,
            Signal::Force,
            Signal::Displacement,
            Signal::Velocity,
            Signal::Acceleration,
        ];
        for signal in all {
            let measure = |unit: &&Unit| unit.factor(signal, 1.0).is_some();
            let mut written: Vec<&str> = (Unit::ALL.iter().filter(measure))
                .flat_map(|unit| unit.written())
                .copied()
                .collect();
            written.sort_unstable();
            assert!(
                written.windows(2).all(|pair| pair[0] != pair[1]),
                "{signal:?}: {written:?}"
            );
        }
    }
}
