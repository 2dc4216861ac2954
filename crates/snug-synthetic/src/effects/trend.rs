//! Change from tightening to tightening within a file.

use super::HiddenEffect;

/// A trend with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TrendLaw {
    /// m, c and k are multiplied by 1 + slope · n, n the 0-based number of the tightening in its file.
    Fatigue {
        /// Of k per tightening.
        stiffness_slope: f64,
        /// Of c per tightening.
        damping_slope: f64,
        /// Of m per tightening.
        mass_slope: f64,
    },
}

impl TrendLaw {
    /// `effect` at `strength`, if it is a trend.
    pub(super) fn of(effect: HiddenEffect, strength: f64) -> Option<Self> {
        (effect == HiddenEffect::Fatigue).then_some(Self::Fatigue {
            stiffness_slope: -0.04 * strength,
            damping_slope: -0.02 * strength,
            mass_slope: 0.01 * strength,
        })
    }

    pub(super) fn values(&self) -> Vec<f64> {
        let Self::Fatigue {
            stiffness_slope,
            damping_slope,
            mass_slope,
        } = *self;
        vec![stiffness_slope, damping_slope, mass_slope]
    }

    /// What m, c, k of the tightening with 0-based number `index` are multiplied by; never below a tenth.
    pub(crate) fn ratios(&self, index: usize) -> [f64; 3] {
        let Self::Fatigue {
            stiffness_slope,
            damping_slope,
            mass_slope,
        } = *self;
        [mass_slope, damping_slope, stiffness_slope]
            .map(|slope| (1.0 + slope * index as f64).max(0.1))
    }
}
