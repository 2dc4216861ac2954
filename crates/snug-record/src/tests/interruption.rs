use super::{bits, record, small_chunks, tightenings};
use crate::read::{Completeness, recordings};
use crate::{RecordError, RecordSettings, Recorder};
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
