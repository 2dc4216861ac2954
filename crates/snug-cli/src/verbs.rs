//! What Snug is asked to do: a verb is one file here, one variant of [`Verb`] and one arm of [`Verb::run`].

mod diagnose;
mod effects;
mod init;
mod recover;
mod run;

pub use run::{refused, study};

use crate::arguments::{ChangeOptions, RunOptions, WorkbenchOptions};
use crate::effect_names::EffectNames;
use crate::front::Front;
use clap::Subcommand;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// From recordings to identified parameters, statistics, report and MCAP.
    ///
    /// Without arguments on {campaign}. Writes report.html, tightenings.csv, statistics.json,
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
        #[arg(value_parser = EffectNames::OfModels, hide_possible_values = true)]
        effects: Vec<String>,
        /// What every verb takes that changes the model.
        #[command(flatten)]
        options: ChangeOptions,
    },
    /// Takes effects out of the study's model and compares what is left with the measurement.
    ///
    /// The study without them is the results' study.ron; the file given by --study changes with --write only.
    Remove {
        /// Names of effects in the study's model.
        #[arg(required = true, value_name = "EFFECT")]
        #[arg(value_parser = EffectNames::OfModels, hide_possible_values = true)]
        effects: Vec<String>,
        /// What every verb takes that changes the model.
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
        #[arg(value_parser = EffectNames::InCatalogue, hide_possible_values = true)]
        name: Option<String>,
    },
    /// A page on this machine: click an effect, and the error falls while all tightenings are fitted with it.
    ///
    /// Only this machine is answered, at 127.0.0.1; Ctrl-C ends it.{workbench}
    Workbench(WorkbenchOptions),
    /// A plant's tightenings as Parquet: brought in, fitted on one machine or many, asked and watched.
    ///
    /// `{program} plant --help` says everything. {plant}
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
}

impl Verb {
    /// Does it, as `front` has it done.
    pub fn run(self, front: &Front) -> ExitCode {
        match self {
            Self::Run(options) => run::run(&options, front),
            Self::Compare(options) => {
                diagnose::diagnose(&options, front, &snug_study::Verb::Compare)
            }
            Self::Diagnose(options) => {
                diagnose::diagnose(&options, front, &snug_study::Verb::Diagnose)
            }
            Self::Add { effects, options } => {
                diagnose::change(&options, front, &snug_study::Verb::Add(effects))
            }
            Self::Remove { effects, options } => diagnose::remove(&options, front, &effects),
            Self::Improve(options) => diagnose::change(&options, front, &snug_study::Verb::Improve),
            Self::Init {
                files,
                study,
                write,
            } => init::init(&files, &study, write),
            Self::Effects { name } => effects::effects(name.as_deref()),
            Self::Workbench(options) => (front.workbench)(front, &options),
            Self::Plant { arguments } => (front.plant)(front, &arguments),
            Self::Recover { file } => recover::recover(&file),
        }
    }
}
