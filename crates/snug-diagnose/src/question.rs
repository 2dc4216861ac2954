//! What can be asked of the data.

use snug_identify::FitTask;
use snug_model::Effect;

/// What is asked of the data.
#[derive(Debug, Clone, PartialEq)]
pub enum Goal {
    /// Model against measurement, and where it fails.
    Compare,
    /// The same, and which effect is missing; nothing is changed.
    Diagnose,
    /// These effects are added, whatever the ranking says of them.
    Add(Vec<Effect>),
    /// Effects are added as long as the data justify it.
    Improve,
}

impl Goal {
    /// The verb that asks for it.
    pub(crate) fn verb(&self) -> &'static str {
        match self {
            Self::Compare => "compare",
            Self::Diagnose => "diagnose",
            Self::Add(_) => "add",
            Self::Improve => "improve",
        }
    }
}

/// A question to the data.
#[derive(Debug, Clone)]
pub struct Question<'a> {
    /// The tightenings.
    pub cases: &'a [FitTask<'a>],
    /// Effects of the study's own model.
    pub effects: Vec<Effect>,
    /// Effects that the study declares but does not use: candidates, too.
    pub custom: Vec<Effect>,
    /// What is asked.
    pub goal: Goal,
}
