//! The preprocessing part of a study file: preset, window and every step's settings, checked before work starts.

pub(crate) mod onset;
pub(crate) mod quality;
pub(crate) mod quiet;
pub(crate) mod rig;
pub(crate) mod stretch;

use crate::error::{PreprocessError, in_range};
use crate::settings::rig::RigSettings;
use onset::OnsetSettings;
use quality::QualitySettings;
use quiet::QuietSettings;
use serde::{Deserialize, Serialize};
use stretch::Stretch;

/// Which way recordings become tightenings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
pub enum Preset {
    /// Bias and noise measured in the quiet part, rest at the window's start, data-quality findings.
    #[default]
    Snug,
    /// The original program, step by step, without corrections.
    Thesis,
}

impl Preset {
    /// Name as in reports and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Snug => "snug",
            Self::Thesis => "thesis",
        }
    }
}

/// Which stretch of a segment is kept.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum Window {
    /// A torque pulse after a quiet part.
    Pulse {
        /// Start after the segment's start \[s\]; default 1.48.
        #[serde(default = "default_start_s")]
        start_s: f64,
        /// Length \[s\]; default 0.3.
        #[serde(default = "default_length_s")]
        length_s: f64,
    },
    /// The whole segment as it was measured: no quiet part, no correction, no noise floor, no pulse sought.
    Whole,
}

fn default_start_s() -> f64 {
    1.48
}

fn default_length_s() -> f64 {
    0.3
}

impl Default for Window {
    fn default() -> Self {
        Self::Pulse {
            start_s: default_start_s(),
            length_s: default_length_s(),
        }
    }
}

/// Everything preprocessing can be told.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PreprocessSettings {
    /// Way of preparing; default `Snug`.
    pub preset: Preset,
    /// Stretch to keep; default `Pulse(start_s: 1.48, length_s: 0.3)`.
    pub window: Window,
    /// The part of every window that counts; default all of it. Not with preset `Thesis`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stretch: Option<Stretch>,
    /// The rig's constants.
    pub rig: RigSettings,
    /// How the quiet part is used (preset `Snug`).
    pub quiet: QuietSettings,
    /// How the pulse and its onset are found (preset `Snug`).
    pub onset: OnsetSettings,
    /// When data count as faulty (preset `Snug`; `repair_gap_s` holds for both presets).
    pub quality: QualitySettings,
}

impl PreprocessSettings {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`PreprocessError`] names the first setting that is not allowed.
    pub fn check(&self) -> Result<(), PreprocessError> {
        match self.window {
            Window::Pulse { start_s, length_s } => {
                in_range("window.start_s", start_s, 0.0, 1e6, "0 or more (seconds)")?;
                in_range("window.length_s", length_s, 1e-6, 1e6, "above 0 (seconds)")?;
            }
            Window::Whole if self.preset == Preset::Thesis => {
                return Err(PreprocessError::ThesisWithoutWindow);
            }
            Window::Whole => {}
        }
        match self.stretch {
            Some(_) if self.preset == Preset::Thesis => {
                return Err(PreprocessError::ThesisWithStretch);
            }
            Some(stretch) => stretch.check()?,
            None => {}
        }
        self.rig.check()?;
        self.quiet.check()?;
        self.onset.check()?;
        self.quality.check()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_study_writes_only_what_differs() {
        let text =
            "(preset: Thesis, window: Pulse(start_s: 0.5), rig: (known_inertia: Fixed(0.0)))";
        let settings: PreprocessSettings = ron::from_str(text).unwrap();
        assert_eq!(settings.preset, Preset::Thesis);
        assert_eq!(
            settings.window,
            Window::Pulse {
                start_s: 0.5,
                length_s: 0.3
            }
        );
        assert_eq!(settings.rig.lever_arm_m, 0.330);
        settings.check().unwrap();
    }

    #[test]
    fn a_typo_is_an_error() {
        for text in [
            "(presett: Snug)",
            "(window: Pulse(start: 1.0))",
            "(quiet: (guard: 1.0))",
        ] {
            assert!(ron::from_str::<PreprocessSettings>(text).is_err(), "{text}");
        }
    }

    #[test]
    fn every_default_survives_a_round_trip() {
        let settings = PreprocessSettings::default();
        let text =
            ron::ser::to_string_pretty(&settings, ron::ser::PrettyConfig::default()).unwrap();
        assert_eq!(
            ron::from_str::<PreprocessSettings>(&text).unwrap(),
            settings
        );
    }

    #[test]
    fn impossible_settings_are_named() {
        let window = |length_s| Window::Pulse {
            start_s: 1.48,
            length_s,
        };
        let mut settings = PreprocessSettings {
            window: window(f64::NAN),
            ..PreprocessSettings::default()
        };
        let error = settings.check().unwrap_err();
        assert!(error.to_string().contains("window.length_s"), "{error}");
        settings.window = Window::Whole;
        settings.check().unwrap();
        settings.preset = Preset::Thesis;
        assert_eq!(settings.check(), Err(PreprocessError::ThesisWithoutWindow));
    }
}
