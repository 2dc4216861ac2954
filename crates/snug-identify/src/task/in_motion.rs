//! Whether recordings begin in motion, or away from where the sensor reads nothing.

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

/// Whether any of a machine's recordings begins in motion: whether its speed at the first sample is no noise, no little of what it is
/// elsewhere, and no error of the sensor. A rig that turns while no torque acts on it loses speed by its damping, here with m, c, k
/// \[kg, kg/s, N/m\] as `base`, where they are known; what one shows that loses none is what the sensor reads at rest, in all of them. An
/// angle's slope at its first sample is too uncertain to say it. Where no torque acts in any of them, there is nothing else that could move
/// them.
pub fn begin_in_motion(
    recordings: &[FitTask<'_>],
    base: Option<[f64; BASE_PARAMETERS.len()]>,
) -> bool {
    if !recordings.is_empty() && recordings.iter().all(FitTask::is_undriven) {
        return true;
    }
    let all: Vec<(&FitTask<'_>, Beginning)> = (recordings.iter())
        .filter_map(|task| Some((task, Beginning::of(task)?)))
        .collect();
    let shifted = all.iter().filter(|(_, beginning)| beginning.is_beyond(0.0));
    let at_rest: Vec<f64> = shifted
        .filter_map(|(task, _)| task.speed_at_rest(base?))
        .collect();
    let offset = at_rest.iter().sum::<f64>() / at_rest.len().max(1) as f64;
    all.iter().any(|(_, one)| one.is_beyond(offset))
}

/// Angle at the first sample, over its root mean square about the mean, from which a recording begins elsewhere \[–\]. Chosen.
const ELSEWHERE: f64 = 0.02;

/// Whether any of the recordings of an angle begins where the sensor reads more than noise and a little of the way that it goes.
pub fn begin_elsewhere(recordings: &[FitTask<'_>]) -> bool {
    let of_angle = |task: &&FitTask<'_>| task.quantity() == Quantity::Displacement;
    recordings.iter().filter(of_angle).any(|task| {
        let angle = task.measured();
        let mean = angle.iter().sum::<f64>() / angle.len().max(1) as f64;
        let about_mean: Vec<f64> = angle.iter().map(|angle| angle - mean).collect();
        let noise = BEYOND_NOISE * white_noise_level(angle);
        let least = (ELSEWHERE * root_mean_square(&about_mean)).max(noise);
        angle.first().is_some_and(|first| first.abs() > least)
    })
}

/// How a recording of a speed begins.
struct Beginning {
    /// Of the first sample \[the output's unit\].
    speed: f64,
    /// From which on that is no noise and no little \[the output's unit\].
    least: f64,
}

impl Beginning {
    fn of(task: &FitTask<'_>) -> Option<Self> {
        let speeds = task.measured();
        let speed = *(speeds.first()).filter(|_| task.quantity() == Quantity::Velocity)?;
        let noise = BEYOND_NOISE * white_noise_level(speeds);
        Some(Self {
            speed,
            least: (IN_MOTION * root_mean_square(speeds)).max(noise),
        })
    }

    fn is_beyond(&self, offset: f64) -> bool {
        (self.speed - offset).abs() > self.least
    }
}

impl FitTask<'_> {
    /// Whether no torque acts from its first sample to its last.
    pub fn is_undriven(&self) -> bool {
        let torques = &self.tightening.torque_nm;
        torques.iter().all(|torque_nm| *torque_nm == 0.0)
    }

    /// How large a torque moves what is known of the rig, its own inertia or a mass, damping or stiffness that is held, by this angle in
    /// this time \[Nm\]; `None` where nothing is.
    pub fn known_torque(&self, angle_rad: f64, time_s: f64) -> Option<f64> {
        let rig = self.model.rig();
        let square = rig.lever_arm_m * rig.lever_arm_m;
        let base = &self.model.parameters()[..BASE_PARAMETERS.len()];
        let held = |index: usize| match base[index].fixed {
            true => base[index].value * square,
            false => 0.0,
        };
        let inertia_kg_m2 = rig.known_inertia_kg_m2 + held(0);
        let torques_nm = [
            inertia_kg_m2 * angle_rad / (time_s * time_s),
            held(1) * angle_rad / time_s,
            held(2) * angle_rad,
        ];
        let largest = torques_nm.into_iter().fold(0.0, f64::max);
        (largest > 0.0).then_some(largest)
    }

    /// What it shows before any torque acts, where that stays what it is while a turning rig would have slowed down.
    fn speed_at_rest(&self, [mass, damping, _]: [f64; BASE_PARAMETERS.len()]) -> Option<f64> {
        let torques = &self.tightening.torque_nm;
        let none = NO_TORQUE * root_mean_square(torques);
        let free = torques
            .iter()
            .take_while(|torque| torque.abs() <= none)
            .count();
        let (speeds, quarter) = (&self.measured()[..free], free / 4);
        if quarter == 0 {
            return None;
        }
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let (begin, end) = (mean(&speeds[..quarter]), mean(&speeds[free - quarter..]));
        let rig = self.model.rig();
        let square = rig.lever_arm_m * rig.lever_arm_m;
        let rate_per_s = damping * square / (rig.known_inertia_kg_m2 + mass * square);
        let apart_s = (free - quarter) as f64 * self.tightening.time_base.interval_s;
        let loss = 1.0 - (-rate_per_s * apart_s).exp();
        let stays = loss > LOSES && (1.0 - end / begin).abs() < LOSES_NONE * loss;
        stays.then(|| mean(speeds))
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

    /// 2 s at 1 kHz: no torque for so many samples, then 1 Nm; the speed before is as told, then 20 rad/s more than at rest.
    fn recording(free: usize, at_rest: f64, speed: impl Fn(f64) -> f64) -> FitTask<'static> {
        let torque_nm: Vec<f64> = (0..2000).map(|k| f64::from(u8::from(k >= free))).collect();
        let speeds = (0..2000).map(|k| match k < free {
            true => speed(k as f64 * 1e-3),
            false => at_rest + 20.0,
        });
        let rig = Rig {
            lever_arm_m: 1.0,
            known_inertia_kg_m2: 0.0,
        };
        let output = speeds.collect();
        FitTask::from_arrays(rig, 1e-3, torque_nm, Quantity::Velocity, output)
            .expect("its parts agree")
    }

    fn begins(free: usize, speed: impl Fn(f64) -> f64, base: Option<[f64; 3]>) -> bool {
        begin_in_motion(&[recording(free, 0.0, speed)], base)
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

    #[test]
    fn an_angle_begins_elsewhere_where_the_sensor_reads_more_than_a_little() {
        let begins_at = |first: f64| {
            let rig = Rig {
                lever_arm_m: 1.0,
                known_inertia_kg_m2: 0.0,
            };
            let angle = (0..2000).map(|k| first + (0.01 * f64::from(k)).sin());
            let torque_nm = vec![1.0; 2000];
            FitTask::from_arrays(
                rig,
                1e-3,
                torque_nm,
                Quantity::Displacement,
                angle.collect(),
            )
            .expect("its parts agree")
        };
        assert!(begin_elsewhere(&[begins_at(0.0), begins_at(-0.1)]));
        assert!(!begin_elsewhere(&[begins_at(0.0), begins_at(0.01)]));
        assert!(
            !begin_elsewhere(&[recording(1, 3.0, |_| 3.0)]),
            "a speed is no angle"
        );
    }

    #[test]
    fn what_the_sensor_of_one_reads_at_rest_that_of_the_others_reads_too() {
        let resting = || recording(2000, 0.0, |_| 3.0);
        let driven_at_once = |first: f64| {
            let begins = move |t_s: f64| if t_s < 0.5e-3 { first } else { 23.0 };
            recording(1, 3.0, begins)
        };
        assert!(!begin_in_motion(&[resting(), driven_at_once(3.0)], BASE));
        assert!(begin_in_motion(&[resting(), driven_at_once(15.0)], BASE));
        assert!(begin_in_motion(&[driven_at_once(3.0)], BASE));
        assert!(!begin_in_motion(&[], BASE));
    }
}
