//! Signals of an invented tightening: an oscillator under a torque pulse, stepped sample by sample, with seeded noise.

use snug_campaign::{Motion, Rig, TimeBase, Traces};

/// Standard deviation of the invented acceleration noise [rad/s²].
pub const ACCELERATION_NOISE: f64 = 0.9;
const SAMPLES: usize = 3000;
const STEP_S: f64 = 1e-4;

/// Reproducible normal numbers: a 64-bit congruential generator and the Box–Muller transform.
pub struct Noise {
    state: u64,
}

impl Noise {
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    fn uniform(&mut self) -> f64 {
        self.state = self
            .state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.state >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// A hand–arm with a tool and a torque pulse.
pub struct Oscillator {
    pub mass_kg: f64,
    pub damping_kg_per_s: f64,
    pub stiffness_n_per_m: f64,
    pub peak_torque_nm: f64,
    pub rise_s: f64,
    pub rig: Rig,
    pub grip_force: bool,
}

impl Oscillator {
    fn torque_nm(&self, time_s: f64) -> f64 {
        let start_s = 0.02;
        let share = (time_s - start_s) / self.rise_s;
        let release = (time_s - start_s - self.rise_s) / 0.008;
        match share {
            share if share < 0.0 => 0.0,
            share if share < 1.0 => self.peak_torque_nm * share.powf(1.6),
            _ => self.peak_torque_nm * (1.0 - release).max(0.0),
        }
    }

    /// Signals of one tightening; `wobble` is an unexplained oscillation in the measurement [rad/s²].
    pub fn traces(&self, noise: &mut Noise, wobble: f64) -> Traces {
        let arm = self.rig.lever_arm_m;
        let inertia = self.rig.known_inertia_kg_m2 + self.mass_kg * arm * arm;
        let (mut angle, mut velocity) = (0.0_f64, 0.0_f64);
        let mut traces = blank();
        let mut simulated = [const { Vec::new() }; 3];
        let mut measured = [const { Vec::new() }; 3];
        let mut grip = Vec::new();
        for index in 0..SAMPLES {
            let time_s = index as f64 * STEP_S;
            let torque = self.torque_nm(time_s);
            let force = arm * (self.damping_kg_per_s * velocity + self.stiffness_n_per_m * angle);
            let acceleration = (torque - arm * force) / inertia;
            let phase = 2.0 * std::f64::consts::PI * 27.0 * time_s;
            let seen = acceleration + ACCELERATION_NOISE * noise.normal() + wobble * phase.sin();
            let extra = wobble / 27.0_f64.powi(2) / 39.5 * (phase - phase.sin());
            for (signals, values) in [
                (&mut simulated, [angle, velocity, acceleration]),
                (&mut measured, [angle + extra, velocity, seen]),
            ] {
                for (signal, value) in signals.iter_mut().zip(values) {
                    signal.push(value);
                }
            }
            let inertia_n = self.rig.known_inertia_kg_m2;
            traces.torque_nm.push(torque);
            traces.euler_displacement_rad.push(angle * 0.994);
            traces.force_f1_n.push(force);
            traces.force_f2_n.push((torque - inertia_n * seen) / arm);
            traces
                .force_f3_n
                .push((torque - inertia_n * acceleration) / arm);
            grip.push((torque - inertia_n * acceleration) / arm * 0.97 + 0.8 * noise.normal());
            velocity += STEP_S * acceleration;
            angle += STEP_S * velocity;
        }
        traces.measured = motion(measured);
        traces.simulated = motion(simulated);
        traces.grip_force_n = self.grip_force.then_some(grip);
        traces
    }
}

fn motion([angle, velocity, acceleration]: [Vec<f64>; 3]) -> Motion {
    Motion {
        displacement_rad: Some(angle),
        velocity_rad_per_s: Some(velocity),
        acceleration_rad_per_s2: Some(acceleration),
    }
}

fn blank() -> Traces {
    Traces {
        before: Motion::default(),
        time_base: TimeBase {
            start_s: 1.48,
            interval_s: STEP_S,
        },
        torque_nm: vec![],
        measured: Motion::default(),
        simulated: Motion::default(),
        euler_displacement_rad: vec![],
        force_f1_n: vec![],
        force_f2_n: vec![],
        force_f3_n: vec![],
        grip_force_n: None,
    }
}
