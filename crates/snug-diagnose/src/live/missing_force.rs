//! The force that a model tried by hand still lacks.

use super::cases::LiveCases;
use super::fit::LiveFit;
use crate::error::DiagnoseError;
use crate::locate::missing_force;
use crate::verdict::tightening_fits::TighteningFits;
use snug_campaign::{ForceCurve, ForceMap};

impl LiveCases {
    /// The missing force of all tightenings under `fit`, over time and over displacement and velocity, as [`crate::locate()`] tells it.
    ///
    /// # Errors
    /// What the model or the fit of a tightening refuses.
    pub fn missing_force(&self, fit: &LiveFit) -> Result<(ForceCurve, ForceMap), DiagnoseError> {
        let fits = TighteningFits::of(&self.cases, &fit.fitted)?;
        Ok(missing_force(&fits.seen(), self.settings.seed))
    }
}
