//! A machine with nothing on it but the program.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// A machine with the program, a home and a folder to work in, both empty.
pub struct Machine {
    folder: TempDir,
}

impl Machine {
    pub fn new() -> Self {
        let machine = Self {
            folder: tempfile::tempdir().unwrap(),
        };
        for folder in ["programs", "home", "work"] {
            std::fs::create_dir(machine.path(folder)).unwrap();
        }
        machine.install(Path::new(env!("CARGO_BIN_EXE_snug")), "snug");
        machine
    }

    /// Puts a program there. Another process does it: one that a test beside this starts meanwhile would inherit a file that is open for
    /// writing here, and while it has that nobody can run it ("text file busy").
    pub fn install(&self, program: &Path, name: &str) {
        let mut install = Command::new("install");
        install.args(["-m", "755"]).arg(program);
        let status = install.arg(self.path("programs").join(name)).status();
        assert!(status.unwrap().success());
    }

    /// A path on it: `home`, `work`, or what lies below.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The environment of a login, and nothing of cargo's.
    pub fn start(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        let programs = self.path("programs");
        command
            .env_clear()
            .env("PATH", format!("{}:/usr/bin:/bin", programs.display()))
            .env("HOME", self.path("home"))
            .current_dir(self.path("work"))
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }

    /// `snug` with these words.
    pub fn snug(&self, words: &[&str]) -> Command {
        let mut command = self.start(self.path("programs/snug").to_str().unwrap());
        command.args(words);
        command
    }
}

/// Runs it to its end: exit code, standard output, standard error.
pub fn ended(command: &mut Command) -> (i32, String, String) {
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let code = output.status.code().unwrap();
    (code, text(output.stdout), text(output.stderr))
}

/// Data of the repository: `campaign` or `mystery`.
pub fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../fixtures")
        .join(name)
}
