//! Thresholds of what is misfit, not noise.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Stretches whose summed scores are taken as independent where the residual holds more than noise. Chosen.
pub(crate) const STRETCHES: usize = 30;
/// Standard deviations by which the mean square residual must exceed the noise to count as misfit. Chosen.
pub(crate) const MISFIT: f64 = 4.0;
/// Mean square of the whitened acceleration residual beyond which a fit of the displacement shows misfit \[–\]: the parameter
/// errors that integrated noise causes are visible in the acceleration by themselves, but do not double it. Chosen.
pub(crate) const BEYOND_PARAMETER_ERROR: f64 = 2.0;
