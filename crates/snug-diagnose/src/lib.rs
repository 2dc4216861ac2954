#![doc = include_str!("../README.md")]

mod case;
mod climb;
mod dense;
mod detectability;
mod error;
mod evidence;
mod examine;
mod experiment;
mod family;
mod fitted;
mod hypothesis;
mod ladder;
mod locate;
mod nuisance;
mod preparation;
mod ranking;
mod score;
mod search;
mod settings;
mod sight;
mod simulated;
mod sizes;
mod tidying;
mod torque_noise;
mod trend;
mod units;
mod unlisted;
mod watch;
mod wording;

pub use case::Case;
pub use error::DiagnoseError;
pub use examine::{Answer, Goal, Question, RungModel, examine};
pub use locate::{Seen, compare, drifts, locate};
pub use settings::DiagnoseSettings;
pub use watch::Watch;
