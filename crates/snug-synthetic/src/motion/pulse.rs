//! The torque of a tightening in closed form, to be had at any instant: rundown, snug point, ramp, shut-off.

use crate::plan::fault::Fault;
use crate::plan::file::{FilePlan, Joint, Strategy};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::PI;

/// A slower stretch in the middle of the ramp, where Quick Step changes its speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dwell {
    /// Its middle, as a share of the ramp's duration.
    pub middle_ratio: f64,
    /// Half its length, as a share of the ramp's duration.
    pub half_length_ratio: f64,
    /// How far the ramp slows down in its middle: 0 not at all, 1 to a stop.
    pub depth_ratio: f64,
}

/// Joint torque of one tightening as a continuous function of time since the window's start.
///
/// ```text
/// rundown   T = T_r s((t − t_0)/t_rise)                     s(u) = 3u² − 2u³ from 0 to 1
/// ramp      T = T_r + (T_p − T_r)(e^{a u} − 1)/(e^a − 1)    u from 0 to 1 over the ramp, slowed by the dwell
/// shut-off  T = T_p exp(−((t − t_p)/w)²)
/// ```
///
/// It is zero before `start_s`, and `peak_nm` is its largest value, taken at [`Pulse::peak_s`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// t_0, where torque begins \[s\].
    pub start_s: f64,
    /// T_r, torque of the rundown \[Nm\].
    pub rundown_nm: f64,
    /// t_rise, time in which the rundown's torque comes up \[s\].
    pub rundown_rise_s: f64,
    /// Snug point: where the ramp begins \[s\].
    pub snug_s: f64,
    /// Length of the ramp \[s\].
    pub ramp_s: f64,
    /// a, curvature of the ramp, without unit; positive: steeper towards the end.
    pub curvature: f64,
    /// The change of speed, if the strategy has one.
    pub dwell: Option<Dwell>,
    /// T_p, peak torque \[Nm\].
    pub peak_nm: f64,
    /// w, width of the shut-off \[s\].
    pub release_s: f64,
}

impl Pulse {
    /// A pulse as this file's strategy and joint give it: nominal torque 15 to 40 Nm in steps of 5, overrun by about
    /// 2 Nm; the ramp takes 22 to 130 ms.
    pub(crate) fn drawn(file: &FilePlan, rng: &mut ChaCha8Rng) -> Self {
        let quick_step = file.strategy == Strategy::QuickStep;
        let nominal_nm = 5.0 * f64::from(rng.random_range(3..=8_u32));
        let overrun: f64 = StandardNormal.sample(rng);
        let ramp_s = match (file.strategy, file.joint) {
            (Strategy::QuickStep, Joint::Soft) => rng.random_range(0.090..0.130),
            (Strategy::QuickStep, Joint::Hard) => rng.random_range(0.045..0.065),
            (Strategy::TurboTight, Joint::Soft) => rng.random_range(0.045..0.075),
            (Strategy::TurboTight, Joint::Hard) => rng.random_range(0.022..0.034),
        };
        let dwell = Dwell {
            middle_ratio: rng.random_range(0.25..0.40),
            half_length_ratio: 0.12,
            depth_ratio: rng.random_range(0.7..0.95),
        };
        Self {
            start_s: rng.random_range(0.0..0.001),
            rundown_nm: rng.random_range(0.9..1.5),
            rundown_rise_s: 0.011,
            snug_s: rng.random_range(0.022..0.029),
            ramp_s,
            curvature: rng.random_range(0.8..1.5),
            dwell: quick_step.then_some(dwell),
            peak_nm: nominal_nm + 2.0 + 0.25 * overrun,
            release_s: rng.random_range(0.006..0.009),
        }
    }

    /// Time of the peak \[s\].
    pub fn peak_s(&self) -> f64 {
        self.snug_s + self.ramp_s
    }

    /// Torque at `time_s` \[Nm\].
    pub fn at(&self, time_s: f64) -> f64 {
        if time_s <= self.start_s {
            0.0
        } else if time_s < self.snug_s {
            self.rundown_nm * smooth_step((time_s - self.start_s) / self.rundown_rise_s)
        } else if time_s < self.peak_s() {
            let share = self.ramp_share(time_s - self.snug_s);
            let shape = (self.curvature * share).exp_m1() / self.curvature.exp_m1();
            self.rundown_nm + (self.peak_nm - self.rundown_nm) * shape
        } else {
            let past = (time_s - self.peak_s()) / self.release_s;
            self.peak_nm * (-past * past).exp()
        }
    }

    /// Where a derivative of the torque jumps \[s\]; integration steps end there.
    pub fn knots_s(&self) -> [f64; 4] {
        [
            self.start_s,
            self.start_s + self.rundown_rise_s,
            self.snug_s,
            self.peak_s(),
        ]
    }

    /// The same pulse, later and smaller: what a second hit looks like.
    pub fn repeated(&self, later_s: f64, ratio: f64) -> Self {
        Self {
            start_s: self.start_s + later_s,
            snug_s: self.snug_s + later_s,
            rundown_nm: self.rundown_nm * ratio,
            peak_nm: self.peak_nm * ratio,
            ..*self
        }
    }

    /// Share of the ramp that is done after `elapsed_s`.
    fn ramp_share(&self, elapsed_s: f64) -> f64 {
        let Some(dwell) = self.dwell else {
            return elapsed_s / self.ramp_s;
        };
        let (middle, half) = (dwell.middle_ratio, dwell.half_length_ratio);
        // Integral of the raised cosine that slows the ramp down.
        let lost = |u: f64| {
            let offset = (u - middle).clamp(-half, half);
            dwell.depth_ratio * 0.5 * (offset + half + half / PI * (PI * offset / half).sin())
        };
        let u = elapsed_s / self.ramp_s;
        (u - lost(u)) / (1.0 - lost(1.0))
    }
}

/// s(u) = 3u² − 2u³, held at 0 below and at 1 above.
pub(crate) fn smooth_step(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u * u * (3.0 - 2.0 * u)
}

/// How much later the second hit of a double hit comes \[s\].
const SECOND_HIT_AFTER_S: f64 = 0.11;

impl Fault {
    /// The pulses that a tightening with this fault really has, when `pulse` was meant.
    pub(crate) fn pulses(self, pulse: Pulse) -> Vec<Pulse> {
        match self {
            Self::NoPulse => Vec::new(),
            Self::DoubleHit => vec![pulse, pulse.repeated(SECOND_HIT_AFTER_S, 0.6)],
            Self::Truncated | Self::SaturatedTorque | Self::Gap | Self::SilentRest => vec![pulse],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quick_step() -> Pulse {
        Pulse {
            start_s: 0.0,
            rundown_nm: 1.2,
            rundown_rise_s: 0.01,
            snug_s: 0.025,
            ramp_s: 0.055,
            curvature: 1.0,
            dwell: Some(Dwell {
                middle_ratio: 0.35,
                half_length_ratio: 0.15,
                depth_ratio: 0.9,
            }),
            peak_nm: 32.0,
            release_s: 0.007,
        }
    }

    #[test]
    fn peaks_at_its_target_and_nowhere_else() {
        let pulse = quick_step();
        assert!((pulse.at(pulse.peak_s()) - 32.0).abs() < 1e-12);
        let largest = (0..30_000)
            .map(|index| pulse.at(index as f64 * 1e-5))
            .fold(0.0, f64::max);
        assert!(largest <= 32.0 && largest > 31.99, "{largest}");
    }

    #[test]
    fn is_continuous_at_every_knot_and_rises_until_the_peak() {
        let pulse = quick_step();
        for knot in pulse.knots_s() {
            let jump = pulse.at(knot + 1e-12) - pulse.at(knot - 1e-12);
            assert!(jump.abs() < 1e-7, "{jump} at {knot}");
        }
        let mut before = 0.0;
        for index in 0..8000 {
            let now = pulse.at(index as f64 * 1e-5);
            assert!(now >= before - 1e-12);
            before = now;
        }
    }

    #[test]
    fn the_dwell_slows_the_ramp_in_its_middle() {
        let pulse = quick_step();
        let speed = |share: f64| {
            let time_s = pulse.snug_s + share * pulse.ramp_s;
            (pulse.at(time_s + 1e-6) - pulse.at(time_s - 1e-6)) / 2e-6
        };
        assert!(speed(0.35) < 0.25 * speed(0.1));
        assert!(speed(0.35) < 0.25 * speed(0.7));
    }

    #[test]
    fn is_gone_soon_after_the_shut_off() {
        let pulse = quick_step();
        assert!(pulse.at(pulse.peak_s() + 0.03) < 1e-5);
        assert_eq!(pulse.at(-0.1), 0.0);
    }
}
