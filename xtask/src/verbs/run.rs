use crate::arguments::{PresetName, RunOptions};
use crate::diagnosis_summary::Following;
use crate::progress::Progress;
use crate::{diagnosis_summary, exit, summary, workspace};
use snug_study::{Outcome, Preset, ProgressEvent, RunSettings, Study, StudyError};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// From recordings to report and MCAP.
pub fn run(options: &RunOptions) -> ExitCode {
    let study = match study(options) {
        Ok(study) => study,
        Err(error) => {
            eprintln!("{error}");
            return exit::bad_arguments();
        }
    };
    carry_out(options, "", |settings, progress, interrupted| {
        snug_study::run(&study, settings, progress, interrupted)
    })
}

/// How a verb hears of progress.
type Tell<'a> = &'a (dyn Fn(ProgressEvent<'_>) + Sync);

/// Does the work with progress, stops it politely on Ctrl-C, prints the summary and chooses the exit code.
pub fn carry_out(
    options: &RunOptions,
    next: &str,
    work: impl FnOnce(&RunSettings, Tell<'_>, &AtomicBool) -> Result<Outcome, StudyError>,
) -> ExitCode {
    let settings = RunSettings {
        out: options.out.clone(),
        threads: options.threads.map(usize::from),
    };
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    let stop = move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(exit::INTERRUPTED.into());
        }
        eprintln!("stopping after what is at hand; Ctrl-C again stops at once");
    };
    if let Err(error) = ctrlc::set_handler(stop) {
        tracing::warn!(%error, "Ctrl-C will stop at once instead of after the current file");
    }
    let progress = Progress::new(options.quiet);
    let outcome = work(&settings, &|event| progress.report(event), &interrupted);
    progress.finish();
    match outcome {
        Ok(outcome) => {
            if !options.quiet {
                let written = settings.out.join("study.ron");
                let following = Following {
                    options: next,
                    study: &options.study.as_ref().unwrap_or(&written).to_string_lossy(),
                    written: &written.to_string_lossy(),
                };
                match &outcome.result.diagnosis {
                    Some(diagnosis) => diagnosis_summary::print(diagnosis, &following),
                    None => print!("{}", summary::of_run(&outcome)),
                }
                print!("{}", summary::of_results(&outcome));
            }
            exit_code(&outcome)
        }
        Err(StudyError::Interrupted) => {
            eprintln!("{}", StudyError::Interrupted);
            exit::interrupted()
        }
        Err(error) => {
            eprintln!("{error}");
            if error.is_bad_argument() {
                exit::bad_arguments()
            } else {
                exit::failed()
            }
        }
    }
}

fn exit_code(outcome: &Outcome) -> ExitCode {
    let tightenings = &outcome.result.tightenings;
    let evaluated = tightenings.iter().any(|t| t.estimate.is_some());
    let diagnosis = outcome.result.diagnosis.as_ref();
    if outcome.interrupted || diagnosis.is_some_and(|one| one.interrupted) {
        exit::interrupted()
    } else if !evaluated {
        eprintln!("no tightening could be evaluated; findings.json says why");
        exit::failed()
    } else if outcome.left_out > 0 {
        exit::left_out()
    } else {
        exit::DONE
    }
}

/// The study file, or the thesis' defaults, with what the command line overrides.
pub fn study(options: &RunOptions) -> Result<Study, StudyError> {
    let mut study = match &options.study {
        Some(path) => Study::read(path)?,
        None => Study::on(workspace::embedded_campaign()),
    };
    if let Some(data) = &options.data {
        study.set_data(data);
    }
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
