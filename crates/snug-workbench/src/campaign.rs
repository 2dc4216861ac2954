//! What is worked on: tightenings that are read once, the model to begin with, and the catalogue beside it.

pub(crate) mod focus;
pub(crate) mod groups;

use crate::campaign::groups::{Group, groups};
use crate::changes::EffectSet;
use crate::error::WorkbenchError;
use snug_campaign::words::effect_name::effect_name;
use snug_campaign::words::number::significant;
use snug_campaign::words::vocabulary::Vocabulary;
use snug_diagnose::LiveFit;
use snug_model::{Description, Effect, Law};
use snug_report::viewer::{Compared, Simulated};
use snug_study::{FilesRead, Prepared, Stretch, Study, prepare};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, OnceLock};

/// Digits of an error.
const DIGITS: i32 = 4;

/// Tightenings, read and prepared, with the model to begin with fitted to them.
pub(crate) struct Campaign {
    pub prepared: Prepared,
    /// Of the study's own model.
    pub base: Arc<LiveFit>,
    /// What may be switched on and off: the study's own effects, then the candidates in the catalogue's order.
    pub switches: Vec<Effect>,
    /// Tightenings, those first that the model to begin with fits worst.
    pub worst_first: Vec<usize>,
    /// Tightenings that have a condition in common, to be looked at alone.
    pub groups: Vec<Group>,
    /// Which stretch of every window is fitted alone, in words; empty where all of it is.
    pub stretch: String,
    /// The title of the study, or the data's name.
    pub title: String,
    /// How many of them would be selected under the model to begin with; worked out when it is first asked.
    base_usable: OnceLock<Option<usize>>,
    /// What an error counts in: multiples of the noise, or the shown output's unit.
    pub error_unit: String,
    /// What an error of a fit is multiplied with to be shown in it.
    error_scale: f64,
}

impl Campaign {
    /// Reads, prepares and fits; `tell` hears of every file that is read.
    pub fn read(study: &Study, tell: &(dyn Fn(FilesRead) + Sync)) -> Result<Self, WorkbenchError> {
        let prepared = prepare(study, tell)?;
        let live = &prepared.live;
        let never = AtomicBool::new(false);
        let base = live.fit(&prepared.effects, None, &|_| (), &never)?;
        let mut switches = prepared.effects.clone();
        switches.extend(live.candidates(&base)?);
        let errors = base.errors();
        let mut worst_first: Vec<usize> = (0..errors.len()).collect();
        worst_first.sort_by(|&a, &b| errors[b].total_cmp(&errors[a]));
        let units = &prepared.units;
        let quantity = live.tasks()[0].quantity();
        let (error_scale, error_unit) = match base.is_over_noise() {
            true => (1.0, "times the noise".to_owned()),
            false => (
                units.output_per_rad,
                format!("{} root mean square", units.motion(quantity)),
            ),
        };
        Ok(Self {
            error_scale,
            error_unit,
            base_usable: OnceLock::new(),
            base: Arc::new(base),
            switches,
            worst_first,
            groups: groups(live),
            stretch: study.preprocess.stretch.map_or_else(String::new, in_words),
            title: study.title(),
            prepared,
        })
    }

    /// How many tightenings would be selected under a model; `None` where nobody knows.
    pub fn usable(&self, fit: &LiveFit) -> Option<usize> {
        let usable = self.prepared.usable(fit);
        usable
            .inspect_err(|error| {
                tracing::warn!(%error, "nobody knows which tightenings would be selected");
            })
            .ok()
    }

    /// The same under the model to begin with.
    pub fn base_usable(&self) -> Option<usize> {
        *self.base_usable.get_or_init(|| self.usable(&self.base))
    }

    /// An error as it is shown, without its unit.
    pub fn shown(&self, error: f64) -> String {
        significant(self.error_scale * error, DIGITS)
    }

    /// The names of the effects to begin with.
    pub fn base_set(&self) -> EffectSet {
        EffectSet::of(self.prepared.effects.iter().map(Effect::name))
    }

    /// What people read about an effect on this rig.
    pub fn description(&self, effect: Effect) -> Description {
        match self.prepared.vocabulary {
            Vocabulary::Hand => *effect.description(),
            Vocabulary::Machine(_) => effect.description().of_machine(),
        }
    }

    /// An effect as people say it on this rig.
    pub fn called(&self, effect: &str) -> String {
        self.says(&effect_name(effect))
    }

    /// A sentence in the words of the rig at hand.
    pub fn says(&self, text: &str) -> String {
        self.prepared.vocabulary.says(text)
    }

    /// Index of the tightening with this number, counted from 1.
    pub fn member(&self, number: usize) -> Result<usize, WorkbenchError> {
        let count = self.prepared.live.tasks().len();
        match (1..=count).contains(&number) {
            true => Ok(number - 1),
            false => Err(WorkbenchError::NoTightening { number, count }),
        }
    }

    /// The group with this key.
    pub fn group(&self, key: &str) -> Result<&Group, WorkbenchError> {
        let found = self.groups.iter().find(|group| group.key == key);
        found.ok_or_else(|| WorkbenchError::NoGroup {
            key: key.to_owned(),
            keys: self.groups.iter().map(|group| group.key.clone()).collect(),
        })
    }

    /// One tightening as measured and as models have it, for the viewer; `signature` is drawn beside what is left over.
    pub fn compared<'a>(
        &'a self,
        member: usize,
        models: Vec<Simulated<'a>>,
        signature: Option<Simulated<'a>>,
    ) -> Compared<'a> {
        let case = &self.prepared.live.tasks()[member];
        let noise = case.tightening.noise.as_ref();
        Compared {
            quantity: case.quantity(),
            units: &self.prepared.units,
            vocabulary: self.prepared.vocabulary,
            interval_s: case.tightening.time_base.interval_s,
            measured: case.measured(),
            models,
            signature,
            noise: noise
                .filter(|noise| noise.quantity == case.quantity())
                .map(|noise| noise.standard_deviation),
            step_nm: Some(self.prepared.live.step_nm(member)),
        }
    }
}

/// A stretch that is fitted alone.
fn in_words(Stretch { from_s, to_s }: Stretch) -> String {
    let number = |value: f64| significant(value, DIGITS);
    format!(
        ", from {} to {} s of every window alone",
        number(from_s),
        number(to_s)
    )
}
