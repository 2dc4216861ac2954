//! Files that hold numbers at named places (MAT, JSON), of which a study says which place is which signal.

pub mod json;
pub mod mat;
mod path;
mod place;

pub use place::Part;

pub(crate) use path::{DataPath, Segment, joined};
pub(crate) use place::{Block, Order};

use crate::csv::TimeUnit;
use crate::error::IngestError;
use crate::file::finding_log::{About, FindingLog};
use crate::file::ingested::Ingested;
use crate::layout;
use crate::layout::{Channel, Layout};
use crate::memory::Budget;
use crate::recording::channels;
use crate::recording::condition_pattern::ConditionPattern;
use crate::recording::range;
use crate::recording::range::Range;
use crate::recording::sampling;
use crate::recording::sampling::Timed;
use crate::signal;
use crate::signal::Signal;
use crate::unit::Unit;
use serde::{Deserialize, Serialize};
use snug_campaign::TimeBase;
use snug_files::Input;
use std::path::Path;

/// Which places of a file are which signals. One file is one recording.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DeclaredLayout {
    /// What is read: one input (torque or force) and at least one motion. Default none (must be declared).
    pub channels: Vec<DeclaredChannel>,
    /// Where the samples' times come from. Default the numbers at `time`, in s.
    pub sampling: DeclaredSampling,
    /// Stretches that become segments; without any the whole file is one. Default none.
    pub ranges: Vec<Range>,
    /// How the file's name tells the conditions; `None` (default): it does not.
    pub conditions: Option<ConditionPattern>,
}

/// One signal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DeclaredChannel {
    /// Where it stands, as `torque`, `run.graph.torque`, `runs[0].torque` (counted from 0), `samples[].torque` (of every
    /// sample) or `run["torque.raw"]` (a name with a point or a bracket).
    pub path: String,
    /// Which part of what stands there. Default `Whole`.
    #[serde(default)]
    pub part: Part,
    /// What it measures.
    pub signal: Signal,
    /// In which unit.
    pub unit: Unit,
    /// Factor before the unit, for gain or sign. Default 1.
    #[serde(default = "signal::as_it_is")]
    pub scale: f64,
}

/// Where the samples' times come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum DeclaredSampling {
    /// The samples are equally spaced, the first at 0 s.
    Rate {
        /// Samples per second \[Hz\].
        hz: f64,
    },
    /// The same, and the file says how many samples a second has.
    RateAt {
        /// Where the number stands \[Hz\].
        path: String,
    },
    /// The file holds the times.
    Times {
        /// Where they stand.
        path: String,
        /// Which part of what stands there. Default `Whole`.
        #[serde(default)]
        part: Part,
        /// Their unit. Default s.
        #[serde(default)]
        unit: TimeUnit,
        /// How far a sample may lie from the uniform grid, in intervals, before all are interpolated. Default 0.1.
        #[serde(default = "sampling::default_tolerance_ratio")]
        tolerance_ratio: f64,
    },
}

impl Default for DeclaredSampling {
    fn default() -> Self {
        Self::Times {
            path: "time".to_owned(),
            part: Part::default(),
            unit: TimeUnit::default(),
            tolerance_ratio: sampling::default_tolerance_ratio(),
        }
    }
}

/// A place that is read, and what it is to hold.
#[derive(Debug)]
pub(crate) struct Wanted {
    /// In words, `torque`.
    pub(crate) what: String,
    pub(crate) path: DataPath,
    pub(crate) part: Part,
}

/// What reading the places gave, in the order of [`DeclaredLayout::wanted`].
type Found = Vec<Result<Vec<f64>, IngestError>>;

/// A format that holds numbers at named places: what it has to say and do beyond its places to be a [`Layout`].
trait Places {
    /// As [`Layout::endings`].
    const ENDINGS: &[&str];

    /// The places.
    fn places(&self) -> &DeclaredLayout;

    /// Checks a path for what this format does not know.
    ///
    /// # Errors
    /// [`IngestError::Setting`] naming the path.
    fn check_path(_: &DataPath) -> Result<(), IngestError> {
        Ok(())
    }

    /// Reads the wanted places.
    ///
    /// # Errors
    /// As [`Layout::read`].
    fn find(
        wanted: &[Wanted],
        input: &mut dyn Input,
        budget: &Budget,
        log: &mut FindingLog,
    ) -> Result<Found, IngestError>;
}

impl<P: Places> Layout for P {
    fn endings(&self) -> &'static [&'static str] {
        P::ENDINGS
    }

    fn check(&self) -> Result<(), IngestError> {
        self.places().check()?;
        let wanted = self.places().wanted();
        wanted.iter().try_for_each(|one| P::check_path(&one.path))
    }

    fn ranges(&self) -> &[Range] {
        &self.places().ranges
    }

    fn declared(&self) -> Vec<(Signal, Unit, f64)> {
        self.places().declared()
    }

    fn read(
        &self,
        input: &mut dyn Input,
        path: &Path,
        lever_arm_m: f64,
        budget: &Budget,
    ) -> Result<Ingested, IngestError> {
        let mut log = FindingLog::new(path);
        let places = self.places();
        let found = P::find(&places.wanted(), input, budget, &mut log)?;
        places.recording(found, path, lever_arm_m, budget, log)
    }
}

impl DeclaredLayout {
    fn check(&self) -> Result<(), IngestError> {
        channels::check(&self.declared())?;
        range::check(&self.ranges)?;
        let (field, value) = match &self.sampling {
            DeclaredSampling::Rate { hz } => ("sampling.hz", *hz),
            DeclaredSampling::RateAt { .. } => ("sampling.path", 1.0),
            DeclaredSampling::Times {
                tolerance_ratio, ..
            } => ("sampling.tolerance_ratio", *tolerance_ratio),
        };
        layout::check_positive(field, value)?;
        let channels = self.channels.iter();
        let paths = channels.map(|channel| ("channels.path", channel.path.as_str()));
        for (field, path) in paths.chain(self.sampling_path()) {
            if DataPath::parse(path).is_none() {
                let allowed = "names between points, as `run.torque`; places in brackets counted from 0, as `runs[0].torque`; \
                               `samples[].torque` for all; `run[\"a.b\"]` for a name with a point, bracket or quote";
                return Err(IngestError::setting(field, path, allowed));
            }
        }
        Ok(())
    }

    fn declared(&self) -> Vec<(Signal, Unit, f64)> {
        let channels = self.channels.iter();
        channels.map(|c| (c.signal, c.unit, c.scale)).collect()
    }

    fn sampling_path(&self) -> Option<(&'static str, &str)> {
        match &self.sampling {
            DeclaredSampling::Rate { .. } => None,
            DeclaredSampling::RateAt { path } | DeclaredSampling::Times { path, .. } => {
                Some(("sampling.path", path))
            }
        }
    }

    /// The places to read: of the channels, then of times or rate where the file has them.
    fn wanted(&self) -> Vec<Wanted> {
        let wanted = |what: String, path: &str, part: Part| {
            DataPath::parse(path).map(|path| Wanted { what, path, part })
        };
        let channels = self.channels.iter();
        let channels = channels.map(|one| wanted(one.signal.in_words(), &one.path, one.part));
        let sampling = match &self.sampling {
            DeclaredSampling::Rate { .. } => None,
            DeclaredSampling::RateAt { path } => {
                wanted("sample rate".to_owned(), path, Part::Whole)
            }
            DeclaredSampling::Times { path, part, .. } => wanted("time".to_owned(), path, *part),
        };
        channels.chain([sampling]).flatten().collect()
    }

    /// The recording of what was found at the places that are [wanted](Self::wanted).
    ///
    /// A signal that is missing or damaged costs itself, and is a finding, as long as the input and one motion are there.
    ///
    /// # Errors
    /// The reason why the input, the times or the last of the motions cannot be read.
    fn recording(
        &self,
        mut found: Found,
        path: &Path,
        lever_arm_m: f64,
        budget: &Budget,
        mut log: FindingLog,
    ) -> Result<Ingested, IngestError> {
        let times = (found.len() > self.channels.len())
            .then(|| found.pop())
            .flatten()
            .transpose()?;
        let (declared, mut columns) = self.readable(found, &mut log)?;
        let is_rate = matches!(self.sampling, DeclaredSampling::RateAt { .. });
        let (rate, mut times) = if is_rate {
            (times, None)
        } else {
            (None, times)
        };
        equalise(columns.iter_mut().chain(&mut times), &mut log);
        let grid = self.on_a_grid(rate, times, &mut columns, budget, &mut log)?;
        let channels: Vec<Channel> = declared.into_iter().zip(columns).collect();
        let about = (&self.ranges[..], self.conditions.as_ref());
        let recording = layout::recording(about, path, grid, channels, lever_arm_m, &mut log);
        Ok(Ingested {
            recordings: vec![recording],
            findings: log.finish(),
        })
    }

    /// The channels that can be read, what each is first.
    #[expect(clippy::type_complexity, reason = "two lists of the same length")]
    fn readable(
        &self,
        found: Found,
        log: &mut FindingLog,
    ) -> Result<(Vec<(Signal, Unit, f64)>, Vec<Vec<f64>>), IngestError> {
        let (mut declared, mut columns, mut lost) = (Vec::new(), Vec::new(), Vec::new());
        for (channel, samples) in self.channels.iter().zip(found) {
            match samples {
                Ok(samples) => {
                    declared.push((channel.signal, channel.unit, channel.scale));
                    columns.push(samples);
                }
                Err(reason) if channel.signal.is_input() || reason.is_of_the_file() => {
                    return Err(reason);
                }
                Err(reason) => lost.push((channel, reason)),
            }
        }
        let moves = declared
            .iter()
            .any(|(signal, ..)| signal.quantity().is_some());
        for (channel, reason) in lost {
            if !moves && channel.signal.quantity().is_some() {
                return Err(reason);
            }
            let message = format!("left out: {reason}");
            log.left_out(reason.code(), About::Channel(&channel.path), message);
        }
        Ok((declared, columns))
    }

    fn on_a_grid(
        &self,
        rate: Option<Vec<f64>>,
        times: Option<Vec<f64>>,
        columns: &mut [Vec<f64>],
        budget: &Budget,
        log: &mut FindingLog,
    ) -> Result<TimeBase, IngestError> {
        let uniform = |hz: f64| TimeBase {
            start_s: 0.0,
            interval_s: 1.0 / hz,
        };
        match &self.sampling {
            DeclaredSampling::Rate { hz } => Ok(uniform(*hz)),
            DeclaredSampling::RateAt { path } => match rate.as_deref() {
                Some(&[hz]) if hz.is_finite() && hz > 0.0 => Ok(uniform(hz)),
                found => Err(IngestError::UnusableRate {
                    variable: path.clone(),
                    found: match found {
                        Some([one]) => one.to_string(),
                        Some(several) => format!("{} numbers", several.len()),
                        None => "nothing".to_owned(),
                    },
                }),
            },
            DeclaredSampling::Times {
                unit,
                tolerance_ratio,
                ..
            } => {
                let mut times_s = times.unwrap_or_default();
                times_s.iter_mut().for_each(|time| *time *= unit.seconds());
                let timed = Timed {
                    times_s,
                    channels: columns,
                    place: &|index| format!("sample {}", index + 1),
                    budget,
                };
                sampling::uniform(timed, *tolerance_ratio, log)
            }
        }
    }
}

/// Cuts all to the shortest, and says so.
fn equalise<'a>(columns: impl Iterator<Item = &'a mut Vec<f64>>, log: &mut FindingLog) {
    let columns: Vec<&mut Vec<f64>> = columns.collect();
    let lengths: Vec<usize> = columns.iter().map(|column| column.len()).collect();
    let shortest = lengths.iter().copied().min().unwrap_or(0);
    if lengths.iter().all(|&length| length == shortest) {
        return;
    }
    log.repaired(
        "unequal_lengths",
        About::File,
        format!("channels have different lengths ({lengths:?}); the first {shortest} samples of each are used"),
    );
    for column in columns {
        column.truncate(shortest);
    }
}
