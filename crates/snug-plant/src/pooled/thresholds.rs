//! When the pooled fit over all rows stops and how it steps; every number without a unit unless it says one.

/// Share of a size by which it may still be off when the fit has converged: a tenth of what it must agree with the fit of one machine.
pub const TOLERANCE: f64 = 1e-10;

/// Standard errors by which it may still be off, for sizes that are nothing. Chosen: nobody could tell.
pub const TOLERANCE_ERRORS: f64 = 1e-7;

/// Steps tried at most. Chosen: from a sample's sizes it takes three to five.
pub const MOST_STEPS: usize = 25;

/// Share of the predicted fall of the cost that a step must keep to be taken (Nocedal and Wright's usual 1e-4).
pub const SUFFICIENT: f64 = 1e-4;

/// Share of the cost that is rounding: of 10^8 rows' sum, added up without error, each row's own rounding.
pub const RESOLUTION: f64 = 1e-13;

/// Damping after the first step that fails, relative to the curvature, and what it is multiplied by after the next (Marquardt's usual).
pub const FIRST_DAMPING: f64 = 1e-3;
/// See [`FIRST_DAMPING`].
pub const DAMPING_FACTOR: f64 = 10.0;

/// Sizes that are fitted together at most, groups' own among them: beyond it the client's matrix would be what binds.
pub const MOST_SIZES: usize = 600;
