use crate::{exit, workspace};
use std::process::ExitCode;

/// Makes the embedded campaigns anew; the same bits every time.
pub fn fixtures() -> ExitCode {
    match snug_synthetic::fixtures::write(&workspace::root().join("fixtures")) {
        Ok(files) => {
            for file in files {
                println!("{}", file.display());
            }
            exit::DONE
        }
        Err(error) => {
            eprintln!("{error}");
            exit::failed()
        }
    }
}
