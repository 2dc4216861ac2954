//! A second force that comes again with the way, with a length λ of its own, beside a `torque_ripple`:
//! poles beside slots, an arm's weight beside them both, two wheels of a gear.
//!
//! ```text
//! F = a_s sin(2π x/λ) + a_c (cos(2π x/λ) − 1)
//! ```
//!
//! Law, units and excitation are the first one's; nothing is left of it where both amplitudes are 0. It is looked for beside that only:
//! the strongest of several waves is told first, and what it explains is no longer there to be read off.
//!
//! Valid for: what the first is valid for. Overtones of one wave are ripples of their own. A third is not told: what is left is then
//! still a motion.
//!
//! Source: as of the first; orders of slots, poles and mechanical eccentricity stand beside each other in every motor.

use super::torque_ripple::{self, TorqueRipple};
use crate::description::{Description, OnMachine, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "A second force comes and goes with the way, with a length of its own: slots beside poles, another wheel of a gear.",
    equation: "F + a_s sin(2 pi x / lambda) + a_c (cos(2 pi x / lambda) - 1)",
}

pub(super) struct SecondRipple;

impl Law for SecondRipple {
    fn description(&self) -> &'static Description {
        &Description {
            name: "second_ripple",
            summary: SUMMARY,
            equation: EQUATION,
            check: "Turn the tool slowly by hand with the power off and feel for more notches among the first; count poles and slots, or the teeth of both wheels.",
            on_machine: Some(OnMachine {
                summary: None,
                shows_as: Some(
                    "a further ripple in the acceleration whose frequency goes with the speed, at the same places in every recording",
                ),
                check: "Turn the rig slowly with the power off and feel for more notches among the first; count poles and slots, or the teeth of both wheels.",
            }),
            shows_as: "a further ripple in the acceleration whose frequency goes with the speed, at the same places in every tightening",
            ..torque_ripple::DESCRIPTION
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, own: &[N]) -> Option<N> {
        TorqueRipple.force(p, at, own)
    }

    fn wavelength(&self) -> Option<usize> {
        TorqueRipple.wavelength()
    }

    fn beside(&self) -> Option<&'static str> {
        Some("torque_ripple")
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::SecondRipple, 1e-7);
    }
}
