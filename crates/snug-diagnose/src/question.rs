//! What can be asked of the data.

use crate::error::DiagnoseError;
use crate::pooled::parameter_place::effect_of;
use crate::pooled::sharing::{Groups, Sharing};
use crate::rung_model::RungModel;
use snug_campaign::{Factor, SignalUnits};
use snug_identify::FitTask;
use snug_model::Effect;
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};

/// What is asked of the data.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Goal {
    /// Model against measurement, and where it fails.
    Compare,
    /// The same, and which effect is missing; nothing is changed.
    Diagnose,
    /// These effects are added, whatever the ranking says of them.
    Add(Vec<Effect>),
    /// Effects are added as long as the data justify it.
    Improve,
    /// The same, begun with these.
    ImproveFrom(Vec<Begun>),
}

/// An effect to begin with.
#[derive(Debug, Clone, PartialEq)]
pub struct Begun {
    /// The effect.
    pub effect: Effect,
    /// Values of parameters that all tightenings share, by name, where a model with it and those before it may begin: where another fit of
    /// that ended.
    pub values: Vec<(String, f64)>,
}

impl Begun {
    /// From where its parameters usually begin.
    pub(crate) fn as_usual(effect: Effect) -> Self {
        Self {
            effect,
            values: Vec::new(),
        }
    }
}

impl<'a> Question<'a> {
    /// Of the base model of `cases`, with no effect in it and none but the catalogue's as candidates.
    pub fn new(cases: &'a [FitTask<'a>], goal: Goal) -> Self {
        Self {
            cases,
            effects: Vec::new(),
            by_group: Vec::new(),
            custom: Vec::new(),
            goal,
            may_ask_for_steps: false,
            until: None,
            units: SignalUnits::default(),
        }
    }

    /// Which of the study's own effects have sizes that differ between groups.
    pub(crate) fn sharing(&self) -> Result<Sharing, DiagnoseError> {
        let mut sharing = Sharing::default();
        let Some(case) = self.cases.first() else {
            return Ok(sharing);
        };
        let model = case.model_with(&self.effects)?;
        for (name, factor) in &self.by_group {
            let index = model.parameters().iter().position(|p| p.name == *name);
            if let Some((effect, _)) = index.and_then(|index| effect_of(&self.effects, index))
                && Groups::of(self.cases, factor).is_some()
            {
                sharing = sharing.with(effect, Some(factor.clone()));
            }
        }
        Ok(sharing)
    }
}

impl Goal {
    /// The verb that asks for it.
    pub(crate) fn verb(&self) -> &'static str {
        match self {
            Self::Compare => "compare",
            Self::Diagnose => "diagnose",
            Self::Add(_) => "add",
            Self::Improve | Self::ImproveFrom(_) => "improve",
        }
    }
}

/// Up to which model effects are added, if one is reached before the data justify no more.
pub struct Until<'a> {
    is_enough: &'a (dyn Fn(&RungModel) -> bool + Sync),
    is_reached: AtomicBool,
}

impl<'a> Until<'a> {
    /// Up to the first that `is_enough`.
    pub fn new(is_enough: &'a (dyn Fn(&RungModel) -> bool + Sync)) -> Self {
        Self {
            is_enough,
            is_reached: AtomicBool::new(false),
        }
    }

    /// Whether the last that was asked about is enough.
    pub fn is_reached(&self) -> bool {
        self.is_reached.load(Ordering::Relaxed)
    }

    pub(crate) fn is_reached_by(&self, model: &RungModel) -> bool {
        let is_enough = (self.is_enough)(model);
        self.is_reached.store(is_enough, Ordering::Relaxed);
        is_enough
    }
}

impl fmt::Debug for Until<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (f.debug_struct("Until"))
            .field("is_reached", &self.is_reached)
            .finish_non_exhaustive()
    }
}

/// A question to the data.
#[derive(Debug, Clone)]
pub struct Question<'a> {
    /// The tightenings.
    pub cases: &'a [FitTask<'a>],
    /// Effects of the study's own model.
    pub effects: Vec<Effect>,
    /// Which of their parameters differ between groups of tightenings, by name, and what groups these.
    pub by_group: Vec<(String, Factor)>,
    /// Effects that the study declares but does not use: candidates, too.
    pub custom: Vec<Effect>,
    /// What is asked.
    pub goal: Goal,
    /// Whether to end with [`DiagnoseError::Unresolved`] where the simulation takes too few steps for what is found.
    pub may_ask_for_steps: bool,
    /// Where to look no further, though the data may justify more.
    pub until: Option<&'a Until<'a>>,
    /// In which units errors are told.
    pub units: SignalUnits,
}
