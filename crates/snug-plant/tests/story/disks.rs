//! A full disk under the results, and under a worker: what is not there is named, what is there is whole.

use crate::cluster::Cluster;
use crate::plant::{Plant, small};
use snug_plant::{FitSettings, Fitted, PlantError};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A disk of so many kB in a folder, which ends with the test.
struct SmallDisk(PathBuf);

impl SmallDisk {
    /// `None`, and said so, where none may be mounted.
    fn at(folder: &Path, kilobytes: usize) -> Option<Self> {
        std::fs::create_dir_all(folder).unwrap();
        let size = format!("size={kilobytes}k");
        let mounted = (Command::new("mount").args(["-t", "tmpfs", "-o", &size, "tmpfs"]))
            .arg(folder)
            .output();
        let why = match mounted {
            Ok(output) if output.status.success() => return Some(Self(folder.to_owned())),
            Ok(output) => String::from_utf8_lossy(&output.stderr).into_owned(),
            Err(error) => error.to_string(),
        };
        let why = why.trim();
        writeln!(
            std::io::stderr(),
            "skipped: no small disk can be mounted: {why}"
        )
        .ok();
        None
    }

    fn grow(&self, kilobytes: usize) {
        let options = format!("remount,size={kilobytes}k");
        let mut mount = Command::new("mount");
        let grown = mount.args(["-o", &options]).arg(&self.0).status();
        assert!(grown.unwrap().success());
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        Command::new("umount")
            .arg("--lazy")
            .arg(&self.0)
            .status()
            .ok();
    }
}

/// Which partitions are named, all of them for want of room.
fn named(fitted: Result<Fitted, PlantError>) -> Vec<String> {
    let error = fitted.unwrap_err();
    let PlantError::Partitions { failed, partitions } = error else {
        panic!("{error}");
    };
    assert_eq!(partitions, 6);
    for (part, why) in &failed {
        assert!(why.contains("No space left on device"), "{part}: {why}");
    }
    failed.into_iter().map(|(part, _)| part).collect()
}

async fn assert_only_these_are_missing(plant: &Plant, missing: &[String]) {
    let mut expected = plant.digests("truth").await;
    expected.retain(|(part, _)| !missing.contains(&part.to_string()));
    assert_eq!(plant.digests("results").await, expected);
}

async fn assert_resumed(plant: &Plant, settings: &FitSettings, missing: usize) {
    let resumed = FitSettings {
        resume: true,
        ..settings.clone()
    };
    let done = plant.fit("results", &resumed).await.unwrap();
    assert_eq!((done.partitions, done.left), (missing, 6 - missing));
    assert_eq!(plant.digests("results").await, plant.digests("truth").await);
}

#[tokio::test(flavor = "multi_thread")]
async fn results_on_a_full_disk_are_named_and_resumed_with_room_again() {
    let plant = Plant::simulated(&small()).await;
    let settings = FitSettings::default();
    plant.fit("truth", &settings).await.unwrap();
    let Some(disk) = SmallDisk::at(&plant.path("results"), 100) else {
        return;
    };
    let missing = named(plant.fit("results", &settings).await);
    assert!((1..6).contains(&missing.len()), "{missing:?}");
    assert_only_these_are_missing(&plant, &missing).await;
    disk.grow(10_000);
    assert_resumed(&plant, &settings, missing.len()).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_worker_with_a_full_disk_is_told_and_another_does_what_it_left() {
    let plant = Plant::simulated(&small()).await;
    let cluster = Cluster::start();
    let settings = FitSettings {
        effects: Vec::new(),
        ..cluster.settings()
    };
    plant.fit("truth", &FitSettings::default()).await.unwrap();
    let work = plant.path("work");
    let Some(_disk) = SmallDisk::at(&work, 8) else {
        return;
    };
    let full = cluster.worker_with(&[format!("--work-dir={}", work.display())]);
    let missing = named(plant.fit("results", &settings).await);
    assert_only_these_are_missing(&plant, &missing).await;
    drop(full);
    let _other = cluster.worker();
    assert_resumed(&plant, &settings, missing.len()).await;
}
