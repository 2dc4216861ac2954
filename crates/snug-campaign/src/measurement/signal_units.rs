//! Units for display, for rigs whose input is a voltage or whose output is a length of the grip.

use crate::measurement::quantity::Quantity;
use serde::{Deserialize, Serialize};

/// In which units a rig's input and output are shown; results themselves stay in SI units about the joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SignalUnits {
    /// Of the input: `Nm`, `N` of a linear rig, or what the source declares in its place, for example `V`.
    pub input: String,
    /// What a torque \[Nm\] is multiplied with to be shown in `input`: 1 by the lever arm for a force, else 1.
    pub input_per_nm: f64,
    /// Of the output as a displacement: `rad`, `m` at the grip, or for example `V`.
    pub output: String,
    /// What a displacement \[rad\] is multiplied with to be shown in `output`: the lever arm for `m`, else 1.
    pub output_per_rad: f64,
}

impl Default for SignalUnits {
    fn default() -> Self {
        Self {
            input: "Nm".into(),
            input_per_nm: 1.0,
            output: "rad".into(),
            output_per_rad: 1.0,
        }
    }
}

impl SignalUnits {
    /// Whether the input is a torque; a rig driven by a force or a voltage has no hand and no target torque.
    pub fn input_is_torque(&self) -> bool {
        self.input == "Nm"
    }

    /// Whether signals stand for an angle or a length, so that mass, damping and stiffness have their usual units.
    pub fn mechanical(&self) -> bool {
        matches!(self.input.as_str(), "Nm" | "N") && matches!(self.output.as_str(), "rad" | "m")
    }

    /// Unit of a motion: `rad/s²`, `m/s²`, `V/s²`.
    pub fn motion(&self, quantity: Quantity) -> String {
        let output = &self.output;
        match quantity {
            Quantity::Displacement => output.clone(),
            Quantity::Velocity => format!("{output}/s"),
            Quantity::Acceleration => format!("{output}/s²"),
        }
    }

    /// Unit of the motion that is called `name`, as in results; none for a name that is none.
    pub fn motion_called(&self, name: &str) -> String {
        let named = Quantity::ALL.into_iter().find(|one| one.name() == name);
        named.map_or_else(String::new, |quantity| self.motion(quantity))
    }

    /// Unit of m, c or k, by its column, where input or output are no mechanical quantities: input per output's derivative.
    pub fn base_parameter(&self, column: &str) -> Option<String> {
        let quantity = match column {
            "mass_kg" => Quantity::Acceleration,
            "damping_kg_per_s" => Quantity::Velocity,
            "stiffness_n_per_m" => Quantity::Displacement,
            _ => return None,
        };
        let output = self.motion(quantity);
        (!self.mechanical()).then(|| match output.contains('/') {
            true => format!("{}/({output})", self.input),
            false => format!("{}/{output}", self.input),
        })
    }
}
