//! Progress on standard error: a bar for people, a plain line every few seconds for files and pipes.

use crate::terminal::complain;
use indicatif::{ProgressBar, ProgressStyle};
use snug_study::ProgressEvent;
use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Between two plain progress lines where there is no terminal.
const PLAIN_EVERY: Duration = Duration::from_secs(5);

/// Shows a run's progress: a bar with rate and time left on a terminal, a line now and then elsewhere.
pub struct Progress {
    bar: Option<ProgressBar>,
    plain: Option<Mutex<Plain>>,
}

/// What the plain lines need to know.
struct Plain {
    started: Instant,
    /// Since when files are evaluated.
    evaluating: Instant,
    last: Instant,
    files_done: usize,
    files: usize,
    tightenings: usize,
}

impl Progress {
    /// Shows nothing when `quiet`.
    pub fn new(quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = (!quiet && terminal).then(|| {
            let bar = ProgressBar::new(0);
            let style = ProgressStyle::with_template(
                "{spinner} {pos}/{len} files  {msg}  {wide_bar}  {elapsed} elapsed, {eta} left",
            )
            .expect("the template is well-formed");
            bar.set_style(style);
            bar.enable_steady_tick(Duration::from_millis(100));
            bar
        });
        let now = Instant::now();
        let plain = (!quiet && !terminal).then(|| {
            Mutex::new(Plain {
                started: now,
                evaluating: now,
                last: now,
                files_done: 0,
                files: 0,
                tightenings: 0,
            })
        });
        Self { bar, plain }
    }

    /// Takes what a run reports.
    pub fn report(&self, event: ProgressEvent<'_>) {
        if let Some(bar) = &self.bar {
            match event {
                ProgressEvent::Started { files } => bar.set_length(files as u64),
                ProgressEvent::FileDone { tightenings } => {
                    bar.inc(1);
                    let rate = tightenings as f64 / bar.elapsed().as_secs_f64().max(1e-3);
                    bar.set_message(format!("{tightenings} tightenings, {rate:.0} a second"));
                }
                ProgressEvent::Stage { what } => bar.set_message(what.to_owned()),
                ProgressEvent::Writing { what } => bar.set_message(format!("writing {what}")),
            }
        }
        if let Some(plain) = &self.plain {
            plain
                .lock()
                .expect("no thread panics while it reports")
                .report(event);
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

impl Plain {
    fn report(&mut self, event: ProgressEvent<'_>) {
        match event {
            ProgressEvent::Started { files } => {
                self.files = files;
                self.files_done = 0;
                self.evaluating = Instant::now();
            }
            ProgressEvent::FileDone { tightenings } => {
                self.files_done += 1;
                self.tightenings = tightenings;
                if self.last.elapsed() >= PLAIN_EVERY {
                    self.last = Instant::now();
                    self.line();
                }
            }
            ProgressEvent::Stage { what } => {
                let elapsed = self.started.elapsed().as_secs_f64();
                complain(&format!("{elapsed:.0} s: {what}"));
            }
            ProgressEvent::Writing { .. } => {}
        }
    }

    fn line(&self) {
        let elapsed = self.evaluating.elapsed().as_secs_f64();
        let rate = self.tightenings as f64 / elapsed;
        let left = elapsed / self.files_done as f64 * (self.files - self.files_done) as f64;
        complain(&format!(
            "{} of {} files, {} tightenings, {rate:.0} a second, about {left:.0} s left",
            self.files_done, self.files, self.tightenings
        ));
    }
}
