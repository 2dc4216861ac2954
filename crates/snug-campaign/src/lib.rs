//! The words every Snug crate shares: recordings, tightenings, estimates, findings, results and a diagnosis.
#![doc = include_str!("../README.md")]

mod campaign;
mod comparison;
mod conditions;
mod diagnosis;
mod diagnosis_summary;
mod estimate;
mod excerpt;
mod factor;
mod finding;
mod likely_name;
mod location;
mod noise;
mod parameter;
mod recording;
mod rig;
mod rung;
mod tightening;
mod time_base;
mod units;
mod validation;
pub mod words;

pub use campaign::{
    AssumptionCheck, CampaignResult, ConditionSummary, EffectSize, Moments, ParameterMeaning,
    PresetSummary, QuantitySummary, RejectionCount, TestRow,
};
pub use comparison::{Comparison, Misfit, TighteningMisfit};
pub use conditions::Conditions;
pub use diagnosis::{
    AddedEffect, ChangePoint, CorrectedEffect, Detectability, Diagnosis, Doubt, EffectParameter,
    Experiment, GroupSize, GroupSizes, InSomeGroups, NegativeControl, NoiseStatement, RankedEffect,
    Removal, SizeComparison, UnlistedTerm, Verdict, WorkDone, sharing,
};
pub use diagnosis_summary::DiagnosisSummary;
pub use estimate::{Estimate, FitStatus, Identifiability, Interval, NORMAL_95, ParameterEstimate};
pub use excerpt::excerpt;
pub use factor::{Factor, Level};
pub use finding::{Finding, Severity};
pub use likely_name::did_you_mean;
pub use location::{
    Aspect, Drift, ForceCurve, ForceMap, FrequencyResponse, Location, ResidualCorrelation,
    Response, Share,
};
pub use noise::{NoiseFloor, NoiseSource};
pub use parameter::{Parameter, ParameterSource};
pub use recording::{Motion, Recording, Segment};
pub use rig::{Intersample, Quantity, Rig};
pub use rung::{Became, Rung};
pub use tightening::{
    Correction, FitMeasures, Rejection, Selection, Tightening, TighteningId, TighteningResult,
    Traces,
};
pub use time_base::TimeBase;
pub use units::SignalUnits;
pub use validation::{Prediction, RestartedPrediction, Validation};
