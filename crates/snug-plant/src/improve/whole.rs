//! The models of a sample's ladder, fitted to all rows.

use super::ImproveSettings;
use crate::engine::Session;
use crate::error::PlantError;
use crate::functions::question::{Held, Sharing, States};
use crate::pooled::{Pass, PooledOverAll, pooled_over_all};
use crate::storage::dataset::{Commit, Dataset};
use crate::storage::partition::Partition;
use serde::Serialize;
use snug_campaign::Factor;
use snug_diagnose::SharedParameter;
use snug_preprocess::Prepared;
use snug_study::{Compared, PreparedDiagnosis, Study, shared_parameters};
use std::collections::BTreeMap;
use std::time::Duration;

/// A rung of the ladder over all rows.
#[derive(Debug, Clone)]
pub(crate) struct Rung {
    /// The study with its effects, their sizes free.
    pub study: Study,
    /// What rows share.
    pub shared: Vec<SharedParameter>,
    /// Where the fit to all rows ended, or why there is none.
    pub fit: Result<PooledOverAll, String>,
}

/// What `verdict.json` says of it.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct RungTold {
    /// Effects in the model.
    pub effects: Vec<String>,
    /// Rows that took part; those left out could not be compared as the sample is, or not be fitted.
    pub rows: Option<f64>,
    /// Rows that did not.
    pub left_out: Option<f64>,
    /// Root mean square of the whitened residual of all rows.
    pub error_over_noise: Option<f64>,
    /// The same of the sample.
    pub sample_error_over_noise: Option<f64>,
    /// Passes over the dataset.
    pub passes: Option<usize>,
    /// Whether the sizes are where the cost of all rows is least.
    pub converged: Option<bool>,
    /// Why this rung was not fitted to all rows.
    pub not_fitted: Option<String>,
}

impl Rung {
    /// What is told of it beside the sample's ladder.
    pub fn told(&self, found: &PreparedDiagnosis) -> RungTold {
        let effects = &self.study.model.effects;
        let ladder = found.result.diagnosis.iter().flat_map(|one| &one.ladder);
        let mut same = ladder.filter(|rung| rung.effects == *effects);
        let fit = self.fit.as_ref().ok();
        RungTold {
            effects: effects.clone(),
            rows: fit.map(|fit| fit.totals.members),
            left_out: fit.map(|fit| fit.totals.rows - fit.totals.members),
            error_over_noise: fit.map(PooledOverAll::error),
            sample_error_over_noise: same.next().and_then(|rung| rung.error_over_noise),
            passes: fit.map(|fit| fit.passes),
            converged: fit.map(|fit| fit.converged),
            not_fitted: self.fit.as_ref().err().cloned(),
        }
    }
}

/// A dataset, and what its rows are asked with.
pub(crate) struct Whole<'a> {
    pub data: &'a Dataset,
    /// The study with which the sample was asked first.
    pub study: &'a Study,
    pub parts: &'a [(Partition, Commit)],
    pub settings: &'a ImproveSettings,
    /// By what rows are known.
    pub states: &'a States,
    /// Where rows are asked.
    pub session: &'a Session,
    /// What rows are compared by.
    pub compared: Compared,
    /// One of the tightenings.
    pub first: &'a Prepared,
}

impl Whole<'_> {
    /// Every rung of what was found, fitted to all rows; the `first` is already.
    pub async fn rungs(
        &self,
        found: &PreparedDiagnosis,
        first: &Rung,
        told: &(dyn Fn(&str) + Sync + Send),
    ) -> Result<Vec<Rung>, PlantError> {
        let mut rungs = Vec::new();
        for of_sample in &found.rungs {
            let is_first = rungs.is_empty() && of_sample.model.effects == first.study.model.effects;
            rungs.push(match is_first {
                true => first.clone(),
                false => self.rung(of_sample, told).await?,
            });
        }
        Ok(rungs)
    }

    /// One model fitted to all rows, from the sizes that its study states.
    pub async fn rung(
        &self,
        of_sample: &Study,
        told: &(dyn Fn(&str) + Sync + Send),
    ) -> Result<Rung, PlantError> {
        let study = self.freed(of_sample);
        let shared = shared_parameters(&study, self.first)?;
        let text = study.to_ron()?;
        let pass = Pass {
            session: self.session,
            data: self.data,
            study: &text,
            parts: self.parts,
            rows_per_job: self.settings.rows_per_job,
            given_up_after: Duration::from_secs(self.settings.given_up_after_s),
        };
        let effects = study.model.effects.join(" + ");
        let name = match effects.is_empty() {
            true => "the base model",
            false => &effects,
        };
        let hear = |pass: usize, cost: f64| {
            let squares = 2.0 * cost;
            told(&format!(
                "{name}, pass {pass} over all rows: sum of squares {squares:.9e}"
            ));
        };
        let bounds = shared.iter().map(|one| (one.minimum, one.maximum));
        let bounds: Vec<(f64, f64)> = bounds.collect();
        let fit = match self.start(of_sample, &shared) {
            Ok(start) => match pooled_over_all(&pass, &start, &bounds, &hear).await {
                Ok(fit) => Ok(fit),
                Err(error @ PlantError::Setting { .. }) => Err(error.to_string()),
                Err(error) => return Err(error),
            },
            Err(why) => Err(why),
        };
        Ok(Rung { study, shared, fit })
    }

    /// The study with the effects of a rung, and all sizes as free as they were at first.
    fn freed(&self, rung: &Study) -> Study {
        let mut study = self.study.clone();
        study.model.effects.clone_from(&rung.model.effects);
        study.model.custom.clone_from(&rung.model.custom);
        study
    }

    /// The sizes that the sample found, as a start for all rows; the reason where they are shared in a way that rows are not asked.
    fn start(&self, rung: &Study, shared: &[SharedParameter]) -> Result<Held, String> {
        let told = |one: &SharedParameter| rung.model.parameters.get(&one.name);
        let by_group: Vec<_> = (shared.iter())
            .map(|one| told(one).and_then(|told| told.by_group.as_ref()))
            .collect();
        let mut factors: Vec<&Factor> = by_group.iter().flatten().map(|by| &by.factor).collect();
        factors.dedup();
        let factor = match factors.as_slice() {
            [] => None,
            [one] if one.is_of_time() => {
                return Err(format!(
                    "sizes differ by the {one} of the sample, which other rows have none of"
                ));
            }
            [one] => Some((*one).clone()),
            several => {
                let names: Vec<String> = several.iter().map(|one| one.to_string()).collect();
                return Err(format!(
                    "sizes differ by {}: of all rows they are asked by one factor only",
                    names.join(" and by ")
                ));
            }
        };
        let all: Vec<f64> = shared
            .iter()
            .map(|one| told(one).and_then(|told| told.value).unwrap_or(one.start))
            .collect();
        let mut groups: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        for (place, by) in by_group.iter().enumerate() {
            for (name, value) in by.iter().flat_map(|by| &by.values) {
                groups.entry(name.clone()).or_insert_with(|| all.clone())[place] = value.value;
            }
        }
        Ok(Held {
            compared: self.compared,
            states: self.states.clone(),
            sharing: Sharing {
                factor,
                differs: by_group.iter().map(Option::is_some).collect(),
            },
            all,
            groups,
        })
    }
}
