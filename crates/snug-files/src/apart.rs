//! That no result is written over an input.

use crate::manifest::Manifest;
use crate::{Disk, FilesError, Identity};
use std::collections::HashMap;
use std::path::Path;

/// What a run reads.
#[derive(Debug, Clone, Copy, Default)]
pub struct Inputs<'a> {
    /// The folder or file that the measurements were asked for by.
    pub data: Option<&'a Path>,
    /// Every file that is read for its measurements.
    pub measurements: &'a [std::path::PathBuf],
    /// The study file. One that is a result as Snug wrote it may be replaced: nothing of anybody's is in it.
    pub study: Option<&'a Path>,
}

/// Checks that none of `names` in `folder` leads to an input, by whatever path or link, and that the results do not lie
/// among the measurements.
///
/// # Errors
/// [`FilesError::OutputIsInput`], [`FilesError::OutputAmongInputs`]; [`FilesError::Refused`] for what cannot be looked at.
pub fn keep_apart(
    disk: &dyn Disk,
    folder: &Path,
    names: &[&str],
    inputs: Inputs<'_>,
) -> Result<(), FilesError> {
    let identity =
        |path: &Path| Identity::of(disk, path).map_err(FilesError::refused("look at", path));
    let Some(place) = identity(folder)? else {
        return Ok(());
    };
    if !disk.metadata(folder).is_ok_and(|one| one.is_dir()) {
        // Whoever wants to write there is told that it is no folder.
        return Ok(());
    }
    if let Some(data) = inputs.data
        && identity(data)? == Some(place)
    {
        return Err(FilesError::OutputAmongInputs {
            folder: folder.to_path_buf(),
        });
    }
    let mut outputs = HashMap::new();
    for &name in names {
        if let Some(one) = identity(&folder.join(name))? {
            outputs.insert(one, name);
        }
    }
    if outputs.is_empty() {
        return Ok(());
    }
    let manifest = Manifest::read(disk, folder)?;
    let measurements = inputs.measurements.iter().map(std::path::PathBuf::as_path);
    for (input, is_study) in measurements
        .map(|path| (path, false))
        .chain(inputs.study.map(|path| (path, true)))
    {
        let Some(&name) = identity(input)?.as_ref().and_then(|one| outputs.get(one)) else {
            continue;
        };
        if !(is_study && manifest.holds(disk, folder, name)) {
            return Err(FilesError::OutputIsInput {
                input: input.to_path_buf(),
                output: folder.join(name),
            });
        }
    }
    Ok(())
}
