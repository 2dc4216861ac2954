//! Progress on standard error: a bar for people, a plain line every few seconds for files and pipes.

use crate::terminal::complain;
use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use snug_study::ProgressEvent;
use std::fmt::Write;
use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Between two plain progress lines where there is no terminal.
const PLAIN_EVERY: Duration = Duration::from_secs(5);
/// What is shown while nobody knows how much there is to do.
const UNCOUNTED: &str = "{spinner} {msg}  {elapsed}";
/// What is shown where it is known.
const COUNTED: &str = "{spinner} {msg}  {pos} of {len}  {wide_bar}  {elapsed}, {left}";

/// Shows a run's progress: a bar with count and time left on a terminal, a line now and then elsewhere.
pub struct Progress {
    bar: Option<ProgressBar>,
    plain: Option<Mutex<Plain>>,
}

/// What the plain lines need to know.
struct Plain {
    started: Instant,
    last: Instant,
    /// What is counted at present.
    count: Count,
}

/// So many of so many pieces of the work at hand.
struct Count {
    since: Instant,
    what: &'static str,
    done: usize,
    of: usize,
}

impl Count {
    fn of(of: usize, what: &'static str) -> Self {
        Self {
            since: Instant::now(),
            what,
            done: 0,
            of,
        }
    }

    /// `12 of 60 candidates, about 20 s left`.
    fn said(&self) -> String {
        let Self { what, done, of, .. } = self;
        let each_s = self.since.elapsed().as_secs_f64() / (*done).max(1) as f64;
        let left_s = each_s * of.saturating_sub(*done) as f64;
        format!("{done} of {of} {what}, about {left_s:.0} s left")
    }
}

impl Progress {
    /// Shows nothing when `quiet`.
    pub fn new(quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = (!quiet && terminal).then(|| {
            let bar = ProgressBar::no_length();
            bar.set_style(style(UNCOUNTED));
            bar.enable_steady_tick(Duration::from_millis(100));
            bar
        });
        let now = Instant::now();
        let plain = (!quiet && !terminal).then(|| {
            Mutex::new(Plain {
                started: now,
                last: now,
                count: Count::of(0, "files"),
            })
        });
        Self { bar, plain }
    }

    /// Takes what a run reports.
    pub fn report(&self, event: ProgressEvent<'_>) {
        if let Some(bar) = &self.bar {
            on_bar(bar, event);
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

fn style(template: &str) -> ProgressStyle {
    let style = ProgressStyle::with_template(template).expect("the template is well-formed");
    style.with_key("left", left)
}

/// `12s left`; before anything is done nobody knows.
fn left(state: &ProgressState, text: &mut dyn Write) {
    let told = match state.pos() {
        0 => write!(text, "time left not known yet"),
        _ => write!(text, "{:#} left", HumanDuration(state.eta())),
    };
    told.expect("a text takes every write");
}

fn on_bar(bar: &ProgressBar, event: ProgressEvent<'_>) {
    let uncounted = |what: String| {
        bar.set_style(style(UNCOUNTED));
        bar.set_message(what);
    };
    let counted = |of: usize| {
        bar.set_style(style(COUNTED));
        bar.set_length(of as u64);
        bar.set_position(0);
        bar.reset_eta();
    };
    match event {
        ProgressEvent::Started { files } => {
            counted(files);
            bar.set_message("files");
        }
        ProgressEvent::FileDone { tightenings } => {
            bar.inc(1);
            bar.set_message(format!("files, {tightenings} evaluated"));
        }
        ProgressEvent::Stage { what } => uncounted(what.to_owned()),
        ProgressEvent::Candidates { of } => counted(of),
        ProgressEvent::CandidateDone => bar.inc(1),
        ProgressEvent::Writing { what } => uncounted(format!("writing {what}")),
    }
}

impl Plain {
    fn report(&mut self, event: ProgressEvent<'_>) {
        match event {
            ProgressEvent::Started { files } => self.count = Count::of(files, "files"),
            ProgressEvent::Candidates { of } => {
                self.count = Count::of(of, "candidates");
                complain(&format!("{}: {of} candidates to try", self.elapsed()));
            }
            ProgressEvent::FileDone { .. } | ProgressEvent::CandidateDone => {
                self.count.done += 1;
                if self.last.elapsed() >= PLAIN_EVERY {
                    self.last = Instant::now();
                    complain(&format!("{}: {}", self.elapsed(), self.count.said()));
                }
            }
            ProgressEvent::Stage { what } => complain(&format!("{}: {what}", self.elapsed())),
            ProgressEvent::Writing { .. } => {}
        }
    }

    fn elapsed(&self) -> String {
        format!("{:.0} s", self.started.elapsed().as_secs_f64())
    }
}
