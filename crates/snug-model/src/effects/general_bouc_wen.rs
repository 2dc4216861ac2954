//! Hysteresis whose loop has a shape of its own: +F = k_h z, where z follows x, stiffer or softer as it builds up and as it goes back.
//!
//! ```text
//! z' = v − β |v| z − γ v |z|
//! ```
//!
//! F has the sign of the base model; k_h = 0 is the base model. Building up z grows as v (1 − (β + γ) |z|), going back it falls as v (1 + (β − γ) |z|):
//! γ > −β gives way, at last at z = 1/(β + γ), γ < −β stiffens; β > 0 makes the loop. β = γ = ½/z_max is the catalogue's `bouc_wen`. Excited by
//! reversals. In the residual a loop over the displacement that small motion does not close.
//!
//! Valid for: travel over which β z and γ z matter; for less it is a spring k_h and k takes it over. The loop does not depend on how fast it is
//! passed through.
//!
//! Source: Bouc (1967) and Wen (1976) with n = 1; Noël and Schoukens, Hysteretic benchmark with a dynamic nonlinearity (2016), β γ and β δ there.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "A spring with a loop: it stiffens or softens as it is pressed, and goes back by another way.",
    equation: "F + k_h z,  dz/dt = v - beta abs(v) z - gamma v abs(z)",
}

pub(super) struct GeneralBoucWen;

impl Law for GeneralBoucWen {
    fn description(&self) -> &'static Description {
        &Description {
            name: "general_bouc_wen",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "k_loop_n_per_m",
                    meaning: "stiffness of the loop",
                    unit: "N/m",
                    starts: &[200.0],
                    minimum: 0.0,
                    maximum: 2e4,
                    limits: (0.0, 2e5),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "beta_per_m",
                    meaning: "beta, which opens the loop",
                    unit: "1/m",
                    starts: &[150.0, 30.0],
                    minimum: 0.0,
                    maximum: 5000.0,
                    limits: (0.0, 5000.0),
                    vanishes_at: None,
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "gamma_per_m",
                    meaning: "gamma, which bends it",
                    unit: "1/m",
                    starts: &[-40.0, 0.0, 100.0],
                    minimum: -5000.0,
                    maximum: 5000.0,
                    limits: (-5000.0, 5000.0),
                    vanishes_at: None,
                    scope: Scope::Shared,
                },
            ],
            states: &["loop_m"],
            twins: &["bouc_wen", "coulomb_friction", "maxwell_branch"],
            excited_by: "reversals over ways of different lengths",
            shows_as: "misfit that runs through a loop over the displacement, wider for longer ways",
            check: "Push slowly to and fro over short and long ways with the power off and draw force over way: the loop shows whether it gives way or stiffens (wire rope, rubber, piezo, magnets).",
            on_machine: None,
            valid_for: "travel over which it bends, for less it is a spring; the loop does not depend on speed",
            source: "Bouc 1967; Wen 1976; Noël and Schoukens 2016, Hysteretic benchmark with a dynamic nonlinearity, Workshop on Nonlinear System Identification Benchmarks, Brussels",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], _at: &Instant<N>, own: &[N]) -> Option<N> {
        Some(p[0] * own[0])
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
        let (v, z) = (at.v_m_per_s, own[0]);
        rates[0] = v - p[1] * v.abs() * z - p[2] * v * z.abs();
        Some(())
    }

    /// Of dry friction beside a spring that stiffens it explains more than either.
    fn is_general(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn builds_up_and_goes_back_by_its_two_numbers() {
        let p = [2000.0, 300.0, -100.0];
        for (v_m_per_s, z_m, expected) in [
            (0.1, 0.002, 0.1 * (1.0 - 200.0 * 0.002)),
            (-0.1, 0.002, -0.1 * (1.0 + 400.0 * 0.002)),
            (-0.1, -0.002, -0.1 * (1.0 - 200.0 * 0.002)),
        ] {
            let (at, mut rates) = (trial::at(0.0, v_m_per_s), [0.0]);
            GeneralBoucWen.rates(&p, &at, &[z_m], 0.0, &mut rates);
            trial::assert_near(rates[0], expected);
            let force = GeneralBoucWen.force(&p, &at, &[z_m]);
            assert_eq!(force, Some(2000.0 * z_m));
        }
    }

    /// With β = γ = ½/z_max it is the law of one number.
    #[test]
    fn of_two_equal_numbers_it_is_the_simpler_one() {
        use crate::effects::bouc_wen::BoucWen;
        for (v_m_per_s, z_m) in [(0.1, 0.002), (-0.1, 0.002), (0.3, -0.001)] {
            let (at, mut rates) = (trial::at(0.0, v_m_per_s), [0.0; 2]);
            GeneralBoucWen.rates(&[2000.0, 200.0, 200.0], &at, &[z_m], 0.0, &mut rates[..1]);
            BoucWen.rates(&[2000.0, 0.0025], &at, &[z_m], 0.0, &mut rates[1..]);
            trial::assert_near(rates[0], rates[1]);
        }
    }

    /// Its rates have a kink where the velocity changes its sign, in the middle of a step.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::GeneralBoucWen, 1e-7);
    }
}
