//! One tightening, ready for identification.

use crate::measurement::conditions::Conditions;
use crate::measurement::motion::Motion;
use crate::measurement::noise::NoiseFloor;
use crate::measurement::quantity::Quantity;
use crate::measurement::rig::Rig;
use crate::measurement::time_base::TimeBase;
use crate::tightening::correction::Correction;
use crate::tightening::id::TighteningId;
use crate::tightening::target_torque::target_torque_nm;
use serde::{Deserialize, Serialize};

/// One tightening, cut out, zeroed and ready for identification. All signals have the same length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tightening {
    /// Which one.
    pub id: TighteningId,
    /// Its conditions.
    pub conditions: Conditions,
    /// The rig's constants for it.
    pub rig: Rig,
    /// The window's sampling grid, in the segment's time (0 = the segment's start).
    pub time_base: TimeBase,
    /// Input: joint torque \[Nm\].
    pub torque_nm: Vec<f64>,
    /// Measured motion, corrected; includes what was integrated from it.
    pub motion: Motion,
    /// Measured grip force \[N\].
    pub grip_force_n: Option<Vec<f64>>,
    /// Largest torque of the whole segment \[Nm\].
    pub peak_torque_nm: f64,
    /// Peak torque rounded to 5 Nm \[Nm\].
    pub target_torque_nm: f64,
    /// Index into the window at which the pulse begins.
    pub onset: Option<usize>,
    /// Measurement noise of the fitted output.
    pub noise: Option<NoiseFloor>,
    /// What was measured in the quiet part and taken out.
    pub corrections: Vec<Correction>,
}

impl Tightening {
    /// The constant error of a measured quantity that was taken out before the fit, and is uncertain.
    pub fn correction_of(&self, quantity: Quantity) -> Option<&Correction> {
        (self.corrections.iter()).find(|correction| correction.constant_of == Some(quantity))
    }

    /// A tightening from arrays: torque \[Nm\], sampled every `interval_s` from 0 s on, on a rig; what is not said is unknown,
    /// not invented. Peak and target torque are those of the torque given.
    pub fn from_torque(rig: Rig, interval_s: f64, torque_nm: Vec<f64>) -> Self {
        let peak_torque_nm = torque_nm.iter().copied().fold(0.0, f64::max);
        Self {
            id: TighteningId {
                file: String::new(),
                number: 1,
            },
            conditions: Conditions::default(),
            rig,
            time_base: TimeBase {
                start_s: 0.0,
                interval_s,
            },
            torque_nm,
            motion: Motion::default(),
            grip_force_n: None,
            peak_torque_nm,
            target_torque_nm: target_torque_nm(peak_torque_nm),
            onset: None,
            noise: None,
            corrections: Vec::new(),
        }
    }

    /// The same with one measured quantity, one value per sample of the torque.
    pub fn with(mut self, quantity: Quantity, samples: Vec<f64>) -> Self {
        self.motion.set(quantity, samples);
        self
    }

    /// The same with the noise of what was measured.
    pub fn with_noise(mut self, noise: NoiseFloor) -> Self {
        self.noise = Some(noise);
        self
    }
}
