//! Where a run's results go: the recording while it works, everything else at its end, all of it at once.

use crate::error::StudyError;
use crate::run::settings::RunSettings;
use crate::study::Study;
use snug_campaign::CampaignResult;
use snug_files::{Exchanged, Growing, Inputs, Results, keep_apart};
use snug_ingest::Listing;
use snug_record::{RecordError, Recorder};
use std::cell::RefCell;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Every name that a result may have.
const NAMES: &[&str] = &[
    "report.html",
    "tightenings.csv",
    "statistics.json",
    "findings.json",
    "verdict.json",
    RECORDING,
    LAYOUT,
    STUDY,
];
const RECORDING: &str = "recording.mcap";
const LAYOUT: &str = "snug-layout.json";
const STUDY: &str = "study.ron";

/// What a run reads, and the folder that is its own until it ends.
pub(crate) struct Workplace {
    pub listing: Listing,
    pub results: Results,
}

impl Workplace {
    /// Lists the data and takes the folder for the results, once it is sure that none of them would be written over what
    /// is read.
    ///
    /// # Errors
    /// [`StudyError::Ingest`] for data that cannot be listed, [`StudyError::Files`].
    pub fn new(
        study: &Study,
        settings: &RunSettings,
        interrupted: &AtomicBool,
    ) -> Result<Self, StudyError> {
        let disk = &*settings.disk;
        let mut listing = snug_ingest::list_on(disk, &study.source, &study.source.path)?;
        listing.files = study.validation.last(listing.files)?;
        let inputs = Inputs {
            data: Some(&study.source.path),
            measurements: &listing.files,
            study: settings.study_file.as_deref(),
        };
        keep_apart(disk, &settings.out, NAMES, inputs)?;
        let go_on = || !interrupted.load(Ordering::Relaxed);
        let waiting: Option<&dyn Fn() -> bool> = match settings.wait {
            true => Some(&go_on),
            false => None,
        };
        let results = Results::begin(settings.disk.clone(), &settings.out, NAMES, waiting)?;
        Ok(Self { listing, results })
    }
}

/// The results in the making.
pub(crate) struct Output {
    results: Results,
    recorder: Recorder<'static>,
    file: Shared,
    /// Where the recording will stand.
    recording: PathBuf,
}

impl Output {
    /// Begins the recording with the study as run.
    pub fn new(
        mut results: Results,
        study: &Study,
        study_ron: &str,
        settings: &RunSettings,
    ) -> Result<Self, StudyError> {
        let recording = settings.out.join(RECORDING);
        let file = Shared(Rc::new(RefCell::new(results.create_lasting(RECORDING)?)));
        let begun = Recorder::new(file.clone(), study.record).and_then(|mut recorder| {
            recorder.study(study_ron)?;
            Ok(recorder)
        });
        match begun {
            Ok(recorder) => Ok(Self {
                results,
                recorder,
                file,
                recording,
            }),
            Err(source) => Err(StudyError::Recording {
                path: recording,
                source,
            }),
        }
    }

    /// Records something.
    pub fn record<T>(
        &mut self,
        what: impl FnOnce(&mut Recorder<'static>) -> Result<T, RecordError>,
    ) -> Result<T, StudyError> {
        what(&mut self.recorder).map_err(|source| StudyError::Recording {
            path: self.recording.clone(),
            source,
        })
    }

    /// From here on the recording is worth having, however the run ends.
    pub fn keep_partial(&mut self) {
        self.results.keep_partial();
    }

    /// Where the recording lies until the run has ended.
    pub fn partial(&self) -> Option<PathBuf> {
        self.results.partial().map(Path::to_path_buf)
    }

    /// Ends the recording, writes everything else and exchanges the results for those of the run before.
    pub fn finish(self, result: &CampaignResult) -> Result<Exchanged, StudyError> {
        let Self {
            mut results,
            recorder,
            file,
            recording: path,
        } = self;
        let ended = recorder.finish();
        ended.map_err(|source| StudyError::Recording { path, source })?;
        for (name, content) in snug_report::files(result) {
            results.write(name, content.as_bytes())?;
        }
        let file = Rc::into_inner(file.0).expect("the recorder let go of it when it ended");
        results.seal(file.into_inner())?;
        let layout = snug_record::layout(&parameter_names(result));
        results.write(LAYOUT, layout.as_bytes())?;
        results.write(STUDY, result.study_ron.as_bytes())?;
        Ok(results.exchange()?)
    }
}

/// The recording's file, which the recorder writes to until it has ended.
#[derive(Clone)]
struct Shared(Rc<RefCell<Growing>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.0.borrow_mut().flush()
    }
}

/// Names of the model's parameters, as far as anything was identified.
fn parameter_names(result: &CampaignResult) -> Vec<&str> {
    let estimate = result.tightenings.iter().find_map(|t| t.estimate.as_ref());
    estimate.map_or_else(Vec::new, |estimate| {
        estimate
            .parameters
            .iter()
            .map(|p| p.name.as_str())
            .collect()
    })
}
