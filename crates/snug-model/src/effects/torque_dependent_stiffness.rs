//! The operator grips harder the more torque acts: k becomes k (1 + κ |T|).
//!
//! T is the torque that acts on the joint. κ > 0 stiffens; κ = 0 is the base model. Excited by displacement while torque still
//! acts: soft joints. In the residual the build-up is stiffer than the free motion after shut-off.
//!
//! Valid for: κ |T| > −1, where the spring still pulls back. It follows the torque at once, as no reaction does: no time scale.
//!
//! Source: grip force, and stiffness with it, rises with the load.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "The hand is stiffer while torque acts.",
    equation: "k (1 + kappa abs(T))",
}

pub(super) struct TorqueDependentStiffness;

impl Law for TorqueDependentStiffness {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_dependent_stiffness",
            kind: Kind::Muscular,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "kappa_per_nm",
                meaning: "growth of the stiffness per Nm",
                unit: "1/Nm",
                starts: &[0.0],
                minimum: -0.02,
                maximum: 0.2,
                limits: (-0.05, 2.0),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["co_contraction"],
            excited_by: "displacement while torque acts: soft joints, high target torque",
            shows_as: "misfit in proportion to torque times displacement: none after shut-off",
            check: "Tighten at several target torques with the grip force recorded: if the hand stiffens with torque, grip force and torque rise together.",
            on_machine: Some(OnMachine {
                summary: Some("The spring is stiffer while the drive pulls."),
                shows_as: Some(
                    "misfit in proportion to input times displacement: none where nothing drives",
                ),
                check: "Deflect the rig by the same way at a small and a large input and compare the fitted stiffness: gears and couplings that are wound up stiffen.",
            }),
            valid_for: "kappa abs(T) > -1; the hand follows the torque at once, without a reaction time",
            source: "Westling and Johansson 1984, Factors influencing the force control during precision grip, Experimental Brain Research 53",
        }
    }

    #[inline(always)]
    fn stiffening<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
        Some(p[0] * at.torque_nm.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn stiffens_with_torque_of_either_sign() {
        for (kappa, torque_nm, expected) in
            [(0.015, 20.0, 0.3), (0.015, -20.0, 0.3), (0.0, 20.0, 0.0)]
        {
            let at = Instant {
                torque_nm,
                ..trial::at(0.01, 0.0)
            };
            let found = TorqueDependentStiffness.stiffening(&[kappa], &at);
            trial::assert_near(found.expect("torque stiffens"), expected);
        }
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::TorqueDependentStiffness, 1e-9);
    }
}
