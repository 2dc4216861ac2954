//! What is driven and what is measured are not one place: between them something bends, with a frequency of its own.
//!
//! ```text
//! q'' + 2 ζ ω q' + ω² q = r T / l + κ v,  ω = 2π f        x_measured = x + q,  and so v + q', a + q''
//! ```
//!
//! With κ = 0 the two are as good as apart: a rig whose damping is spread as its masses or its springs are. Where a damper sits in
//! one place (a suspension, a coupling of rubber) the modes drive each other, and κ makes the sum exact: poles, zeros and gain
//! of every linear rig of two masses, driven and measured anywhere, are seven numbers, m, c, k, r, f, ζ and κ.
//!
//! The second term of the modal sum: r > 0 where both places move to the same side in this mode, as where driven and measured
//! are one, r < 0 where they move against each other; r = κ = 0 is the base model. Mechanics itself stays the base model's, so that
//! no energy balance holds for the measured motion. Excited by torque near f. In the residual it rings at f, in the
//! acceleration most, and follows the torque at once.
//!
//! Valid for: small bending, one further mode, the same place and torque throughout; linear, any amplitude. Below f it is a
//! compliance r/ω² between the two places.
//!
//! Source: modal superposition (Ewins, Modal Testing): real residues of proportionally damped modes, either sign; complex ones of
//! modes that are not proportionally damped are carried by κ.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{ExcitedBy, Instant, Kinematics, Law, Resonance};
use crate::numeric::number::Number;
use crate::resonance::{DAMPING_RATIO, FREQUENCY};
use std::f64::consts::TAU;

state! {
    summary: "Something between motor and sensor bends: a second mode rings beside the first.",
    equation: "q'' + 2 zeta w q' + w^2 q = r T / l + kappa v,  x + q, v + q', a + q'' measured,  w = 2 pi f",
}

pub(super) struct SecondMode;

impl Law for SecondMode {
    fn description(&self) -> &'static Description {
        &Description {
            name: "second_mode",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "residue_per_kg",
                    meaning: "residue",
                    unit: "1/kg",
                    starts: &[0.1],
                    minimum: -5.0,
                    maximum: 5.0,
                    limits: (-50.0, 50.0),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                FREQUENCY,
                DAMPING_RATIO,
                ParameterSpec {
                    name: "coupling_per_s",
                    meaning: "coupling to the speed of the first mode",
                    unit: "1/s",
                    starts: &[0.0],
                    minimum: -1e3,
                    maximum: 1e3,
                    limits: (-1e4, 1e4),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
            ],
            states: &["mode_m", "mode_m_per_s"],
            twins: &["second_mass", "attached_mass"],
            excited_by: "torque with power near the frequency of the mode: sweeps, steps, noise",
            shows_as: "ringing at a second frequency that the torque excites at once, or a dip between two resonances",
            check: "Tap the rig beside the sensor and at the drive and compare the ringing; clamp the sensor nearer to the drive and repeat.",
            on_machine: None,
            valid_for: "small bending and one further mode; torque and sensor at the same places throughout; any amplitude",
            source: "Ewins 2000, Modal Testing: Theory, Practice and Application, Research Studies Press",
        }
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
        let omega = p[1] * TAU;
        let force_n = at
            .torque_nm
            .times(at.lever_arm_m.constant(1.0) / at.lever_arm_m);
        rates[0] = own[1];
        rates[1] =
            p[0] * force_n + p[3] * at.v_m_per_s - omega * (p[2] * own[1] * 2.0 + omega * own[0]);
        Some(())
    }

    #[inline(always)]
    fn relative_motion<N: Number>(
        &self,
        _p: &[N],
        at: &Instant<N>,
        own: &[N],
        own_rates: &[N],
    ) -> Option<Kinematics<N>> {
        Some(Kinematics::of_states(at, own, own_rates))
    }

    fn resonance(&self) -> Option<Resonance> {
        Some(Resonance {
            size: 0,
            frequency: 1,
            damping: 2,
            excited_by: ExcitedBy::Torque,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn the_torque_drives_it_and_the_sensor_sees_its_share() {
        let (p, own) = ([-0.4, 25.0, 0.05, 3.0], [1e-3, 0.2]);
        let (at, omega) = (trial::at(0.0, 0.7), TAU * 25.0);
        let mut rates = [0.0; 2];
        SecondMode.rates(&p, &at, &own, 5.0, &mut rates);
        trial::assert_near(rates[0], 0.2);
        let expected =
            -0.4 * 20.0 / 0.33 + 3.0 * 0.7 - 2.0 * 0.05 * omega * 0.2 - omega * omega * 1e-3;
        trial::assert_near(rates[1], expected);
        let seen = SecondMode.relative_motion(&p, &at, &own, &rates);
        let seen = seen.expect("the sensor is elsewhere");
        trial::assert_near(seen.displacement_rad, 1e-3 / 0.33);
        trial::assert_near(seen.velocity_rad_per_s, 0.2 / 0.33);
        trial::assert_near(seen.acceleration_rad_per_s2, expected / 0.33);
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::SecondMode, 1e-7);
    }
}
