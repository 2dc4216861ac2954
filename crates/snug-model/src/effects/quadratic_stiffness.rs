//! An asymmetric hand spring: +F = k2 x², stiffer one way (k2 > 0: away from the operator's rest) than the other.
//!
//! Parameter: k2_n_per_m2 \[N/m²\], −1e5 to 1e5. Excited by large displacements; its share grows with the amplitude. In the
//! residual it stands around the peak with one sign on both sides of rest (even harmonics, a shifted mean).
//! Source: asymmetric restoring force (Nayfeh and Mook, Nonlinear Oscillations, 1979).

use crate::numeric::number::Number;
use crate::effect::{Description, Instant, Kind, Law, ParameterSpec, Scope};

pub struct QuadraticStiffness;

impl Law for QuadraticStiffness {
    fn description(&self) -> &'static Description {
        &Description {
            name: "quadratic_stiffness",
            kind: Kind::Mechanical,
            summary: "The hand's spring is stiffer in one direction than in the other.",
            equation: "F + k2 x^2",
            parameters: &[ParameterSpec {
                name: "k2_n_per_m2",
                meaning: "quadratic stiffness",
                unit: "N/m^2",
                starts: &[0.0],
                minimum: -1e5,
                maximum: 1e5,
                limits: (-2e6, 2e6),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["cubic_stiffness", "directional_damping"],
            excited_by: "large displacements: high target torque, soft grip",
            shows_as: "misfit around the peak that grows as x^2, with the same sign on both sides of rest",
            check: "Let the tool pull the hand in the other direction once (left-hand thread or reversed tool): an uneven spring is stiffer one way than the other.",
            source: "asymmetric spring (Nayfeh and Mook 1979)",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        Some(p[0] * at.x_m.power(2))
    }
}
