//! Dry friction in grip and joint: +F = F_c tanh(v / v_s), against the motion for F_c > 0.
//!
//! Excited by any motion; relatively strongest in weak pulses. Its residual follows sign(v): a step at every reversal.
//!
//! Valid for: a hand on a tool, whose speeds are far above v_s. Below v_s it is a damper F_c / v_s: nothing sticks. On a rig
//! of another scale it is F_c sgn v and holds at rest, see `simulate::dry_friction`.
//!
//! Source: Coulomb friction, smoothed as usual in identification so that it is differentiable.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "Dry friction holds against every motion with a constant force.",
    equation: "F + Fc tanh(v / 0.01 m/s)",
}

/// v_s, the velocity over which the friction turns \[m/s\].
const SMOOTHING_M_PER_S: f64 = 0.01;

pub(super) struct CoulombFriction;

impl Law for CoulombFriction {
    fn description(&self) -> &'static Description {
        &Description {
            name: "coulomb_friction",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "fc_n",
                meaning: "friction force",
                unit: "N",
                starts: &[1.0],
                minimum: 0.0,
                maximum: 30.0,
                limits: (0.0, 300.0),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["quadratic_damping", "stribeck_friction"],
            excited_by: "any motion; relatively strongest in weak pulses",
            shows_as: "misfit that follows the sign of the velocity, with a step at every reversal",
            check: "Move the handle slowly by hand with the tool off and feel or measure whether it needs a small force to move at all: look for rubbing sleeves, cables, hoses and the suspension.",
            on_machine: Some(OnMachine {
                summary: None,
                shows_as: None,
                check: "Move the rig slowly with the power off and feel or measure whether it needs a small force to move at all: look for rubbing seals, bearings, guides and cables.",
            }),
            valid_for: "a hand on a tool at speeds far above 0.01 m/s, below which nothing sticks; a machine, which it holds at rest",
            source: "Armstrong-Hélouvry, Dupont and Canudas de Wit 1994, A survey of models, analysis tools and compensation methods for the control of machines with friction, Automatica 30",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        Some(p[0] * (at.v_m_per_s * (1.0 / SMOOTHING_M_PER_S)).tanh())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn holds_against_the_motion_and_turns_softly() {
        for (fc_n, v_m_per_s, expected_n) in [
            (5.0, 1.0, 5.0),
            (5.0, -1.0, -5.0),
            (5.0, 1e-6, 5e-4),
            (0.0, 1.0, 0.0),
        ] {
            let found_n = trial::force(&CoulombFriction, &[fc_n], 0.0, v_m_per_s);
            trial::assert_near(found_n, expected_n);
        }
    }

    /// It turns over within few steps.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::CoulombFriction, 1e-7);
    }
}
