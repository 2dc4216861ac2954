//! Whether a tightening takes part in the statistics, and why not.

use serde::{Deserialize, Serialize};

/// Why a tightening was rejected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rejection {
    /// Thesis code 1: the displacement goes up and does not come back.
    GoesUp,
    /// Thesis code 2: the displacement goes down.
    GoesDown,
    /// Thesis code 3: not lightly damped.
    NotLightlyDamped,
    /// Fit below the study's limit (90 %).
    PoorFit,
    /// Estimated mass not positive.
    MassNotPositive,
    /// The optimum lies on a constraint: the parameters are not the data's free choice.
    AtConstraint,
    /// The identification did not reach an optimum, or the data do not determine the parameters.
    NotIdentified,
    /// Kept for validation: simulated with the parameters of the others, not fitted.
    Validation,
    /// The data themselves are faulty (saturation, gaps, no pulse, truncated, …): see the findings.
    DataQuality,
}

impl Rejection {
    /// Stable snake-case name, as in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::GoesUp => "goes_up",
            Self::GoesDown => "goes_down",
            Self::NotLightlyDamped => "not_lightly_damped",
            Self::PoorFit => "poor_fit",
            Self::MassNotPositive => "mass_not_positive",
            Self::AtConstraint => "at_constraint",
            Self::NotIdentified => "not_identified",
            Self::Validation => "validation",
            Self::DataQuality => "data_quality",
        }
    }
}

/// Whether a tightening takes part in the statistics.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Selection {
    /// Empty when selected.
    pub rejections: Vec<Rejection>,
}

impl Selection {
    /// True when nothing speaks against the tightening.
    pub fn selected(&self) -> bool {
        self.rejections.is_empty()
    }
}
