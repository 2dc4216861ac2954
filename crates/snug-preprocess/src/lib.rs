#![doc = include_str!("../README.md")]

mod autoregression;
mod bias;
mod channel;
mod context;
mod division;
mod error;
mod faults;
mod integration;
mod locate;
mod offset;
mod onset;
mod prepared;
mod preprocess;
mod presets;
mod quality;
mod quiet;
mod quiet_measurement;
mod remarks;
mod rig;
mod settings;
mod signals;
mod spread;
#[cfg(test)]
mod tests;
mod thesis_checks;
mod torque_target;
mod window;

pub use autoregression::Autoregression;
pub use error::PreprocessError;
pub use integration::cumulative_trapezoid;
pub use prepared::{Prepared, Preprocessed};
pub use preprocess::preprocess;
pub use rig::{KnownInertia, RigSettings};
pub use settings::onset::OnsetSettings;
pub use settings::quality::QualitySettings;
pub use settings::quiet::QuietSettings;
pub use settings::{PreprocessSettings, Preset, Window};
pub use thesis_checks::ThesisChecks;
pub use torque_target::target_torque_nm;
