//! One measurement file, read and prepared: what every evaluation of a command begins from.

use crate::error::StudyError;
use crate::study::Study;
use snug_campaign::{Finding, Motion, Quantity, Recording};
use snug_files::Disk;
use snug_ingest::IngestError;
use snug_preprocess::{Preprocessed, preprocess};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A file's recordings with what preparation under the study's own preset made of each.
pub(crate) struct PreparedFile {
    pub recordings: Vec<(Recording, Preprocessed)>,
    /// What reading found; preparation's findings stand with its recordings.
    pub findings: Vec<Finding>,
}

impl PreparedFile {
    /// Reads and prepares a file; the inner error says why it cannot be read.
    pub fn read(
        study: &Study,
        disk: &dyn Disk,
        path: &Path,
    ) -> Result<Result<Self, IngestError>, StudyError> {
        let lever_arm_m = study.preprocess.rig.lever_arm_m;
        let ingested = match snug_ingest::read_on(disk, &study.source, path, lever_arm_m) {
            Ok(ingested) => ingested,
            Err(error) => return Ok(Err(error)),
        };
        let fitted_output = study.identify.fitted_output;
        let recordings = (ingested.recordings.into_iter())
            .map(|recording| {
                let prepared = preprocess(&recording, &study.preprocess, fitted_output)?;
                Ok((recording, prepared))
            })
            .collect::<Result<_, StudyError>>()?;
        Ok(Ok(Self {
            recordings,
            findings: ingested.findings,
        }))
    }

    /// Memory that its signals take.
    fn bytes(&self) -> usize {
        let samples = |torque: &[f64], motion: &Motion, force: &Option<Vec<f64>>| {
            let motion = Quantity::ALL.map(|quantity| motion.get(quantity).map_or(0, <[f64]>::len));
            torque.len() + motion.iter().sum::<usize>() + force.as_ref().map_or(0, Vec::len)
        };
        let count: usize = (self.recordings.iter())
            .map(|(whole, prepared)| {
                let cut = prepared.tightenings.iter().map(|one| {
                    let cut = &one.tightening;
                    samples(&cut.torque_nm, &cut.motion, &cut.grip_force_n)
                });
                samples(&whole.torque_nm, &whole.motion, &whole.grip_force_n) + cut.sum::<usize>()
            })
            .sum();
        count * size_of::<f64>()
    }
}

/// Memory for files that are kept from a diagnosis' beginning to its end \[byte\]: 240 tightenings of 3000 samples and five
/// channels, recorded and cut, take 60 MB. What does not fit is read again.
const KEPT_BYTES: usize = 256 << 20;

/// Files that were read when a diagnosis began, and are wanted once more at its end.
#[derive(Default)]
pub(crate) struct KeptFiles {
    files: BTreeMap<PathBuf, PreparedFile>,
    bytes: usize,
}

impl KeptFiles {
    /// Keeps a file if there is room for it.
    pub fn offer(&mut self, path: &Path, file: PreparedFile) {
        let bytes = file.bytes();
        if self.bytes + bytes <= KEPT_BYTES {
            self.bytes += bytes;
            self.files.insert(path.to_owned(), file);
        }
    }

    /// Hands a file on, if it was kept.
    pub fn take(&mut self, path: &Path) -> Option<PreparedFile> {
        self.files.remove(path)
    }
}
