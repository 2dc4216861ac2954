//! How well the model predicts what took no part in the fit.

use serde::{Deserialize, Serialize};

/// How well the parameters of others predict a tightening that is kept for validation, run in two ways.
///
/// A free run is what a simulation is worth by itself; it accumulates every error. Restarted from the measured motion every so often,
/// the model is judged by what it predicts over that time.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Validation {
    /// From the first sample to the last.
    pub free_run: Prediction,
    /// `None` where restarts make no sense: the motion is not measured beside the fitted output, or too fast for its sampling.
    pub restarted: Option<RestartedPrediction>,
}

/// What one way of running the model comes to, over the scored samples of the fitted output.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Prediction {
    /// 100 (1 − ‖y − ŷ‖ / ‖y − ȳ‖).
    pub fit_percent: Option<f64>,
    /// Root mean square of the residual, in the unit of the fitted output: \[rad\], \[rad/s\] or \[rad/s²\].
    pub rms: Option<f64>,
}

/// The same where the simulation takes up the measured motion again and again.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RestartedPrediction {
    /// From one restart to the next \[s\].
    pub every_s: f64,
    /// What it comes to.
    #[serde(flatten)]
    pub prediction: Prediction,
}

impl Validation {
    /// The same with residuals that are `factor` times as large, as in another unit.
    pub fn times(mut self, factor: f64) -> Self {
        self.free_run = self.free_run.times(factor);
        if let Some(restarted) = &mut self.restarted {
            restarted.prediction = restarted.prediction.times(factor);
        }
        self
    }
}

impl Prediction {
    fn times(self, factor: f64) -> Self {
        Self {
            rms: self.rms.map(|rms| rms * factor),
            ..self
        }
    }
}
