//! What Snug is asked to do: a verb is one file here, one variant of [`Verb`] and one arm of [`Verb::run`].

mod bench;
mod diagnose;
mod effects;
mod fixtures;
mod fuzz;
mod init;
mod plant;
mod recover;
mod run;
mod test;
mod tidy;
mod workbench;

use crate::arguments::{ChangeOptions, RunOptions};
use clap::Subcommand;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

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
    /// The study with them and their sizes is the results' study.ron; the file given by --study changes with --write only.
    Add {
        /// Names of effects, from the catalogue or the study's own.
        #[arg(required = true, value_name = "EFFECT")]
        effects: Vec<String>,
        #[command(flatten)]
        options: ChangeOptions,
    },
    /// Takes effects out of the study's model and compares what is left with the measurement.
    ///
    /// The study without them is the results' study.ron; the file given by --study changes with --write only.
    Remove {
        /// Names of effects in the study's model.
        #[arg(required = true, value_name = "EFFECT")]
        effects: Vec<String>,
        #[command(flatten)]
        options: ChangeOptions,
    },
    /// Diagnoses, adds, refits, again and again until nothing more is justified.
    ///
    /// Writes the whole ladder: how the error fell, what was tried and why it stopped. The study with the model found is the
    /// results' study.ron; the file given by --study changes with --write only.
    Improve(ChangeOptions),
    /// Writes a commented study for measurement files of which nobody has declared anything.
    ///
    /// Looks at the columns of CSV, MAT or JSON files, guesses signals, units and sampling from names and numbers, shows
    /// what it found, and writes every guess with its reason into a study file.
    Init {
        /// One folder, or files of one folder.
        #[arg(required = true, value_name = "FILES")]
        files: Vec<PathBuf>,
        /// Study file that is written.
        #[arg(long, value_name = "FILE.ron", default_value = "rig.ron")]
        study: PathBuf,
        /// Also over a file that is there.
        #[arg(long)]
        write: bool,
    },
    /// The catalogue of physical effects, or one of them in full.
    Effects {
        /// Name of one effect, for example coulomb_friction.
        name: Option<String>,
    },
    /// A page on this machine: click an effect, and the error falls while all tightenings are fitted with it.
    ///
    /// Only this machine is answered, at 127.0.0.1; Ctrl-C ends it. The first time it is built, which takes a minute or two.
    Workbench {
        /// Study file (RON); without it, the thesis' rig and file layout.
        #[arg(long, value_name = "FILE.ron")]
        study: Option<PathBuf>,
        /// Folder (or file) with the data; overrides the study's.
        #[arg(long, value_name = "DIR")]
        data: Option<PathBuf>,
        /// Port of 127.0.0.1 to listen at; 0 for any free one.
        #[arg(long, value_name = "N")]
        port: Option<u16>,
        /// Does not open the browser.
        #[arg(long)]
        no_open: bool,
    },
    /// A plant's tightenings as Parquet: brought in, fitted on one machine or many, asked and watched.
    ///
    /// `cargo xtask plant --help` says everything. The first time it is built with its engine, which takes some ten minutes.
    #[command(disable_help_flag = true)]
    Plant {
        /// What the plant's program is given.
        #[arg(
            trailing_var_arg = true,
            allow_hyphen_values = true,
            value_name = "ARGS"
        )]
        arguments: Vec<OsString>,
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
    /// Every test of the workspace, then every example.
    Test {
        /// Also the statistical checks with many cases (minutes).
        #[arg(long)]
        many: bool,
        /// Also every effect of the catalogue hidden and searched for (half an hour and more).
        #[arg(long)]
        blind: bool,
        /// Also 37 campaigns of people, joints and times that differ, and 20 that hide nothing (half an hour); a word picks those whose
        /// label has it.
        #[arg(long, value_name = "WORD", num_args = 0..=1, require_equals = true, default_missing_value = "1")]
        people: Option<String>,
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
        /// Only readers whose name contains this, for example csv.
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
        /// Sections, for example base or effects; default all.
        sections: Vec<String>,
        /// Also what takes minutes: 2687 tightenings.
        #[arg(long)]
        long: bool,
    },
}

impl Verb {
    /// Does it.
    pub fn run(self) -> ExitCode {
        match self {
            Self::Run(options) => run::run(&options),
            Self::Compare(options) => diagnose::diagnose(&options, &snug_study::Verb::Compare),
            Self::Diagnose(options) => diagnose::diagnose(&options, &snug_study::Verb::Diagnose),
            Self::Add { effects, options } => {
                diagnose::change(&options, &snug_study::Verb::Add(effects))
            }
            Self::Remove { effects, options } => diagnose::remove(&options, &effects),
            Self::Improve(options) => diagnose::change(&options, &snug_study::Verb::Improve),
            Self::Init {
                files,
                study,
                write,
            } => init::init(&files, &study, write),
            Self::Effects { name } => effects::effects(name.as_deref()),
            Self::Workbench {
                study,
                data,
                port,
                no_open,
            } => workbench::workbench(study.as_deref(), data.as_deref(), port, no_open),
            Self::Plant { arguments } => plant::plant(&arguments),
            Self::Recover { file } => recover::recover(&file),
            Self::Fixtures => fixtures::fixtures(),
            Self::Test {
                many,
                blind,
                people,
                filter,
            } => test::test(many, blind, people.as_deref(), filter.as_deref()),
            Self::Tidy { list } => tidy::tidy(list),
            Self::Fuzz {
                target,
                input,
                seconds,
                seed,
            } => fuzz::fuzz(target.as_deref(), input.as_deref(), seconds, seed),
            Self::Bench { sections, long } => bench::bench(&sections, long),
        }
    }
}
