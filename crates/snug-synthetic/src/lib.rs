//! Simulated tightening campaigns whose truth is known, which share no equation with the model.
#![doc = include_str!("../README.md")]

mod error;
mod files;
pub mod fixtures;
mod motion;
mod plan;
mod random;
mod sensing;
mod simulate;

pub use error::SyntheticError;
pub use files::campaign::SyntheticCampaign;
pub use files::file::SyntheticFile;
pub use files::layout::MatStyle;
pub use files::mat5::{MatValue, mat5};
pub use files::truth::{TighteningTruth, Truth};
pub use motion::plant::Plant;
pub use motion::pulse::{Dwell, Pulse};
pub use motion::trajectory::Trajectory;
pub use plan::CampaignPlan;
pub use plan::effects::{HiddenEffect, Law};
pub use plan::fault::{Fault, PlannedFault};
pub use plan::file::{ChannelNames, FilePlan, Joint, Strategy};
pub use plan::population::{HandArm, Population};
pub use plan::sensors::{Sensors, ZeroErrors};
pub use plan::whose::Whose;
pub use random::noise::NoiseKind;
pub use simulate::{simulate, simulate_part};
