//! What a column or topic measures, and in which unit.

use serde::{Deserialize, Serialize};
use snug_campaign::Quantity;

/// A measured quantity of a one-degree-of-freedom rig.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Signal {
    /// Input: torque about the joint. Given in units of force, it acts at the grip, through the lever arm: T = l F.
    Torque,
    /// Angle of the tool, or displacement x = l θ of the grip.
    Displacement,
    /// Angular velocity of the tool, or velocity of the grip.
    Velocity,
    /// Angular acceleration of the tool, or acceleration of the grip.
    Acceleration,
    /// Force between tool and hand.
    GripForce,
    /// Input of a linear rig: force at the grip along its motion, T = l F.
    Force,
}

impl Signal {
    /// Its name in messages.
    pub(crate) fn in_words(self) -> String {
        format!("{self:?}").to_lowercase()
    }

    /// Whether it drives the rig; a rig has one input.
    pub fn is_input(self) -> bool {
        matches!(self, Self::Torque | Self::Force)
    }

    /// The motion it belongs to; `None` for torque and forces.
    pub fn quantity(self) -> Option<Quantity> {
        match self {
            Self::Displacement => Some(Quantity::Displacement),
            Self::Velocity => Some(Quantity::Velocity),
            Self::Acceleration => Some(Quantity::Acceleration),
            Self::Torque | Self::GripForce | Self::Force => None,
        }
    }
}

/// The default of a channel's factor.
pub(crate) fn as_it_is() -> f64 {
    1.0
}
