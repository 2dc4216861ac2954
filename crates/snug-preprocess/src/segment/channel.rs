//! A segment's channels: names and units for findings, and which effect of the catalogue an offset of each would be.

use snug_campaign::Quantity;

/// One measured signal of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Channel {
    Torque,
    Motion(Quantity),
    GripForce,
}

impl Channel {
    /// Name as findings give it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Torque => "torque",
            Self::Motion(quantity) => quantity.name(),
            Self::GripForce => "grip_force",
        }
    }

    /// Unit as people write it.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Self::Torque => "Nm",
            Self::Motion(Quantity::Displacement) => "rad",
            Self::Motion(Quantity::Velocity) => "rad/s",
            Self::Motion(Quantity::Acceleration) => "rad/s^2",
            Self::GripForce => "N",
        }
    }

    /// The motion that it is, if it is one.
    pub(crate) fn quantity(self) -> Option<Quantity> {
        match self {
            Self::Motion(quantity) => Some(quantity),
            Self::Torque | Self::GripForce => None,
        }
    }

    /// Catalogue name of a constant error of this channel; the grip force does not enter the model.
    pub(crate) fn offset_effect(self) -> Option<&'static str> {
        match self {
            Self::Torque => Some("torque_offset"),
            Self::Motion(Quantity::Acceleration) => Some("acceleration_bias"),
            Self::Motion(Quantity::Displacement | Quantity::Velocity) => Some("output_offset"),
            Self::GripForce => None,
        }
    }
}
