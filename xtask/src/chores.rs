//! What a checkout is asked to do beside Snug's verbs: a chore is one file here, one variant of [`Chore`] and one arm of its `run`.

mod bench;
mod fixtures;
mod fuzz;
mod test;
mod tidy;

use clap::Subcommand;
use std::path::PathBuf;
use std::process::ExitCode;

/// What to do in a checkout.
#[derive(Debug, Subcommand)]
pub enum Chore {
    /// Makes the embedded campaigns in fixtures/ anew, bit for bit.
    Fixtures,
    /// Every test of the workspace, then every example.
    Test {
        /// Also the statistical checks with many cases, and the longest stories (minutes).
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
        /// Sections, for example base or effects; default all of the engine. By their names only: workbench (clicks in a browser), plant.
        sections: Vec<String>,
        /// Also what takes minutes: 2687 tightenings, a day's clicks.
        #[arg(long)]
        long: bool,
    },
}

impl Chore {
    /// Does it.
    pub fn run(self) -> ExitCode {
        match self {
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
