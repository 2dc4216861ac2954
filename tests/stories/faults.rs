//! Every single call to the disk fails in turn while a study is run or improved: the old results stand, or the new ones.

use snug_files::fault::{Fault, FaultyDisk, Lasting};
use snug_files::{Disk, Host};
use snug_study::{Outcome, ProgressEvent, RunSettings, Study, StudyError, Verb, diagnose, run};
use snug_synthetic::{CampaignPlan, HiddenEffect, MatStyle, simulate};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tempfile::TempDir;

type Results = BTreeMap<String, Vec<u8>>;
type Work = fn(&Study, &RunSettings) -> Result<Outcome, StudyError>;

/// In memory where that is to be had: many runs wait for the medium many times.
fn folder() -> TempDir {
    tempfile::tempdir_in("/dev/shm").unwrap_or_else(|_| tempfile::tempdir().unwrap())
}

/// A study on a small campaign with a cubic spring.
fn study(files: usize, seed: u64, folder: &Path) -> Study {
    let mut plan = CampaignPlan::of_size(files, 4);
    plan.effects = vec![HiddenEffect::CubicStiffness];
    let campaign = simulate(&plan, seed).unwrap();
    let data = folder.join("data");
    campaign.write(&data, MatStyle::default()).unwrap();
    let mut study = Study::on(data);
    study.diagnosis.search.sign_flips = 99;
    study.diagnosis.search.control_campaigns = 0;
    study.diagnosis.search.starts = 1;
    study
}

fn settings(out: &Path, disk: impl Disk + 'static) -> RunSettings {
    RunSettings {
        threads: Some(1),
        disk: Arc::new(disk),
        ..RunSettings::new(out)
    }
}

fn run_it(study: &Study, settings: &RunSettings) -> Result<Outcome, StudyError> {
    run(study, settings, &|_| (), &AtomicBool::new(false))
}

fn compare_it(study: &Study, settings: &RunSettings) -> Result<Outcome, StudyError> {
    let never = AtomicBool::new(false);
    diagnose(study, &Verb::Compare, settings, &|_| (), &never)
}

/// What an improvement reads and writes, without the search between, in which the disk has no part.
fn improve_it(study: &Study, settings: &RunSettings) -> Result<Outcome, StudyError> {
    let stop = AtomicBool::new(false);
    let stop_there = |event: ProgressEvent<'_>| {
        if matches!(event, ProgressEvent::Stage { what } if what.starts_with("ranking")) {
            stop.store(true, Ordering::Relaxed);
        }
    };
    diagnose(study, &Verb::Improve, settings, &stop_there, &stop)
}

/// The same with the search.
fn improve_to_the_end(study: &Study, settings: &RunSettings) -> Result<Outcome, StudyError> {
    let never = AtomicBool::new(false);
    diagnose(study, &Verb::Improve, settings, &|_| (), &never)
}

/// The results in a folder; what was set aside because it could not be read is one of the old ones.
fn results(out: &Path, old: &Results) -> Results {
    let mut results = Results::new();
    for entry in std::fs::read_dir(out).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let content = std::fs::read(&path).unwrap_or_default();
        if name.contains(".kept-") {
            assert!(old.values().any(|known| *known == content), "{name}");
        } else if !name.starts_with(".snug-") && !name.contains(".partial-") {
            results.insert(name, content);
        }
    }
    results
}

/// Whether these are the new results, or what came out without a measurement file that could not be read: then that is
/// told.
fn is_new(found: &Results, new: &Results) -> bool {
    let tells = |name: &str| {
        let text = found.get(name).map(|text| String::from_utf8_lossy(text));
        text.is_some_and(|text| text.contains("cannot be read"))
    };
    found == new || found.keys().eq(new.keys()) && (tells("findings.json") || tells("verdict.json"))
}

struct Trial {
    work: Work,
    old: Results,
    new: Results,
    second: Study,
    /// The old results, from which every attempt begins.
    template: TempDir,
    _data: [TempDir; 2],
}

impl Trial {
    fn new(work: Work) -> Self {
        let data = [folder(), folder()];
        let (first, second) = (study(1, 7, data[0].path()), study(2, 8, data[1].path()));
        let (template, alone) = (folder(), folder());
        compare_it(&first, &settings(template.path(), Host)).unwrap();
        work(&second, &settings(alone.path(), Host)).unwrap();
        let nothing = Results::new();
        Self {
            work,
            old: results(template.path(), &nothing),
            new: results(alone.path(), &nothing),
            second,
            template,
            _data: data,
        }
    }

    /// A folder with the old results.
    fn begun(&self) -> TempDir {
        let out = folder();
        for entry in std::fs::read_dir(self.template.path()).unwrap() {
            let path = entry.unwrap().path();
            std::fs::copy(&path, out.path().join(path.file_name().unwrap())).unwrap();
        }
        out
    }

    fn calls(&self) -> u64 {
        let (out, disk) = (self.begun(), FaultyDisk::counting());
        (self.work)(&self.second, &settings(out.path(), disk.clone())).unwrap();
        disk.calls()
    }

    /// One call fails.
    fn attempt(&self, at: u64, fault: Fault, lasting: Lasting) {
        let out = self.begun();
        let told = format!("{fault:?}, {lasting:?}, at call {at}");
        let disk = FaultyDisk::new(at, fault, lasting);
        let outcome = (self.work)(&self.second, &settings(out.path(), disk));
        if lasting == Lasting::FromThenOn {
            // Whoever takes the folder next ends what was begun.
            let names = &["report.html"];
            drop(snug_files::Results::begin(Arc::new(Host), out.path(), names, None).unwrap());
        }
        let left = results(out.path(), &self.old);
        match &outcome {
            Ok(_) => assert!(is_new(&left, &self.new), "{told}: done, but not whole"),
            Err(error) => {
                let is_whole =
                    left == self.old || lasting == Lasting::FromThenOn && is_new(&left, &self.new);
                assert!(is_whole, "{told}: {error}");
                let text = error.to_string();
                let names_a_path = text.contains("/dev/shm") || text.contains("/tmp");
                assert!(names_a_path, "{told}: {text}");
            }
        }
    }

    /// Every `step`th call fails, each fault and duration in turn, and every `at_last`th of the exchange at the end.
    fn attempts(&self, step: usize, at_last: usize) {
        let calls = self.calls();
        println!("{calls} calls to the disk, each {step}. of them made to fail");
        for (turn, at) in (0..calls).step_by(step).enumerate() {
            let lasting = [Lasting::Once, Lasting::FromThenOn][turn / 4 % 2];
            self.attempt(at, Fault::ALL[turn % 4], lasting);
        }
        for at in (calls.saturating_sub(EXCHANGE)..calls).step_by(at_last) {
            self.attempt(at, Fault::ALL[at as usize % 4], Lasting::Once);
        }
    }
}

/// Calls that an exchange of results takes, and a few more.
const EXCHANGE: u64 = 60;

/// Of so many calls one fails; with SNUG_MANY every other does.
fn each(step: usize) -> usize {
    match snug_tests::many() {
        true => 2,
        false => step,
    }
}

#[test]
fn a_run_of_which_any_call_fails_leaves_old_results_or_new_ones() {
    Trial::new(run_it).attempts(each(9), 1);
}

#[test]
fn an_improvement_of_which_any_call_fails_leaves_old_results_or_new_ones() {
    Trial::new(improve_it).attempts(each(13), 3);
}

#[test]
fn an_improvement_to_its_end_of_which_a_call_fails_leaves_old_results_or_new_ones() {
    let trial = Trial::new(improve_to_the_end);
    let calls = trial.calls();
    for (at, fault) in [(calls / 2, Fault::Io), (calls - 20, Fault::NoSpace)] {
        trial.attempt(at, fault, Lasting::Once);
    }
}
