//! Damping that grows with speed: +F = c2 v |v|, against the motion for c2 > 0.
//!
//! Excited by fast motion: high targets, hard joints. In the residual it follows v |v|: peaks where the velocity peaks, and
//! the fitted c drifts with amplitude.
//!
//! Valid for: speeds around and above c / c2, where it is as large as the damper; slower motion does not show it. It follows
//! v at once: no time scale, any rig.
//!
//! Source: velocity-squared damping (Nayfeh and Mook, Nonlinear Oscillations, 1979).

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "The hand damps fast motion more than in proportion.",
    equation: "F + c2 v abs(v)",
}

pub(super) struct QuadraticDamping;

impl Law for QuadraticDamping {
    fn description(&self) -> &'static Description {
        &Description {
            name: "quadratic_damping",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "c2_n_s2_per_m2",
                meaning: "quadratic damping",
                unit: "N s^2/m^2",
                starts: &[0.0],
                minimum: 0.0,
                maximum: 1000.0,
                limits: (0.0, 1e4),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["coulomb_friction", "torque_delay"],
            excited_by: "fast motion: high target torque, hard joints",
            shows_as: "misfit that follows v abs(v), largest where the velocity peaks; fitted damping drifts with amplitude",
            check: "Compare a slow and a fast joint at the same target torque: damping of this kind grows with the speed of the handle, friction does not.",
            on_machine: Some(OnMachine {
                summary: Some("Fast motion is damped more than in proportion."),
                shows_as: None,
                check: "Drive the rig slowly and fast with the same force: damping of this kind grows with the speed, as air and oil resist; friction does not.",
            }),
            valid_for: "speeds around and above c / c2; slower motion does not show it; it has no time scale",
            source: "Nayfeh and Mook 1979, Nonlinear Oscillations, Wiley",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        Some(p[0] * (at.v_m_per_s * at.v_m_per_s.abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn brakes_both_ways() {
        for (c2, v_m_per_s, expected_n) in
            [(100.0, 0.5, 25.0), (100.0, -0.5, -25.0), (0.0, 0.5, 0.0)]
        {
            let found_n = trial::force(&QuadraticDamping, &[c2], 0.0, v_m_per_s);
            trial::assert_near(found_n, expected_n);
        }
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::QuadraticDamping, 1e-9);
    }
}
