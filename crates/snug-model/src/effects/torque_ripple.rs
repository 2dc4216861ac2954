//! A force that comes again with every length λ of the way: +F = A (sin(2π x/λ + φ) − sin φ), as of gear teeth, of magnets
//! past their slots, of a bearing that rattles.
//!
//! ```text
//! F = a_s sin(2π x/λ) + a_c (cos(2π x/λ) − 1)      A = √(a_s² + a_c²),  φ = atan2(a_c, a_s)
//! ```
//!
//! Two amplitudes in place of one and a phase: the force is linear in them, and nothing is left of it where both are 0. What
//! it is at rest is held from before and drops out; on a machine, whose zero of x is anyone's choice, nothing is taken off
//! (`Scale::effect`). Excited by travel over several λ. In the residual a ripple whose frequency goes with the speed.
//!
//! Valid for: travel of at least one or two λ, over less it is a spring of some curvature; sampling at least four times while a
//! λ passes. It has no time scale and, over a λ, no work.
//!
//! Source: cogging and ripple torque of drives, transmission error of gears: periodic in position.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;
use std::f64::consts::TAU;

state! {
    summary: "A force comes and goes with the way: gear teeth, magnets or balls that pass.",
    equation: "F + a_s sin(2 pi x / lambda) + a_c (cos(2 pi x / lambda) - 1)",
}

/// What people read about it.
pub(super) const DESCRIPTION: Description = Description {
    name: "torque_ripple",
    kind: Kind::Mechanical,
    acts_on: ActsOn::Anything,
    summary: SUMMARY,
    equation: EQUATION,
    parameters: &[
        ParameterSpec {
            name: "a_sin_n",
            meaning: "amplitude of the sine",
            unit: "N",
            starts: &[3.0],
            minimum: -50.0,
            maximum: 50.0,
            limits: (-500.0, 500.0),
            vanishes_at: Some(0.0),
            scope: Scope::Shared,
        },
        ParameterSpec {
            name: "a_cos_n",
            meaning: "amplitude of the cosine",
            unit: "N",
            starts: &[3.0, -3.0],
            minimum: -50.0,
            maximum: 50.0,
            limits: (-500.0, 500.0),
            vanishes_at: Some(0.0),
            scope: Scope::Shared,
        },
        ParameterSpec {
            name: "wavelength_m",
            meaning: "way after which it comes again",
            unit: "m",
            starts: &[0.006, 0.0025],
            minimum: 5e-4,
            maximum: 0.02,
            limits: (2e-4, 0.03),
            vanishes_at: None,
            scope: Scope::Shared,
        },
    ],
    states: &[],
    twins: &[],
    excited_by: "travel over several wavelengths: high targets, a soft grip, a drive that turns",
    shows_as: "a ripple in the acceleration whose frequency goes with the speed, at the same places in every tightening",
    check: "Turn the tool slowly by hand with the power off and feel for notches; count the teeth, slots or balls that pass in one turn.",
    on_machine: Some(OnMachine {
        summary: None,
        shows_as: Some(
            "a ripple in the acceleration whose frequency goes with the speed, at the same places in every recording",
        ),
        check: "Turn the rig slowly with the power off and feel for notches; count the teeth, slots or balls that pass in one turn.",
    }),
    valid_for: "travel of a wavelength or two at least, over less it is a curved spring; four samples per wavelength passed",
    source: "Jahns and Soong 1996, Pulsating torque minimization techniques for permanent magnet AC motor drives – a review, IEEE Transactions on Industrial Electronics 43",
};

pub(super) struct TorqueRipple;

impl Law for TorqueRipple {
    fn description(&self) -> &'static Description {
        &DESCRIPTION
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        let (sine, cosine) = (at.x_m * TAU / p[2]).sin_cos();
        Some(p[0] * sine + p[1] * (cosine - 1.0))
    }

    fn wavelength(&self) -> Option<usize> {
        Some(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn comes_again_and_is_not_there_at_rest() {
        let p = [3.0, -2.0, 0.006];
        for (x_m, expected_n) in [
            (0.0, 0.0),
            (0.0015, 3.0 + 2.0),
            (0.003, 4.0),
            (0.0045, -3.0 + 2.0),
            (0.006, 0.0),
            (-0.0015, -3.0 + 2.0),
            (0.0615, 5.0),
        ] {
            let found_n = trial::force(&TorqueRipple, &p, x_m, 0.5);
            assert!((found_n - expected_n).abs() < 1e-10, "{found_n}");
        }
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::TorqueRipple, 1e-7);
    }
}
