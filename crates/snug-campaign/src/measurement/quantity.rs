//! Which derivative of the motion is meant.

use serde::{Deserialize, Serialize};

/// Which derivative of the motion is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Quantity {
    /// Angle θ \[rad\].
    Displacement,
    /// Angular velocity ω \[rad/s\].
    Velocity,
    /// Angular acceleration α \[rad/s²\].
    Acceleration,
}

impl Quantity {
    /// All of them, each the derivative of the one before.
    pub const ALL: [Self; 3] = [Self::Displacement, Self::Velocity, Self::Acceleration];

    /// What it is called in texts and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
        }
    }

    /// Its unit as people write it.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Displacement => "rad",
            Self::Velocity => "rad/s",
            Self::Acceleration => "rad/s^2",
        }
    }
}
