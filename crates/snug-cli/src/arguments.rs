//! Options of the command line; the comments here are what `--help` prints. The verbs stand in `verbs.rs`.

use crate::effect_names::EffectNames;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use std::time::Duration;

/// Snug identifies the hand–arm model of a nutrunner from measured tightenings.
#[derive(Debug, Parser)]
#[command(version, after_help = EXAMPLES)]
pub(crate) struct Arguments<V: Subcommand> {
    /// What to do.
    #[command(subcommand)]
    pub verb: V,
    /// How log lines are written.
    #[command(flatten)]
    pub log: LogOptions,
}

/// Options of the log; every verb takes them.
#[derive(Debug, Args)]
pub(crate) struct LogOptions {
    /// Log lines for people or, one JSON object a line, for machines (on standard error).
    #[arg(long, global = true, value_enum, default_value_t = LogFormat::Text)]
    pub log: LogFormat,
    /// Which log lines: error, warn, info, debug, trace, or a filter such as snug_ingest=debug.
    #[arg(long, global = true, default_value = "warn", value_name = "FILTER")]
    pub log_level: String,
}

/// Form of the log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum LogFormat {
    /// For people.
    Text,
    /// One JSON object a line.
    Json,
}

/// Options of the verbs that evaluate data.
#[derive(Debug, Args)]
pub struct RunOptions {
    /// Study file (RON); without it, the thesis' rig and file layout.
    #[arg(long, value_name = "FILE.ron")]
    pub study: Option<PathBuf>,
    /// Folder (or file) with the data; overrides the study's.
    #[arg(long, value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// How recordings become tightenings; overrides the study's.
    #[arg(long, value_enum)]
    pub preset: Option<PresetName>,
    /// Effects in the model, separated by commas, for example coulomb_friction,torque_delay.
    #[arg(long, value_delimiter = ',', value_name = "A,B")]
    #[arg(value_parser = EffectNames::OfModels, hide_possible_values = true)]
    pub effects: Option<Vec<String>>,
    /// Folder for the results; made if it is not there.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Ends after so many seconds with the best answer so far, which says that it is one; without it `improve` looks for effects for 240.
    #[arg(long, value_name = "S", value_parser = seconds)]
    pub time: Option<Duration>,
    /// Waits for another run that writes into the same folder.
    #[arg(long)]
    pub wait: bool,
    /// Exit code 3 when a file or tightening was left out.
    #[arg(long)]
    pub strict: bool,
    /// No progress, no summary: only errors.
    #[arg(long)]
    pub quiet: bool,
    /// Threads; without it, one a core. Results do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Seed of everything random (permutation tests).
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
}

/// `60` or `60s`.
fn seconds(text: &str) -> Result<Duration, String> {
    let number = text.strip_suffix('s').unwrap_or(text).trim();
    let seconds: f64 = number.parse().unwrap_or(f64::NAN);
    match Duration::try_from_secs_f64(seconds) {
        Ok(time) if !time.is_zero() => Ok(time),
        _ => Err("a number of seconds above 0 is wanted, as 60 or 60s".to_owned()),
    }
}

/// Options of the verbs that change the model: a study file stays as it is unless somebody says otherwise.
#[derive(Debug, Args)]
pub struct ChangeOptions {
    /// Also writes the changed list of effects into the file given by --study.
    #[arg(long, requires = "study")]
    pub write: bool,
    /// What every evaluation takes.
    #[command(flatten)]
    pub run: RunOptions,
}

/// How recordings become tightenings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PresetName {
    /// Bias and noise measured in the quiet part, velocity zeroed there; the default.
    Snug,
    /// The original program, step by step.
    Thesis,
}

/// Options of the workbench.
#[derive(Debug, Args)]
pub struct WorkbenchOptions {
    /// Study file (RON); without it, the thesis' rig and file layout.
    #[arg(long, value_name = "FILE.ron")]
    pub study: Option<PathBuf>,
    /// Folder (or file) with the data; overrides the study's.
    #[arg(long, value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// Port of 127.0.0.1 to listen at; 0 for any free one.
    #[arg(long, value_name = "N")]
    pub port: Option<u16>,
    /// Does not open the browser.
    #[arg(long)]
    pub no_open: bool,
}

/// What every program's help ends with.
const EXAMPLES: &str = "\
Examples:
  {program} run                              the embedded campaign, into out/
  {program} run --data DIR                   your folder of MAT files (or a folder of recordings)
  {program} run --data DIR --preset thesis   the same, as the original program did it
  {program} run --study rig.ron              any rig described in a study file
  {program} init DIR                         a study for files of any other rig, in rig.ron
  {program} compare --data DIR               where the model fails
  {program} diagnose --data DIR              which physical effect is missing
  {program} add coulomb_friction --data DIR  the error before and after
  {program} improve --data DIR               all of that, until only noise is left
  {program} effects cubic_stiffness          one effect of the catalogue in full
  {program} workbench --data DIR             a page on this machine: click an effect, the error falls

  {program} plant --help                     thousands of tools: Parquet, one machine or many, what changed when

  {program} recover FILE.mcap                a recording that was cut short, made whole

Exit codes: 0 done, 1 failed or nothing was identified, 2 bad arguments, 130 stopped by Ctrl-C or a signal;
with --strict 3 when some data was left out (findings.json says which).";
