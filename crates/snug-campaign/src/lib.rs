//! The words every Snug crate shares: recordings, tightenings, estimates, findings, results and a diagnosis.
#![doc = include_str!("../README.md")]

mod campaign;
mod diagnosis;
mod effect;
mod identification;
mod measurement;
mod tightening;
pub mod words;

pub use campaign::condition_summary::{ConditionSummary, Moments, QuantitySummary};
pub use campaign::hypothesis_test::{AssumptionCheck, EffectSize, TestRow};
pub use campaign::parameter_meaning::ParameterMeaning;
pub use campaign::preset_summary::{PresetSummary, RejectionCount};
pub use campaign::result::CampaignResult;
pub use diagnosis::became::Became;
pub use diagnosis::comparison::{Comparison, Misfit, TighteningMisfit};
pub use diagnosis::drift::Drift;
pub use diagnosis::experiment::Experiment;
pub use diagnosis::location::{
    Aspect, ForceCurve, ForceMap, FrequencyResponse, Location, ResidualCorrelation, Response, Share,
};
pub use diagnosis::negative_control::NegativeControl;
pub use diagnosis::noise::NoiseStatement;
pub use diagnosis::removal::Removal;
pub use diagnosis::result::Diagnosis;
pub use diagnosis::rung::Rung;
pub use diagnosis::summary::DiagnosisSummary;
pub use diagnosis::verdict::Verdict;
pub use diagnosis::work::WorkDone;
pub use effect::added::AddedEffect;
pub use effect::corrected::CorrectedEffect;
pub use effect::detectability::{Detectability, InSomeGroups};
pub use effect::ranked::{Doubt, RankedEffect};
pub use effect::size::{ChangePoint, EffectParameter, GroupSize, GroupSizes, sharing};
pub use effect::size_comparison::SizeComparison;
pub use effect::unlisted::UnlistedTerm;
pub use identification::estimate::{Estimate, FitStatus, Identifiability, ParameterEstimate};
pub use identification::interval::{Interval, NORMAL_95};
pub use identification::parameter::{Parameter, ParameterSource};
pub use measurement::conditions::Conditions;
pub use measurement::finding::{Finding, Severity};
pub use measurement::motion::Motion;
pub use measurement::noise::{NoiseFloor, NoiseSource};
pub use measurement::quantity::Quantity;
pub use measurement::recording::{Recording, Segment};
pub use measurement::rig::{Intersample, Rig};
pub use measurement::signal_units::SignalUnits;
pub use measurement::time_base::TimeBase;
pub use tightening::correction::Correction;
pub use tightening::factor::Factor;
pub use tightening::id::TighteningId;
pub use tightening::level::Level;
pub use tightening::measures::FitMeasures;
pub use tightening::prepared::Tightening;
pub use tightening::result::TighteningResult;
pub use tightening::selection::{Rejection, Selection};
pub use tightening::target_torque::target_torque_nm;
pub use tightening::traces::Traces;
pub use tightening::validation::{Prediction, RestartedPrediction, Validation};
pub use words::excerpt::excerpt;
pub use words::likely_name::did_you_mean;
