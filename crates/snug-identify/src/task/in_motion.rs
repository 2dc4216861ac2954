//! Whether a recording of a speed begins in motion.

use crate::task::FitTask;
use snug_campaign::Quantity;
use snug_model::BASE_PARAMETERS;
use snug_signal::white_noise_level;

/// Speed at the first sample, over its root mean square in the recording, from which it begins in motion \[–\]. Chosen.
const IN_MOTION: f64 = 0.1;
/// The same over the white noise of single samples \[–\]: five hardly ever come by chance.
const BEYOND_NOISE: f64 = 5.0;
/// Torque up to which none acts, over its root mean square in the recording \[–\]. Chosen.
const NO_TORQUE: f64 = 0.05;
/// Share of the speed that a freely turning rig must lose while no torque acts, so that one that loses none is seen to rest \[–\]. Chosen.
const LOSES: f64 = 0.1;
/// Share of that loss below which it loses none \[–\]. Chosen.
const LOSES_NONE: f64 = 0.2;

impl FitTask<'_> {
    /// Whether the speed at the first sample is no noise, no little of what it is elsewhere, and no error of the sensor: a rig that turns
    /// while no torque acts on it loses speed by its damping, here with m, c, k \[kg, kg/s, N/m\] as `base`, where they are known. An
    /// angle's slope at its first sample is too uncertain to say it.
    pub fn begins_in_motion(&self, base: Option<[f64; BASE_PARAMETERS.len()]>) -> bool {
        let speeds = self.measured();
        let Some(first) = (speeds.first()).filter(|_| self.quantity() == Quantity::Velocity) else {
            return false;
        };
        let least =
            (IN_MOTION * root_mean_square(speeds)).max(BEYOND_NOISE * white_noise_level(speeds));
        first.abs() > least && !base.is_some_and(|base| self.rests_at_an_offset(base))
    }

    /// Whether what it shows before any torque acts stays what it is where a turning rig would have slowed down.
    fn rests_at_an_offset(&self, [mass, damping, _]: [f64; BASE_PARAMETERS.len()]) -> bool {
        let torques = &self.tightening.torque_nm;
        let none = NO_TORQUE * root_mean_square(torques);
        let free = torques
            .iter()
            .take_while(|torque| torque.abs() <= none)
            .count();
        let (speeds, quarter) = (&self.measured()[..free], free / 4);
        if quarter == 0 {
            return false;
        }
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let (begin, end) = (mean(&speeds[..quarter]), mean(&speeds[free - quarter..]));
        let rig = self.model.rig();
        let square = rig.lever_arm_m * rig.lever_arm_m;
        let rate_per_s = damping * square / (rig.known_inertia_kg_m2 + mass * square);
        let apart_s = (free - quarter) as f64 * self.tightening.time_base.interval_s;
        let loss = 1.0 - (-rate_per_s * apart_s).exp();
        loss > LOSES && (1.0 - end / begin).abs() < LOSES_NONE * loss
    }
}

fn root_mean_square(values: &[f64]) -> f64 {
    let squares: f64 = values.iter().map(|value| value * value).sum();
    (squares / values.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use snug_campaign::Rig;

    /// 0.02 kg/s on 0.01 kg at an arm of 1 m: a free speed falls by e every half second.
    const BASE: Option<[f64; 3]> = Some([0.01, 0.02, 0.0]);

    /// 2 s at 1 kHz: no torque for so many samples, then 1 Nm; the speed before is as told, then 20 rad/s.
    fn begins(free: usize, speed: impl Fn(f64) -> f64, base: Option<[f64; 3]>) -> bool {
        let torque_nm: Vec<f64> = (0..2000).map(|k| f64::from(u8::from(k >= free))).collect();
        let speeds = (0..2000).map(|k| {
            if k < free {
                speed(k as f64 * 1e-3)
            } else {
                20.0
            }
        });
        let rig = Rig {
            lever_arm_m: 1.0,
            known_inertia_kg_m2: 0.0,
        };
        let output = speeds.collect();
        let task = FitTask::from_arrays(rig, 1e-3, torque_nm, Quantity::Velocity, output);
        task.expect("its parts agree").begins_in_motion(base)
    }

    #[test]
    fn what_slows_down_or_is_driven_moves() {
        assert!(begins(400, |t_s| 3.0 * (-2.0 * t_s).exp(), BASE));
        assert!(begins(0, |_| 0.0, BASE));
        assert!(!begins(400, |_| 0.5, BASE), "that is little");
    }

    #[test]
    fn what_stays_as_it_is_without_torque_rests_beside_an_error_of_its_sensor() {
        assert!(!begins(400, |_| 3.0, BASE));
        assert!(
            begins(400, |_| 3.0, None),
            "nobody knows how it would slow down"
        );
        assert!(begins(20, |_| 3.0, BASE), "it has hardly had time to");
    }
}
