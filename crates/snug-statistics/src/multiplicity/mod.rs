//! p values adjusted for having looked at many: an adjusted p below α keeps the stated error
//! rate over the whole table at α.

mod benjamini_hochberg;
mod benjamini_yekutieli;
mod holm;

pub use benjamini_hochberg::benjamini_hochberg;
pub use benjamini_yekutieli::benjamini_yekutieli;
pub use holm::holm;

use serde::{Deserialize, Serialize};

use crate::{Result, StatisticsError};

/// Which adjustment, for settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Adjustment {
    /// False-discovery rate; valid for independent or positively dependent tests.
    #[default]
    BenjaminiHochberg,
    /// False-discovery rate under any dependence.
    BenjaminiYekutieli,
    /// Family-wise error rate under any dependence.
    Holm,
}

impl Adjustment {
    /// Adjusted p values in the order given.
    ///
    /// # Errors
    /// [`StatisticsError::OutOfRange`] for a p value outside 0 to 1 or NaN.
    pub fn adjust(self, p: &[f64]) -> Result<Vec<f64>> {
        match self {
            Self::BenjaminiHochberg => benjamini_hochberg(p),
            Self::BenjaminiYekutieli => benjamini_yekutieli(p),
            Self::Holm => holm(p),
        }
    }
}

/// Positions of the p values from smallest to largest, after checking them.
fn ascending(p: &[f64]) -> Result<Vec<usize>> {
    if let Some(value) = p.iter().find(|value| !(0.0..=1.0).contains(*value)) {
        return Err(StatisticsError::OutOfRange {
            argument: "p",
            value: *value,
            allowed: "0 to 1",
        });
    }
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|a, b| p[*a].total_cmp(&p[*b]));
    Ok(order)
}

/// Step-up adjustment `min over j ≥ i of factor · m/j · p₍ⱼ₎`, at most 1.
fn step_up(p: &[f64], factor: f64) -> Result<Vec<f64>> {
    let order = ascending(p)?;
    let count = p.len() as f64;
    let mut adjusted = vec![0.0; p.len()];
    let mut smallest = 1.0_f64;
    for (position, index) in order.iter().enumerate().rev() {
        smallest = smallest.min(factor * count / (position + 1) as f64 * p[*index]);
        adjusted[*index] = smallest;
    }
    Ok(adjusted)
}
