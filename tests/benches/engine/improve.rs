//! From measurement files to report, in a process of its own: time and peak memory.

use crate::campaign::Campaign;
use crate::measure::{Times, once};
use crate::ranking::bare_fits;
use crate::table::{Reference, alone, left_out, section, short, times_the};
use snug_study::{RunSettings, Study, Verb, diagnose};
use snug_synthetic::HiddenEffect;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::AtomicBool;

/// Tells this program on its command line to be the process that is measured.
pub const CHILD: &str = "improve-this";

/// Tightenings, and whether only asked for.
const CAMPAIGNS: [(usize, bool); 3] = [(24, false), (240, false), (2687, true)];
/// Runs that suffice, and seconds after which none is begun any more.
const RUNS: usize = 3;
const BUDGET_S: f64 = 30.0;
/// What they hide.
const HIDDEN: [(HiddenEffect, f64); 2] = [
    (HiddenEffect::CubicStiffness, 0.35),
    (HiddenEffect::TorqueDelay, 0.35),
];

pub fn fill(is_long: bool) {
    section(
        "improve: files read, ranked, effects added until nothing more is justified, every rung evaluated, recorded, reported; all cores",
    );
    for (tightenings, only_long) in CAMPAIGNS {
        if only_long && !is_long {
            left_out(&format!("{tightenings} tightenings take minutes: --long"));
            continue;
        }
        let campaign = Campaign::hiding(&HIDDEN, tightenings);
        let measured = repeat(&campaign);
        let times = Times::new(measured.iter().map(|run| run.seconds).collect());
        let memory = (measured.iter())
            .filter_map(|run| run.peak_mb)
            .reduce(f64::max);
        let memory =
            memory.map_or_else(|| "not known".to_owned(), |mb| format!("{} MB", short(mb)));
        let (count, cases) = (campaign.tightenings, campaign.cases());
        let reference = Reference {
            name: "bare scalar loops",
            times: &once(|| bare_fits(&cases)),
        };
        let found = &measured[0].found;
        let what = format!(
            "{count} tightenings ({found}); the reference fits the base model to each once"
        );
        times_the(&reference, &times, &what);
        alone(&memory, &format!("{count} tightenings, peak memory"));
    }
}

fn repeat(campaign: &Campaign) -> Vec<Measured> {
    let mut measured: Vec<Measured> = Vec::new();
    let spent = |measured: &[Measured]| measured.iter().map(|run| run.seconds).sum::<f64>();
    while measured.is_empty() || (measured.len() < RUNS && spent(&measured) < BUDGET_S) {
        measured.push(measure(campaign));
    }
    measured
}

struct Measured {
    seconds: f64,
    peak_mb: Option<f64>,
    found: String,
}

fn measure(campaign: &Campaign) -> Measured {
    let program = std::env::current_exe().expect("this program is a file");
    let output = Command::new(program)
        .arg(CHILD)
        .arg(campaign.data())
        .arg(campaign.beside("out"))
        .output()
        .expect("this program can be started again");
    let text = String::from_utf8_lossy(&output.stdout);
    let mut lines = text.lines();
    let mut number = || lines.next().and_then(|line| line.parse().ok());
    let (seconds, peak_mb) = (number(), number());
    Measured {
        seconds: seconds.unwrap_or_else(|| {
            panic!(
                "improve failed: {}",
                String::from_utf8_lossy(&output.stderr)
            )
        }),
        peak_mb,
        found: lines.next().unwrap_or_default().to_owned(),
    }
}

/// One `improve`; prints seconds, peak memory \[MB\] and what was added, a line each.
pub fn child(data: &Path, out: &Path) {
    let study = Study::on(data.to_path_buf());
    let settings = RunSettings::new(out);
    let start = std::time::Instant::now();
    let outcome = diagnose(
        &study,
        &Verb::Improve,
        &settings,
        &|_| (),
        &AtomicBool::new(false),
    )
    .expect("the benchmark's own data");
    println!("{}", start.elapsed().as_secs_f64());
    println!(
        "{}",
        peak_mb().map_or_else(String::new, |mb| mb.to_string())
    );
    let diagnosis = outcome.result.diagnosis.expect("improve diagnoses");
    let added: Vec<&str> = diagnosis
        .added
        .iter()
        .map(|one| one.effect.as_str())
        .collect();
    println!("added: {}", added.join(", "));
}

/// Most memory this process has had at once \[MB\]; only Linux tells.
fn peak_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1024.0 / 1e6)
}
