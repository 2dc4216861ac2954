//! The rig's settings: lever arm, and the tool's inertia, which in the thesis depends on the force transducer.

use crate::error::{PreprocessError, in_range};
use serde::{Deserialize, Serialize};
use snug_campaign::{Recording, Rig};

/// How the known inertia I_n of a recording is found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum KnownInertia {
    /// By whether the file holds a force channel: the transducer adds inertia (thesis).
    ByForceChannel {
        /// I_n with the force transducer mounted \[kg m²\]; 0.275 in the thesis.
        with_kg_m2: f64,
        /// I_n without it \[kg m²\]; 0.15 in the thesis.
        without_kg_m2: f64,
    },
    /// The same for every recording \[kg m²\]; 0 where all inertia is to be identified.
    Fixed(f64),
}

/// The rig's constants and how they follow from a recording.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RigSettings {
    /// l, joint axis to grip \[m\]; default 0.330.
    pub lever_arm_m: f64,
    /// I_n; default `ByForceChannel(with_kg_m2: 0.275, without_kg_m2: 0.15)`.
    pub known_inertia: KnownInertia,
}

impl Default for RigSettings {
    fn default() -> Self {
        Self {
            lever_arm_m: 0.330,
            known_inertia: KnownInertia::ByForceChannel {
                with_kg_m2: 0.275,
                without_kg_m2: 0.15,
            },
        }
    }
}

impl RigSettings {
    /// The constants that hold for `recording`.
    pub fn rig(&self, recording: &Recording) -> Rig {
        let known_inertia_kg_m2 = match self.known_inertia {
            KnownInertia::ByForceChannel { with_kg_m2, .. } if recording.has_force_channel => {
                with_kg_m2
            }
            KnownInertia::ByForceChannel { without_kg_m2, .. } => without_kg_m2,
            KnownInertia::Fixed(inertia_kg_m2) => inertia_kg_m2,
        };
        Rig {
            lever_arm_m: self.lever_arm_m,
            known_inertia_kg_m2,
        }
    }

    pub(crate) fn check(&self) -> Result<(), PreprocessError> {
        in_range(
            "rig.lever_arm_m",
            self.lever_arm_m,
            1e-6,
            1e3,
            "above 0 (metres)",
        )?;
        let inertia = |setting, value| in_range(setting, value, 0.0, 1e6, "0 or more (kg m^2)");
        match self.known_inertia {
            KnownInertia::ByForceChannel {
                with_kg_m2,
                without_kg_m2,
            } => {
                inertia("rig.known_inertia.with_kg_m2", with_kg_m2)?;
                inertia("rig.known_inertia.without_kg_m2", without_kg_m2)
            }
            KnownInertia::Fixed(inertia_kg_m2) => inertia("rig.known_inertia", inertia_kg_m2),
        }
    }
}
