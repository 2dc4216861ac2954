//! An accelerometer with cross-sensitivities and a lag, and the velocity and displacement integrated from its signal.

use crate::law::Kinematics;
use crate::numeric::number::Number;
use crate::simulate::first_order::left_after;

/// What an accelerometer with cross-sensitivities and a lag makes of the motion, and what its integrated signals then show.
///
/// ```text
/// s = α + χ,  τ a' = s − a       χ: cross-sensitivity; sensed, measured [rad/s²]
/// ω_a = ω + ∫ χ − τ a            ∫ a, from rest [rad/s]
/// θ_a = θ + ∫∫ χ − τ ω_a         ∫ ω_a, from rest [rad]
/// ```
///
/// χ and s are taken as straight between samples, s as starting from zero one interval before the first; the lag's
/// recursion is then exact, also as τ → 0. Under a held input s jumps at the samples: it goes straight from there to where its mean over
/// the interval is the change of ω.
#[derive(Debug)]
pub struct Accelerometer<N: Number> {
    interval_s: N::Real,
    lag: Option<Lag<N>>,
    cross_sensitivity: N,
    leaked_velocity: N,
    leaked_displacement: N,
    sensed: N,
    measured: N,
    /// ω with what leaked in, where s jumps at the samples.
    jumps_from: Option<N>,
    started: bool,
}

/// a ← E a + A s + B s₊ for τ a' = s − a with s straight from s to s₊.
#[derive(Debug)]
struct Lag<N> {
    tau_s: N,
    keep: N,
    before: N,
    now: N,
}

impl<N: Number> Lag<N> {
    #[inline(always)]
    fn new(tau_s: N, interval_s: N::Real) -> Self {
        let ratio = tau_s.times(interval_s.constant(1.0) / interval_s);
        let keep = left_after(1.0, ratio);
        let mean = ratio * (-keep + 1.0);
        Self {
            tau_s,
            keep,
            before: mean - keep,
            now: -mean + 1.0,
        }
    }
}

impl<N: Number> Accelerometer<N> {
    /// At rest; samples are `interval_s` apart, `tau_s` is the lag's time constant if there is one, and the acceleration `jumps` at them.
    #[inline(always)]
    pub fn new(interval_s: N::Real, tau_s: Option<N>, jumps: bool) -> Self {
        let zero = N::from(interval_s.constant(0.0));
        Self {
            interval_s,
            lag: tau_s.map(|tau_s| Lag::new(tau_s, interval_s)),
            cross_sensitivity: zero,
            leaked_velocity: zero,
            leaked_displacement: zero,
            sensed: zero,
            measured: zero,
            jumps_from: jumps.then_some(zero),
            started: false,
        }
    }

    /// The next sample: true motion and what leaks in \[rad/s²\], to the motion as the sensor has it.
    #[inline(always)]
    pub fn sample(&mut self, motion: Kinematics<N>, cross_sensitivity: Option<N>) -> Kinematics<N> {
        let mut seen = motion;
        if let Some(cross_sensitivity) = cross_sensitivity {
            self.integrate(cross_sensitivity);
            seen.displacement_rad += self.leaked_displacement;
            seen.velocity_rad_per_s += self.leaked_velocity;
            seen.acceleration_rad_per_s2 += cross_sensitivity;
        }
        if let Some(lag) = &self.lag {
            let sensed = seen.acceleration_rad_per_s2;
            let reached = match &mut self.jumps_from {
                None => sensed,
                Some(before) if self.started => {
                    let gained = seen.velocity_rad_per_s - *before;
                    gained.times(self.interval_s.constant(2.0) / self.interval_s) - self.sensed
                }
                Some(_) => self.sensed,
            };
            if let Some(before) = &mut self.jumps_from {
                *before = seen.velocity_rad_per_s;
            }
            self.measured = lag.keep * self.measured + lag.before * self.sensed + lag.now * reached;
            self.sensed = sensed;
            seen.acceleration_rad_per_s2 = self.measured;
            seen.velocity_rad_per_s = seen.velocity_rad_per_s - lag.tau_s * self.measured;
            seen.displacement_rad = seen.displacement_rad - lag.tau_s * seen.velocity_rad_per_s;
        }
        self.started = true;
        seen
    }

    #[inline(always)]
    fn integrate(&mut self, cross_sensitivity: N) {
        let h = self.interval_s;
        if self.started {
            self.leaked_displacement += self.leaked_velocity.times(h)
                + (self.cross_sensitivity * 2.0 + cross_sensitivity).times(h * h * (1.0 / 6.0));
            self.leaked_velocity += (self.cross_sensitivity + cross_sensitivity).times(h * 0.5);
        }
        self.cross_sensitivity = cross_sensitivity;
    }
}
