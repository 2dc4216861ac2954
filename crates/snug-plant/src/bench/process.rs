//! What a process spends, as Linux says it under /proc.

use super::program;
use crate::error::PlantError;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Ticks of the processor time in /proc in a second: 100 wherever Linux runs programs (`getconf CLK_TCK`).
const TICKS_PER_S: f64 = 100.0;

/// A process to be asked.
#[derive(Debug, Clone, Copy)]
pub struct Resources(u32);

impl Resources {
    /// Of a process.
    ///
    /// # Errors
    /// [`PlantError::Read`] where the system does not say.
    pub fn of(process: u32) -> Result<Self, PlantError> {
        let own = Self(process);
        own.processor_s().map(|_| own)
    }

    fn file(&self, name: &str) -> Result<String, PlantError> {
        let path = std::path::PathBuf::from(format!("/proc/{}/{name}", self.0));
        std::fs::read_to_string(&path).map_err(|source| PlantError::Read { path, source })
    }

    /// Processor time so far \[s\].
    pub fn processor_s(&self) -> Result<f64, PlantError> {
        let text = self.file("stat")?;
        // The name in parentheses may hold anything; user and system time are the 12th and 13th word behind it.
        let behind = text.rsplit_once(')').map_or("", |(_, behind)| behind);
        let ticks = behind.split_whitespace().skip(11).take(2);
        Ok(ticks
            .filter_map(|word| word.parse::<f64>().ok())
            .sum::<f64>()
            / TICKS_PER_S)
    }

    /// Largest memory so far \[byte\].
    pub fn peak_bytes(&self) -> Result<u64, PlantError> {
        let text = self.file("status")?;
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
        Ok(kilobytes.unwrap_or(0) * 1024)
    }
}

/// How often a process is asked what it has spent.
const ASKED_EVERY: Duration = Duration::from_millis(5);

/// What a process spent from its beginning to its end.
pub struct Whole {
    /// Time \[s\].
    pub wall_s: f64,
    /// Processor time \[s\].
    pub processor_s: f64,
    /// Largest memory \[byte\].
    pub peak_bytes: u64,
}

/// Runs this program with some arguments to its end: what it spends is nobody else's.
///
/// # Errors
/// [`PlantError::Cluster`] where it does not end well.
pub async fn run(arguments: &[&str]) -> Result<Whole, PlantError> {
    let failed = |reason: String| PlantError::Cluster {
        what: "a process",
        address: arguments.join(" "),
        reason,
    };
    let mut command = Command::new(program()?);
    command.args(arguments).env("RUST_LOG", "error");
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let began = Instant::now();
    let mut child = command.spawn().map_err(|error| failed(error.to_string()))?;
    let resources = Resources(child.id());
    let (mut processor_s, mut peak_bytes) = (0.0, 0);
    let status = loop {
        // Its times stand until it is waited for, its memory goes with its end.
        processor_s = resources.processor_s().unwrap_or(processor_s);
        peak_bytes = peak_bytes.max(resources.peak_bytes().unwrap_or(0));
        match child
            .try_wait()
            .map_err(|error| failed(error.to_string()))?
        {
            Some(status) => break status,
            None => tokio::time::sleep(ASKED_EVERY).await,
        }
    };
    match status.success() {
        true => Ok(Whole {
            wall_s: began.elapsed().as_secs_f64(),
            processor_s,
            peak_bytes,
        }),
        false => Err(failed(status.to_string())),
    }
}

/// Since when something is measured.
pub struct Spent {
    wall: Instant,
    processor_s: f64,
}

impl Spent {
    /// From now on.
    pub fn since(resources: &Resources) -> Result<Self, PlantError> {
        Ok(Self {
            wall: Instant::now(),
            processor_s: resources.processor_s()?,
        })
    }

    /// Time since \[s\].
    pub fn wall_s(&self) -> f64 {
        self.wall.elapsed().as_secs_f64()
    }

    /// Time and processor time since \[s\].
    pub fn so_far(&self, resources: &Resources) -> Result<(f64, f64), PlantError> {
        Ok((self.wall_s(), resources.processor_s()? - self.processor_s))
    }
}
