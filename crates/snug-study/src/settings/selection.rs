//! Which fitted tightenings count in the statistics: Snug's own rules, and those of the original program in its order.

use crate::error::StudyError;
use serde::{Deserialize, Serialize};
use snug_campaign::{Estimate, FitMeasures, FitStatus, Rejection};
use snug_model::{BASE_PARAMETERS, Scale};
use snug_preprocess::Preset;

/// When a tightening counts in the statistics.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SelectionSettings {
    /// Smallest fit \[%\]; default 90, the thesis' rule. It is the displacement's fit, or, where preset `snug` has no
    /// measured noise to compare with, the fitted output's.
    pub minimum_fit_percent: f64,
    /// Preset `snug`: a fit below the limit still counts while the residual stays within this multiple of the measured
    /// noise, for then what is left in the displacement is integrated noise and no misfit \[ratio\]; default 1.1.
    pub noise_limited_ratio: f64,
    /// m_n, mass of the tool for the thesis' damping check \[kg\]; default 2.60.
    pub tool_mass_kg: f64,
}

impl Default for SelectionSettings {
    fn default() -> Self {
        Self {
            minimum_fit_percent: 90.0,
            noise_limited_ratio: 1.1,
            tool_mass_kg: 2.60,
        }
    }
}

impl SelectionSettings {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`StudyError::Setting`] names the first that is not allowed.
    pub fn check(&self) -> Result<(), StudyError> {
        let reject = |setting, value, allowed| {
            Err(StudyError::Setting {
                setting,
                value,
                allowed,
            })
        };
        if self.minimum_fit_percent.is_nan() || self.minimum_fit_percent > 100.0 {
            return reject(
                "selection.minimum_fit_percent",
                self.minimum_fit_percent,
                "at most 100",
            );
        }
        let positive_or_zero = [
            ("selection.noise_limited_ratio", self.noise_limited_ratio),
            ("selection.tool_mass_kg", self.tool_mass_kg),
        ];
        for (setting, value) in positive_or_zero {
            if value.is_nan() || value < 0.0 {
                return reject(setting, value, "0 or more");
            }
        }
        Ok(())
    }

    /// Why a fitted tightening is not selected, beside what preparation found.
    ///
    /// `snug`: no free optimum, or a fit below the limit that is not the noise's doing. A hand has mass, damper and spring;
    /// another rig may lack damper or spring, and a fit that leaves one at nothing is no worse for it. `thesis`: the
    /// original's rules, in its order: overdamped by its own check (which also fires for k < 0 or a negative total mass),
    /// fit at or below the limit, mass not positive.
    pub fn rejections(
        &self,
        preset: Preset,
        scale: Scale,
        estimate: &Estimate,
        measures: &FitMeasures,
    ) -> Vec<Rejection> {
        let mut good = measures
            .fit_percent
            .is_some_and(|percent| percent > self.minimum_fit_percent);
        let mass_is_positive = estimate.value("mass_kg").is_some_and(|mass| mass > 0.0);
        let mut rejections = Vec::new();
        match preset {
            Preset::Snug => {
                match estimate.status {
                    FitStatus::Converged => {}
                    FitStatus::ConvergedAtConstraint => {
                        let mut active = estimate.active_constraints.iter();
                        if !active.all(|active| can_be_lacking(scale, active)) {
                            rejections.push(Rejection::AtConstraint);
                        }
                    }
                    _ => rejections.push(Rejection::NotIdentified),
                }
                if measures.error_over_noise.is_none() {
                    good = measures
                        .fit_percent_fitted_output
                        .is_some_and(|percent| percent > self.minimum_fit_percent);
                }
                let noise_limited = measures
                    .error_over_noise
                    .is_some_and(|ratio| ratio <= self.noise_limited_ratio);
                if !good && !noise_limited {
                    rejections.push(Rejection::PoorFit);
                }
            }
            Preset::Thesis => {
                if !measures
                    .thesis_damping_ratio
                    .is_some_and(|zeta| zeta <= 1.0)
                {
                    rejections.push(Rejection::NotLightlyDamped);
                }
                if !good {
                    rejections.push(Rejection::PoorFit);
                }
                if !mass_is_positive {
                    rejections.push(Rejection::MassNotPositive);
                }
            }
        }
        rejections
    }
}

/// Whether an active constraint only says that a rig has no damper or no spring.
fn can_be_lacking(scale: Scale, active: &str) -> bool {
    let [_, damping, stiffness] = BASE_PARAMETERS;
    let at_least = |name: &str| active.strip_prefix(name) == Some(" minimum");
    matches!(scale, Scale::Rig { .. }) && (at_least(damping) || at_least(stiffness))
}
