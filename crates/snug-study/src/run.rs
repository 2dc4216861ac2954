//! The order of work: list, evaluate file by file, record, and at the end tables and report.

use crate::evaluation::Evaluated;
use crate::examples::Examples;
use crate::file_evaluation::{FileEvaluation, evaluate_file, other, outcomes};
use crate::{ProgressEvent, Study, StudyError, statistics};
use rayon::prelude::*;
use snug_campaign::{
    CampaignResult, Diagnosis, Finding, ParameterMeaning, PresetSummary, Rejection, RejectionCount,
    Severity, TighteningId, TighteningResult,
};
use snug_model::{BASE_PARAMETERS, Law, Model};
use snug_record::Recorder;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// How a study is run, beside what it says itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RunSettings {
    /// Folder for the results; made if it is not there.
    pub out: PathBuf,
    /// Threads; `None` for one a core. Results do not depend on it.
    pub threads: Option<usize>,
}

/// What a run came to.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// Everything that was found out.
    pub result: CampaignResult,
    /// The files that were written.
    pub written: Vec<PathBuf>,
    /// Files and tightenings that were left out; the findings say why.
    pub left_out: usize,
    /// Measurement files that were listed.
    pub files: usize,
    /// Whether it was stopped before the last file.
    pub interrupted: bool,
}

/// What grows while files are evaluated.
#[derive(Default)]
struct Collected {
    tightenings: Vec<TighteningResult>,
    findings: Vec<Finding>,
    examples: Examples,
    here: Vec<(TighteningId, Vec<Rejection>)>,
    there: Vec<(TighteningId, Vec<Rejection>)>,
}

/// Runs a study: ingest → preprocess → identify → statistics → report and MCAP.
///
/// Files are evaluated in groups of as many as there are threads, and recorded in order, so that memory does not grow
/// with their number and the results do not depend on the threads. When `interrupted` becomes true, the group at hand is
/// finished and everything is written for what was evaluated.
///
/// # Errors
/// [`StudyError`] for a setting that is not allowed, data that cannot be listed and results that cannot be written. A
/// file or tightening that cannot be used is a finding instead.
pub fn run(
    study: &Study,
    settings: &RunSettings,
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
    interrupted: &AtomicBool,
) -> Result<Outcome, StudyError> {
    run_with(study, None, settings, progress, interrupted)
}

/// The same, with what a diagnosis found out told beside it.
pub(crate) fn run_with(
    study: &Study,
    diagnosis: Option<Diagnosis>,
    settings: &RunSettings,
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
    interrupted: &AtomicBool,
) -> Result<Outcome, StudyError> {
    study.check()?;
    let listing = snug_ingest::list(&study.source, &study.source.path)?;
    let files = listing.files;
    create_folder(&settings.out)?;
    let study_ron = runnable_anywhere(study)?.to_ron()?;
    let study_path = settings.out.join("study.ron");
    write(&study_path, &study_ron)?;
    let pool = pool(settings.threads)?;
    let recording_path = settings.out.join("recording.mcap");
    let mut recorder = Recorder::create(&recording_path, study.record)?;
    recorder.study(&study_ron)?;
    progress(ProgressEvent::Started { files: files.len() });

    let mut collected = Collected::default();
    collected.note(listing.findings, &mut recorder)?;
    let mut stopped = false;
    for group in files.chunks(pool.current_num_threads()) {
        if interrupted.load(Ordering::Relaxed) {
            stopped = true;
            break;
        }
        let evaluated: Vec<Result<FileEvaluation, StudyError>> = pool.install(|| {
            group
                .par_iter()
                .map(|path| evaluate_file(study, path))
                .collect()
        });
        for file in evaluated {
            collected.take(file?, &mut recorder)?;
            progress(ProgressEvent::FileDone {
                tightenings: collected.tightenings.len(),
            });
        }
    }

    progress(ProgressEvent::Writing { what: "statistics" });
    let mut result = collected.result(study, study_ron)?;
    result.diagnosis = diagnosis;
    recorder.statistics(&result.conditions, &result.tests)?;
    if let Some(diagnosis) = &result.diagnosis {
        recorder.diagnosis(diagnosis)?;
    }
    recorder.finish()?;
    let layout_path = settings.out.join("snug-layout.json");
    let names: Vec<&str> = parameter_names(&result);
    write(&layout_path, &snug_record::layout(&names))?;
    progress(ProgressEvent::Writing { what: "report" });
    let mut written = snug_report::write(&settings.out, &result)?;
    written.extend([recording_path, layout_path, study_path]);
    Ok(Outcome {
        left_out: count(&result.findings, Severity::LeftOut),
        files: files.len(),
        interrupted: stopped,
        written,
        result,
    })
}

impl Collected {
    /// Records one file's results and keeps what the tables and the report need of them.
    fn take(
        &mut self,
        file: FileEvaluation,
        recorder: &mut Recorder<BufWriter<File>>,
    ) -> Result<(), StudyError> {
        for recording in &file.recordings {
            recorder.measurement(recording)?;
        }
        self.here.extend(outcomes(&file.evaluated));
        self.there.extend(file.other_preset.unwrap_or_default());
        for Evaluated {
            result,
            traces,
            onset,
        } in file.evaluated
        {
            if let Some(traces) = traces {
                recorder.tightening(&result, &traces, onset)?;
                self.examples.offer(self.tightenings.len(), traces);
            }
            self.tightenings.push(result);
        }
        self.note(file.findings, recorder)?;
        recorder.flush()?;
        Ok(())
    }

    fn note(
        &mut self,
        findings: Vec<Finding>,
        recorder: &mut Recorder<BufWriter<File>>,
    ) -> Result<(), StudyError> {
        for finding in findings {
            recorder.finding(&finding)?;
            self.findings.push(finding);
        }
        Ok(())
    }

    fn result(self, study: &Study, study_ron: String) -> Result<CampaignResult, StudyError> {
        let fitted: Vec<&TighteningResult> = self
            .tightenings
            .iter()
            .filter(|t| !t.selection.rejections.contains(&Rejection::Validation))
            .collect();
        let units = study.source.units(study.preprocess.rig.lever_arm_m);
        let conditions = statistics::summaries(&fitted, &units);
        let tests = statistics::rows(&fitted, &units, study.seed);
        let mut presets = vec![preset_summary(study, self.here)];
        presets.extend(other(study).map(|other| preset_summary(&other, self.there)));
        let model = study.model.model(study.any_rig())?;
        Ok(CampaignResult {
            title: study.title(),
            study_ron,
            preset: study.preprocess.preset.name().to_owned(),
            fitted_output: study.identify.fitted_output.name().to_owned(),
            units,
            effects: study.model.effects.clone(),
            meanings: meanings(&model),
            presets,
            conditions,
            tests,
            tightenings: self.tightenings,
            findings: self.findings,
            examples: self.examples.into_kept(),
            diagnosis: None,
        })
    }
}

/// What the parameters of the model's effects are.
fn meanings(model: &Model) -> Vec<ParameterMeaning> {
    let effects: Vec<_> = model.effects().collect();
    let described = effects.iter().flat_map(|effect| {
        let specs = effect.description().parameters.iter();
        specs.map(move |spec| (effect.name(), spec.meaning))
    });
    model.parameters()[BASE_PARAMETERS.len()..]
        .iter()
        .zip(described)
        .map(|(parameter, (effect, meaning))| ParameterMeaning {
            name: parameter.name.clone(),
            effect: effect.to_owned(),
            meaning: meaning.to_owned(),
        })
        .collect()
}

fn preset_summary(study: &Study, outcomes: Vec<(TighteningId, Vec<Rejection>)>) -> PresetSummary {
    let mut counts: BTreeMap<Rejection, usize> = BTreeMap::new();
    for rejection in outcomes.iter().flat_map(|(_, rejections)| rejections) {
        *counts.entry(*rejection).or_default() += 1;
    }
    let mut rejections: Vec<RejectionCount> = counts
        .into_iter()
        .map(|(rejection, tightenings)| RejectionCount {
            rejection,
            tightenings,
        })
        .collect();
    rejections.sort_by_key(|count| std::cmp::Reverse(count.tightenings));
    PresetSummary {
        preset: study.preprocess.preset.name().to_owned(),
        tightenings: outcomes.len(),
        selected: outcomes.iter().filter(|(_, r)| r.is_empty()).count(),
        rejections,
        outcomes,
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

fn count(findings: &[Finding], severity: Severity) -> usize {
    findings.iter().filter(|f| f.severity == severity).count()
}

/// The study with its data's full path, so that its file can be run from wherever it lies.
fn runnable_anywhere(study: &Study) -> Result<Study, StudyError> {
    let path = &study.source.path;
    let full = std::path::absolute(path).map_err(|source| StudyError::Read {
        path: path.clone(),
        source,
    })?;
    let mut study = study.clone();
    study.source.path = full;
    Ok(study)
}

pub(crate) fn pool(threads: Option<usize>) -> Result<rayon::ThreadPool, StudyError> {
    let threads = threads.unwrap_or(0);
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| StudyError::Threads {
            threads,
            message: error.to_string(),
        })
}

fn create_folder(folder: &Path) -> Result<(), StudyError> {
    std::fs::create_dir_all(folder).map_err(|source| StudyError::Write {
        path: folder.to_path_buf(),
        source,
    })
}

fn write(path: &Path, text: &str) -> Result<(), StudyError> {
    snug_report::write_whole(path, text).map_err(|source| StudyError::Write {
        path: path.to_path_buf(),
        source,
    })
}
