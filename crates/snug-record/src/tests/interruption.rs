//! What a cut, a kill and a failed write leave behind.

use super::{bits, record, small_chunks, tightenings};
use crate::error::RecordError;
use crate::read::{Completeness, recordings};
use crate::recorder::Recorder;
use crate::settings::{Compression, RecordSettings};
use std::cell::RefCell;
use std::io::Write;
use std::rc::Rc;

#[test]
fn a_cut_recording_gives_everything_before_the_cut() {
    let bytes = record(small_chunks());
    let whole = recordings(&bytes).unwrap();
    let mut most = 0;
    for length in (8..bytes.len()).step_by(61) {
        let cut = recordings(&bytes[..length]).unwrap();
        assert_eq!(cut.malformed_messages, 0);
        let mut found = 0;
        for (file, full) in cut.files.iter().zip(&whole.files) {
            let torque_nm = &file.recording.torque_nm;
            found += torque_nm.len();
            assert_eq!(
                bits(torque_nm),
                bits(&full.recording.torque_nm[..torque_nm.len()])
            );
        }
        assert!(
            found >= most,
            "{found} samples after {length} bytes, {most} before"
        );
        most = found;
        assert!(
            found == 720 || cut.completeness == Completeness::Truncated,
            "{:?} after {length} of {} bytes",
            cut.completeness,
            bytes.len()
        );
    }
    assert_eq!(most, 720);
}

/// A file that can be looked at while it is written.
#[derive(Clone, Default)]
struct Disk(Rc<RefCell<Vec<u8>>>);

impl Write for Disk {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_killed_run_keeps_every_finished_tightening() {
    let disk = Disk::default();
    let mut recorder = Recorder::new(disk.clone(), RecordSettings::default()).unwrap();
    for (index, (result, traces)) in tightenings().iter().enumerate() {
        recorder.tightening(result, traces, None).unwrap();
        let on_disk = disk.0.borrow().clone();
        let campaign = recordings(&on_disk).unwrap();
        assert_eq!(campaign.completeness, Completeness::Truncated);
        assert_eq!(campaign.windows.len(), index + 1);
        let samples: usize = campaign
            .files
            .iter()
            .map(|file| file.recording.torque_nm.len())
            .sum();
        assert_eq!(samples, 120 * (index + 1));
    }
    // Dropping, as a panic does, even ends the file properly.
    drop(recorder);
    let campaign = recordings(&disk.0.borrow()).unwrap();
    assert_eq!(campaign.completeness, Completeness::Complete);
}

#[test]
fn a_killed_process_leaves_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("recording.mcap");
    let mut recorder = Recorder::create(&path, RecordSettings::default()).unwrap();
    let (result, traces) = &tightenings()[0];
    recorder.tightening(result, traces, None).unwrap();
    // Nothing is closed or dropped, as after SIGKILL.
    std::mem::forget(recorder);
    let campaign = recordings(&std::fs::read(&path).unwrap()).unwrap();
    assert_eq!(campaign.files[0].recording.torque_nm.len(), 120);
    let missing = folder.path().join("none").join("recording.mcap");
    assert!(matches!(
        Recorder::create(&missing, RecordSettings::default()),
        Err(RecordError::Create { .. })
    ));
}

#[test]
fn an_existing_recording_is_never_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("recording.mcap");
    std::fs::write(&path, b"results of a week").unwrap();
    match Recorder::create(&path, RecordSettings::default()) {
        Err(RecordError::Exists { path: named }) => assert_eq!(named, path),
        other => panic!("{:?}", other.err()),
    }
    assert_eq!(std::fs::read(&path).unwrap(), b"results of a week");
}

/// A disk that is full at one call, and has space again after it.
struct FullDisk {
    calls: usize,
    full_at: usize,
    longest: usize,
    taken: Vec<u8>,
}

impl FullDisk {
    fn call(&mut self) -> std::io::Result<()> {
        self.calls += 1;
        if self.calls == self.full_at {
            // ENOSPC
            return Err(std::io::Error::from_raw_os_error(28));
        }
        assert!(self.calls < self.full_at, "written on after a failure");
        Ok(())
    }
}

impl Write for FullDisk {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.call()?;
        let length = bytes.len().min(self.longest);
        self.taken.extend_from_slice(&bytes[..length]);
        Ok(length)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.call()
    }
}

fn two_tightenings_on(disk: &mut FullDisk, settings: RecordSettings) -> Result<(), RecordError> {
    let mut recorder = Recorder::new(disk, settings)?;
    recorder.study("(title: \"full\")")?;
    for (result, traces) in &tightenings()[..2] {
        recorder.tightening(result, traces, None)?;
    }
    recorder.finish()?;
    Ok(())
}

/// Whatever call fails first, the error names the disk's reason, the recorder can be dropped, and what came before is
/// readable: nothing is written behind half a record.
#[test]
fn a_full_disk_is_named_at_every_call() {
    for compression in [Compression::Zstd, Compression::Lz4, Compression::Off] {
        let settings = RecordSettings {
            compression,
            ..small_chunks()
        };
        for longest in [usize::MAX, 1000] {
            for full_at in 1.. {
                let mut disk = FullDisk {
                    calls: 0,
                    full_at,
                    longest,
                    taken: Vec::new(),
                };
                let Err(error) = two_tightenings_on(&mut disk, settings) else {
                    assert!(full_at > 20, "{full_at} calls");
                    break;
                };
                let text = error.to_string();
                assert!(
                    text.contains("No space left on device (os error 28)"),
                    "call {full_at}: {text}"
                );
                if disk.taken.len() >= 8 {
                    recordings(&disk.taken).unwrap();
                }
            }
        }
    }
}
