//! What a user may set about how tightenings are identified.

use crate::constraint_kind::ConstraintKind;
use crate::residual::restarts::Simulation;
use serde::{Deserialize, Serialize};
use snug_campaign::Quantity;
use snug_least_squares::Settings;

/// How tightenings are identified.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct IdentifySettings {
    /// Which output is fitted: `Acceleration`, `Velocity` or `Displacement`; default `Acceleration`.
    pub fitted_output: Quantity,
    /// What must hold of m, c, k; default `[Positive, LightlyDamped]`.
    pub constraints: Vec<ConstraintKind>,
    /// Samples at the window's start that count for nothing; default 0.
    pub unscored_samples: usize,
    /// How the model is run beside the measurement: `Automatic`, `FreeRun` or `Restarted(every_s: …)`; default
    /// `Automatic`.
    pub simulation: Simulation,
    /// The solver's own settings; default [`Settings::of_measurement`].
    pub solver: Settings,
}

impl Default for IdentifySettings {
    fn default() -> Self {
        Self {
            fitted_output: Quantity::Acceleration,
            constraints: vec![ConstraintKind::Positive, ConstraintKind::LightlyDamped],
            unscored_samples: 0,
            simulation: Simulation::Automatic,
            solver: Settings::of_measurement(),
        }
    }
}
