//! What people read: the summary on standard output, complaints on standard error.
//!
//! Neither a reader that has gone away nor a full disk behind a redirection may end a run that has done its work.

use crate::exit;
use console::Term;
use snug_campaign::words::program::program;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// Characters of one complaint: what is longer quotes a stranger's file at length.
const LONGEST_COMPLAINT: usize = 4000;

/// Columns of the terminal that standard output is; `None` where it is none.
pub fn columns() -> Option<usize> {
    let (_, columns) = Term::stdout().size_checked()?;
    Some(usize::from(columns)).filter(|columns| *columns > 0)
}

/// Prints to standard output, on a terminal no wider than that; the exit code is `done`, or that of a failure where the text could not be printed.
///
/// A reader that has read enough and gone, as `head` does, is no failure.
pub fn say(text: &str, done: ExitCode) -> ExitCode {
    let text = match columns() {
        Some(columns) => wrapped(&printable(text), columns),
        None => printable(text),
    };
    let mut output = std::io::stdout().lock();
    let said = output
        .write_all(text.as_bytes())
        .and_then(|()| output.flush());
    match said {
        Ok(()) => done,
        Err(error) if error.kind() == ErrorKind::BrokenPipe => done,
        Err(error) => {
            complain(&format!("the summary cannot be printed: {error}"));
            exit::failed()
        }
    }
}

/// Prints a line to standard error, as far as that is possible.
pub fn complain(text: &str) {
    let mut line: String = printable(text).chars().take(LONGEST_COMPLAINT).collect();
    if line.len() < text.len() && line.chars().count() == LONGEST_COMPLAINT {
        line.push_str(" …");
    }
    line.push('\n');
    // Whoever closed standard error does not want to know.
    std::io::stderr().write_all(line.as_bytes()).ok();
}

/// Standard error for whatever writes lines of its own: what it writes is shown, never sent as it is.
pub struct Printable(std::io::Stderr);

impl Printable {
    pub fn stderr() -> Self {
        Self(std::io::stderr())
    }
}

impl Write for Printable {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let text = printable(&String::from_utf8_lossy(bytes));
        self.0.write_all(text.as_bytes()).map(|()| bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.0.flush()
    }
}

/// What a summary may send to a terminal beside text: bold on and off.
const ALLOWED: [&str; 2] = ["\u{1b}[1m", "\u{1b}[0m"];

/// The text with control characters shown instead of sent: a file's name must not steer the terminal.
fn printable(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(one) = rest.chars().next() {
        let allowed = ALLOWED.iter().find(|allowed| rest.starts_with(**allowed));
        let length = allowed.map_or(one.len_utf8(), |allowed| allowed.len());
        match one.is_control() && one != '\n' && allowed.is_none() {
            true => shown.extend(one.escape_default()),
            false => shown.push_str(&rest[..length]),
        }
        rest = &rest[length..];
    }
    shown
}

/// Share of the columns within which what goes on stands below the last column of a table \[–\]. Chosen.
const TABLE: f64 = 0.6;
/// Columns by which what goes on is moved in elsewhere.
const HANGING: usize = 4;

/// The text with every line that is longer than `columns` broken between words. Commands stay whole, to be copied.
pub fn wrapped(text: &str, columns: usize) -> String {
    let command = format!("{} ", program());
    let lines = text.split('\n').map(|line| {
        let is_command = line.trim_start().starts_with(&command);
        match visible(line) <= columns || is_command {
            true => line.to_owned(),
            false => broken(line, columns),
        }
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Characters that take room on a terminal.
pub fn visible(text: &str) -> usize {
    let bold = ALLOWED
        .iter()
        .map(|code| text.matches(code).count() * code.len());
    text.chars().count() - bold.sum::<usize>()
}

fn broken(line: &str, columns: usize) -> String {
    let margin = line.len() - line.trim_start().len();
    let table = line[margin..]
        .rfind("  ")
        .map(|gap| visible(&line[..margin + gap]) + 2);
    let indent = table
        .filter(|column| *column as f64 <= TABLE * columns as f64)
        .unwrap_or(margin + HANGING);
    let mut text = String::new();
    let (mut rest, mut moved_in) = (line, 0);
    while visible(rest) + moved_in > columns {
        let words_begin = rest.len() - rest.trim_start().len();
        let gaps = rest[words_begin..]
            .match_indices(' ')
            .map(|(at, _)| words_begin + at)
            // A number and its percent sign stay on one line.
            .filter(|at| !rest[*at..].starts_with(" %"));
        let fits = |at: &usize| visible(&rest[..*at]) + moved_in <= columns;
        let Some(at) = gaps.clone().take_while(fits).last().or(gaps.clone().next()) else {
            break;
        };
        text += rest[..at].trim_end();
        text += "\n";
        text += &" ".repeat(indent);
        (rest, moved_in) = (rest[at..].trim_start(), indent);
    }
    text + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_is_wider_than_the_terminal() {
        let text = "\u{1b}[1mHow far the model misses the measurement\u{1b}[0m\n  preset snug    selects 46 of 48 (96 %); rejected: 2 data quality\n    snug run --study a/very/long/path/to/study.ron\n  short\n";
        let narrow = wrapped(text, 40);
        let lines: Vec<&str> = narrow.lines().collect();
        let expected = [
            "\u{1b}[1mHow far the model misses the measurement\u{1b}[0m",
            "  preset snug    selects 46 of 48",
            "                 (96 %); rejected: 2",
            "                 data quality",
            "    snug run --study a/very/long/path/to/study.ron",
            "  short",
        ];
        assert_eq!(lines, expected);
        assert_eq!(wrapped(text, 200), text);
    }

    #[test]
    fn a_word_that_is_wider_than_the_terminal_stays_whole() {
        assert_eq!(
            broken("  /a/path/that/has/no/gap", 10),
            "  /a/path/that/has/no/gap"
        );
        assert_eq!(
            broken("ab /a/path/that/has/no/gap", 10),
            "ab\n    /a/path/that/has/no/gap"
        );
    }

    #[test]
    fn names_of_files_do_not_steer_the_terminal() {
        assert_eq!(
            printable("a\u{1b}[2Jb\nc\u{7}\u{1b}[1mü"),
            "a\\u{1b}[2Jb\nc\\u{7}\u{1b}[1mü"
        );
    }
}
