use crate::accelerometer::Accelerometer;
use crate::effect::{Kinematics, Law};
use crate::model::{Assembly, Part};
use crate::{Input, Number};

/// From the true motion to the measured one: leaks and lag of the accelerometer, then what is added to its signals.
pub struct Sensors<'a, N> {
    parts: &'a [Part],
    p: &'a [N],
    input: &'a Input,
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
            accelerometer: None,
        };
        let lag = sensors.total(|effect, p| effect.acceleration_lag_s(p));
        if lag.is_some() || sensors.leak(&still).is_some() {
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
            let leak = self.leak(&motion);
            if let Some(accelerometer) = &mut self.accelerometer {
                seen = accelerometer.sample(motion, leak);
            }
        }
        let since_rest_s = self.input.since_rest_s(index);
        self.parts.iter().fold(seen, |motion, part| {
            let own = &self.p[part.parameters.clone()];
            part.effect.measure(own, since_rest_s, motion)
        })
    }

    fn leak(&self, motion: &Kinematics<N>) -> Option<N> {
        self.total(|effect, p| effect.leak(p, motion))
    }

    /// The sum of what the effects add to the same place, if any adds to it.
    fn total(&self, of: impl Fn(crate::Effect, &[N]) -> Option<N>) -> Option<N> {
        self.parts
            .iter()
            .filter_map(|part| of(part.effect, &self.p[part.parameters.clone()]))
            .reduce(|sum, more| sum + more)
    }
}
