//! A drive runs harder one way than the other: +F = d |v|, so that F_v+ = c + d forwards and F_v− = c − d backwards.
//!
//! The base model's c is then the mean of both; d > 0 brakes forward motion more, d = 0 is the base model. Excited by motion
//! both ways. In the residual a push to one side in proportion to the speed.
//!
//! Valid for: |d| ≤ c, where it is passive, and drives that turn both ways: one way only, it is c. It follows v at once:
//! no time scale, any rig. `directional_damping` says the same of a hand, whose way back it is.
//!
//! Source: identification of drives with F_v+ and F_v− (Kozlowski 1998; Armstrong 1991 for friction that differs by direction).

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "The drive runs harder one way than the other, the more so the faster it turns.",
    equation: "F + d abs(v),  F_v+ = c + d,  F_v- = c - d",
}

pub(super) struct AsymmetricViscousFriction;

impl Law for AsymmetricViscousFriction {
    fn description(&self) -> &'static Description {
        &Description {
            name: "asymmetric_viscous_friction",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "d_kg_per_s",
                meaning: "half of F_v+ less F_v-",
                unit: "kg/s",
                starts: &[0.0],
                minimum: -200.0,
                maximum: 200.0,
                limits: (-2000.0, 2000.0),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["directional_damping", "torque_offset"],
            excited_by: "motion both ways, at several speeds",
            shows_as: "misfit to one side that grows with the speed, whichever way it turns",
            check: "Let the drive run at the same speed one way and the other and compare the torque it takes: worm gears, seals and brushes can differ by direction.",
            on_machine: None,
            valid_for: "abs(d) <= c and motion both ways; it has no time scale",
            source: "Armstrong-Hélouvry 1991, Control of Machines with Friction, Kluwer; Kozłowski 1998, Modelling and Identification in Robotics, Springer",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        Some(p[0] * at.v_m_per_s.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn brakes_one_way_and_spares_the_other() {
        for (d, v_m_per_s, expected_n) in [(25.0, 0.2, 5.0), (25.0, -0.2, 5.0), (0.0, 0.2, 0.0)] {
            let found_n = trial::force(&AsymmetricViscousFriction, &[d], 0.0, v_m_per_s);
            trial::assert_near(found_n, expected_n);
        }
    }

    /// Its slope jumps where the velocity changes its sign.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::AsymmetricViscousFriction, 1e-7);
    }
}
