//! A hand spring that hardens (k3 > 0) or softens (k3 < 0) with displacement: +F = k3 x³.
//!
//! Excited by large displacements only; its share grows with the square of the amplitude, so high targets show it and
//! low ones do not. In the residual it stands around the peak, third harmonic like, and the fitted k drifts with
//! amplitude. Source: Duffing oscillator; muscle and tissue stiffening with stretch.

use crate::numeric::number::Number;
use crate::effect::{Description, Instant, Kind, Law, ParameterSpec, Scope};

pub struct CubicStiffness;

impl Law for CubicStiffness {
    fn description(&self) -> &'static Description {
        &Description {
            name: "cubic_stiffness",
            kind: Kind::Mechanical,
            summary: "The hand's spring becomes stiffer (or softer) the further it is pushed.",
            equation: "F + k3 x^3",
            parameters: &[ParameterSpec {
                name: "k3_n_per_m3",
                meaning: "cubic stiffness",
                unit: "N/m^3",
                starts: &[0.0],
                minimum: -5e6,
                maximum: 5e6,
                limits: (-1e8, 1e8),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["quadratic_stiffness", "co_contraction"],
            excited_by: "large displacements: high target torque, soft grip",
            shows_as: "misfit around the peak that grows as x^3 and only at big targets; fitted stiffness drifts with amplitude",
            check: "Tighten at a low, a middle and a high target torque with the same grip: a spring that hardens gives a fitted stiffness that rises with the target.",
            source: "Duffing oscillator",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        Some(p[0] * at.x_m.power(3))
    }
}
