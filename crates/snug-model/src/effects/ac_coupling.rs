//! The motion channel is coupled by a capacitor: what is slow does not come through: y' + ω_c y = q', ω_c = 2π f_c.
//!
//! With e what the measured displacement has more than the true one, all three of the motion pass the same filter:
//!
//! ```text
//! e'' = −ω_c (v + e')        x_measured = x + e, and so v + e', a + e''
//! ```
//!
//! f_c = 0 is the base model. Excited by motion that is slow for a while. In the residual it is what was measured before, with its sign changed and
//! ever less of it: an acceleration that lasts sags.
//!
//! Valid for: filters of first order, all channels behind the same one, at rest before the first sample; any amplitude.
//!
//! Source: piezoelectric sensors and the AC coupling of their amplifiers, whose lower limiting frequency (−3 dB) is f_c: Serridge and Licht (1987).

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Kinematics, Law};
use crate::numeric::number::Number;
use std::f64::consts::TAU;

state! {
    summary: "The motion channel is AC coupled: what is slow does not come through.",
    equation: "dy/dt + w y = dq/dt, q is the true motion, y is measured, w = 2 pi f_c",
}

pub(super) struct AcCoupling;

impl Law for AcCoupling {
    fn description(&self) -> &'static Description {
        &Description {
            name: "ac_coupling",
            kind: Kind::Measurement,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "corner_hz",
                meaning: "frequency below which nothing comes through",
                unit: "Hz",
                starts: &[0.5, 4.0],
                minimum: 0.0,
                maximum: 50.0,
                limits: (0.0, 200.0),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &["more_m", "more_m_per_s"],
            twins: &["maxwell_branch"],
            excited_by: "motion that is slow for a while: low frequencies, forces that last",
            shows_as: "misfit that is what was measured before, with its sign changed and ever less of it",
            check: "Look up the lower limiting frequency of sensor and amplifier, and whether the channel is AC or DC coupled; turn the sensor over by hand and see whether its reading sags.",
            on_machine: None,
            valid_for: "filters of first order, one for all channels of the motion, rest before the first sample; any amplitude",
            source: "Serridge and Licht 1987, Piezoelectric Accelerometers and Vibration Preamplifiers, Bruel and Kjaer",
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
        rates[0] = own[1];
        rates[1] = p[0] * -TAU * (at.v_m_per_s + own[1]);
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    /// 2 Hz: of a velocity of 0.7 m/s, of which 0.3 does not come through.
    #[test]
    fn what_comes_through_sags() {
        let (at, own) = (trial::at(0.0, 0.7), [1e-3, -0.3]);
        let mut rates = [0.0; 2];
        AcCoupling.rates(&[2.0], &at, &own, 5.0, &mut rates);
        trial::assert_near(rates[0], -0.3);
        trial::assert_near(rates[1], -2.0 * TAU * 0.4);
        let seen = AcCoupling.relative_motion(&[2.0], &at, &own, &rates);
        let seen = seen.expect("the sensor sees otherwise");
        trial::assert_near(seen.displacement_rad, 1e-3 / 0.33);
        trial::assert_near(seen.velocity_rad_per_s, -0.3 / 0.33);
        trial::assert_near(seen.acceleration_rad_per_s2, -0.8 * TAU / 0.33);
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::AcCoupling, 1e-9);
    }
}
