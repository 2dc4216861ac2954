//! The measured motion: angle, angular velocity, angular acceleration.

use crate::measurement::quantity::Quantity;
use serde::{Deserialize, Serialize};

/// The measured motion, a value a sample: whichever of angle, angular velocity and angular acceleration the rig records.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// θ \[rad\].
    pub displacement_rad: Option<Vec<f64>>,
    /// ω \[rad/s\].
    pub velocity_rad_per_s: Option<Vec<f64>>,
    /// α \[rad/s²\].
    pub acceleration_rad_per_s2: Option<Vec<f64>>,
}

impl Motion {
    /// The samples of one quantity, if it is there.
    pub fn get(&self, quantity: Quantity) -> Option<&[f64]> {
        match quantity {
            Quantity::Displacement => self.displacement_rad.as_deref(),
            Quantity::Velocity => self.velocity_rad_per_s.as_deref(),
            Quantity::Acceleration => self.acceleration_rad_per_s2.as_deref(),
        }
    }

    /// Puts the samples of one quantity.
    pub fn set(&mut self, quantity: Quantity, samples: Vec<f64>) {
        match quantity {
            Quantity::Displacement => self.displacement_rad = Some(samples),
            Quantity::Velocity => self.velocity_rad_per_s = Some(samples),
            Quantity::Acceleration => self.acceleration_rad_per_s2 = Some(samples),
        }
    }
}
