//! Tightenings as the diagnosis takes them.

use crate::error::StudyError;
use crate::evaluation::prepared_file::{KeptFiles, PreparedFile};
use crate::evaluation::tightening::{input, torque_before_nm};
use crate::study::Study;
use crate::tasks::comparable::{Comparable, comparable};
use rayon::prelude::*;
use snug_campaign::Rejection;
use snug_campaign::words::reason::Reason;
use snug_files::{Disk, Host};
use snug_identify::{FitTask, IdentifySettings};
use snug_ingest::IngestError;
use snug_preprocess::Prepared;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Reads and prepares at most `most` tightenings, evenly spread over the files and within each; tightenings with faulty
/// data, those kept for validation and those that cannot be judged by the same measure as the others take no part.
pub fn cases(
    study: &Study,
    files: &[PathBuf],
    most: usize,
) -> Result<Vec<FitTask<'static>>, StudyError> {
    Ok(chosen(study, &Host, files, most, &|_| ())?.0.cases)
}

/// Samples that must be scored for a comparison to say anything: some for each number of a model with an effect. Chosen.
const FEWEST_SCORED: usize = 30;

/// Why a tightening takes no part in a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoPart {
    /// Its data are faulty.
    Faulty,
    /// Too few of its samples are scored.
    Short,
}

/// How far reading has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FilesRead {
    /// Files that are read and prepared.
    pub read: usize,
    /// Files that are to be: of very many only as many as there is room for their tightenings.
    pub files: usize,
}

/// Tightenings of one file that take part at least, if it has them: what drifts within a file shows between two.
const EACH: usize = 2;

/// The same, with what is to be said of those that take no part, and the files as far as there is room for them; `tell` hears of
/// every file that was read.
pub(crate) fn chosen(
    study: &Study,
    disk: &dyn Disk,
    files: &[PathBuf],
    most: usize,
    tell: &(dyn Fn(FilesRead) + Sync),
) -> Result<(Comparable, KeptFiles), StudyError> {
    let kept = Mutex::new(KeptFiles::default());
    let (read_files, to_read) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let short = AtomicUsize::new(0);
    let is_fitted = |file: &&PathBuf| !study.validation.keeps(file);
    let files: Vec<PathBuf> = files.iter().filter(is_fitted).cloned().collect();
    let stride = files.len().div_ceil((most / EACH).max(1)).max(1);
    let each = (most * stride / files.len().max(1)).max(1);
    let read = |from: usize| -> Result<Vec<Part>, StudyError> {
        let some: Vec<usize> = (from..files.len()).step_by(stride).collect();
        to_read.fetch_add(some.len(), Ordering::Relaxed);
        let parts = some.into_par_iter().map(|number| {
            let path = &files[number];
            let (all, unread) = match PreparedFile::read(study, disk, path)? {
                Ok(file) => {
                    let (all, few) = cases_of_file(study, &file)?;
                    short.fetch_add(few, Ordering::Relaxed);
                    if let Ok(mut kept) = kept.lock() {
                        kept.offer(path, file);
                    }
                    (all, None)
                }
                Err(error) => (Vec::new(), Some(error)),
            };
            tell(FilesRead {
                read: read_files.fetch_add(1, Ordering::Relaxed) + 1,
                files: to_read.load(Ordering::Relaxed),
            });
            let part = Part::of(number, all, each, number / stride);
            Ok(Part { unread, ..part })
        });
        parts.collect::<Vec<Result<_, _>>>().into_iter().collect()
    };
    let taken = |parts: &[Part]| parts.iter().map(|part| part.cases.len()).sum::<usize>();
    let mut parts = read(0)?;
    // Files with one tightening each: there is room for those between.
    if stride > 1 && 2 * taken(&parts) <= most {
        parts.extend(read(stride / 2)?);
        parts.sort_by_key(|part| part.number);
    }
    let is_selection = parts.len() < files.len() || parts.iter().any(|part| part.is_selection);
    let reason = Reason::LearntFrom {
        taken: taken(&parts),
        read: parts.len(),
        files: files.len(),
    };
    let unread: Vec<IngestError> = (parts.iter_mut())
        .filter_map(|part| part.unread.take())
        .collect();
    let mut comparable = comparable(parts.into_iter().flat_map(|part| part.cases).collect());
    comparable.reasons.extend(is_selection.then_some(reason));
    let short = short.into_inner();
    (comparable.reasons).extend((short > 0).then_some(Reason::Short {
        left_out: short,
        samples: FEWEST_SCORED,
    }));
    // A disk that fails for a moment may read them again when the study is run, and then no finding names them.
    (comparable.reasons).extend(unread.first().map(|first| Reason::Unread {
        first: first.to_string(),
        more: unread.len() - 1,
    }));
    Ok((comparable, kept.into_inner().unwrap_or_default()))
}

/// What is taken of a file.
struct Part {
    /// Which file.
    number: usize,
    cases: Vec<FitTask<'static>>,
    /// Whether it has more.
    is_selection: bool,
    /// Why nothing could be read of it.
    unread: Option<IngestError>,
}

impl Part {
    /// At most `most` of the tightenings of a file, evenly spread and `later` by so many, round the end.
    fn of(number: usize, all: Vec<FitTask<'static>>, most: usize, later: usize) -> Self {
        let (count, picked) = (all.len(), most.min(all.len()));
        let places: BTreeSet<usize> = (0..picked)
            .map(|place| (place * count / picked + later) % count)
            .collect();
        let cases = all.into_iter().enumerate();
        let kept = cases.filter_map(|(place, case)| places.contains(&place).then_some(case));
        Self {
            number,
            cases: kept.collect(),
            is_selection: picked < count,
            unread: None,
        }
    }
}

/// The same tightenings with a study that differs in its model and in how that is run.
pub(crate) fn with_settled<'a>(
    study: &Study,
    cases: Vec<FitTask<'a>>,
) -> Result<Vec<FitTask<'a>>, StudyError> {
    let simulation = study.identify.simulation;
    (cases.into_iter())
        .map(|case| {
            let model = study.model_for(&case.tightening)?;
            let before_nm = torque_before_nm(study, &case.tightening.torque_nm);
            let input = (case
                .input
                .into_owned()
                .in_steps(study.model.steps_per_sample()))
            .with_torque_before(before_nm);
            let input = simulation.of(input, &case.tightening);
            Ok(FitTask {
                model: Cow::Owned(model),
                input: Cow::Owned(input),
                ..case
            })
        })
        .collect()
}

/// What of a file can be compared with the model. Everything else that is left out the run of the study names in its findings.
/// How many are too short is said of the verdict, since they are fitted all the same.
fn cases_of_file(
    study: &Study,
    file: &PreparedFile,
) -> Result<(Vec<FitTask<'static>>, usize), StudyError> {
    let only_simulated = study.validation_segments();
    let (mut cases, mut short) = (Vec::new(), 0);
    for (_, prepared) in &file.recordings {
        for one in &prepared.tightenings {
            if !only_simulated.contains(&one.tightening.id.number) {
                match case_of(study, one)? {
                    Ok(case) => cases.push(case),
                    Err(NoPart::Short) => short += 1,
                    Err(NoPart::Faulty) => {}
                }
            }
        }
    }
    Ok((cases, short))
}

/// A tightening as it is compared with the model, or why it cannot be.
pub(crate) fn case_of(
    study: &Study,
    one: &Prepared,
) -> Result<Result<FitTask<'static>, NoPart>, StudyError> {
    if one.rejections().contains(&Rejection::DataQuality) {
        return Ok(Err(NoPart::Faulty));
    }
    let input = input(study, one);
    let tightening = one.tightening.clone();
    let fitted = study.identify.fitted_output;
    // The noise is known of what was measured: that is where model and measurement are best compared.
    let quantity = tightening
        .noise
        .as_ref()
        .map(|noise| noise.quantity)
        .filter(|&quantity| tightening.motion.get(quantity).is_some())
        .unwrap_or(fitted);
    let settings = IdentifySettings {
        fitted_output: quantity,
        constraints: study.identify.constraints.clone(),
        unscored_samples: study.identify_settings(&tightening).unscored_samples,
        ..IdentifySettings::default()
    };
    let case = FitTask {
        model: Cow::Owned(study.model_for(&tightening)?),
        input: Cow::Owned(input),
        settings: Cow::Owned(settings),
        tightening: Cow::Owned(tightening),
    };
    Ok(
        match case.measured().len() < case.unscored() + FEWEST_SCORED {
            true => Err(NoPart::Short),
            false => Ok(case),
        },
    )
}
