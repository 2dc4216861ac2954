//! The present model's results as files: report and recording, made by the same order of work as every run.

use crate::bench::{Bench, locked};
use crate::changes::EffectSet;
use crate::error::WorkbenchError;
use snug_study::{RunSettings, Verb, diagnose, run};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

/// Results that were made, by their models; the folders go with the workbench.
#[derive(Default)]
pub(crate) struct Results {
    made: Vec<(usize, EffectSet, TempDir)>,
    count: usize,
}

/// Results that are kept; a report and a recording of 24 tightenings take 3 MB. Chosen.
const MOST: usize = 8;

/// What may be had of them, and what that is.
pub(crate) const FILES: [(&str, &str); 2] = [
    ("report.html", "text/html; charset=utf-8"),
    ("recording.mcap", "application/octet-stream"),
];

impl Bench {
    /// Makes report and recording of a model, or finds them; the number under which they are kept.
    ///
    /// What was added to the study's own model is tested as `add` does it; another model is run as a study that has it.
    pub(crate) fn make_results(&self, effects: &EffectSet) -> Result<usize, WorkbenchError> {
        let campaign = self.campaign()?;
        campaign.prepared.named(effects.names())?;
        let known = {
            let results = locked(&self.results);
            let found = results.made.iter().find(|(_, known, _)| known == effects);
            found.map(|(number, _, _)| *number)
        };
        if let Some(number) = known {
            return Ok(number);
        }
        let folder = TempDir::new().map_err(|source| WorkbenchError::Results { source })?;
        let (settings, never) = (RunSettings::new(folder.path()), AtomicBool::new(false));
        let base = campaign.base_set();
        let added: Vec<String> = effects.beyond(&base).map(str::to_owned).collect();
        let mut study = self.study().clone();
        match base.beyond(effects).next() {
            None if !added.is_empty() => {
                diagnose(&study, &Verb::Add(added), &settings, &|_| (), &never)?
            }
            _ => {
                study.model.effects = effects.names().to_vec();
                run(&study, &settings, &|_| (), &never)?
            }
        };
        let mut results = locked(&self.results);
        results.count += 1;
        let number = results.count;
        if results.made.len() >= MOST {
            results.made.remove(0);
        }
        results.made.push((number, effects.clone(), folder));
        Ok(number)
    }

    /// Where a file of results stands, and what it is.
    pub(crate) fn result_file(
        &self,
        number: usize,
        name: &str,
    ) -> Result<(PathBuf, &'static str), WorkbenchError> {
        let results = locked(&self.results);
        let folder = results.made.iter().find(|(known, _, _)| *known == number);
        let file = FILES.iter().find(|(known, _)| *known == name);
        match (folder, file) {
            (Some((_, _, folder)), Some((name, kind))) => Ok((folder.path().join(name), kind)),
            _ => Err(WorkbenchError::NoResults),
        }
    }
}
