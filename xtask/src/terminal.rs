//! What people read: the summary on standard output, complaints on standard error.
//!
//! Neither a reader that has gone away nor a full disk behind a redirection may end a run that has done its work.

use crate::exit;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// Characters of one complaint: what is longer quotes a stranger's file at length.
const LONGEST_COMPLAINT: usize = 4000;

/// Prints to standard output; the exit code is `done`, or that of a failure where the text could not be printed.
///
/// A reader that has read enough and gone, as `head` does, is no failure.
pub fn say(text: &str, done: ExitCode) -> ExitCode {
    let mut output = std::io::stdout().lock();
    let said = output
        .write_all(printable(text).as_bytes())
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_do_not_steer_the_terminal() {
        assert_eq!(
            printable("a\u{1b}[2Jb\nc\u{7}\u{1b}[1mü"),
            "a\\u{1b}[2Jb\nc\\u{7}\u{1b}[1mü"
        );
    }
}
