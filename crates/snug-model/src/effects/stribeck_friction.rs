//! Dry friction that is larger until it moves: +F = (F_c + (F_s − F_c) exp(−(v/v_s)²)) tanh(v / v_0), v_0 = 0.01 m/s.
//!
//! Against the motion for F_c, F_s > 0: F_s near rest, F_c far above v_s. F_s = F_c, and anything less, is dry friction alone, both 0
//! the base model.
//! Excited by motion that is slow for a while: reversals, weak pulses. In the residual a step at every reversal that fades
//! as the speed grows.
//!
//! Valid for: v_s well above v_0, below which it is a damper F_s / v_0: nothing sticks. On a rig of another scale sgn v stands for
//! the tanh, and it holds at rest, see `simulate::dry_friction`.
//!
//! Source: Stribeck (1902); Armstrong-Hélouvry, Dupont & Canudas de Wit (1994), with exponent 2.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::lanewise::Lanewise;
use crate::numeric::number::Number;

state! {
    summary: "Dry friction holds more firmly at low speed and gives way as the motion gets faster.",
    equation: "F + (Fc + (Fs - Fc) exp(-(v / v_s)^2)) tanh(v / 0.01 m/s)",
}

/// v_0, the velocity over which the friction turns \[m/s\].
const SMOOTHING_M_PER_S: f64 = 0.01;

pub(super) struct StribeckFriction;

impl Law for StribeckFriction {
    fn description(&self) -> &'static Description {
        &Description {
            name: "stribeck_friction",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "fc_n",
                    meaning: "friction when fast",
                    unit: "N",
                    starts: &[1.0],
                    minimum: 0.0,
                    maximum: 30.0,
                    limits: (0.0, 300.0),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "fs_n",
                    meaning: "friction when slow",
                    unit: "N",
                    starts: &[3.0],
                    minimum: 0.0,
                    maximum: 60.0,
                    limits: (0.0, 600.0),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "v_s_m_per_s",
                    meaning: "speed at which it has given way",
                    unit: "m/s",
                    starts: &[0.06, 0.2],
                    minimum: 0.02,
                    maximum: 1.0,
                    limits: (0.01, 5.0),
                    vanishes_at: None,
                    scope: Scope::Shared,
                },
            ],
            states: &[],
            twins: &["coulomb_friction"],
            excited_by: "motion that is slow for a while: reversals, weak pulses, slow drives",
            shows_as: "misfit that steps at every reversal and fades as the speed grows",
            check: "Pull the handle by hand with a spring scale, first very slowly, then faster, with the tool off: friction that sticks pulls hardest when slow; grease and seals change it.",
            on_machine: Some(OnMachine {
                summary: None,
                shows_as: None,
                check: "Pull the moving part with a spring scale with the power off, first very slowly, then faster: friction that sticks pulls hardest when slow; grease and seals change it.",
            }),
            valid_for: "a hand on a tool with v_s well above 0.01 m/s, below which nothing sticks; a machine, which it holds at rest",
            source: "Stribeck 1902, Die wesentlichen Eigenschaften der Gleit- und Rollenlager, Zeitschrift des VDI 46; Armstrong-Hélouvry, Dupont and Canudas de Wit 1994, A survey of models, analysis tools and compensation methods for the control of machines with friction, Automatica 30",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        let v = at.v_m_per_s;
        let share = (-(v / p[2]).power(2)).exp();
        // Friction that grows with the speed is another law's.
        let slow = N::select(p[1].value().is_above(p[0].value()), p[1], p[0]);
        let force = p[0] + (slow - p[0]) * share;
        Some(force * (v * (1.0 / SMOOTHING_M_PER_S)).tanh())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::coulomb_friction::CoulombFriction;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn holds_more_firmly_when_slow() {
        let p = [2.0, 6.0, 0.1];
        for (v_m_per_s, expected_n) in [
            (0.0, 0.0),
            (1.0, 2.0),
            (-1.0, -2.0),
            (0.1, (2.0 + 4.0 / std::f64::consts::E) * 10.0_f64.tanh()),
            (1e-7, 6e-5),
        ] {
            let found_n = trial::force(&StribeckFriction, &p, 0.0, v_m_per_s);
            assert!((found_n - expected_n).abs() < 1e-9, "{found_n}");
        }
    }

    #[test]
    fn without_an_excess_it_is_dry_friction() {
        for (v_m_per_s, slow_n) in [(-0.3, 4.0), (-0.004, 4.0), (0.02, 1.0), (0.5, 0.0)] {
            let found_n = trial::force(&StribeckFriction, &[4.0, slow_n, 0.1], 0.0, v_m_per_s);
            let dry_n = trial::force(&CoulombFriction, &[4.0], 0.0, v_m_per_s);
            trial::assert_near(found_n, dry_n);
        }
    }

    /// It turns over within few steps.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::StribeckFriction, 1e-7);
    }
}
