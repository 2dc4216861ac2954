//! A workbench in a process of its own, so that its memory is nobody else's: this program once more, told to serve.

use crate::server::Server;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// What tells this program to serve; the study's file comes next.
const SERVE: &str = "--serve";

/// Ticks in a second that nobody works for. Chosen.
const AT_REST: u64 = 5;
/// How long somebody waits for that \[s\]. Chosen.
const LONGEST_WAIT_S: usize = 120;

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

    /// Waits until nothing is worked on: effects are tested for a while after the last click.
    pub fn rests(&self) {
        let mut worked = self.worked();
        for _ in 0..LONGEST_WAIT_S {
            std::thread::sleep(Duration::from_secs(1));
            let before = std::mem::replace(&mut worked, self.worked());
            if worked <= before + AT_REST {
                return;
            }
        }
    }

    /// Ticks of the processor that it took so far, hundredths of a second; 0 where the system does not tell them.
    fn worked(&self) -> u64 {
        let stat = format!("/proc/{}/stat", self.process.id());
        let stat = std::fs::read_to_string(stat).unwrap_or_default();
        let after_name = stat.rsplit(')').next().unwrap_or_default();
        let ticks = after_name.split_whitespace().skip(11).take(2);
        ticks.filter_map(|ticks| ticks.parse::<u64>().ok()).sum()
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
