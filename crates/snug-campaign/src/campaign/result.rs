//! A campaign, evaluated: what report and recording are made of.

use crate::campaign::condition_summary::ConditionSummary;
use crate::campaign::hypothesis_test::TestRow;
use crate::campaign::parameter_meaning::ParameterMeaning;
use crate::campaign::preset_summary::PresetSummary;
use crate::diagnosis::result::Diagnosis;
use crate::measurement::finding::Finding;
use crate::measurement::signal_units::SignalUnits;
use crate::tightening::result::TighteningResult;
use crate::tightening::traces::Traces;
use crate::words::vocabulary::Vocabulary;
use serde::Serialize;

/// A campaign, evaluated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CampaignResult {
    /// Title of the study.
    pub title: String,
    /// The study as run, every default written out (RON).
    pub study_ron: String,
    /// Preset the results were made with.
    pub preset: String,
    /// Which quantity was fitted, in words, for example `acceleration`.
    pub fitted_output: String,
    /// In which units input and output are shown.
    pub units: SignalUnits,
    /// In whose words it is told.
    pub vocabulary: Vocabulary,
    /// Names of the effects in the model; empty for the base model.
    pub effects: Vec<String>,
    /// What their parameters are.
    pub meanings: Vec<ParameterMeaning>,
    /// Both presets side by side (the one in use first).
    pub presets: Vec<PresetSummary>,
    /// Every tightening, in campaign order.
    pub tightenings: Vec<TighteningResult>,
    /// Means and spreads per condition.
    pub conditions: Vec<ConditionSummary>,
    /// Tests per quantity and factor.
    pub tests: Vec<TestRow>,
    /// What was left out, repaired or is worth knowing.
    pub findings: Vec<Finding>,
    /// Signals of a bounded number of tightenings: index into `tightenings`, signals.
    pub examples: Vec<(usize, Traces)>,
    /// What is missing in the model; `None` when nobody asked.
    pub diagnosis: Option<Diagnosis>,
}
