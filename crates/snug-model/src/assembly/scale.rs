//! Starts and bounds of effects on rigs that are no hand on a tool, by what their units make of torque, angle and time.

use crate::description::{OUTPUT_UNIT, OUTPUT_UNIT_PER_SECOND, ParameterSpec};
use crate::law::Corner;
use serde::{Deserialize, Serialize};
use snug_campaign::Rig;

/// How large torques, angles and times are on a rig: starts and bounds of the catalogue's effects follow.
///
/// The catalogue's numbers are meant for a hand on a tool. On another rig each is multiplied by what the scales of its
/// unit make of it (a stiffness in N/m by force over length), and bounds are ten times wider, since nobody has looked at
/// such a rig before.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum Scale {
    /// As the data show it where the window is `Whole`, otherwise as for a hand on a tool.
    #[default]
    Automatic,
    /// The catalogue's own numbers.
    HandOnTool,
    /// Typical sizes on this rig, root mean square.
    Rig {
        /// Torque \[Nm\].
        torque_nm: f64,
        /// Angle about its mean \[rad\].
        angle_rad: f64,
        /// Angle over angular velocity \[s\].
        time_s: f64,
    },
}

/// What the catalogue's numbers were chosen for: pulses of some 30 Nm, a hand that gives way by a centimetre or two.
const HAND_TORQUE_NM: f64 = 10.0;
const HAND_ANGLE_RAD: f64 = 0.03;
const HAND_TIME_S: f64 = 0.04;
const HAND_LEVER_ARM_M: f64 = 0.33;

/// Least length over which a contact sets in \[m\], and time over which it does \[s\]: of a hand's play, at some 10 kHz a quarter of
/// a sample.
const HAND_CORNER_M: f64 = 1e-6;
const HAND_CORNER_S: f64 = 2.5e-5;

/// How much wider bounds are on a rig that the catalogue was not made for.
pub(crate) const WIDER: f64 = 10.0;
/// How much wider still those of the size of a force that grows with the motion are \[–\]: the typical torque is what drives a rig, and near
/// resonance, or after the blow of a hammer, a spring pulls as much harder than that as it rings longer. Chosen: of some 500 periods. Not of
/// a force that has an amplitude: a weight of 360 Nm stood in for a spring that stiffens, against a spring of as much.
const RINGING: f64 = 1000.0;

/// Starts and bounds of one parameter on one rig, in the parameter's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct PlausibleRange {
    /// Starting values, the usual one first.
    pub starts: Vec<f64>,
    /// Smallest plausible value.
    pub minimum: f64,
    /// Largest plausible value.
    pub maximum: f64,
    /// What a fit may reach.
    pub limits: (f64, f64),
}

impl PlausibleRange {
    /// Largest plausible size, whatever its sign.
    pub fn largest(&self) -> f64 {
        self.minimum.abs().max(self.maximum.abs())
    }
}

impl Scale {
    /// Starts and bounds of a catalogue effect's parameter on `rig`.
    pub fn range(&self, spec: &ParameterSpec, rig: &Rig) -> PlausibleRange {
        let factor = match self {
            Self::Automatic | Self::HandOnTool => None,
            Self::Rig { .. } => self
                .factor(spec.unit, rig.lever_arm_m)
                .filter(|_| spec.unit != "1"),
        };
        let Some(factor) = factor else {
            return PlausibleRange {
                starts: spec.starts.to_vec(),
                minimum: spec.minimum,
                maximum: spec.maximum,
                limits: spec.limits,
            };
        };
        let wider = match spec.vanishes_at == Some(0.0) && grows_with_motion(spec.unit) {
            true => WIDER * RINGING,
            false => WIDER,
        };
        // A bound on the far side of 0 moves outwards, one between 0 and the starts towards 0.
        let outwards = |bound: f64, is_outer: bool| {
            bound * factor * if is_outer { wider } else { 1.0 / WIDER }
        };
        let minimum = outwards(spec.minimum, spec.minimum < 0.0);
        let maximum = outwards(spec.maximum, spec.maximum > 0.0);
        PlausibleRange {
            starts: spec.starts.iter().map(|start| start * factor).collect(),
            minimum,
            maximum,
            limits: (minimum, maximum),
        }
    }

    /// By what a value in `unit` is larger than on a hand and tool \[–\]; 1 for a unit that no scale is known of.
    ///
    /// Whatever a method takes for short, slow or small on a hand is so on another rig times this.
    pub fn times_hand(&self, unit: &str, rig: &Rig) -> f64 {
        self.factor(unit, rig.lever_arm_m).unwrap_or(1.0)
    }

    /// Over what a contact sets in.
    pub(crate) fn corner(&self, rig: &Rig) -> Corner<f64> {
        Corner {
            length_m: HAND_CORNER_M * self.times_hand("m", rig),
            time_s: HAND_CORNER_S * self.times_hand("s", rig),
        }
    }

    /// By what a value in `unit` is larger than on a hand and tool; `None` for a unit that no scale is known of.
    fn factor(&self, unit: &str, lever_arm_m: f64) -> Option<f64> {
        let Self::Rig {
            torque_nm,
            angle_rad,
            time_s,
        } = *self
        else {
            return Some(1.0);
        };
        let (torque, angle, time) = (
            torque_nm / HAND_TORQUE_NM,
            angle_rad / HAND_ANGLE_RAD,
            time_s / HAND_TIME_S,
        );
        let lever = lever_arm_m / HAND_LEVER_ARM_M;
        let (force, length) = (torque / lever, angle * lever);
        // Whichever output is fitted: a range that is too wide does no harm.
        let output = angle * f64::max(1.0, 1.0 / time).max(1.0 / (time * time));
        match unit {
            OUTPUT_UNIT => return Some(output),
            OUTPUT_UNIT_PER_SECOND => return Some(output / time),
            _ => {}
        }
        let symbol = |symbol: &str| {
            Some(match symbol {
                "1" => 1.0,
                "N" => force,
                "Nm" => torque,
                "m" => length,
                "rad" => angle,
                "s" => time,
                "Hz" => 1.0 / time,
                "kg" => force * time * time / length,
                _ => return None,
            })
        };
        let power = |text: &str| match text.split_once('^') {
            Some((base, exponent)) => Some(symbol(base)?.powi(exponent.parse().ok()?)),
            None => symbol(text),
        };
        let mut parts = unit.split('/');
        let product = |text: &str| {
            text.split(' ')
                .try_fold(1.0, |all, one| Some(all * power(one)?))
        };
        let mut factor = product(parts.next()?)?;
        for below in parts {
            factor /= product(below)?;
        }
        factor.is_finite().then_some(factor)
    }
}

/// Whether what has this `unit` makes a force in proportion to a power of the motion.
fn grows_with_motion(unit: &str) -> bool {
    let force = |above: &str| (above.split(' ')).any(|one| matches!(one, "N" | "Nm" | "kg"));
    unit.split_once('/').is_some_and(|(above, _)| force(above))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::effects::Effect;
    use crate::law::Law;

    const RIG: Rig = Rig {
        lever_arm_m: 0.66,
        known_inertia_kg_m2: 0.0,
    };
    /// Twice the torque, four times the angle, half the speed of events; with twice the lever arm the same force, eight
    /// times the length.
    const SCALE: Scale = Scale::Rig {
        torque_nm: 20.0,
        angle_rad: 0.12,
        time_s: 0.08,
    };

    #[test]
    fn a_hand_on_a_tool_keeps_the_catalogue_s_numbers() {
        for effect in Effect::ALL {
            for spec in effect.description().parameters {
                for scale in [Scale::Automatic, Scale::HandOnTool] {
                    let range = scale.range(spec, &RIG);
                    assert_eq!(range.starts, spec.starts);
                    assert_eq!((range.minimum, range.maximum), (spec.minimum, spec.maximum));
                    assert_eq!(range.limits, spec.limits);
                }
            }
        }
    }

    #[test]
    fn units_scale_by_hand_calculation() {
        for (unit, expected) in [
            ("N", 1.0),
            ("N/m", 1.0 / 8.0),
            ("N/m^3", 1.0 / 512.0),
            ("kg", 4.0 / 8.0),
            ("kg/s", 2.0 / 8.0),
            ("N s^2/m^2", 4.0 / 64.0),
            ("Nm", 2.0),
            ("1/Nm", 0.5),
            ("rad/s^2", 1.0),
            ("s", 2.0),
            ("Hz", 0.5),
            ("1/kg", 2.0),
            ("1", 1.0),
        ] {
            let factor = SCALE.factor(unit, RIG.lever_arm_m).unwrap();
            assert!((factor - expected).abs() < 1e-12, "{unit}: {factor}");
        }
        assert_eq!(SCALE.factor("V/furlong", 1.0), None);
    }

    /// By hand calculation: a cubic stiffness is 512 times smaller on the longer way, a torque twice as large.
    #[test]
    fn a_spring_may_pull_far_harder_than_what_drives_the_rig_and_a_weight_not() {
        let largest = |effect: Effect| {
            let spec = &effect.description().parameters[0];
            SCALE.range(spec, &RIG).maximum / spec.maximum
        };
        let cubic = largest(Effect::CubicStiffness);
        assert!((cubic * 512.0 / 1e4 - 1.0).abs() < 1e-12, "{cubic}");
        let weight = largest(Effect::GravityTorque);
        assert!((weight / 20.0 - 1.0).abs() < 1e-12, "{weight}");
    }

    /// A unit that cannot be read would silently keep a hand's numbers.
    #[test]
    fn every_unit_of_the_catalogue_can_be_read() {
        for effect in Effect::ALL {
            for spec in effect.description().parameters {
                let known = SCALE.factor(spec.unit, 1.0).is_some();
                assert!(
                    known,
                    "{}: nobody knows the unit `{}`; write it in N, Nm, m, rad, s, Hz, kg and 1, or add its symbol to `Scale::factor`",
                    effect.name(),
                    spec.unit
                );
                let range = SCALE.range(spec, &RIG);
                let inside = |start: &f64| (range.minimum..=range.maximum).contains(start);
                assert!(
                    range.starts.iter().all(inside),
                    "{}: `starts` of `{}` leave its range on another rig; move them in its file",
                    effect.name(),
                    spec.name
                );
                let (lowest, highest) = spec.limits;
                assert!(
                    lowest <= spec.minimum && spec.maximum <= highest,
                    "{}: `limits` of `{}` must hold its range from `minimum` to `maximum`; widen them in its file",
                    effect.name(),
                    spec.name
                );
            }
        }
    }
}
