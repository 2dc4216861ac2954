//! Why a model is restarted from the measured motion, and what counts then.

use crate::measurement::quantity::Quantity;
use crate::words::number::whole_percent;
use std::fmt::{self, Formatter};

/// Why a model is restarted from the measured motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WhyRestarted {
    /// A free run misses this share of the measured motion.
    Misses(f64),
    /// Nothing brings the fitted output back.
    Unheld(Quantity),
}

/// Said of an error in which straight lines hardly count.
pub(super) const BESIDE_LINES: &str = " A straight line from each restart to the next counts in it only so far as it is larger than errors of the motion that is taken up there: those are such lines, and no force of the rig.";

impl WhyRestarted {
    /// Why it is, and what that means.
    pub(super) fn restarted_every(self, f: &mut Formatter<'_>, every_s: f64) -> fmt::Result {
        match self {
            Self::Unheld(quantity) => {
                f.write_str(match quantity {
                    Quantity::Displacement => "Nothing brings this angle back",
                    Quantity::Velocity | Quantity::Acceleration => {
                        "Hardly anything brings this speed back"
                    }
                })?;
                f.write_str(": what a free run has missed once it misses to the end, whatever moved the rig then, such as a load that was not recorded, and single effects hardly show.")?;
            }
            Self::Misses(share) => write!(
                f,
                "Run freely from its first sample on, the study's own model misses {} of the measured motion, so that a free run says little about single effects.",
                whole_percent(share.min(9.99))
            )?,
        }
        write!(
            f,
            " Every model is therefore judged by what it predicts over {every_s} s from the measured motion, again and again (`identify.simulation: Restarted(every_s: {every_s})`; `FreeRun` in the study file asks for the whole record at once)."
        )
    }
}
