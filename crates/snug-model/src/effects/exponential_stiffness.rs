//! A spring that stiffens ever faster, as tissue does: +F = f0 (exp(|x|/x0) − 1) sgn x.
//!
//! The tangent stiffness f0/x0 · exp(|x|/x0) grows in proportion to the force; against the displacement for f0 > 0, and f0 = 0 is
//! the base model. Beyond 40 x0 it goes on straight, so that no trial step of a fit overflows. Excited by large
//! displacements. In the residual it grows faster than any power, at the peaks of the largest targets.
//!
//! Valid for: travel from about x0 to 10 x0; for less it is a spring f0/x0, which k takes over. It has no time scale.
//!
//! Source: Fung (1967), elasticity of soft tissues in simple elongation.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::lanewise::Lanewise;
use crate::numeric::number::Number;

state! {
    summary: "The hand is a spring that stiffens ever faster the further it is pulled, as tissue does.",
    equation: "F + f0 (exp(abs(x) / x0) - 1) sgn(x)",
}

/// |x|/x0 from which it goes on straight.
const STRAIGHT_FROM: f64 = 40.0;

pub(super) struct ExponentialStiffness;

impl Law for ExponentialStiffness {
    fn description(&self) -> &'static Description {
        &Description {
            name: "exponential_stiffness",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "f0_n",
                    meaning: "force",
                    unit: "N",
                    starts: &[1.0],
                    minimum: 0.0,
                    maximum: 50.0,
                    limits: (0.0, 1000.0),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "x0_m",
                    meaning: "way over which stiffness grows",
                    unit: "m",
                    starts: &[0.008, 0.004, 0.016],
                    minimum: 0.002,
                    maximum: 0.05,
                    limits: (0.001, 0.2),
                    vanishes_at: None,
                    scope: Scope::Shared,
                },
            ],
            states: &[],
            twins: &["cubic_stiffness"],
            excited_by: "large displacements: high target torque, soft grip",
            shows_as: "misfit around the peak that is nothing at small targets and grows steeply with the largest",
            check: "Tighten at a low, a middle, a high and a very high target torque with the same grip: the fitted stiffness rises ever faster, not in proportion to the square of the displacement.",
            on_machine: Some(OnMachine {
                summary: Some(
                    "The spring stiffens ever faster the further it is pulled, as rubber or a stop does.",
                ),
                shows_as: Some(
                    "misfit around the peak that is nothing in small motion and grows steeply with the largest",
                ),
                check: "Drive the rig at several amplitudes up to the largest: the fitted stiffness rises ever faster, not in proportion to the square of the displacement.",
            }),
            valid_for: "travel from about x0 to 10 x0, for less it is a spring f0 / x0; it has no time scale",
            source: "Fung 1967, Elasticity of soft tissues in simple elongation, American Journal of Physiology 213",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        let way = at.x_m.abs() / p[1];
        let bounded = way.value().within(0.0, STRAIGHT_FROM);
        let is_far = (way.value() - STRAIGHT_FROM).is_positive();
        let near = N::select(is_far, way.constant(STRAIGHT_FROM), way);
        let beyond = way.plus(-bounded);
        let far = (beyond + 1.0) * STRAIGHT_FROM.exp();
        Some(p[0] * (N::select(is_far, far, near.exp()) - 1.0) * at.x_m.sign())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn stiffens_ever_faster_on_both_sides() {
        let e = std::f64::consts::E;
        for (f0, x_m, expected_n) in [
            (5.0, 0.01, 5.0 * (e - 1.0)),
            (5.0, -0.02, -5.0 * (e * e - 1.0)),
            (5.0, 0.0, 0.0),
            (0.0, 0.01, 0.0),
        ] {
            let found_n = trial::force(&ExponentialStiffness, &[f0, 0.01], x_m, 0.0);
            trial::assert_near(found_n, expected_n);
        }
    }

    /// A trial step far off must not end in infinity less infinity.
    #[test]
    fn goes_on_straight_where_it_would_overflow() {
        let force_n = |x_m| trial::force(&ExponentialStiffness, &[1.0, 0.001], x_m, 0.0);
        let (at, after) = (force_n(0.04), force_n(0.041));
        assert!((at / 40.0_f64.exp() - 1.0).abs() < 1e-9);
        assert!((after / at - 2.0).abs() < 1e-9);
        assert!(force_n(1e6).is_finite() && force_n(-1e6) < 0.0);
    }

    /// Its slope jumps where the displacement changes its sign.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::ExponentialStiffness, 1e-7);
    }
}
