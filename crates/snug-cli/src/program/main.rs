//! The program `snug`: Snug's verbs where there is no checkout, and completions for shells.

mod completions;
mod plant;
mod workbench;

use clap::Subcommand;
use clap_complete::CompleteEnv;
use completions::Shell;
use mimalloc::MiMalloc;
use snug_campaign::words::program;
use snug_cli::Front;
use std::process::ExitCode;

/// A workbench lives for a day: from 250 clicks on models of up to three effects to 500 it has between 164 and 185 MB at rest, and no more at
/// the end than at the beginning of that. With the system's own it had 373 MB after 500 and 453 after 1500.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// What to do.
#[derive(Debug, Subcommand)]
enum Verb {
    #[command(flatten)]
    Snug(snug_cli::Verb),
    /// Prints what a shell must read to complete verbs, options and names of effects.
    ///
    ///   shell       where                         what
    ///   bash        ~/.bashrc                     source <(snug completions bash)
    ///   zsh         ~/.zshrc, after compinit      source <(snug completions zsh)
    ///   fish        ~/.config/fish/config.fish    snug completions fish | source
    ///   elvish      ~/.config/elvish/rc.elv       eval (snug completions elvish | slurp)
    ///   powershell  $PROFILE                      snug completions powershell | Out-String | Invoke-Expression
    #[command(verbatim_doc_comment)]
    Completions {
        /// The shell.
        #[arg(value_name = "SHELL")]
        shell: Shell,
    },
}

const WORDS: &[(&str, &str)] = &[
    ("{campaign}", "the campaign that Snug holds"),
    ("{workbench}", ""),
    (
        "{plant}",
        "It is a program of its own, looked for beside this one and in PATH; cargo install --locked --path crates/snug-plant installs it.",
    ),
];

fn main() -> ExitCode {
    let front = Front {
        // A program that starts this one says what people typed.
        program: std::env::var(program::VARIABLE).map_or(program::program(), |name| name.leak()),
        words: WORDS,
        campaign: snug_cli::campaign,
        workbench: workbench::open,
        plant: plant::start,
    };
    CompleteEnv::with_factory(|| front.command::<Verb>())
        .var(completions::VARIABLE)
        .complete();
    front.run(|verb| match verb {
        Verb::Snug(verb) => verb.run(&front),
        Verb::Completions { shell } => completions::print(shell),
    })
}
