//! What a user may set of the solver: when it stops, and how it begins.

use crate::error::SolveError;
use serde::{Deserialize, Serialize};

/// When the solver stops and how it begins.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Most accepted and rejected steps together \[–\]; default 3000.
    pub max_iterations: usize,
    /// Converged when the part of the residual that a feasible first-order step could still remove is at most this
    /// share of the residual, √(2·predicted decrease)/‖r‖ \[–\]; default 1e-9, of [a tightening](Self::of_measurement)
    /// 1e-7. The estimate is then within about this times √(residuals − parameters) standard errors of the optimum.
    pub gradient_tolerance: f64,
    /// Converged, too, when a hardly damped step changes no parameter by more than this share of its value \[–\];
    /// default 1e-14. It ends fits whose residual vanishes.
    pub step_tolerance: f64,
    /// Damping λ of the first step, relative to the squared length of each parameter's sensitivity \[–\]; default 1e-3.
    pub initial_damping: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            max_iterations: 3000,
            gradient_tolerance: 1e-9,
            step_tolerance: 1e-14,
            initial_damping: 1e-3,
        }
    }
}

impl Settings {
    /// For a tightening: within 5e-6 standard errors of the optimum where 3000 samples are measured.
    pub fn of_measurement() -> Self {
        Self {
            gradient_tolerance: 1e-7,
            ..Self::default()
        }
    }

    /// Checks every field.
    ///
    /// # Errors
    /// [`SolveError::Setting`] names the first field that is not allowed.
    pub fn check(&self) -> Result<(), SolveError> {
        let positive = "a positive finite number";
        for (name, value) in [
            ("gradient_tolerance", self.gradient_tolerance),
            ("step_tolerance", self.step_tolerance),
            ("initial_damping", self.initial_damping),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(SolveError::Setting {
                    name,
                    value,
                    allowed: positive,
                });
            }
        }
        if self.max_iterations == 0 {
            return Err(SolveError::Setting {
                name: "max_iterations",
                value: 0.0,
                allowed: "at least 1",
            });
        }
        Ok(())
    }
}
