//! A spring and a damper in series beside the hand's own: +F = f with f' = k_m v − f/τ.
//!
//! F has the sign of the base model. Excited by fast changes: the branch is stiff for motion quicker than τ and gone for
//! slower. Its residual follows the velocity with a decaying tail.
//!
//! Valid for: motion with changes around τ. To slower motion it is a damper k_m τ, to much quicker a spring k_m, and then c or
//! k takes it over. Linear: any amplitude.
//!
//! Source: standard linear solid (Zener); tissue relaxation.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "Tissue that is stiff when pushed quickly and gives way within milliseconds.",
    equation: "F + f,  df/dt = k_m v - f / tau",
}

pub(super) struct MaxwellBranch;

impl Law for MaxwellBranch {
    fn description(&self) -> &'static Description {
        &Description {
            name: "maxwell_branch",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "k_m_n_per_m",
                    meaning: "stiffness that relaxes",
                    unit: "N/m",
                    starts: &[200.0],
                    minimum: 0.0,
                    maximum: 2e4,
                    limits: (0.0, 2e5),
                    vanishes_at: Some(0.0),
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
                    vanishes_at: None,
                    scope: Scope::Shared,
                },
            ],
            states: &["branch_force_n"],
            twins: &["stretch_reflex"],
            excited_by: "fast changes: hard joints, short pulses",
            shows_as: "misfit that follows the velocity and decays over tau after each change",
            check: "Repeat with a bare hand, with a glove and with another handle cover: a soft layer in between changes the misfit.",
            on_machine: Some(OnMachine {
                summary: Some(
                    "Something that is stiff when pushed quickly and gives way within milliseconds: rubber, oil, a belt.",
                ),
                shows_as: None,
                check: "Repeat without, or with other, rubber mounts, belts and couplings: a soft layer in between changes the misfit.",
            }),
            valid_for: "motion that changes over times around tau: for slower it is a damper k_m tau, for quicker a spring k_m; any amplitude",
            source: "Zener 1948, Elasticity and Anelasticity of Metals, University of Chicago Press",
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
    ) -> Option<()> {
        rates[0] = p[0] * at.v_m_per_s - own[0] / p[1];
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn follows_the_velocity_and_relaxes() {
        for (k_m, expected_n_per_s) in [(800.0, -20.0), (0.0, -100.0)] {
            let mut rates = [0.0];
            let at = trial::at(0.0, 0.1);
            MaxwellBranch.rates(&[k_m, 0.03], &at, &[3.0], 0.0, &mut rates);
            trial::assert_near(rates[0], expected_n_per_s);
            assert_eq!(MaxwellBranch.force(&[k_m, 0.03], &at, &[3.0]), Some(3.0));
        }
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::MaxwellBranch, 1e-9);
    }
}
