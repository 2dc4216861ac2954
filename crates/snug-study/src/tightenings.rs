//! Tightenings by themselves: one file of a study read and prepared, and any of them fitted side by side, for programs that
//! keep tightenings and results in a place of their own.

pub(crate) mod diagnosed;
pub(crate) mod prepared;

use crate::error::StudyError;
use crate::evaluation::prepared_file::PreparedFile;
use crate::evaluation::tightening::{Kept, fitted, fitted_keeping};
use crate::study::Study;
use crate::tasks::cases::chosen;
use crate::tasks::settling::{leaves_open, settle};
use snug_campaign::{Finding, TighteningResult, Traces};
use snug_files::Host;
use snug_identify::IdentifyError;
use snug_preprocess::Prepared;
use std::path::{Path, PathBuf};

/// What a measurement file holds that is fitted, and what was found on the way.
#[derive(Debug, Clone, Default)]
pub struct FileTightenings {
    /// Prepared under the study's own preset, in file order; what is kept for validation is not among them.
    pub tightenings: Vec<Prepared>,
    /// What reading and preparation left out, repaired or found worth knowing; a file that cannot be read is one of them.
    pub findings: Vec<Finding>,
}

/// A tightening's result with its signals; these are `None` when nothing was simulated.
pub type FittedTightening = (TighteningResult, Option<Traces>);

/// The files of a study that are fitted, in the order in which they are read, and what was found in the folder beside them.
///
/// # Errors
/// As [`crate::run()`] for data that cannot be listed.
pub fn fitted_files(study: &Study) -> Result<(Vec<PathBuf>, Vec<Finding>), StudyError> {
    let listing = snug_ingest::list_on(&Host, &study.source, &study.source.path)?;
    let mut files = study.validation.last(listing.files)?;
    files.retain(|file| !study.validation.keeps(file));
    Ok((files, listing.findings))
}

/// Reads and prepares one file of a study, as [`crate::run()`] does.
///
/// # Errors
/// [`StudyError`] for a setting that is not allowed; what is wrong with the file is a finding.
pub fn read_tightenings(study: &Study, file: &Path) -> Result<FileTightenings, StudyError> {
    let read = match PreparedFile::read(study, &Host, file)? {
        Ok(read) => read,
        Err(error) => {
            return Ok(FileTightenings {
                findings: vec![error.finding()],
                ..FileTightenings::default()
            });
        }
    };
    let only_simulated = study.validation_segments();
    let mut whole = FileTightenings {
        findings: read.findings,
        ..FileTightenings::default()
    };
    for (_, prepared) in read.recordings {
        let is_fitted = |one: &Prepared| !only_simulated.contains(&one.tightening.id.number);
        let fitted = prepared.tightenings.into_iter().filter(is_fitted);
        whole.tightenings.extend(fitted);
        whole.findings.extend(prepared.findings);
    }
    Ok(whole)
}

/// Fits prepared tightenings side by side in one thread; a tightening has the bits that [`crate::run()`] gives it, whatever stands
/// beside it.
///
/// # Errors
/// [`StudyError::Model`] for a model that cannot be; the inner error says why one tightening cannot be fitted.
pub fn fit_tightenings(
    study: &Study,
    prepared: &[&Prepared],
) -> Result<Vec<Result<FittedTightening, IdentifyError>>, StudyError> {
    let outcomes = fitted(study, prepared)?.into_iter();
    Ok(outcomes
        .map(|outcome| outcome.map(|done| (done.result, done.traces)))
        .collect())
}

/// The same numbers without the signals, for a table of results: of the measures, agreement of the displacement and with the noise,
/// frequencies and damping; that of the fitted output only where the noise is not known.
///
/// # Errors
/// As [`fit_tightenings`].
pub fn fit_numbers(
    study: &Study,
    prepared: &[&Prepared],
) -> Result<Vec<Result<TighteningResult, IdentifyError>>, StudyError> {
    let outcomes = fitted_keeping(Kept::Numbers, study, prepared)?.into_iter();
    Ok(outcomes
        .map(|outcome| outcome.map(|done| done.result))
        .collect())
}

/// The study with what it leaves open settled on its own data, as [`crate::run()`] settles it.
///
/// # Errors
/// As [`crate::run()`] for settings and data.
pub fn settled(study: &Study) -> Result<Study, StudyError> {
    study.check()?;
    if !leaves_open(study) {
        return Ok(study.clone());
    }
    let (files, _) = fitted_files(study)?;
    let most = study.diagnosis.most_tightenings;
    let (comparable, _) = chosen(study, &Host, &files, most, &|_| ())?;
    let settled = settle(study, &comparable.cases);
    Ok(settled.map_or_else(|| study.clone(), |settled| settled.study))
}
