//! A spring and a damper in series beside the hand's own: +F = f with f' = k_m v − f/τ.
//!
//! Excited by fast changes: the branch is stiff for motion quicker than τ and gone for slower. Its residual follows the
//! velocity with a decaying tail. Source: standard linear solid (Zener); tissue relaxation.

use crate::numeric::number::Number;
use crate::effect::{Description, Instant, Kind, Law, ParameterSpec, Scope};

pub struct MaxwellBranch;

impl Law for MaxwellBranch {
    fn description(&self) -> &'static Description {
        &Description {
            name: "maxwell_branch",
            kind: Kind::Mechanical,
            summary: "Tissue that is stiff when pushed quickly and gives way within milliseconds.",
            equation: "F + f,  df/dt = k_m v - f / tau",
            parameters: &[
                ParameterSpec {
                    name: "k_m_n_per_m",
                    meaning: "stiffness that relaxes",
                    unit: "N/m",
                    starts: &[200.0],
                    minimum: 0.0,
                    maximum: 2e4,
                    limits: (0.0, 2e5),
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "tau_s",
                    meaning: "time in which it relaxes",
                    unit: "s",
                    starts: &[0.03, 0.01, 0.1],
                    minimum: 0.005,
                    maximum: 0.2,
                    limits: (0.002, 0.5),
                    scope: Scope::Shared,
                },
            ],
            states: &["branch_force_n"],
            twins: &["stretch_reflex"],
            excited_by: "fast changes: hard joints, short pulses",
            shows_as: "misfit that follows the velocity and decays over tau after each change",
            check: "Repeat with a bare hand, with a glove and with another handle cover: a soft layer in between changes the misfit.",
            source: "Zener, standard linear solid",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, _p: &[N], _at: &Instant<N>, own: &[N]) -> Option<N> {
        Some(own[0])
    }

    #[inline(always)]
    fn rates<N: Number>(
        &self,
        p: &[N],
        at: &Instant<N>,
        own: &[N],
        _hand_n: N,
        rates: &mut [N],
    ) {
        rates[0] = p[0] * at.v_m_per_s - own[0] / p[1];
    }
}
