//! Units for display, for rigs whose input is a voltage or whose output is a length of the grip.

use serde::{Deserialize, Serialize};

/// In which units a rig's input and output are shown; results themselves stay in SI units about the joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SignalUnits {
    /// Of the input: `Nm`, or what the source declares in its place, for example `V`.
    pub input: String,
    /// Of the output as a displacement: `rad`, `m` at the grip, or for example `V`.
    pub output: String,
    /// What a displacement \[rad\] is multiplied with to be shown in `output`: the lever arm for `m`, else 1.
    pub output_per_rad: f64,
}

impl Default for SignalUnits {
    fn default() -> Self {
        Self {
            input: "Nm".into(),
            output: "rad".into(),
            output_per_rad: 1.0,
        }
    }
}

impl SignalUnits {
    /// Whether the input is a torque; a rig driven by a voltage has no forces and no target torque.
    pub fn input_is_torque(&self) -> bool {
        self.input == "Nm"
    }

    /// Whether signals stand for an angle or a length, so that mass, damping and stiffness have their usual units.
    pub fn mechanical(&self) -> bool {
        self.input_is_torque() && matches!(self.output.as_str(), "rad" | "m")
    }
}
