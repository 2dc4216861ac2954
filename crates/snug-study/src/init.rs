//! A study for files of which nobody has declared anything: what their columns probably are, and why, as text to be read
//! and corrected.

mod choice;
mod events;
mod numbers;
mod roles;
mod text;
mod trials;
mod units;

use crate::error::StudyError;
use crate::study::Study;
use choice::Choice;
use events::{Flanks, Pulse};
use snug_campaign::Recording;
use snug_files::{FilesError, Host, Identity, write_new, write_whole};
use snug_ingest::csv::CsvLayout;
use snug_ingest::declared::{json::JsonLayout, mat::MatLayout};
use snug_ingest::survey::{Survey, SurveyedPlace, survey};
use snug_ingest::{Format, IngestError, Source};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Files that are looked at.
const MOST_FILES: usize = 300;

/// A study that was written for some files.
#[derive(Debug, Clone)]
pub struct Draft {
    /// Every column of the first file that holds enough, for a picture.
    pub columns: Vec<DraftColumn>,
    /// What was found out, a sentence each.
    pub notes: Vec<String>,
    /// The study file, commented.
    pub text: String,
}

/// A column and what it is taken for.
#[derive(Debug, Clone)]
pub struct DraftColumn {
    /// Where it stands.
    pub place: String,
    /// What it is taken for, and why.
    pub told: String,
    /// Its numbers, in the unit of the file.
    pub values: Vec<f64>,
}

/// Looks at `paths` (one folder, or files of one folder) and drafts the study that would stand at `study_file`.
///
/// # Errors
/// [`StudyError::Ingest`] for what cannot be read, [`StudyError::NothingToDraft`] where no file holds an input and a motion.
pub fn draft(paths: &[PathBuf], study_file: &Path) -> Result<Draft, StudyError> {
    let given = Given::of(paths)?;
    keep_apart(study_file, &given.files)?;
    let mut reference = None;
    let mut why_not = Vec::new();
    for file in given.files.iter().take(MOST_FILES) {
        match survey(file)
            .map_err(StudyError::from)
            .and_then(|found| usable(file, found))
        {
            Ok(found) => {
                reference = Some((file, found));
                break;
            }
            Err(error) => why_not.push(error),
        }
    }
    let Some((file, found)) = reference else {
        return Err(match why_not.into_iter().next() {
            Some(first) if given.is_folder => nothing_in(
                &given.path,
                &format!("no file with columns of numbers (the first: {first})"),
            ),
            Some(first) => first,
            None => nothing_in(&given.path, "nothing"),
        });
    };
    if found.is_thesis {
        return Err(StudyError::NeedsNoStudy { path: given.path });
    }
    let mut choice = Choice::of(file, &found)?;
    let files = given.readable(&choice)?;
    choice.set_window(files.pulse);
    let path = text::path_from(study_file, &given.path);
    let text = text::study(&choice, &path, &files.named, &given.title());
    Study::parse(&text, study_file)?.check()?;
    let mut notes = choice.notes.clone();
    notes.insert(0, files.told);
    Ok(Draft {
        columns: choice.told(&found),
        notes,
        text,
    })
}

/// Writes a study to `study_file`, whole or not at all; over a file that is there only where `over` says so.
///
/// # Errors
/// [`StudyError::StudyIsThere`], [`StudyError::Files`].
pub fn write_draft(draft: &Draft, study_file: &Path, over: bool) -> Result<(), StudyError> {
    if over {
        return Ok(write_whole(&Host, study_file, draft.text.as_bytes())?);
    }
    write_new(&Host, study_file, draft.text.as_bytes()).map_err(|error| match error {
        FilesError::Refused { source, .. } if source.kind() == ErrorKind::AlreadyExists => {
            StudyError::StudyIsThere {
                path: study_file.to_path_buf(),
            }
        }
        error => error.into(),
    })
}

/// No study is written over a measurement, whatever its name: it ends in `.ron`, and leads to none of the files.
fn keep_apart(study_file: &Path, files: &[PathBuf]) -> Result<(), StudyError> {
    let refused = || StudyError::NoStudyName {
        path: study_file.to_path_buf(),
    };
    if study_file.extension().is_none_or(|ending| ending != "ron") {
        return Err(refused());
    }
    let identity = |path: &Path| Identity::of(&Host, path).ok().flatten();
    let Some(study) = identity(study_file) else {
        return Ok(());
    };
    match files
        .iter()
        .any(|file| identity(file) == Some(study.clone()))
    {
        true => Err(refused()),
        false => Ok(()),
    }
}

/// A survey with at least two columns; of the thesis' files no more is asked.
fn usable(file: &Path, found: Survey) -> Result<Survey, StudyError> {
    if found.is_thesis || found.columns.len() > 1 {
        return Ok(found);
    }
    Err(StudyError::NothingToDraft {
        path: file.to_path_buf(),
        found: format!("{} column(s) of at least 16 numbers", found.columns.len()),
    })
}

/// What was asked to be looked at.
struct Given {
    /// Folder or file that the study is to name.
    path: PathBuf,
    files: Vec<PathBuf>,
    /// Whether a folder is meant.
    is_folder: bool,
    /// Files in it that its source would read and that hold no measurement.
    others: usize,
}

/// That a folder holds nothing that can be drafted, and what else is there.
fn nothing_in(folder: &Path, found: &str) -> StudyError {
    let mut inside: Vec<String> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    inside.sort();
    let folders = match inside.as_slice() {
        [] => String::new(),
        [first, ..] => format!(
            "; folders inside are not looked into ({} of them, as {}): name one",
            inside.len(),
            folder.join(first).display()
        ),
    };
    StudyError::NothingToDraft {
        path: folder.to_path_buf(),
        found: format!("{found}{folders}"),
    }
}

/// Which files a study reads.
struct Readable {
    /// Their names, where they are not all of the folder.
    named: Vec<String>,
    /// The window of the pulse that each of them holds.
    pulse: Option<Pulse>,
    told: String,
}

impl Given {
    fn of(paths: &[PathBuf]) -> Result<Self, StudyError> {
        match paths {
            [one] if one.is_dir() => Self::folder(one),
            [one] => Ok(Self {
                path: one.clone(),
                files: vec![one.clone()],
                is_folder: false,
                others: 0,
            }),
            several => {
                let parent = |path: &PathBuf| path.parent().unwrap_or(Path::new("")).to_path_buf();
                let folder = several.first().map(parent).unwrap_or_default();
                if let Some(other) = several
                    .iter()
                    .find(|path| parent(path) != folder || path.is_dir())
                {
                    return Err(StudyError::NothingToDraft {
                        path: other.clone(),
                        found: "no file of the same folder as the first: name one folder, or files of one".to_owned(),
                    });
                }
                Ok(Self {
                    path: folder,
                    files: several.to_vec(),
                    is_folder: false,
                    others: 0,
                })
            }
        }
    }

    /// The files of the format of which a folder has most, as its source will list them.
    fn folder(folder: &Path) -> Result<Self, StudyError> {
        let listed = |format: Format| {
            let source = Source {
                format,
                ..Source::default()
            };
            match snug_ingest::list(&source, folder) {
                Ok(listing) => Ok(listing.files),
                Err(IngestError::NothingToRead { .. }) => Ok(Vec::new()),
                Err(error) => Err(error),
            }
        };
        let is_text = |file: &PathBuf| {
            let ending = file.extension().unwrap_or_default();
            ending.eq_ignore_ascii_case("txt")
        };
        // A source of tables reads texts, too.
        let (texts, tables): (Vec<_>, Vec<_>) = listed(Format::Csv(CsvLayout::default()))?
            .into_iter()
            .partition(is_text);
        let trees = listed(Format::Json(JsonLayout::default()))?;
        let variables = listed(Format::Mat(MatLayout::default()))?;
        let most = trees.len().max(tables.len()).max(variables.len());
        let (files, others) = match most {
            // Text may be anything, and beside tables it mostly is what people have to say of them.
            0 => (texts, 0),
            _ if variables.len() == most => (variables, 0),
            _ if tables.len() == most => (tables, texts.len()),
            _ => (trees, 0),
        };
        if files.is_empty() {
            let expected = "no .csv, .tsv, .txt, .mat or .json file";
            return Err(nothing_in(folder, expected));
        }
        Ok(Self {
            path: folder.to_path_buf(),
            files,
            is_folder: true,
            others,
        })
    }

    fn title(&self) -> String {
        let absolute = self
            .path
            .canonicalize()
            .unwrap_or_else(|_| self.path.clone());
        let name = if self.is_folder {
            absolute.file_name()
        } else {
            absolute.file_stem()
        };
        name.unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Which of the files the choice can read.
    fn readable(&self, choice: &Choice) -> Result<Readable, StudyError> {
        let source = choice.study()?.source;
        let (mut read, mut failed) = (Vec::new(), Vec::<IngestError>::new());
        let mut pulses = Vec::new();
        for file in self.files.iter().take(MOST_FILES) {
            match snug_ingest::read(&source, file, 1.0) {
                Ok(ingested) => {
                    pulses.push(pulse_of(&ingested.recordings));
                    read.push(file);
                }
                Err(error) => failed.push(error),
            }
        }
        let all = self.files.len();
        let name = |file: &&PathBuf| {
            file.file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned()
        };
        let is_one = all == 1 && !self.is_folder;
        let is_all = self.is_folder && self.others == 0 && (failed.is_empty() || all > MOST_FILES);
        let mut told = match all {
            1 => "One file, one recording.".to_owned(),
            _ => format!(
                "{} of {} files can be read so; each is one recording.",
                read.len(),
                all.min(MOST_FILES)
            ),
        };
        if let Some(first) = failed.first() {
            told += &format!(" The others are left out (the first: {first}).");
        }
        Ok(Readable {
            named: if is_one || is_all {
                Vec::new()
            } else {
                read.iter().map(name).collect()
            },
            told,
            pulse: (pulses.into_iter().collect::<Option<Vec<_>>>())
                .and_then(|all| events::window(&all)),
        })
    }
}

/// Where the pulse of a file's recording lies.
fn pulse_of(recordings: &[Recording]) -> Option<Flanks> {
    let [recording] = recordings else {
        return None;
    };
    let (first, end) = events::pulse(&recording.torque_nm)?;
    let at = |sample: usize| sample as f64 * recording.time_base.interval_s;
    Some(Flanks {
        first_s: at(first),
        end_s: at(end),
        recording_s: at(recording.torque_nm.len()),
    })
}

/// A place as people name it.
fn told_place(place: &SurveyedPlace) -> String {
    match place {
        SurveyedPlace::Column(column) => column.to_string(),
        SurveyedPlace::Path(path, snug_ingest::declared::Part::Row(row)) => {
            format!("row {row} of {path}")
        }
        SurveyedPlace::Path(path, snug_ingest::declared::Part::Column(column)) => {
            format!("column {column} of {path}")
        }
        SurveyedPlace::Path(path, _) => path.clone(),
    }
}

#[cfg(test)]
mod tests;
