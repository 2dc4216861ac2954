//! Names of effects as arguments: shells complete those of the catalogue, and any name is taken.
//!
//! A study's own laws are effects, too, so that only the verb knows whether there is one of that name.

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::{Arg, Command};
use snug_model::{Effect, INVISIBLE, Law, TRENDS};
use std::ffi::OsStr;

/// Which names shells complete.
#[derive(Debug, Clone, Copy)]
pub enum EffectNames {
    /// Of effects that a model can have.
    OfModels,
    /// Of whatever the catalogue has a page on.
    InCatalogue,
}

impl TypedValueParser for EffectNames {
    type Value = String;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        StringValueParser::new().parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let value = |name, summary| PossibleValue::new(name).help(summary);
        let models = (Effect::ALL.iter().map(Law::description))
            .map(move |effect| value(effect.name, effect.summary));
        let trends = TRENDS
            .iter()
            .map(move |trend| value(trend.name, trend.summary));
        let never = INVISIBLE
            .iter()
            .map(move |one| value(one.name, one.summary));
        match self {
            Self::OfModels => Some(Box::new(models)),
            Self::InCatalogue => Some(Box::new(models.chain(trends).chain(never))),
        }
    }
}
