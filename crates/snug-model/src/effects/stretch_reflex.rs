//! The nerve answers late: +F = k_r x(t − τ), a stiffness that acts on the displacement a delay ago.
//!
//! k_r > 0 pulls back; k_r = 0 is the base model. A delayed spring can feed energy in. Before the window the tool rests at
//! its first displacement. Excited by pulses shorter than τ. In the residual nothing shows until τ after the motion began,
//! then a shifted copy of the displacement.
//!
//! Valid for: pulses shorter than τ in windows much longer; within τ it cannot be seen, and for motion slower than τ it is a
//! spring and k takes it over. Linear: any amplitude, one and the same delay.
//!
//! Source: short- and long-latency stretch reflexes of the arm, 25–50 ms and 50–100 ms.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Delayed, Law};
use crate::numeric::number::Number;

state! {
    summary: "The stretch reflex pulls back in proportion to where the tool was a nerve's delay ago.",
    equation: "F + k_r x(t - tau)",
}

pub(super) struct StretchReflex;

impl Law for StretchReflex {
    fn description(&self) -> &'static Description {
        &Description {
            name: "stretch_reflex",
            kind: Kind::Muscular,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "k_r_n_per_m",
                    meaning: "stiffness of the reflex",
                    unit: "N/m",
                    starts: &[100.0],
                    minimum: -5000.0,
                    maximum: 5000.0,
                    limits: (-2e4, 2e4),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "tau_s",
                    meaning: "delay of the reflex",
                    unit: "s",
                    starts: &[0.06, 0.03, 0.1],
                    minimum: 0.02,
                    maximum: 0.12,
                    limits: (0.01, 0.2),
                    vanishes_at: None,
                    scope: Scope::Shared,
                },
            ],
            states: &[],
            twins: &["maxwell_branch"],
            excited_by: "pulses shorter than the delay, and a window much longer",
            shows_as: "misfit that starts a fixed 20 to 120 ms after the motion and repeats it",
            check: "Ask the operator to stay relaxed, then to resist: a reflex begins the same short time after the pulse and changes in size only.",
            on_machine: None,
            valid_for: "pulses shorter than tau in windows much longer; for slower motion it is a spring; any amplitude, a fixed delay",
            source: "Marsden, Merton and Morton 1972, Servo action in human voluntary movement, Nature 238",
        }
    }

    #[inline(always)]
    fn delayed<N: Number>(&self, p: &[N]) -> Option<Delayed<N>> {
        Some(Delayed {
            stiffness_n_per_m: p[0],
            delay_s: p[1],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    #[test]
    fn is_a_spring_on_what_was_a_delay_ago() {
        let spring = StretchReflex.delayed(&[400.0, 0.06]);
        let spring = spring.expect("a reflex is delayed");
        assert_eq!(spring.stiffness_n_per_m, 400.0);
        assert_eq!(spring.delay_s, 0.06);
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::StretchReflex, 1e-9);
    }
}
