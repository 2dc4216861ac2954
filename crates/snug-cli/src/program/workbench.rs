//! `snug workbench`: the page, served by this program.

use snug_cli::{CliError, Front, WorkbenchOptions, complain, exit, refused, say, study};
use snug_workbench::{Notice, Opening};
use std::process::ExitCode;

/// Opens the page until it is ended.
pub fn open(front: &Front, options: &WorkbenchOptions) -> ExitCode {
    let (file, data) = (options.study.as_deref(), options.data.as_deref());
    let study = study(file, data, front, &complain);
    let study = study.and_then(|study| {
        study.check()?;
        Ok::<_, CliError>(study)
    });
    let study = match study {
        Ok(study) => study,
        Err(error) => return refused(&error),
    };
    let opening = Opening {
        study,
        study_file: options.study.clone(),
        port: options.port,
        is_browser_opened: !options.no_open,
    };
    match snug_workbench::open(opening, &tell) {
        Ok(()) => exit::DONE,
        Err(error) => {
            complain(&error.to_string());
            exit::failed()
        }
    }
}

fn tell(notice: Notice) {
    match notice {
        Notice::Open { address } => {
            say(
                &format!("The workbench is at {address}; Ctrl-C ends it.\n"),
                exit::DONE,
            );
        }
        Notice::NoBrowser { source } => complain(&format!(
            "no browser could be opened ({source}): open the address yourself"
        )),
        _ => {}
    }
}
