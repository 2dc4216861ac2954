//! A study on the mystery in a folder of its own, its workbench, and a browser to look at it with.

use crate::browser::{Headless, Tab, installed};
use crate::server::{Server, study_in};
use std::path::PathBuf;
use tempfile::TempDir;

/// All of it, for as long as a story takes.
pub struct Opened {
    /// Where studies are saved.
    pub folder: TempDir,
    pub study_file: PathBuf,
    pub server: Server,
    pub browser: Headless,
}

impl Opened {
    /// `None` where there is no browser, which then is said.
    pub fn on_the_mystery() -> Option<Self> {
        let program = installed()?;
        let folder = TempDir::new().unwrap();
        let study_file = study_in(folder.path());
        Some(Self {
            server: Server::begin(0, &study_file),
            browser: Headless::launch(program),
            study_file,
            folder,
        })
    }

    /// The page as somebody at a desk has it.
    pub fn tab(&self) -> Tab {
        self.browser.open(&self.server.address(), 1400, "light")
    }

    /// Closes all but the folder.
    pub fn close(self) -> TempDir {
        self.browser.close();
        self.server.end();
        self.folder
    }
}
