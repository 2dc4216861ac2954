//! Every single call to the disk fails in turn while a study is run or improved: the old results stand, or the new ones.

use snug_files::fault::{Fault, FaultyDisk, Lasting};
use snug_files::{Disk, Host};
use snug_study::{Outcome, RunSettings, Study, StudyError, Verb, diagnose, run};
use snug_synthetic::{CampaignPlan, HiddenEffect, MatStyle, simulate};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
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
    campaign.write(folder, MatStyle::default()).unwrap();
    let mut study = Study::on(folder.to_path_buf());
    study.diagnosis.search.sign_flips = 99;
    study.diagnosis.search.control_campaigns = 0;
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

fn improve_it(study: &Study, settings: &RunSettings) -> Result<Outcome, StudyError> {
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

/// What is in a folder of findings but for those that a fault may add.
fn is_new(found: &Results, new: &Results) -> bool {
    // A measurement file that could not be read is a finding, and the run goes on without it.
    let findings = String::from_utf8_lossy(&found["findings.json"]).into_owned();
    found == new
        || (findings.contains("Input/output error") || findings.contains("left out"))
            && found.len() == new.len()
}

struct Trial {
    work: Work,
    old: Results,
    new: Results,
    first: Study,
    second: Study,
    _data: [TempDir; 2],
}

impl Trial {
    fn new(work: Work) -> Self {
        let data = [folder(), folder()];
        let (first, second) = (study(1, 7, data[0].path()), study(2, 8, data[1].path()));
        let alone = |study: &Study, work: Work| {
            let out = folder();
            work(study, &settings(out.path(), Host)).unwrap();
            results(out.path(), &Results::new())
        };
        Self {
            work,
            old: alone(&first, improve_it),
            new: alone(&second, work),
            first,
            second,
            _data: data,
        }
    }

    /// A folder with the old results.
    fn begun(&self) -> TempDir {
        let out = folder();
        improve_it(&self.first, &settings(out.path(), Host)).unwrap();
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

    /// About `attempts` of the calls, each fault and duration in turn.
    fn attempts(&self, attempts: u64) {
        let calls = self.calls();
        let step = (calls / attempts).max(1);
        println!("{calls} calls to the disk, each {step}. of them made to fail");
        for (turn, at) in (0..calls).step_by(step as usize).enumerate() {
            let fault = Fault::ALL[turn % 4];
            let lasting = [Lasting::Once, Lasting::FromThenOn][turn / 4 % 2];
            self.attempt(at, fault, lasting);
        }
        // The exchange at the end call by call.
        for at in calls.saturating_sub(60)..calls {
            self.attempt(at, Fault::ALL[at as usize % 4], Lasting::Once);
        }
    }
}

/// How many calls fail: some, or with SNUG_MANY all.
fn how_many(some: u64) -> u64 {
    match std::env::var_os("SNUG_MANY") {
        Some(_) => 8 * some,
        None => some,
    }
}

#[test]
fn a_run_of_which_any_call_fails_leaves_old_results_or_new_ones() {
    Trial::new(run_it).attempts(how_many(60));
}

#[test]
fn an_improvement_of_which_any_call_fails_leaves_old_results_or_new_ones() {
    Trial::new(improve_it).attempts(how_many(15));
}
