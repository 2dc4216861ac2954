//! A hand spring that hardens (k3 > 0) or softens (k3 < 0) with displacement: +F = k3 x³.
//!
//! Excited by large displacements only; its share grows with the square of the amplitude, so high targets show it and
//! low ones do not. In the residual it stands around the peak, third harmonic like, and the fitted k drifts with
//! amplitude.
//!
//! Valid for: displacements whose next odd power is small. A spring that softens has its largest force at
//! x = √(k / 3|k3|); beyond, the law lets go, which no hand does. It follows x at once: no time scale, any rig.
//!
//! Source: Duffing oscillator; muscle and tissue stiffening with stretch.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "The hand's spring becomes stiffer (or softer) the further it is pushed.",
    equation: "F + k3 x^3",
}

pub(super) struct CubicStiffness;

impl Law for CubicStiffness {
    fn description(&self) -> &'static Description {
        &Description {
            name: "cubic_stiffness",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "k3_n_per_m3",
                meaning: "cubic stiffness",
                unit: "N/m^3",
                starts: &[0.0],
                minimum: -5e6,
                maximum: 5e6,
                limits: (-1e8, 1e8),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["quadratic_stiffness", "co_contraction"],
            excited_by: "large displacements: high target torque, soft grip",
            shows_as: "misfit around the peak that grows as x^3 and only at big targets; fitted stiffness drifts with amplitude",
            check: "Tighten at a low, a middle and a high target torque with the same grip: a spring that hardens gives a fitted stiffness that rises with the target.",
            on_machine: Some(OnMachine {
                summary: Some("The spring becomes stiffer (or softer) the further it is pushed."),
                shows_as: Some(
                    "misfit around the peak that grows as x^3 and only in large motion; fitted stiffness drifts with amplitude",
                ),
                check: "Drive the rig at a small, a middle and a large amplitude: a spring that hardens gives a fitted stiffness that rises with the amplitude.",
            }),
            valid_for: "displacements well below sqrt(k / (3 abs(k3))) when it softens, where its force is largest; it has no time scale",
            source: "Duffing 1918, Erzwungene Schwingungen bei veränderlicher Eigenfrequenz, Vieweg",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        Some(p[0] * at.x_m.power(3))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn a_positive_one_pulls_back_harder_on_both_sides() {
        for (k3, x_m, expected_n) in [(2e6, 0.01, 2.0), (2e6, -0.01, -2.0), (0.0, 0.01, 0.0)] {
            trial::assert_near(trial::force(&CubicStiffness, &[k3], x_m, 0.0), expected_n);
        }
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::CubicStiffness, 1e-9);
    }
}
