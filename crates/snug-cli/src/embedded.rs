//! The campaign that the program holds: a simulation with a seed, written once to the user's data folder.

use crate::error::CliError;
use crate::front::Notify;
use snug_campaign::words::program::program;
use snug_synthetic::fixtures::{CAMPAIGN, MYSTERY, write};
use std::path::{Path, PathBuf};

/// Folder of the embedded campaign among the user's data, `snug/VERSION/campaign`; it lasts, because a run's study.ron points
/// to it. The first time it is made there, the mystery beside it, which takes some seconds and is told.
///
/// # Errors
/// [`CliError::NoFolder`] where the environment names no folder for data, [`CliError::Campaign`] and [`CliError::Write`] where
/// the campaign cannot be made in it.
pub fn campaign(tell: Notify<'_>) -> Result<PathBuf, CliError> {
    let folder = data_folder()?.join("snug").join(env!("CARGO_PKG_VERSION"));
    if !folder.is_dir() {
        tell(&format!(
            "Simulating the campaign that Snug holds, once, into {}; beside it a mystery to solve:\n  {} improve --data {}",
            folder.display(),
            program(),
            folder.join(MYSTERY).display()
        ));
        make(&folder)?;
    }
    Ok(folder.join(CAMPAIGN))
}

/// Makes both campaigns in a folder that is there whole or not at all, whoever else makes it meanwhile.
fn make(folder: &Path) -> Result<(), CliError> {
    let failed = |source| CliError::Write {
        folder: folder.to_path_buf(),
        source,
    };
    let unfinished = folder.with_file_name(format!("unfinished-{}", std::process::id()));
    std::fs::create_dir_all(&unfinished).map_err(failed)?;
    let made = write(&unfinished).map_err(CliError::from);
    let moved = made.and_then(|_| match std::fs::rename(&unfinished, folder) {
        Err(_) if folder.is_dir() => Ok(()),
        moved => moved.map_err(failed),
    });
    // Gone where it was moved.
    std::fs::remove_dir_all(&unfinished).ok();
    moved
}

/// Where programs keep a user's data.
fn data_folder() -> Result<PathBuf, CliError> {
    let named = |variable| std::env::var_os(variable).map(PathBuf::from);
    let absolute = |path: &PathBuf| path.is_absolute();
    if cfg!(windows) {
        let variable = "LOCALAPPDATA";
        return (named(variable).filter(absolute)).ok_or(CliError::NoFolder { variable });
    }
    let below_home = |home: PathBuf| home.join(".local").join("share");
    (named("XDG_DATA_HOME").filter(absolute))
        .or_else(|| named("HOME").filter(absolute).map(below_home))
        .ok_or(CliError::NoFolder { variable: "HOME" })
}
