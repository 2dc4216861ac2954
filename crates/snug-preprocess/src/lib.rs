//! Recordings in, tightenings out: cut, integrated, windowed, and cleared of what the quiet part shows.
#![doc = include_str!("../README.md")]

mod error;
mod faults;
mod noise;
mod prepared;
mod preprocess;
mod presets;
mod pulse;
mod quality;
mod quiet;
mod segment;
mod settings;
#[cfg(test)]
mod tests;
mod thesis;

pub use error::PreprocessError;
pub use noise::autoregression::Autoregression;
pub use prepared::{Prepared, Preprocessed};
pub use preprocess::preprocess;
pub use segment::integration::cumulative_trapezoid;
pub use settings::onset::OnsetSettings;
pub use settings::quality::QualitySettings;
pub use settings::quiet::QuietSettings;
pub use settings::rig::{KnownInertia, RigSettings};
pub use settings::stretch::Stretch;
pub use settings::{PreprocessSettings, Preset, Window};
pub use thesis::checks::ThesisChecks;
