//! Verbs and options of the command line; the comments here are what `--help` prints.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Snug identifies the hand–arm model of a nutrunner from measured tightenings.
#[derive(Debug, Parser)]
#[command(
    name = "cargo xtask",
    bin_name = "cargo xtask",
    version,
    after_help = "\
Examples:
  cargo xtask run                              the embedded campaign, into out/
  cargo xtask run --data DIR                   your folder of MAT files (or a folder of recordings)
  cargo xtask run --data DIR --preset thesis   the same, as the original program did it
  cargo xtask run --study rig.ron              any rig described in a study file
  cargo xtask compare --data DIR               where the model fails
  cargo xtask diagnose --data DIR              which physical effect is missing
  cargo xtask add coulomb_friction --data DIR  the error before and after
  cargo xtask improve --data DIR               all of that, until only noise is left
  cargo xtask effects cubic_stiffness          one effect of the catalogue in full

  cargo xtask recover FILE.mcap                a recording that was cut short, made whole

Exit codes: 0 done, 1 failed or nothing was identified, 2 bad arguments, 130 stopped by Ctrl-C or a signal;
with --strict 3 when some data was left out (findings.json says which)."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
    /// How log lines are written.
    #[command(flatten)]
    pub log: LogOptions,
}

/// Options of the log; every verb takes them.
#[derive(Debug, Args)]
pub struct LogOptions {
    /// Log lines for people or, one JSON object a line, for machines (on standard error).
    #[arg(long, global = true, value_enum, default_value_t = LogFormat::Text)]
    pub log: LogFormat,
    /// Which log lines: error, warn, info, debug, trace, or a filter such as snug_ingest=debug.
    #[arg(long, global = true, default_value = "warn", value_name = "FILTER")]
    pub log_level: String,
}

/// Form of the log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LogFormat {
    /// For people.
    Text,
    /// One JSON object a line.
    Json,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// From recordings to identified parameters, statistics, report and MCAP.
    ///
    /// Without arguments on the campaign embedded in fixtures/. Writes report.html, tightenings.csv, statistics.json,
    /// findings.json, recording.mcap (with a layout for the viewer) and study.ron, the study with every default written
    /// out, which can be run again.
    Run(RunOptions),
    /// Model against measurement: how large the error is, and where it lies.
    ///
    /// Per tightening and pooled, in units, in percent and in multiples of the measured noise; over time, phase,
    /// frequency, amplitude and conditions; and as a missing force.
    Compare(RunOptions),
    /// What is missing: every effect that could be, ranked. Changes nothing.
    ///
    /// Each effect of the catalogue is scored, refitted to all tightenings together and tried on tightenings that took no
    /// part; the first of the ranking is named if chance does not do as well.
    Diagnose(RunOptions),
    /// Adds effects to the model, refits, and shows the error before and after.
    ///
    /// With --study, the effects are written into that file's model; always into the results' study.ron, with their sizes.
    Add {
        /// Names of effects, from the catalogue or the study's own.
        #[arg(required = true, value_name = "EFFECT")]
        effects: Vec<String>,
        #[command(flatten)]
        options: RunOptions,
    },
    /// Takes an effect out of a study file's model.
    Remove {
        /// Its name.
        effect: String,
        /// The study file (RON).
        #[arg(long, value_name = "FILE.ron")]
        study: PathBuf,
    },
    /// Diagnoses, adds, refits, again and again until nothing more is justified.
    ///
    /// Writes the whole ladder: how the error fell, what was tried and why it stopped.
    Improve(RunOptions),
    /// The catalogue of physical effects, or one of them in full.
    Effects {
        /// Name of one effect, for example coulomb_friction.
        name: Option<String>,
    },
    /// Makes a recording that was cut short whole: an index at its end, so that every reader opens it.
    ///
    /// A run that is killed leaves its recording as recording.partial-TIME.mcap. Everything in it that can be read stays
    /// as it is; what is missing is told. The file as it was is kept beside.
    Recover {
        /// The recording (MCAP).
        #[arg(value_name = "FILE.mcap")]
        file: PathBuf,
    },
    /// Makes the embedded campaigns in fixtures/ anew, bit for bit.
    Fixtures,
    /// Every test of the workspace.
    Test {
        /// Also the statistical checks with many cases (minutes).
        #[arg(long)]
        many: bool,
        /// Also every effect of the catalogue hidden and searched for (half an hour and more).
        #[arg(long)]
        blind: bool,
        /// Only tests whose name contains this.
        filter: Option<String>,
    },
    /// Licences, advisories, dependencies, sizes and units of the workspace; needs no network.
    Tidy {
        /// Also what fails nothing: accepted advisories, duplicates and who needs them.
        #[arg(long)]
        list: bool,
    },
    /// Mutated inputs for everything that reads a stranger's bytes, each reader in a process of its own.
    Fuzz {
        /// Only readers whose name contains this: mat4, mat5, mat5_packed, hdf5, csv, mcap, mcap_packed, study, expression,
        /// pipeline.
        target: Option<String>,
        /// An input that failed before, to be tried again.
        input: Option<PathBuf>,
        /// How long each reader is tried.
        #[arg(long, value_name = "S", default_value_t = 60)]
        seconds: u32,
        /// Which mutations.
        #[arg(long, value_name = "N", default_value_t = 0)]
        seed: u64,
    },
    /// How fast Snug is beside bare loops and other programs, in one table.
    Bench {
        /// Sections: base, effects, ranking, improve, throughput, peers; default all.
        sections: Vec<String>,
        /// Also what takes minutes: 2687 tightenings.
        #[arg(long)]
        long: bool,
    },
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
    pub effects: Option<Vec<String>>,
    /// Folder for the results; made if it is not there.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
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

/// How recordings become tightenings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PresetName {
    /// Bias and noise measured in the quiet part, velocity zeroed there; the default.
    Snug,
    /// The original program, step by step.
    Thesis,
}
