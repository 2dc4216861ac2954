//! Which physical effect a model lacks, how large it is, how sure that is, and when to stop.
#![doc = include_str!("../README.md")]

mod data;
mod error;
mod examine;
mod library;
mod live;
mod locate;
mod pooled;
mod question;
mod ranking;
mod rung_model;
mod selection;
mod settings;
#[cfg(test)]
mod tests;
mod verdict;

pub use data::follower::FitStep;
pub use data::watch::{Pieces, Watch};
pub use error::DiagnoseError;
pub use examine::examine;
pub use live::by_hand::{ByHand, HandNumber};
pub use live::cases::LiveCases;
pub use live::fit::LiveFit;
pub use live::focus::{CloserLook, Counted, Focus};
pub use live::held_out::HeldOut;
pub use live::tightening::LiveTightening;
pub use locate::{Seen, compare, drifts, locate};
pub use pooled::groups::nothing::Nothing;
pub use pooled::shared_block::{SharedBlock, SharedParameter, shared_blocks, shared_parameters};
pub use pooled::steps::friction::steps_per_sample;
pub use pooled::thresholds::{FALSE_DISCOVERIES, ROUNDING};
pub use pooled::together::{Together, fit_together, starts_together};
pub use question::{Begun, Goal, Question, Until};
pub use ranking::free_run::is_followed_with_an_effect;
pub use rung_model::RungModel;
pub use settings::DiagnoseSettings;
pub use snug_identify::derived::Derived;
pub use verdict::answer::Answer;
