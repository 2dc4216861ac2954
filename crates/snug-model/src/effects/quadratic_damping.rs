//! Damping that grows with speed: +F = c2 v |v|, against the motion for c2 > 0.
//!
//! Parameter: c2_n_s2_per_m2 \[N s²/m²\], 0 to 1000. Excited by fast motion: high targets, hard joints. In the residual it
//! follows v |v|: peaks where the velocity peaks, and the fitted c drifts with amplitude.
//! Source: velocity-squared damping (Nayfeh and Mook, Nonlinear Oscillations, 1979).

use crate::numeric::number::Number;
use crate::effect::{Description, Instant, Kind, Law, ParameterSpec, Scope};

pub struct QuadraticDamping;

impl Law for QuadraticDamping {
    fn description(&self) -> &'static Description {
        &Description {
            name: "quadratic_damping",
            kind: Kind::Mechanical,
            summary: "The hand damps fast motion more than in proportion.",
            equation: "F + c2 v abs(v)",
            parameters: &[ParameterSpec {
                name: "c2_n_s2_per_m2",
                meaning: "quadratic damping",
                unit: "N s^2/m^2",
                starts: &[0.0],
                minimum: 0.0,
                maximum: 1000.0,
                limits: (0.0, 1e4),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["coulomb_friction", "torque_delay"],
            excited_by: "fast motion: high target torque, hard joints",
            shows_as: "misfit that follows v abs(v), largest where the velocity peaks; fitted damping drifts with amplitude",
            check: "Compare a slow and a fast joint at the same target torque: damping of this kind grows with the speed of the handle, friction does not.",
            source: "velocity-squared damping",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        Some(p[0] * (at.v_m_per_s * at.v_m_per_s.abs()))
    }
}
