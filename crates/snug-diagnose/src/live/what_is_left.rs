//! What a model tried by hand leaves: the force it still lacks, and whether the rest is white.

use super::cases::LiveCases;
use super::fit::LiveFit;
use crate::error::DiagnoseError;
use crate::locate::what_is_left;
use crate::verdict::tightening_fits::TighteningFits;
use snug_campaign::Location;

impl LiveCases {
    /// The missing force of all tightenings under `fit`, over time and over displacement and velocity, and how the residual goes with
    /// itself and with the torque, as [`crate::locate()`] tells them; without its other views.
    ///
    /// # Errors
    /// What the model or the fit of a tightening refuses.
    pub fn what_is_left(&self, fit: &LiveFit) -> Result<Location, DiagnoseError> {
        let fits = TighteningFits::of(&self.cases, &fit.fitted)?;
        Ok(what_is_left(&fits.seen(), self.settings.seed))
    }
}
