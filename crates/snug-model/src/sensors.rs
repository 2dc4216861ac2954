use crate::accelerometer::Accelerometer;
use crate::acting_torque::{ActingTorque, with_added_torque};
use crate::assembly::{Assembly, Part};
use crate::effect::{Instant, Kinematics, Law};
use crate::{Input, Number};

/// From the true motion to the measured one: leaks and lag of the accelerometer, then what is added to its signals.
pub struct Sensors<'a, N> {
    parts: &'a [Part],
    p: &'a [N],
    input: &'a Input,
    lever_arm_m: f64,
    acting_torque: ActingTorque<'a, N>,
    /// Absent when no effect of the assembly needs it.
    accelerometer: Option<Accelerometer<N>>,
}

impl<'a, N: Number> Sensors<'a, N> {
    /// At rest before the first sample.
    pub fn new(assembly: &'a Assembly, p: &'a [N], input: &'a Input) -> Self {
        let still = Kinematics {
            displacement_rad: N::from(0.0),
            velocity_rad_per_s: N::from(0.0),
            acceleration_rad_per_s2: N::from(0.0),
        };
        let mut sensors = Self {
            parts: assembly.parts(),
            p,
            input,
            lever_arm_m: assembly.rig().lever_arm_m,
            acting_torque: ActingTorque::new(assembly.parts(), p, input),
            accelerometer: None,
        };
        let lag = sensors.total(|effect, p| effect.acceleration_lag_s(p));
        if lag.is_some() || sensors.leak(0, &still).is_some() {
            let interval_s = input.since_rest_s(1) - input.since_rest_s(0);
            sensors.accelerometer = Some(Accelerometer::new(interval_s, lag));
        }
        sensors
    }

    /// The measured motion of the next sample, which is number `index`.
    #[inline(always)]
    pub fn sample(&mut self, index: usize, motion: Kinematics<N>) -> Kinematics<N> {
        let mut seen = motion;
        if self.accelerometer.is_some() {
            let leak = self.leak(index, &motion);
            if let Some(accelerometer) = &mut self.accelerometer {
                seen = accelerometer.sample(motion, leak);
            }
        }
        let since_rest_s = self.input.since_rest_s(index);
        self.parts.iter().fold(seen, |motion, part| {
            let own = &self.p[part.parameters.clone()];
            let measured = part.effect.measure(own, since_rest_s, motion);
            measured.unwrap_or(motion)
        })
    }

    /// Whether an effect of the assembly changes what is measured of the motion.
    pub fn are_heard(&self) -> bool {
        self.parts.iter().any(|part| part.effect.measurement_only())
    }

    fn leak(&self, index: usize, motion: &Kinematics<N>) -> Option<N> {
        let at = self.instant(index, motion);
        self.total(|effect, p| effect.leak(p, &at, motion))
    }

    /// The instant of sample `index`, at which the true motion is `motion`.
    fn instant(&self, index: usize, motion: &Kinematics<N>) -> Instant<N> {
        let point = index * self.input.substeps();
        let at = Instant {
            torque_nm: self.acting_torque.at(point),
            x_m: motion.displacement_rad * self.lever_arm_m,
            v_m_per_s: motion.velocity_rad_per_s * self.lever_arm_m,
            since_onset_s: point as f64 * self.input.grid_interval_s() - self.input.onset_s(),
            lever_arm_m: self.lever_arm_m,
        };
        with_added_torque(self.parts, self.p, at)
    }

    /// The sum of what the effects add to the same place, if any adds to it.
    fn total(&self, of: impl Fn(crate::Effect, &[N]) -> Option<N>) -> Option<N> {
        self.parts
            .iter()
            .filter_map(|part| of(part.effect, &self.p[part.parameters.clone()]))
            .reduce(|sum, more| sum + more)
    }
}
