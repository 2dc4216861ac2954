//! The rungs of the error ladder.

use crate::effect::ranked::RankedEffect;
use serde::{Deserialize, Serialize};

/// Least misfit, as a share of the squared error, by which shares of the misfit are compared \[–\]: an error at the noise leaves
/// none to share out. Chosen.
const LEAST_MISFIT: f64 = 1e-3;

/// One rung of the error ladder: a model and what it leaves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Rung {
    /// Effects in the model.
    pub effects: Vec<String>,
    /// Pooled root mean square of the whitened residual; `None` when the noise is not known.
    pub error_over_noise: Option<f64>,
    /// The same in tightenings that took no part in fixing the effects' sizes.
    pub heldout_error_over_noise: Option<f64>,
    /// The same with whole target torques held out; `None` with fewer than two.
    pub heldout_target_error_over_noise: Option<f64>,
    /// The same with whole participants held out; `None` with fewer than two.
    pub heldout_participant_error_over_noise: Option<f64>,
    /// Root-mean-square residual of the fitted output, in its unit.
    pub rms_fitted_output: f64,
    /// Root-mean-square residual of the displacement \[rad\].
    pub rms_displacement_rad: Option<f64>,
    /// Median over tightenings of the displacement's fit \[%\].
    pub fit_percent_median: Option<f64>,
    /// Share of tightenings that the study's preset selects.
    pub selected_fraction: f64,
    /// The candidates that were ranked beside this model before the next rung was taken, the one that was taken first; empty for
    /// the last rung, whose ranking is the diagnosis' own, and where nothing was ranked: before the second of a pair, say.
    #[serde(default)]
    pub ranking: Vec<RankedEffect>,
}

impl Rung {
    /// Squared error beyond the noise; where the noise is not known, all of it.
    pub(super) fn misfit(&self) -> f64 {
        match self.error_over_noise {
            Some(error) => (error * error - 1.0).max(LEAST_MISFIT * error * error),
            None => self.rms_fitted_output.powi(2),
        }
    }
}
