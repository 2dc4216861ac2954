//! From the true motion to what the channels hold.

use crate::motion::plant::Plant;
use crate::motion::trajectory::Trajectory;
use crate::plan::CampaignPlan;
use crate::plan::effects::HiddenEffect;
use crate::plan::fault::Fault;
use crate::plan::sensors::ZeroErrors;
use crate::random::Stream;
use crate::random::noise::NoiseKind;
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::TAU;

/// Steps of the converters where a plan wants them: powers of two, exact in single precision.
const ACCELERATION_STEP_RAD_PER_S2: f64 = 1.0 / 32.0;
const TORQUE_STEP_NM: f64 = 1.0 / 256.0;
const FORCE_STEP_N: f64 = 1.0 / 16.0;

/// Torque at which the motor's vibration is fully there \[Nm\].
const VIBRATION_TORQUE_NM: f64 = 2.0;

/// The channels of one segment, in SI units.
pub(crate) struct Channels {
    pub(crate) torque_nm: Vec<f64>,
    pub(crate) acceleration_rad_per_s2: Vec<f64>,
    pub(crate) grip_force_n: Option<Vec<f64>>,
    /// Constant acceleration bias that was added.
    pub(crate) bias_rad_per_s2: f64,
    /// Samples of the segment that the file holds; less than all where it is truncated.
    pub(crate) kept: usize,
}

impl Channels {
    /// Applies a fault of the data.
    pub(crate) fn spoil(&mut self, fault: Fault, window: usize, plan: &CampaignPlan) {
        fault.spoil(
            window,
            plan.sample_rate_hz,
            &mut self.torque_nm,
            &mut self.acceleration_rad_per_s2,
        );
        if let Some(kept_s) = fault.kept_s(plan.quiet_s) {
            self.kept = self
                .kept
                .min((kept_s * plan.sample_rate_hz).round() as usize);
        }
    }
}

/// What the sensors make of `trajectory`, whose end is the segment's end; `window` is the index of the window's
/// first sample in the segment.
pub(crate) fn sense(
    plan: &CampaignPlan,
    plant: &Plant,
    trajectory: &Trajectory,
    window: usize,
    seed: u64,
    file: usize,
    index: usize,
) -> Channels {
    let samples = plan.segment_samples();
    let quiet = samples - trajectory.time_s.len();
    let sensors = &plan.sensors;
    let mut noise_rng = Stream::Noise.rng(seed, file, index);
    let mut noise = |kind: NoiseKind, deviation| kind.samples(deviation, samples, &mut noise_rng);
    let mut acceleration = noise(sensors.noise, sensors.acceleration_noise_rad_per_s2);
    let mut torque = noise(NoiseKind::White, sensors.torque_noise_nm);
    let mut force = noise(NoiseKind::White, sensors.force_noise_n);

    let nuisance = Nuisance::drawn(plan, seed, file, index);
    let errors = ConstantErrors::of(plant);
    let bias = nuisance.bias_rad_per_s2 + errors.bias_rad_per_s2;
    for sample in 0..samples {
        let in_window = sample >= window;
        let shown = in_window || sensors.zero_errors == ZeroErrors::WholeRecording;
        if shown {
            torque[sample] += errors.torque_offset_nm;
            acceleration[sample] += errors.bias_rad_per_s2;
        }
        if in_window {
            acceleration[sample] += errors.output_offset_rad_per_s2;
        }
        acceleration[sample] += nuisance.bias_rad_per_s2;
        if let Some(step) = sample.checked_sub(quiet) {
            torque[sample] += errors.torque_gain * trajectory.logged_torque_nm[step];
            acceleration[sample] += measured_acceleration(plant, trajectory, step);
            acceleration[sample] += nuisance.vibration_rad_per_s2(trajectory, step);
            force[sample] += trajectory.grip_force_n[step];
        }
    }
    let steps = |step: f64| sensors.quantised.then_some(step);
    Channels {
        torque_nm: converted(torque, steps(TORQUE_STEP_NM)),
        acceleration_rad_per_s2: converted(acceleration, steps(ACCELERATION_STEP_RAD_PER_S2)),
        grip_force_n: Some(converted(force, steps(FORCE_STEP_N))),
        bias_rad_per_s2: bias,
        kept: samples,
    }
}

/// α as the accelerometer has it: behind its lag, with what leaks in from ω and θ.
fn measured_acceleration(plant: &Plant, trajectory: &Trajectory, step: usize) -> f64 {
    let omega = trajectory.omega_rad_per_s[step];
    let mut measured = trajectory.sensed_acceleration_rad_per_s2[step];
    for law in &plant.laws {
        measured += match law.parts() {
            (HiddenEffect::CentripetalCrosstalk, [epsilon]) => epsilon * omega * omega,
            (HiddenEffect::GravityLeakage, [gamma]) => gamma * trajectory.theta_rad[step].sin(),
            _ => 0.0,
        };
    }
    measured
}

/// Sensor errors that do not depend on the motion.
struct ConstantErrors {
    torque_offset_nm: f64,
    torque_gain: f64,
    bias_rad_per_s2: f64,
    output_offset_rad_per_s2: f64,
}

impl ConstantErrors {
    fn of(plant: &Plant) -> Self {
        let mut errors = Self {
            torque_offset_nm: 0.0,
            torque_gain: 1.0,
            bias_rad_per_s2: 0.0,
            output_offset_rad_per_s2: 0.0,
        };
        for law in &plant.laws {
            match law.parts() {
                (HiddenEffect::TorqueOffset, [offset]) => errors.torque_offset_nm += offset,
                (HiddenEffect::TorqueGain, [gain_error]) => errors.torque_gain += gain_error,
                (HiddenEffect::AccelerationBias, [bias]) => errors.bias_rad_per_s2 += bias,
                (HiddenEffect::OutputOffset, [y0]) => errors.output_offset_rad_per_s2 += y0,
                _ => {}
            }
        }
        errors
    }
}

/// What disturbs without being a hidden effect.
struct Nuisance {
    bias_rad_per_s2: f64,
    amplitude_rad_per_s2: f64,
    frequency_hz: f64,
    phase_rad: f64,
}

impl Nuisance {
    fn drawn(plan: &CampaignPlan, seed: u64, file: usize, index: usize) -> Self {
        let mut rng = Stream::Nuisance.rng(seed, file, index);
        let standard: f64 = StandardNormal.sample(&mut rng);
        Self {
            bias_rad_per_s2: plan.sensors.bias_sd_rad_per_s2 * standard,
            amplitude_rad_per_s2: plan.sensors.vibration_rad_per_s2 * rng.random_range(0.7..1.3),
            frequency_hz: rng.random_range(150.0..400.0),
            phase_rad: rng.random_range(0.0..TAU),
        }
    }

    fn vibration_rad_per_s2(&self, trajectory: &Trajectory, step: usize) -> f64 {
        let share = (trajectory.acting_torque_nm[step] / VIBRATION_TORQUE_NM).min(1.0);
        let turn = TAU * self.frequency_hz * trajectory.time_s[step] + self.phase_rad;
        self.amplitude_rad_per_s2 * share * turn.sin()
    }
}

/// Rounded to the converter's steps, if it has any, and to single precision, as the thesis' files hold it.
fn converted(mut samples: Vec<f64>, step: Option<f64>) -> Vec<f64> {
    for sample in &mut samples {
        if let Some(step) = step {
            *sample = (*sample / step).round() * step;
        }
        *sample = f64::from(*sample as f32);
    }
    samples
}
