//! How the missing effect is looked for.

use crate::error::StudyError;
use serde::{Deserialize, Serialize};

/// How a study is diagnosed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DiagnosisSettings {
    /// Most tightenings from which effects are learnt, evenly spread over the files; what was learnt is then applied to
    /// all. Default 240.
    pub most_tightenings: usize,
    /// How the missing effect is looked for.
    pub search: snug_diagnose::DiagnoseSettings,
}

impl Default for DiagnosisSettings {
    fn default() -> Self {
        Self {
            most_tightenings: 240,
            search: snug_diagnose::DiagnoseSettings::default(),
        }
    }
}

impl DiagnosisSettings {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`StudyError::Setting`] names the first that is not allowed.
    pub fn check(&self) -> Result<(), StudyError> {
        let search = &self.search;
        let checks = [
            (
                "diagnosis.most_tightenings",
                self.most_tightenings as f64,
                self.most_tightenings >= 8,
                "at least 8",
            ),
            (
                "diagnosis.search.sign_flips",
                search.sign_flips as f64,
                search.sign_flips >= 99,
                "at least 99",
            ),
            (
                "diagnosis.search.level",
                search.level,
                search.level > 0.0 && search.level < 1.0,
                "between 0 and 1",
            ),
            (
                "diagnosis.search.smallest_gain",
                search.smallest_gain,
                (0.0..1.0).contains(&search.smallest_gain),
                "0 or more and below 1",
            ),
            (
                "diagnosis.search.smallest_gain_at_noise",
                search.smallest_gain_at_noise,
                (0.0..1.0).contains(&search.smallest_gain_at_noise),
                "0 or more and below 1",
            ),
            (
                "diagnosis.search.starts",
                search.starts as f64,
                search.starts >= 1,
                "at least 1",
            ),
        ];
        match checks.into_iter().find(|(_, _, is_allowed, _)| !is_allowed) {
            Some((setting, value, _, allowed)) => Err(StudyError::Setting {
                setting,
                value,
                allowed,
            }),
            None => Ok(()),
        }
    }
}
