//! The words every Snug crate shares.
//!
//! A [`Recording`] is one measurement file in SI units; [`Tightening`]s are cut from it; a [`TighteningResult`] says
//! what was identified, and a [`CampaignResult`] what all of them say together. This crate holds plain data: it reads
//! no files, knows no model and computes nothing beyond one-line definitions.
//!
//! ```
//! use snug_campaign::{Conditions, TighteningId, TimeBase};
//!
//! let time = TimeBase { start_s: 1.48, interval_s: 1e-4 };
//! assert_eq!(time.at(100), 1.49);
//! let id = TighteningId { file: "TP3_QS_Soft_8.mat".into(), number: 2 };
//! assert_eq!(id.to_string(), "TP3_QS_Soft_8.mat #2");
//! let conditions = Conditions { participant: Some("TP3".into()), ..Conditions::default() };
//! assert!(conditions.strategy.is_none(), "what a file does not say stays unsaid");
//! ```

mod campaign;
mod comparison;
mod conditions;
mod diagnosis;
mod estimate;
mod finding;
mod location;
mod noise;
mod parameter;
mod recording;
mod rig;
mod tightening;
mod time_base;
mod units;

pub use campaign::{
    CampaignResult, ConditionSummary, EffectSize, Moments, PresetSummary, QuantitySummary,
    RejectionCount, TestRow,
};
pub use comparison::{Comparison, Misfit, TighteningMisfit};
pub use conditions::Conditions;
pub use diagnosis::{
    AddedEffect, CorrectedEffect, Detectability, Diagnosis, EffectParameter, Experiment,
    NegativeControl, NoiseStatement, RankedEffect, Removal, Rung, Showcase, UnlistedTerm, Verdict,
};
pub use estimate::{Estimate, FitStatus, Identifiability, Interval, ParameterEstimate};
pub use finding::{Finding, Severity};
pub use location::{Aspect, Drift, ForceCurve, ForceMap, Location, Share};
pub use noise::{NoiseFloor, NoiseSource};
pub use parameter::{Parameter, ParameterSource};
pub use recording::{Motion, Recording, Segment};
pub use rig::{Intersample, Quantity, Rig};
pub use tightening::{
    Correction, FitMeasures, Rejection, Selection, Tightening, TighteningId, TighteningResult,
    Traces,
};
pub use time_base::TimeBase;
pub use units::SignalUnits;
