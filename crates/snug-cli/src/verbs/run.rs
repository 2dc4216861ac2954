//! `run`, and the frame of every verb that evaluates data: study, progress, signals, summary, exit code.

use crate::arguments::{PresetName, RunOptions};
use crate::diagnosis_summary::Following;
use crate::error::CliError;
use crate::front::{Front, Notify};
use crate::progress::Progress;
use crate::terminal::complain;
use crate::{diagnosis_summary, estimates, exit, signals, summary, terminal};
use snug_campaign::words::program::program;
use snug_study::{Outcome, Preset, ProgressEvent, RunSettings, Study, StudyError};
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// From recordings to report and MCAP.
pub fn run(options: &RunOptions, front: &Front) -> ExitCode {
    let study = match study_of(options, front) {
        Ok(study) => study,
        Err(error) => return refused(&error),
    };
    carry_out(
        options,
        options.time,
        "",
        |settings, progress, interrupted| snug_study::run(&study, settings, progress, interrupted),
    )
}

/// How a verb hears of progress.
type Tell<'a> = &'a (dyn Fn(ProgressEvent<'_>) + Sync);

/// Does the work with progress, stops it politely on a signal and after the `longest` time, prints the summary and chooses the exit code.
pub fn carry_out(
    options: &RunOptions,
    longest: Option<Duration>,
    next: &str,
    work: impl FnOnce(&RunSettings, Tell<'_>, &AtomicBool) -> Result<Outcome, StudyError>,
) -> ExitCode {
    let settings = RunSettings {
        threads: options.threads.map(usize::from),
        study_file: options.study.clone(),
        wait: options.wait,
        ..RunSettings::new(&options.out)
    };
    let interrupted = signals::interruption();
    // A limit that nobody asked for is one of the search: what is evaluated afterwards is evaluated whole.
    let is_over = Arc::new(AtomicBool::new(false));
    let is_up = longest.map(|time| signals::after(time, &interrupted, &is_over));
    let is_up = || {
        is_up
            .as_ref()
            .is_some_and(|is_up| is_up.load(Ordering::Relaxed))
    };
    let progress = Progress::new(options.quiet);
    let tell = |event: ProgressEvent<'_>| {
        let ends_search = matches!(event, ProgressEvent::Started { .. });
        is_over.fetch_or(ends_search && options.time.is_none(), Ordering::Relaxed);
        progress.report(event);
    };
    let outcome = work(&settings, &tell, &interrupted);
    progress.finish();
    match outcome {
        Ok(outcome) => {
            let code = exit_code(&outcome, options.strict, is_up());
            if outcome.nothing_identified().is_some() {
                hint(options);
            }
            if options.quiet {
                return code;
            }
            let code = terminal::say(&told(&outcome, options, next), code);
            if let (true, Some(longest), None) = (is_up(), longest, options.time) {
                complain(&format!(
                    "ended after {} s, as a search does that is not told how long: --time 1800 gives it half an hour",
                    longest.as_secs()
                ));
            }
            code
        }
        Err(error) if error.is_interruption() && is_up() => {
            complain("the time was up before anything was found: allow more by --time");
            exit::failed()
        }
        Err(error) if error.is_interruption() => {
            complain(&error.to_string());
            exit::interrupted()
        }
        Err(error) => {
            let is_about_data = error.is_about_data();
            let code = refused(&error.into());
            if is_about_data {
                hint(options);
            }
            code
        }
    }
}

/// Whoever names data without saying what they are learns that a study can be drafted.
fn hint(options: &RunOptions) {
    if let (Some(data), None) = (&options.data, &options.study) {
        complain(&format!(
            "without --study only files in the layout of the thesis are read; for any others\n  {} init {}\nlooks at them and \
             writes a study",
            program(),
            data.display()
        ));
    }
}

/// Complains of an error; the exit code that goes with it.
pub fn refused(error: &CliError) -> ExitCode {
    complain(&error.to_string());
    match error.is_bad_argument() {
        true => exit::bad_arguments(),
        false => exit::failed(),
    }
}

/// What the work came to, on one screen.
fn told(outcome: &Outcome, options: &RunOptions, next: &str) -> String {
    let written = options.out.join("study.ron");
    let following = Following {
        options: next,
        written: &written.to_string_lossy(),
    };
    let vocabulary = outcome.result.vocabulary;
    let mut text = match &outcome.result.diagnosis {
        Some(diagnosis) => {
            diagnosis_summary::of(&vocabulary.told(diagnosis), &following, vocabulary)
        }
        None => vocabulary.says(&summary::of_run(outcome)),
    };
    text.push_str(&estimates::of(&outcome.result));
    if outcome.result.diagnosis.is_some() {
        text.push_str(&summary::of_recordings(&outcome.result.findings));
    }
    text.push_str(&vocabulary.says(&summary::of_results(outcome)));
    text
}

/// What a time limit ended was meant to end there.
fn exit_code(outcome: &Outcome, strict: bool, is_time_up: bool) -> ExitCode {
    let diagnosis = outcome.result.diagnosis.as_ref();
    let is_cut = outcome.interrupted || diagnosis.is_some_and(|one| one.interrupted);
    if is_cut && !is_time_up {
        exit::interrupted()
    } else if let Some(why) = outcome.nothing_identified() {
        complain(&outcome.result.vocabulary.says(&why));
        exit::failed()
    } else if strict && outcome.left_out > 0 {
        exit::left_out()
    } else {
        exit::DONE
    }
}

/// The study file, or the thesis' defaults, on the data named, the study's own, or the campaign that `front` has, which tells what
/// takes long.
///
/// # Errors
/// A study file that cannot be read or is wrong, or a campaign that cannot be had.
pub fn study(
    file: Option<&Path>,
    data: Option<&Path>,
    front: &Front,
    tell: Notify<'_>,
) -> Result<Study, CliError> {
    let mut study = match (file, data) {
        (Some(path), _) => Study::read(path)?,
        (None, Some(data)) => Study::on(data.to_path_buf()),
        (None, None) => Study::on((front.campaign)(tell)?),
    };
    if let Some(data) = data {
        study.set_data(data);
    }
    Ok(study)
}

/// The same with what else the command line overrides.
pub fn study_of(options: &RunOptions, front: &Front) -> Result<Study, CliError> {
    let tell = |text: &str| {
        if !options.quiet {
            complain(text);
        }
    };
    let (file, data) = (options.study.as_deref(), options.data.as_deref());
    let mut study = study(file, data, front, &tell)?;
    match options.preset {
        Some(PresetName::Snug) => study.set_preset(Preset::Snug),
        Some(PresetName::Thesis) => study.set_preset(Preset::Thesis),
        None => {}
    }
    if let Some(effects) = &options.effects {
        study.model.effects.clone_from(effects);
    }
    if let Some(seed) = options.seed {
        study.seed = seed;
    }
    study.check()?;
    Ok(study)
}
