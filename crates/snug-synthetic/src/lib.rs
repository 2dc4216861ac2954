#![doc = include_str!("../README.md")]

mod campaign;
mod effects;
mod error;
mod fault;
mod file;
pub mod fixtures;
mod history;
mod layout;
mod mat5;
mod noise;
mod plan;
mod plant;
mod population;
mod pulse;
mod random;
mod sensing;
mod sensors;
mod simulate;
mod trajectory;
mod truth;

pub use campaign::SyntheticCampaign;
pub use effects::{HiddenEffect, Law};
pub use error::SyntheticError;
pub use fault::{Fault, PlannedFault};
pub use file::SyntheticFile;
pub use layout::MatStyle;
pub use mat5::{MatValue, mat5};
pub use noise::NoiseKind;
pub use plan::{CampaignPlan, ChannelNames, FilePlan, Joint, Strategy};
pub use plant::Plant;
pub use population::{HandArm, Population};
pub use pulse::{Dwell, Pulse};
pub use sensors::{Sensors, ZeroErrors};
pub use simulate::simulate;
pub use trajectory::Trajectory;
pub use truth::{TighteningTruth, Truth};
