//! The accelerometer's zero is off: a + b; in the integrated velocity a slope, in the displacement a parabola.
//!
//! b > 0 reads too much. Always there; counted from the instant the integration began, which is why a long quiet part before
//! the pulse makes it grow. In the residual a constant in the acceleration, a slope in the velocity, a parabola in the
//! displacement.
//!
//! Valid for: a zero that stays the same from the beginning of the integration to the window's end, velocity and displacement
//! integrated from this very acceleration.
//!
//! Source: sensor zero offset, temperature drift.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Kinematics, Law};
use crate::numeric::number::Number;

state! {
    summary: "The accelerometer does not read zero at rest.",
    equation: "a + b",
}

pub(super) struct AccelerationBias;

impl Law for AccelerationBias {
    fn description(&self) -> &'static Description {
        &Description {
            name: "acceleration_bias",
            kind: Kind::Measurement,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "bias_rad_per_s2",
                meaning: "bias",
                unit: "rad/s^2",
                starts: &[0.0],
                minimum: -2.0,
                maximum: 2.0,
                limits: (-50.0, 50.0),
                vanishes_at: Some(0.0),
                scope: Scope::PerTightening,
            }],
            states: &[],
            twins: &["initial_motion"],
            excited_by: "nothing: it is there at rest",
            shows_as: "a constant in the acceleration, a parabola in the displacement",
            check: "Read the accelerometer with the tool at rest, cold and warm: it must show zero; if not, record a quiet part before each pulse.",
            on_machine: Some(OnMachine {
                summary: None,
                shows_as: None,
                check: "Read the accelerometer with the rig at rest, cold and warm: it must show zero; if not, record a quiet part before each start.",
            }),
            valid_for: "a zero that does not drift from the beginning of the integration to the end of the window",
            source: "IEEE Std 1293-1998, Test Procedure for Linear, Single-Axis, Nongyroscopic Accelerometers: bias",
        }
    }

    #[inline(always)]
    fn measure<N: Number>(
        &self,
        p: &[N],
        since_rest_s: N::Real,
        seen: Kinematics<N>,
    ) -> Option<Kinematics<N>> {
        Some(Kinematics {
            displacement_rad: seen.displacement_rad + p[0].times(since_rest_s * 0.5 * since_rest_s),
            velocity_rad_per_s: seen.velocity_rad_per_s + p[0].times(since_rest_s),
            acceleration_rad_per_s2: seen.acceleration_rad_per_s2 + p[0],
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    /// θ + ½ b t², ω + b t, α + b.
    #[test]
    fn adds_a_constant_and_its_integrals() {
        let (bias, rest_before_s) = (0.3, 1.48);
        let trial = Trial::ramp().rested_before(rest_before_s);
        let plain = trial.motion_of(&[], &[]);
        let biased = trial.motion(Effect::AccelerationBias, &[bias]);
        let elapsed = rest_before_s + 2000.0 * trial::INTERVAL_S;
        let expected = [0.5 * bias * elapsed * elapsed, bias * elapsed, bias];
        for quantity in 0..3 {
            let found = biased[quantity][2000] - plain[quantity][2000];
            trial::assert_near(found, expected[quantity]);
        }
    }
}
