//! The workspace's driver: Snug's verbs, which live in `crates/snug-cli`, and the chores of a checkout.

mod chores;
mod programs;
mod workspace;

use chores::Chore;
use clap::Subcommand;
use snug_cli::Front;
use std::process::ExitCode;

/// What to do.
#[derive(Debug, Subcommand)]
enum Verb {
    #[command(flatten)]
    Snug(snug_cli::Verb),
    #[command(flatten)]
    Chore(Chore),
}

const WORDS: &[(&str, &str)] = &[
    ("{campaign}", "the campaign embedded in fixtures/"),
    (
        "{workbench}",
        " The first time it is built, which takes a minute or two.",
    ),
    (
        "{plant}",
        "The first time it is built with its engine, which takes some ten minutes.",
    ),
];

fn main() -> ExitCode {
    let front = Front {
        program: "cargo xtask",
        words: WORDS,
        campaign: |_| Ok(workspace::embedded_campaign()),
        workbench: programs::workbench,
        plant: programs::plant,
    };
    front.run(|verb| match verb {
        Verb::Snug(verb) => verb.run(&front),
        Verb::Chore(chore) => chore.run(),
    })
}
