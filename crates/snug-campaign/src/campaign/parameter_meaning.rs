//! What the parameters of the model's effects are.

use crate::words::effect_name::effect_name;
use serde::{Deserialize, Serialize};

/// What a parameter of one of the model's effects is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ParameterMeaning {
    /// Its column: name with unit suffix.
    pub name: String,
    /// Its effect.
    pub effect: String,
    /// What it is, in a few words, as its effect says it.
    pub meaning: String,
}

impl ParameterMeaning {
    /// Effect and parameter: `Coulomb friction: friction force`; of an effect that is called like its only parameter once.
    pub fn words(&self) -> String {
        let effect = effect_name(&self.effect);
        match self.meaning == effect {
            true => effect,
            false => format!("{effect}: {}", self.meaning),
        }
    }
}
