//! The same fits by other programs, where Python 3 is there: SciPy and numba, in an environment that goes away again.
//!
//! One script a peer in `peers/`. A peer stays alive and fits when it is told to, so that it takes turns with us.

use crate::base::{FITS, SAME_OPTIMUM, difference, fit_all, fitting, inside, values};
use crate::campaign::{Campaign, START, record};
use crate::measure::{Clock, Times};
use crate::table::{Reference, alone, faster_than, left_out, section};
use snug_campaign::Quantity;
use snug_identify::FitTask;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// Script, name, fits a round.
const PEERS: &[(&str, &str, usize)] = &[
    ("numba_levenberg_marquardt.py", "numba, hand-written", FITS),
    ("scipy_lfilter.py", "SciPy, lfilter", FITS),
    ("scipy_lsim.py", "SciPy, lsim", 4),
];
const PACKAGES: [&str; 3] = ["numpy", "scipy", "numba"];
/// Turns of each peer after one to warm up.
const ROUNDS: usize = 5;

pub fn fill(_is_long: bool) {
    section(
        "Peers: m, c, k from the displacement of the same tightenings, 3000 samples, from the same start, one core each",
    );
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let python = match environment(folder.path()) {
        Ok(python) => python,
        Err(why) => return left_out(&format!("peers: skipped: {why}")),
    };
    let all = Campaign::hiding(&[], FITS).cases();
    let cases = inside(&all);
    write_problem(&cases, folder.path());
    for &(script, name, most) in PEERS {
        let cases = &cases[..most.min(cases.len())];
        match Peer::start(&python, script, folder.path()) {
            Ok(peer) => compare(peer, name, cases),
            Err(why) => left_out(&format!("peers: skipped: {name}: {why}")),
        }
    }
}

/// A Python with the packages, in an environment of its own.
fn environment(folder: &Path) -> Result<PathBuf, String> {
    let environment = folder.join("environment");
    let mut create = Command::new("python3");
    create.args(["-m", "venv"]).arg(&environment);
    succeed(&mut create, "python3 -m venv")?;
    let python = environment.join("bin").join("python");
    let mut install = Command::new(&python);
    install.args([
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
    ]);
    succeed(install.args(PACKAGES), "pip install numpy scipy numba")?;
    Ok(python)
}

fn succeed(command: &mut Command, what: &str) -> Result<(), String> {
    let output = command
        .output()
        .map_err(|error| format!("{what}: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    let text = String::from_utf8_lossy(&output.stderr);
    let last = text.lines().last().unwrap_or("no message").to_owned();
    Err(format!("{what}: {last}"))
}

/// `index.json`, and torque and angle of every tightening one after the other as little-endian doubles.
fn write_problem(cases: &[&FitTask<'_>], folder: &Path) {
    let records: Vec<_> = cases.iter().map(|case| record(case)).collect();
    let index = serde_json::json!({
        "tightenings": records.len(),
        "samples": records[0].torque_nm.len(),
        "interval_s": records[0].interval_s,
        "lever_arm_m": records[0].lever_arm_m,
        "known_inertia_kg_m2": records.iter().map(|record| record.known_inertia_kg_m2).collect::<Vec<_>>(),
        "start": START,
    });
    let written = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.join(name), bytes).expect("a temporary folder can be written");
    };
    written("index.json", index.to_string().as_bytes());
    for (name, signals) in [
        (
            "torque.f64",
            records
                .iter()
                .map(|record| record.torque_nm)
                .collect::<Vec<_>>(),
        ),
        (
            "angle.f64",
            records.iter().map(|record| record.angle_rad).collect(),
        ),
    ] {
        let bytes = signals
            .into_iter()
            .flatten()
            .flat_map(|value| value.to_le_bytes());
        written(name, &bytes.collect::<Vec<u8>>());
    }
}

/// A peer that waits for being told how many tightenings to fit.
struct Peer {
    process: Child,
    orders: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Peer {
    fn start(python: &Path, script: &str, problem: &Path) -> Result<Self, String> {
        let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/engine/peers");
        let mut command = Command::new(python);
        command.arg("-B").arg(scripts.join(script)).arg(problem);
        // A peer's linear algebra would otherwise take all cores.
        for threads in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"] {
            command.env(threads, "1");
        }
        let process = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut process = process.map_err(|error| error.to_string())?;
        let (orders, answers) = (process.stdin.take(), process.stdout.take());
        Ok(Self {
            orders: orders.expect("it is piped"),
            answers: BufReader::new(answers.expect("it is piped")),
            process,
        })
    }

    /// Seconds per fit and the parameters of the first `count` tightenings.
    fn round(&mut self, count: usize) -> Result<(f64, Vec<Vec<f64>>), String> {
        let ended = |error: std::io::Error| format!("the script ended: {error}");
        writeln!(self.orders, "{count}").map_err(ended)?;
        self.orders.flush().map_err(ended)?;
        let mut line = String::new();
        self.answers.read_line(&mut line).map_err(ended)?;
        serde_json::from_str(&line).map_err(|error| format!("the script's answer: {error}"))
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // Failing means that it has ended already.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn compare(mut peer: Peer, name: &str, cases: &[&FitTask<'_>]) {
    let settings = fitting(Quantity::Displacement);
    let (mut theirs, mut ours) = (Vec::new(), Vec::new());
    let mut worst = 0.0_f64;
    // The first turn compiles and fills caches.
    for turn in 0..=ROUNDS {
        let (seconds, parameters) = match peer.round(cases.len()) {
            Ok(answer) => answer,
            Err(why) => return left_out(&format!("peers: skipped: {name}: {why}")),
        };
        let mut estimates = Vec::new();
        let own_seconds =
            Clock::Core.time(|| estimates = fit_all(cases, &settings)) / cases.len() as f64;
        if turn == 0 {
            let pairs = estimates.iter().zip(&parameters);
            worst = pairs
                .map(|(estimate, theirs)| difference(&values(estimate), theirs))
                .fold(0.0, f64::max);
            continue;
        }
        theirs.push(seconds);
        ours.push(own_seconds);
    }
    let (theirs, ours) = (Times::new(theirs), Times::new(ours));
    let reference = Reference {
        name,
        times: &theirs,
    };
    faster_than(&reference, &ours, "one of many fits");
    alone(
        &format!("{worst:.1e} (allowed {SAME_OPTIMUM:.0e})"),
        &format!(
            "largest relative difference to the optimum of {name}, {} tightenings",
            cases.len()
        ),
    );
    assert!(worst < SAME_OPTIMUM, "{name} ends at another optimum");
}
