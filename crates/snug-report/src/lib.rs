#![doc = include_str!("../README.md")]

mod decimation;
mod effect_name;
mod effect_words;
mod error;
mod figure;
mod findings_json;
mod number;
mod outcome;
mod page;
mod quantity;
mod quartiles;
mod section;
mod signal_unit;
mod statistics_json;
mod tightenings_csv;
mod traces_json;
mod verdict_json;
mod whole_file;

pub use error::ReportError;
pub use findings_json::findings_json;
pub use page::html;
pub use statistics_json::statistics_json;
pub use tightenings_csv::tightenings_csv;
pub use verdict_json::verdict_json;
pub use whole_file::write_whole;

use snug_campaign::CampaignResult;
use std::fs;
use std::path::{Path, PathBuf};

/// Writes `report.html`, `tightenings.csv`, `statistics.json` and `findings.json` into `folder`, which is made when it
/// is not there, and `verdict.json` when the result has a diagnosis. Files of these names are replaced.
///
/// Returns the paths written, in that order.
///
/// # Errors
/// [`ReportError`] names the folder or file that could not be written.
pub fn write(folder: &Path, result: &CampaignResult) -> Result<Vec<PathBuf>, ReportError> {
    fs::create_dir_all(folder).map_err(|source| ReportError::CreateFolder {
        path: folder.to_path_buf(),
        source,
    })?;
    let mut files = vec![
        ("report.html", html(result)),
        ("tightenings.csv", tightenings_csv(result)),
        ("statistics.json", statistics_json(result)),
        ("findings.json", findings_json(result)),
    ];
    if let Some(diagnosis) = &result.diagnosis {
        files.push(("verdict.json", verdict_json(diagnosis)));
    }
    let mut written = Vec::with_capacity(files.len());
    for (name, content) in files {
        let path = folder.join(name);
        write_whole(&path, &content).map_err(|source| ReportError::WriteFile {
            path: path.clone(),
            source,
        })?;
        written.push(path);
    }
    Ok(written)
}
