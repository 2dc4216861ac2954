//! A workbench in a process of its own, so that its memory is nobody else's: this program once more, told to serve.

use crate::server::Server;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// What tells this program to serve; the study's file comes next.
const SERVE: &str = "--serve";

/// Whether this process is the workbench.
pub fn is_asked_for() -> bool {
    std::env::args().nth(1).as_deref() == Some(SERVE)
}

/// Serves until whoever began it closes its input.
pub fn serve() {
    let study = std::env::args().nth(2).unwrap();
    let server = Server::begin(0, Path::new(&study));
    println!("{}", server.port);
    std::io::stdin().lines().for_each(drop);
    server.end();
}

/// A workbench in a process of its own.
pub struct Apart {
    process: Child,
    pub port: u16,
}

impl Apart {
    /// On a study's file, at any port.
    pub fn begin(study: &Path) -> Self {
        let mut process = Command::new(std::env::current_exe().unwrap())
            .arg(SERVE)
            .arg(study)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        let mut told = BufReader::new(process.stdout.take().unwrap());
        told.read_line(&mut line).unwrap();
        let port = line.trim().parse().unwrap();
        Self { process, port }
    }

    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/", self.port)
    }

    /// Resident memory \[MB\]; NaN where the system does not tell it.
    pub fn memory_mb(&self) -> f64 {
        let status = format!("/proc/{}/status", self.process.id());
        let status = std::fs::read_to_string(status).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        let kb = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok());
        kb.map_or(f64::NAN, |kb| kb / 1e3)
    }

    pub fn end(mut self) {
        drop(self.process.stdin.take());
        self.process.wait().unwrap();
    }
}
