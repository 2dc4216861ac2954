use std::path::{Path, PathBuf};

/// The workspace's folder: where cargo says this package is now, else where it was when it was built.
pub fn root() -> PathBuf {
    let package = std::env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    package.parent().map_or(package.clone(), Path::to_path_buf)
}

/// The campaign that ships with Snug.
pub fn embedded_campaign() -> PathBuf {
    root().join("fixtures").join("campaign")
}
