//! What differs between the programs that offer Snug's verbs: their name, their campaign, and how they start other programs.

use crate::arguments::{Arguments, WorkbenchOptions};
use crate::error::CliError;
use crate::terminal::complain;
use crate::{exit, logging};
use clap::{Command, CommandFactory, FromArgMatches, Subcommand};
use snug_campaign::words::program::set_program;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

/// Hears what a person who waits is to be told.
pub type Notify<'a> = &'a dyn Fn(&str);

/// A program that offers Snug's verbs: `snug`, or `cargo xtask` in a checkout.
#[derive(Debug, Clone, Copy)]
pub struct Front {
    /// What people type before a verb.
    pub program: &'static str,
    /// What stands in help for each word in braces, beside `{program}`.
    pub words: &'static [(&'static str, &'static str)],
    /// Folder of the campaign that is evaluated where nobody names data; hears whom to tell what takes long.
    pub campaign: fn(Notify<'_>) -> Result<PathBuf, CliError>,
    /// Opens the workbench until it is ended.
    pub workbench: fn(&Front, &WorkbenchOptions) -> ExitCode,
    /// Starts the plant's program with these arguments.
    pub plant: fn(&Front, &[OsString]) -> ExitCode,
}

impl Front {
    /// Does what was typed with one of the verbs `V`; texts recommend the program's name from now on. Ends the program where the
    /// arguments are wrong.
    pub fn run<V: Subcommand>(&self, act: impl FnOnce(V) -> ExitCode) -> ExitCode {
        set_program(self.program);
        let mut command = self.command::<V>();
        let mut matches = command.get_matches_mut();
        let arguments = Arguments::<V>::from_arg_matches_mut(&mut matches)
            .unwrap_or_else(|error| error.format(&mut command).exit());
        if let Err(error) = logging::start(&arguments.log) {
            complain(&error);
            return exit::bad_arguments();
        }
        act(arguments.verb)
    }

    /// The command line with the verbs `V` under the program's name, every word in braces filled in.
    pub fn command<V: Subcommand>(&self) -> Command {
        let command = Arguments::<V>::command()
            .name(self.program)
            .bin_name(self.program);
        self.filled(command)
            .mut_subcommands(|verb| self.filled(verb))
    }

    fn filled(&self, command: Command) -> Command {
        let filled = |text: Option<&clap::builder::StyledStr>| {
            let text = text.map(ToString::to_string).unwrap_or_default();
            let own = [("{program}", self.program)];
            (own.iter().chain(self.words)).fold(text, |text, (word, told)| text.replace(word, told))
        };
        let long = command.get_long_about().is_some();
        let (about, long_about) = (
            filled(command.get_about()),
            filled(command.get_long_about()),
        );
        let after = filled(command.get_after_help());
        let command = command.about(about).after_help(after);
        match long {
            true => command.long_about(long_about),
            false => command,
        }
    }
}
