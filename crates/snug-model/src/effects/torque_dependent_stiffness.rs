//! The operator grips harder the more torque acts: k becomes k (1 + κ |T|).
//!
//! T is the torque that acts on the joint. Parameter: kappa_per_nm \[1/Nm\], −0.02 to 0.2; κ = 0 is the base model. Excited by
//! displacement while torque still acts: soft joints. In the residual the build-up is stiffer than the free motion after
//! shut-off. Source: grip force, and stiffness with it, rises with the load.

use crate::numeric::number::Number;
use crate::effect::{Description, Instant, Kind, Law, ParameterSpec, Scope};

pub struct TorqueDependentStiffness;

impl Law for TorqueDependentStiffness {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_dependent_stiffness",
            kind: Kind::Muscular,
            summary: "The hand is stiffer while torque acts.",
            equation: "k (1 + kappa abs(T))",
            parameters: &[ParameterSpec {
                name: "kappa_per_nm",
                meaning: "growth of the stiffness per Nm",
                unit: "1/Nm",
                starts: &[0.0],
                minimum: -0.02,
                maximum: 0.2,
                limits: (-0.05, 2.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["co_contraction"],
            excited_by: "displacement while torque acts: soft joints, high target torque",
            shows_as: "misfit in proportion to torque times displacement: none after shut-off",
            check: "Tighten at several target torques with the grip force recorded: if the hand stiffens with torque, grip force and torque rise together.",
            source: "grip force rises with load",
        }
    }

    #[inline(always)]
    fn stiffening<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
        Some(p[0] * at.torque_nm.abs())
    }
}
