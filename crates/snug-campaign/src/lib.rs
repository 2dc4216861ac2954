//! The words every Snug crate shares: recordings, tightenings, estimates, findings, results and a diagnosis.
#![doc = include_str!("../README.md")]

mod campaign;
mod diagnosis;
mod identification;
mod measurement;
mod tightening;
pub mod words;

pub use campaign::result::{
    AssumptionCheck, CampaignResult, ConditionSummary, EffectSize, Moments, ParameterMeaning,
    PresetSummary, QuantitySummary, RejectionCount, TestRow,
};
pub use diagnosis::comparison::{Comparison, Misfit, TighteningMisfit};
pub use diagnosis::location::{
    Aspect, Drift, ForceCurve, ForceMap, FrequencyResponse, Location, ResidualCorrelation,
    Response, Share,
};
pub use diagnosis::result::{
    AddedEffect, ChangePoint, CorrectedEffect, Detectability, Diagnosis, Doubt, EffectParameter,
    Experiment, GroupSize, GroupSizes, InSomeGroups, NegativeControl, NoiseStatement, RankedEffect,
    Removal, SizeComparison, UnlistedTerm, Verdict, WorkDone, sharing,
};
pub use diagnosis::rung::{Became, Rung};
pub use diagnosis::summary::DiagnosisSummary;
pub use identification::estimate::{
    Estimate, FitStatus, Identifiability, Interval, NORMAL_95, ParameterEstimate,
};
pub use identification::parameter::{Parameter, ParameterSource};
pub use measurement::conditions::Conditions;
pub use measurement::finding::{Finding, Severity};
pub use measurement::noise::{NoiseFloor, NoiseSource};
pub use measurement::recording::{Motion, Recording, Segment};
pub use measurement::rig::{Intersample, Quantity, Rig};
pub use measurement::signal_units::SignalUnits;
pub use measurement::time_base::TimeBase;
pub use tightening::factor::{Factor, Level};
pub use tightening::result::{
    Correction, FitMeasures, Rejection, Selection, Tightening, TighteningId, TighteningResult,
    Traces,
};
pub use tightening::validation::{Prediction, RestartedPrediction, Validation};
pub use words::excerpt::excerpt;
pub use words::likely_name::did_you_mean;
