//! An asymmetric hand spring: +F = k2 x², stiffer one way (k2 > 0: away from the operator's rest) than the other.
//!
//! Excited by large displacements; its share grows with the amplitude. In the residual it stands around the peak with one
//! sign on both sides of rest (even harmonics, a shifted mean).
//!
//! Valid for: |x| below k / 2|k2|, where on the soft side the force is largest and the spring would let go. It follows x at
//! once: no time scale, any rig.
//!
//! Source: asymmetric restoring force (Nayfeh and Mook, Nonlinear Oscillations, 1979).

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "The hand's spring is stiffer in one direction than in the other.",
    equation: "F + k2 x^2",
}

pub(super) struct QuadraticStiffness;

impl Law for QuadraticStiffness {
    fn description(&self) -> &'static Description {
        &Description {
            name: "quadratic_stiffness",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "k2_n_per_m2",
                meaning: "quadratic stiffness",
                unit: "N/m^2",
                starts: &[0.0],
                minimum: -1e5,
                maximum: 1e5,
                limits: (-2e6, 2e6),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["cubic_stiffness", "directional_damping"],
            excited_by: "large displacements: high target torque, soft grip",
            shows_as: "misfit around the peak that grows as x^2, with the same sign on both sides of rest",
            check: "Let the tool pull the hand in the other direction once (left-hand thread or reversed tool): an uneven spring is stiffer one way than the other.",
            on_machine: Some(OnMachine {
                summary: Some("The spring is stiffer in one direction than in the other."),
                shows_as: None,
                check: "Pull the rig the same way to either side with a spring scale: an uneven spring is stiffer one way than the other.",
            }),
            valid_for: "displacements below k / (2 abs(k2)), where on the soft side its force is largest; it has no time scale",
            source: "Nayfeh and Mook 1979, Nonlinear Oscillations, Wiley",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        Some(p[0] * at.x_m.power(2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn acts_one_way_on_both_sides() {
        for (k2, x_m, expected_n) in [(1e4, 0.01, 1.0), (1e4, -0.01, 1.0), (0.0, 0.01, 0.0)] {
            trial::assert_near(
                trial::force(&QuadraticStiffness, &[k2], x_m, 0.0),
                expected_n,
            );
        }
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::QuadraticStiffness, 1e-9);
    }
}
