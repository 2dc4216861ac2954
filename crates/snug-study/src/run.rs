//! The order of work: list, evaluate file by file, record, and at the end tables and report.

pub(crate) mod campaign_result;
pub(crate) mod examples;
pub(crate) mod output;
pub(crate) mod settings;

use crate::error::StudyError;
use crate::evaluation::file::{FileEvaluation, Purpose, evaluate_file, other, outcomes};
use crate::evaluation::prepared_file::KeptFiles;
use crate::evaluation::rungs::{Ladder, RungShare};
use crate::evaluation::tightening::Evaluated;
use crate::evaluation::validation::mean_estimate;
use crate::progress::ProgressEvent;
use crate::run::campaign_result::{meanings, preset_summary, vocabulary};
use crate::run::examples::Examples;
use crate::run::output::{Output, Workplace};
use crate::run::settings::RunSettings;
use crate::statistics;
use crate::study::Study;
use crate::tasks::cases::chosen;
use crate::tasks::copies::Measured;
use crate::tasks::settling::{leaves_open, settle};
use rayon::prelude::*;
use snug_campaign::words::reason::Reason;
use snug_campaign::{
    CampaignResult, Estimate, Finding, Recording, Rejection, Severity, TighteningId,
    TighteningResult, Traces,
};
use snug_ingest::Listing;
use snug_record::Recorder;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

/// What a run came to.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// Everything that was found out.
    pub result: CampaignResult,
    /// The files that were written.
    pub written: Vec<PathBuf>,
    /// Where files went that had a result's name and were none of Snug's, or were changed since.
    pub set_aside: Vec<PathBuf>,
    /// Recordings in the folder that earlier runs left unfinished.
    pub unfinished: Vec<PathBuf>,
    /// Files and tightenings that were left out; the findings say why.
    pub left_out: usize,
    /// Measurement files that were listed.
    pub files: usize,
    /// Whether it was stopped before the last file.
    pub interrupted: bool,
}

impl Outcome {
    /// Why nothing at all was identified; `None` where something was.
    pub fn nothing_identified(&self) -> Option<String> {
        use snug_campaign::FitStatus::{Converged, ConvergedAtConstraint};
        let mut estimates = (self.result.tightenings.iter()).filter_map(|t| t.estimate.as_ref());
        if estimates.any(|one| matches!(one.status, Converged | ConvergedAtConstraint)) {
            return None;
        }
        Some(match self.first_left_out() {
            Some(first) => format!("nothing was identified: {first}"),
            None => "nothing was identified: no fit found an optimum; the column status of \
                     tightenings.csv says how each ended"
                .to_owned(),
        })
    }

    /// What was left out first, and how much more; `None` where nothing was.
    pub(crate) fn first_left_out(&self) -> Option<String> {
        let findings = self.result.findings.iter();
        let mut left_out = findings.filter(|finding| finding.severity == Severity::LeftOut);
        let first = left_out.next()?;
        let more = match left_out.count() {
            0 => String::new(),
            some => format!(" (and {some} more)"),
        };
        Some(format!(
            "{}: {}{more}; findings.json says everything",
            first.file, first.message
        ))
    }
}

/// What grows while files are evaluated.
#[derive(Default)]
pub(crate) struct Collected {
    tightenings: Vec<TighteningResult>,
    findings: Vec<Finding>,
    examples: Examples,
    pub here: Vec<(TighteningId, Vec<Rejection>)>,
    there: Vec<(TighteningId, Vec<Rejection>)>,
    rungs: Vec<RungShare>,
    measured: Measured<String>,
}

/// Runs a study: ingest → preprocess → identify → statistics → report and MCAP.
///
/// What the study leaves open of the model is settled first, as a diagnosis of it does.
///
/// Files are evaluated in groups of as many as there are threads, and recorded in order, so that memory does not grow
/// with their number and the results do not depend on the threads. When `interrupted` becomes true, the group at hand is
/// finished and everything is written for what was evaluated; the files that were not reached are findings.
///
/// The results of the run before stand until the new ones are complete, and are then exchanged for them as a whole.
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
    study.check()?;
    let workplace = Workplace::new(study, settings, interrupted)?;
    if !leaves_open(study) {
        return run_with(Task::of(study), workplace, settings, progress, interrupted);
    }
    progress(ProgressEvent::Stage {
        what: "reading recordings",
    });
    let (disk, files) = (&*settings.disk, &workplace.listing.files);
    let (settled, kept) = pool(settings.threads)?.install(|| {
        let (comparable, kept) = chosen(
            study,
            disk,
            files,
            study.diagnosis.most_tightenings,
            &|_| (),
        )?;
        Ok::<_, StudyError>((settle(study, &comparable.cases), kept))
    })?;
    let (study, notes) = match &settled {
        Some(settled) => (&settled.study, settled.reasons.as_slice()),
        None => (study, [].as_slice()),
    };
    let task = Task {
        notes: notes
            .iter()
            .map(|reason| settled_note(study, reason))
            .collect(),
        kept,
        ..Task::of(study)
    };
    run_with(task, workplace, settings, progress, interrupted)
}

/// What was settled on the way, as a finding: a run has no verdict that would say it.
fn settled_note(study: &Study, reason: &Reason) -> Finding {
    let path = &study.source.path;
    let name = path.file_name().unwrap_or(path.as_os_str());
    Finding {
        severity: Severity::Note,
        code: "settled".to_owned(),
        file: name.to_string_lossy().into_owned(),
        tightening: None,
        channel: None,
        message: reason.to_string(),
    }
}

/// What is run.
pub(crate) struct Task<'a> {
    pub study: &'a Study,
    /// What a diagnosis found out before, whose rungs are evaluated beside the study.
    pub ladder: Option<Ladder>,
    /// Files that are read and prepared already.
    pub kept: KeptFiles,
    /// What is to be said of the study itself.
    pub notes: Vec<Finding>,
}

impl<'a> Task<'a> {
    /// A study, nothing known of it.
    pub fn of(study: &'a Study) -> Self {
        Self {
            study,
            ladder: None,
            kept: KeptFiles::default(),
            notes: Vec::new(),
        }
    }
}

/// The same at a workplace, with what a diagnosis found out told beside it.
pub(crate) fn run_with(
    task: Task<'_>,
    workplace: Workplace,
    settings: &RunSettings,
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
    interrupted: &AtomicBool,
) -> Result<Outcome, StudyError> {
    let Workplace { listing, results } = workplace;
    let study_ron = runnable_anywhere(task.study)?.to_ron()?;
    let output = Output::new(results, task.study, &study_ron, settings)?;
    let partial = output.partial();
    let run = Run {
        task,
        study_ron,
        settings,
        progress,
        interrupted,
    };
    run.carry_out(listing, output)
        .map_err(|error| match partial {
            Some(partial) if partial.is_file() => StudyError::Unfinished {
                source: Box::new(error),
                partial,
            },
            _ => error,
        })
}

/// A run whose results have a place.
struct Run<'a> {
    task: Task<'a>,
    study_ron: String,
    settings: &'a RunSettings,
    progress: &'a (dyn Fn(ProgressEvent<'_>) + Sync),
    interrupted: &'a AtomicBool,
}

impl Run<'_> {
    fn carry_out(mut self, listing: Listing, mut output: Output) -> Result<Outcome, StudyError> {
        let progress = self.progress;
        let asked_for = self.task.ladder.as_ref().and_then(Ladder::shown);
        let mut collected = Collected::with(Examples::with(asked_for.cloned()));
        collected.note(listing.findings, &mut output)?;
        collected.note(std::mem::take(&mut self.task.notes), &mut output)?;
        let left = self.evaluate(&listing.files, &mut collected, &mut output)?;
        warn_of_files(&collected.findings);
        collected.note(not_reached(left), &mut output)?;

        progress(ProgressEvent::Writing { what: "statistics" });
        let shares = std::mem::take(&mut collected.rungs);
        let mut result = collected.result(self.task.study, self.study_ron)?;
        result.diagnosis = (self.task.ladder).map(|ladder| ladder.completed(shares));
        output.record(|recorder| {
            recorder.statistics(&result.conditions, &result.tests)?;
            match &result.diagnosis {
                Some(diagnosis) => recorder.diagnosis(diagnosis),
                None => Ok(()),
            }
        })?;
        progress(ProgressEvent::Writing { what: "report" });
        let exchanged = output.finish(&result)?;
        Ok(Outcome {
            left_out: count(&result.findings, Severity::LeftOut),
            files: listing.files.len(),
            interrupted: !left.is_empty(),
            written: exchanged.written,
            set_aside: exchanged.set_aside,
            unfinished: exchanged.unfinished,
            result,
        })
    }

    /// Evaluates file after file, first those that are fitted; returns those that were not reached.
    fn evaluate<'f>(
        &mut self,
        files: &'f [PathBuf],
        collected: &mut Collected,
        output: &mut Output,
    ) -> Result<&'f [PathBuf], StudyError> {
        (self.progress)(ProgressEvent::Started { files: files.len() });
        let pool = pool(self.settings.threads)?;
        let settings = &self.task.study.validation;
        let fitted = files.iter().take_while(|file| !settings.keeps(file));
        let (fitted, kept) = files.split_at(fitted.count());
        let done = self.evaluate_some(fitted, Purpose::Fit, &pool, collected, output)?;
        if done < fitted.len() {
            return Ok(&files[done..]);
        }
        // What is kept is simulated with what was found of all the others.
        let found = collected.mean_estimate();
        let purpose = Purpose::Validate(found.as_ref());
        let done = self.evaluate_some(kept, purpose, &pool, collected, output)?;
        Ok(&kept[done..])
    }

    /// Evaluates files for one purpose; returns how many were reached.
    fn evaluate_some(
        &mut self,
        files: &[PathBuf],
        purpose: Purpose<'_>,
        pool: &rayon::ThreadPool,
        collected: &mut Collected,
        output: &mut Output,
    ) -> Result<usize, StudyError> {
        let at_once = pool.current_num_threads();
        for (number, group) in files.chunks(at_once).enumerate() {
            if self.interrupted.load(Ordering::Relaxed) {
                return Ok(number * at_once);
            }
            let Task {
                study,
                ladder,
                kept,
                ..
            } = &mut self.task;
            let (ladder, disk) = (ladder.as_ref(), &*self.settings.disk);
            let group: Vec<_> = (group.iter()).map(|path| (path, kept.take(path))).collect();
            let evaluated: Vec<Result<FileEvaluation, StudyError>> = pool.install(|| {
                (group.into_par_iter())
                    .map(|(path, kept)| evaluate_file(study, ladder, disk, path, kept, purpose))
                    .collect()
            });
            for file in evaluated {
                collected.take(file?, output)?;
                (self.progress)(ProgressEvent::FileDone {
                    tightenings: collected.tightenings.len(),
                });
            }
        }
        Ok(files.len())
    }
}

/// Warns of files that are left out: of those that are for one reason once, with their number.
fn warn_of_files(findings: &[Finding]) {
    let mut alike: BTreeMap<&str, Vec<&Finding>> = BTreeMap::new();
    let left_out = findings
        .iter()
        .filter(|finding| finding.severity == Severity::LeftOut && finding.tightening.is_none());
    for finding in left_out {
        alike.entry(&finding.code).or_default().push(finding);
    }
    for (reason, files) in alike {
        let (count, first) = (files.len(), files[0]);
        tracing::warn!(
            reason,
            count,
            first = first.file,
            message_of_first = first.message,
            "files left out; findings.json names each"
        );
    }
}

/// Says of a recording that its samples were there before.
fn copied(recording: &Recording, original: &str) -> Finding {
    Finding {
        severity: Severity::Note,
        code: "copy".to_owned(),
        file: recording.file.clone(),
        tightening: None,
        channel: None,
        message: format!(
            "the same samples as {original} to the last bit: tables and tests count them twice, a diagnosis once"
        ),
    }
}

/// Says of files that they were not evaluated because the run was stopped.
fn not_reached(files: &[PathBuf]) -> Vec<Finding> {
    let finding = |path: &PathBuf| Finding {
        severity: Severity::LeftOut,
        code: "not_reached".to_owned(),
        file: (path.file_name().unwrap_or_default())
            .to_string_lossy()
            .into_owned(),
        tightening: None,
        channel: None,
        message: "the run was stopped before this file; it was not evaluated".to_owned(),
    };
    files.iter().map(finding).collect()
}

impl Collected {
    /// Nothing yet, with room for these signals.
    pub fn with(examples: Examples) -> Self {
        Self {
            examples,
            ..Self::default()
        }
    }

    /// Records one file's results and keeps what the tables and the report need of them.
    fn take(&mut self, file: FileEvaluation, output: &mut Output) -> Result<(), StudyError> {
        let mut copies = Vec::new();
        for recording in &file.recordings {
            output.record(|recorder| recorder.measurement(recording))?;
            let (torque_nm, motion) = (&recording.torque_nm, &recording.motion);
            let original = self.measured.before(&recording.file, torque_nm, motion);
            copies.extend(original.map(|original| copied(recording, &original)));
        }
        self.note(copies, output)?;
        self.here.extend(outcomes(&file.evaluated));
        self.there.extend(file.other_preset.unwrap_or_default());
        self.rungs.resize_with(file.rungs.len(), RungShare::default);
        for (rung, share) in self.rungs.iter_mut().zip(file.rungs) {
            rung.add(share);
        }
        for Evaluated {
            result,
            traces,
            onset,
        } in file.evaluated
        {
            if let Some(traces) = &traces {
                output.record(|recorder| recorder.tightening(&result, traces, onset))?;
            }
            self.keep(result, traces);
        }
        self.note(file.findings, output)?;
        output.record(Recorder::flush)?;
        output.keep_partial();
        Ok(())
    }

    /// Keeps what the tables and the report need of one tightening.
    pub fn keep(&mut self, result: TighteningResult, traces: Option<Traces>) {
        if let Some(traces) = traces {
            let index = self.tightenings.len();
            self.examples.offer(index, &result.id, traces);
        }
        self.tightenings.push(result);
    }

    /// What was found of everything that is fitted, on average.
    fn mean_estimate(&self) -> Option<Estimate> {
        let is_kept = |one: &&TighteningResult| {
            let rejections = &one.selection.rejections;
            rejections.contains(&Rejection::Validation)
        };
        let estimates = self.tightenings.iter().filter(|one| !is_kept(one));
        mean_estimate(estimates.filter_map(|one| one.estimate.as_ref()))
    }

    fn note(&mut self, findings: Vec<Finding>, output: &mut Output) -> Result<(), StudyError> {
        for finding in findings {
            output.record(|recorder| recorder.finding(&finding))?;
            self.findings.push(finding);
        }
        Ok(())
    }

    pub fn result(self, study: &Study, study_ron: String) -> Result<CampaignResult, StudyError> {
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
            vocabulary: vocabulary(study, &units),
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
