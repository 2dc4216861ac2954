//! A command reads every measurement file once, however many models it evaluates on it.

use snug_files::{Disk, Host, Input, Output};
use snug_study::{RunSettings, Study, Verb, diagnose, run};
use snug_synthetic::{CampaignPlan, HiddenEffect, MatStyle, simulate};
use std::collections::BTreeMap;
use std::fs::{File, Metadata};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};

/// The operating system's file system, which notes how often a file is opened for reading.
#[derive(Debug, Default)]
struct Counting {
    opened: Mutex<BTreeMap<PathBuf, usize>>,
}

impl Counting {
    /// How often each measurement file was opened.
    fn measurements(&self) -> Vec<usize> {
        let opened = self.opened.lock().unwrap();
        let files = opened
            .iter()
            .filter(|(path, _)| path.extension().is_some_and(|e| e == "mat"));
        files.map(|(_, count)| *count).collect()
    }
}

impl Disk for Counting {
    fn metadata(&self, path: &Path) -> io::Result<Metadata> {
        Host.metadata(path)
    }
    fn link_metadata(&self, path: &Path) -> io::Result<Metadata> {
        Host.link_metadata(path)
    }
    fn entries(&self, folder: &Path) -> io::Result<Vec<PathBuf>> {
        Host.entries(folder)
    }
    fn open(&self, path: &Path) -> io::Result<Box<dyn Input>> {
        *self
            .opened
            .lock()
            .unwrap()
            .entry(path.to_owned())
            .or_default() += 1;
        Host.open(path)
    }
    fn create(&self, path: &Path) -> io::Result<Box<dyn Output>> {
        Host.create(path)
    }
    fn open_lock(&self, path: &Path) -> io::Result<File> {
        Host.open_lock(path)
    }
    fn create_folder(&self, path: &Path) -> io::Result<()> {
        Host.create_folder(path)
    }
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        Host.rename(from, to)
    }
    fn link(&self, from: &Path, to: &Path) -> io::Result<()> {
        Host.link(from, to)
    }
    fn remove_file(&self, path: &Path) -> io::Result<()> {
        Host.remove_file(path)
    }
    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        Host.remove_folder(path)
    }
    fn sync_folder(&self, folder: &Path) -> io::Result<()> {
        Host.sync_folder(folder)
    }
}

/// How often each file is opened by a run and by an improvement that climbs at least one rung.
fn opened(most_tightenings: usize) -> (Vec<usize>, Vec<usize>) {
    let folder = tempfile::tempdir().unwrap();
    let mut plan = CampaignPlan::of_size(4, 4);
    plan.effects = vec![HiddenEffect::CubicStiffness];
    let campaign = simulate(&plan, 5).unwrap();
    let data = folder.path().join("data");
    campaign.write(&data, MatStyle::default()).unwrap();
    let mut study = Study::on(data);
    study.diagnosis.most_tightenings = most_tightenings;
    study.diagnosis.search.sign_flips = 99;
    study.diagnosis.search.control_campaigns = 0;
    study.diagnosis.search.starts = 1;
    let never = AtomicBool::new(false);
    let out = tempfile::tempdir().unwrap();
    let counted = |verb: Option<&Verb>| {
        let disk = Arc::new(Counting::default());
        let settings = RunSettings {
            disk: disk.clone(),
            ..RunSettings::new(out.path())
        };
        let outcome = match verb {
            None => run(&study, &settings, &|_| (), &never),
            Some(verb) => diagnose(&study, verb, &settings, &|_| (), &never),
        };
        let ladder = outcome
            .unwrap()
            .result
            .diagnosis
            .map_or(0, |diagnosis| diagnosis.ladder.len());
        (disk.measurements(), ladder)
    };
    let (by_run, _) = counted(None);
    let (by_improve, rungs) = counted(Some(&Verb::Improve));
    assert_eq!(by_run.len(), 4);
    assert!(rungs >= 2, "{rungs} rungs");
    (by_run, by_improve)
}

#[test]
fn an_improvement_opens_every_file_as_often_as_a_run() {
    let (by_run, by_improve) = opened(240);
    assert_eq!(by_improve, by_run);
}

/// Where effects are learnt from a part of the tightenings, the files are kept all the same as long as there is room.
#[test]
fn so_it_does_where_it_learns_from_a_part() {
    let (by_run, by_improve) = opened(8);
    assert_eq!(by_improve, by_run);
}
