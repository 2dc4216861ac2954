//! The present model's results as files: report and recording, made by the same order of work as every run.

use crate::bench::{Bench, locked};
use crate::changes::EffectSet;
use crate::error::WorkbenchError;
use snug_study::{RunSettings, Verb, diagnose, run};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

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
        // Two that ask at the same moment: the second waits, and finds what the first has made.
        let turn = self.making.of(effects);
        let _turn = locked(&turn);
        let known = locked(&self.results).number(effects);
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
        Ok(locked(&self.results).keep(effects.clone(), folder))
    }

    /// Where a file of results stands, and what it is.
    pub(crate) fn result_file(
        &self,
        number: usize,
        name: &str,
    ) -> Result<(PathBuf, &'static str), WorkbenchError> {
        let results = locked(&self.results);
        let folder = results.folder(number);
        let file = FILES.iter().find(|(known, _)| *known == name);
        match (folder, file) {
            (Some(folder), Some((name, kind))) => Ok((folder.join(name), kind)),
            _ => Err(WorkbenchError::NoResults),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use snug_study::Study;
    use std::path::Path;
    use std::sync::Arc;

    #[test]
    fn two_who_ask_at_the_same_moment_get_the_same_files_made_once() {
        let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/mystery");
        let bench = Bench::new(Study::on(data), None);
        bench.read();
        let ask = || {
            let bench = Arc::clone(&bench);
            std::thread::spawn(move || bench.make_results(&EffectSet::default()).unwrap())
        };
        let asked: Vec<_> = (0..3).map(|_| ask()).collect();
        let numbers: Vec<usize> = asked.into_iter().map(|one| one.join().unwrap()).collect();
        assert_eq!(numbers, [numbers[0]; 3]);
        assert_eq!(locked(&bench.results).made(), 1);
        for (name, _) in FILES {
            assert!(bench.result_file(numbers[0], name).unwrap().0.is_file());
        }
    }
}
