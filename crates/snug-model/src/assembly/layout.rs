//! Which parameters and states belong to which effect of a model: the only place that knows their indices.

use crate::effects::Effect;
use crate::law::{AnsweredHooks, Corner};
use snug_campaign::Rig;
use std::ops::Range;

/// Free parameters a simulation with sensitivities can carry.
pub const MAXIMUM_FREE: usize = 16;

/// Names of the base model's parameters, in the order every assembly begins with.
pub const BASE_PARAMETERS: [&str; 3] = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];

/// Most states that the effects of one assembly may have together.
pub(crate) const MAXIMUM_OWN_STATES: usize = 4;

/// One effect's place in an assembly.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub effect: Effect,
    pub answered: AnsweredHooks,
    pub parameters: Range<usize>,
    pub states: Range<usize>,
}

/// The base model with its effects, laid out.
#[derive(Debug, Clone)]
pub struct Assembly {
    pub(crate) rig: Rig,
    pub(crate) corner: Corner<f64>,
    pub(crate) parts: Vec<Part>,
    pub(crate) parameter_count: usize,
    pub(crate) own_state_count: usize,
}

impl Assembly {
    pub(crate) fn rig(&self) -> &Rig {
        &self.rig
    }

    pub(crate) fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// No effect at all: the fast exact path without dual numbers applies.
    pub(crate) fn is_base(&self) -> bool {
        self.parts.is_empty()
    }

    /// The motion itself is the base model's, whatever the sensors add.
    pub(crate) fn moves_as_base(&self) -> bool {
        self.parts.iter().all(|part| part.answered.are_of_sensors())
    }
}
