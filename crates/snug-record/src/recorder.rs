//! The recorder: every kind of result as messages on its topic, one after another.

pub(crate) mod until_failure;

use crate::encoding::schema::Message;
use crate::encoding::shape::{Shape, tidy};
use crate::error::RecordError;
use crate::messages::signals;
use crate::messages::signals::Columns;
use crate::messages::window::Window;
use crate::messages::{diagnosis, estimate, finding, measurement, statistics, window};
use crate::recorder::until_failure::{LastingWriter, UntilFailure};
use crate::settings::{Compression, RecordSettings};
use crate::topic;
use mcap::Attachment;
use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use serde::Serialize;
use serde_json::Value;
use snug_campaign::{
    ConditionSummary, Diagnosis, Finding, Recording, TestRow, TighteningResult, Traces,
};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::io::{BufWriter, ErrorKind, Write};
use std::path::Path;

/// The recording's time axis begins here, because some viewers take a time of zero for "no time".
const START_NS: u64 = 1_000_000_000;
/// Distance of neighbouring rungs, and of neighbouring candidates, on the time axis.
const PLACE_NS: u64 = 100_000_000;

/// Writes one recording, tightening by tightening.
///
/// Memory stays below a few chunks however long the recording gets. Every call that adds a tightening, a measurement file
/// or the study ends with a flush, so that a run killed later leaves it readable. The same calls give the same bytes.
pub struct Recorder<'w> {
    writer: LastingWriter<'w>,
    settings: RecordSettings,
    channels: HashMap<String, OpenChannel>,
    /// Where the next message stands on the time axis.
    cursor_ns: u64,
    tightenings: u64,
    samples: u64,
    measurement_samples: u64,
}

struct OpenChannel {
    id: u16,
    sequence: u32,
    /// The shape the schema was made from, for topics without a fixed schema.
    shape: Option<Shape>,
}

impl Recorder<'static> {
    /// Begins a recording in a new file. A file that is there already is never touched: the measurements and results in
    /// it may exist nowhere else.
    ///
    /// # Errors
    /// [`RecordError::Exists`], [`RecordError::Create`], [`RecordError::Write`], [`RecordError::Setting`].
    pub fn create(path: &Path, settings: RecordSettings) -> Result<Self, RecordError> {
        settings.check()?;
        let file = File::create_new(path).map_err(|source| {
            let path = path.to_owned();
            match source.kind() {
                ErrorKind::AlreadyExists => RecordError::Exists { path },
                _ => RecordError::Create { path, source },
            }
        })?;
        Self::new(BufWriter::new(file), settings)
    }
}

impl<'w> Recorder<'w> {
    /// Begins a recording on any writer.
    ///
    /// # Errors
    /// [`RecordError::Write`], [`RecordError::Setting`].
    pub fn new(writer: impl Write + 'w, settings: RecordSettings) -> Result<Self, RecordError> {
        settings.check()?;
        let compression = match settings.compression {
            Compression::Zstd => Some(mcap::Compression::Zstd),
            Compression::Lz4 => Some(mcap::Compression::Lz4),
            Compression::Off => None,
        };
        let writer = until_failure::options(u64::from(settings.chunk_bytes))
            .compression(compression)
            .library(concat!("snug-record ", env!("CARGO_PKG_VERSION")))
            .create(NoSeek::new(UntilFailure::new(writer)))?;
        Ok(Self {
            writer,
            settings,
            channels: HashMap::new(),
            cursor_ns: START_NS,
            tightenings: 0,
            samples: 0,
            measurement_samples: 0,
        })
    }

    /// Keeps the study as run (RON): as metadata `snug.study` and as attachment `study.ron`.
    ///
    /// # Errors
    /// [`RecordError::Write`].
    pub fn study(&mut self, ron: &str) -> Result<(), RecordError> {
        self.writer.write_metadata(&Metadata {
            name: topic::STUDY.into(),
            metadata: BTreeMap::from([
                ("format".to_owned(), "1".to_owned()),
                ("study_ron".to_owned(), ron.to_owned()),
            ]),
        })?;
        self.writer.attach(&Attachment {
            log_time: self.cursor_ns,
            create_time: self.cursor_ns,
            name: "study.ron".into(),
            media_type: "text/plain".into(),
            data: Cow::Borrowed(ron.as_bytes()),
        })?;
        self.flush()
    }

    /// Keeps a whole measurement file, quiet parts included, so that the recording can be evaluated anew.
    ///
    /// Returns false, and writes nothing, when [`RecordSettings::measurement_samples`] would be exceeded.
    ///
    /// # Errors
    /// [`RecordError::Write`], [`RecordError::Json`].
    pub fn measurement(&mut self, recording: &Recording) -> Result<bool, RecordError> {
        let header = measurement::header(recording);
        let samples = self.measurement_samples + header.samples as u64;
        if samples > self.settings.measurement_samples {
            tracing::debug!(
                file = recording.file,
                samples = header.samples,
                "measurement file not kept in the recording: it would exceed measurement_samples"
            );
            return Ok(false);
        }
        self.measurement_samples = samples;
        self.known(topic::MEASUREMENT_FILE, &measurement::FILE, &header)?;
        let time_ns = self.cursor_ns;
        for block in measurement::blocks(recording) {
            self.protobuf(
                topic::MEASUREMENT_SAMPLES,
                &measurement::SAMPLES,
                time_ns,
                &block,
            )?;
        }
        self.flush()?;
        Ok(true)
    }

    /// Writes one tightening: its window, its estimate and its signals, after the tightenings before it on the time axis.
    ///
    /// `onset` is the sample of the window at which the pulse begins (`Tightening::onset`).
    ///
    /// # Errors
    /// [`RecordError::UnequalLengths`] when a signal is not as long as the torque (nothing is written then),
    /// [`RecordError::Write`], [`RecordError::Json`].
    pub fn tightening(
        &mut self,
        result: &TighteningResult,
        traces: &Traces,
        onset: Option<usize>,
    ) -> Result<(), RecordError> {
        let number = self.tightenings + 1;
        let mut columns = Columns::new(number, &result.id, traces)?;
        self.tightenings = number;
        let samples = traces.torque_nm.len();
        let stride = self.settings.stride(samples, self.samples);
        let window = window(result, traces, onset, number, stride);
        self.known(topic::WINDOW, &window::WINDOW, &window)?;
        let estimate = estimate::message(number, result).map_err(|source| RecordError::Json {
            topic: topic::ESTIMATE.into(),
            source,
        })?;
        self.known(topic::ESTIMATE, &estimate::ESTIMATE, &estimate)?;

        let base = traces.time_base;
        let origin_s = base.at(onset.unwrap_or(0));
        let start_ns = self.cursor_ns;
        let mut message = Vec::new();
        for sample in (0..samples).step_by(stride) {
            let time_s = base.at(sample);
            columns.encode(sample, time_s, time_s - origin_s, &mut message);
            let time_ns = start_ns.saturating_add(nanoseconds(sample as f64 * base.interval_s));
            self.protobuf(topic::SIGNALS, &signals::SIGNALS, time_ns, &message)?;
        }
        self.samples += window.stored_samples() as u64;
        let length_s = samples as f64 * base.interval_s + self.settings.gap_s;
        self.cursor_ns = start_ns.saturating_add(nanoseconds(length_s));
        self.flush()
    }

    /// Writes a finding, at the current place on the time axis.
    ///
    /// # Errors
    /// [`RecordError::Write`], [`RecordError::Json`].
    pub fn finding(&mut self, finding: &Finding) -> Result<(), RecordError> {
        self.known(topic::FINDING, &finding::FINDING, finding)?;
        let line = finding::log_line(finding, self.cursor_ns);
        self.known(topic::LOG, &finding::LOG, &line)
    }

    /// Writes the tables of statistics.
    ///
    /// # Errors
    /// [`RecordError::Write`], [`RecordError::Json`].
    pub fn statistics(
        &mut self,
        conditions: &[ConditionSummary],
        tests: &[TestRow],
    ) -> Result<(), RecordError> {
        let conditions = BTreeMap::from([("rows", conditions)]);
        self.known(topic::CONDITIONS, &statistics::CONDITIONS, &conditions)?;
        let tests = BTreeMap::from([("rows", tests)]);
        self.known(topic::TESTS, &statistics::TESTS, &tests)
    }

    /// Writes what is missing in the model: the verdict, then every rung of the ladder and every candidate of every rung's ranking.
    ///
    /// Rungs follow one another on the time axis by a tenth of a second, and so do candidates, so that plots show them
    /// side by side.
    ///
    /// # Errors
    /// [`RecordError::Write`], [`RecordError::Json`].
    pub fn diagnosis(&mut self, found: &Diagnosis) -> Result<(), RecordError> {
        let verdict = diagnosis::verdict(found);
        self.json(topic::VERDICT, "snug.Verdict", &verdict)?;
        let start_ns = self.cursor_ns;
        for rung in diagnosis::rungs(found) {
            self.known(topic::LADDER, &diagnosis::LADDER, &rung)?;
            self.cursor_ns = self.cursor_ns.saturating_add(PLACE_NS);
        }
        let ladder_end_ns = std::mem::replace(&mut self.cursor_ns, start_ns);
        for candidate in diagnosis::candidates(found) {
            self.known(topic::RANKING, &diagnosis::RANKING, &candidate)?;
            self.cursor_ns = self.cursor_ns.saturating_add(PLACE_NS);
        }
        self.cursor_ns = self.cursor_ns.max(ladder_end_ns);
        self.flush()
    }

    /// Writes anything else as JSON, with a schema made from the value itself.
    ///
    /// Nulls are left out, lists of mixed kinds become objects, and a value that is no object becomes the field `value`.
    /// A later value on the same topic with fields that the first did not have opens a second channel of that topic.
    ///
    /// # Errors
    /// [`RecordError::Write`], [`RecordError::Json`].
    pub fn json(
        &mut self,
        topic: &str,
        schema_name: &str,
        value: &impl Serialize,
    ) -> Result<(), RecordError> {
        let mut value = json_value(topic, value)?;
        if !value.is_object() {
            value = serde_json::json!({ "value": value });
        }
        let shape = Shape::of(&value).expect("an object has a shape");
        let earlier = self.channels.get(topic).and_then(|open| open.shape.clone());
        let wanted = match earlier.clone() {
            Some(earlier) => earlier.merge(shape),
            None => shape,
        };
        if earlier.as_ref() != Some(&wanted) {
            let mut schema = wanted.schema();
            schema["title"] = schema_name.into();
            let schema = schema.to_string();
            self.open(topic, schema_name, "jsonschema", schema.as_bytes(), "json")?;
            if let Some(open) = self.channels.get_mut(topic) {
                open.shape = Some(wanted);
            }
        }
        self.write(topic, self.cursor_ns, value.to_string().as_bytes())
    }

    /// Writes what is pending to the writer, so that it survives the process.
    ///
    /// # Errors
    /// [`RecordError::Write`].
    pub fn flush(&mut self) -> Result<(), RecordError> {
        Ok(self.writer.flush()?)
    }

    /// Ends the recording with its index. Dropping a recorder does the same, but hides errors;
    /// after a failed write nothing more is written.
    ///
    /// # Errors
    /// [`RecordError::Write`].
    pub fn finish(self) -> Result<(), RecordError> {
        until_failure::finish(self.writer)
    }

    /// One JSON message of a fixed schema.
    fn known(
        &mut self,
        topic: &str,
        message: &Message,
        value: &impl Serialize,
    ) -> Result<(), RecordError> {
        let value = json_value(topic, value)?;
        if !self.channels.contains_key(topic) {
            let schema = message.json_schema();
            self.open(topic, message.name, "jsonschema", &schema, "json")?;
        }
        self.write(topic, self.cursor_ns, value.to_string().as_bytes())
    }

    fn protobuf(
        &mut self,
        topic: &str,
        message: &Message,
        time_ns: u64,
        data: &[u8],
    ) -> Result<(), RecordError> {
        if !self.channels.contains_key(topic) {
            let schema = message.descriptor_set();
            self.open(topic, message.name, "protobuf", &schema, "protobuf")?;
        }
        self.write(topic, time_ns, data)
    }

    fn open(
        &mut self,
        topic: &str,
        schema_name: &str,
        schema_encoding: &str,
        schema: &[u8],
        message_encoding: &str,
    ) -> Result<(), RecordError> {
        let schema_id = self
            .writer
            .add_schema(schema_name, schema_encoding, schema)?;
        let id = self
            .writer
            .add_channel(schema_id, topic, message_encoding, &BTreeMap::new())?;
        let channel = OpenChannel {
            id,
            sequence: 0,
            shape: None,
        };
        self.channels.insert(topic.to_owned(), channel);
        Ok(())
    }

    fn write(&mut self, topic: &str, time_ns: u64, data: &[u8]) -> Result<(), RecordError> {
        let open = self
            .channels
            .get_mut(topic)
            .expect("every caller opens the channel first");
        open.sequence += 1;
        let header = MessageHeader {
            channel_id: open.id,
            sequence: open.sequence,
            log_time: time_ns,
            publish_time: time_ns,
        };
        Ok(self.writer.write_to_known_channel(&header, data)?)
    }
}

fn json_value(topic: &str, value: &impl Serialize) -> Result<Value, RecordError> {
    let value = serde_json::to_value(value).map_err(|source| RecordError::Json {
        topic: topic.to_owned(),
        source,
    })?;
    Ok(tidy(value))
}

fn window(
    result: &TighteningResult,
    traces: &Traces,
    onset: Option<usize>,
    tightening: u64,
    stored_every: usize,
) -> Window {
    let grip_force_n = traces.grip_force_n.as_deref();
    let channels = measurement::channels(&traces.torque_nm, &traces.measured, grip_force_n);
    Window {
        tightening,
        file: result.id.file.clone(),
        number: result.id.number,
        started_at_s: result.started_at_s,
        conditions: result.conditions.clone(),
        rig: result.rig,
        peak_torque_nm: result.peak_torque_nm,
        target_torque_nm: result.target_torque_nm,
        time_base: traces.time_base,
        samples: traces.torque_nm.len(),
        stored_every,
        onset,
        channels: measurement::names(channels.map(|samples| samples.is_some())),
        noise: result.noise.clone(),
        corrections: result.corrections.clone(),
    }
}

/// Nearest whole nanosecond; a grid without sense gives 0.
fn nanoseconds(time_s: f64) -> u64 {
    (time_s * 1e9).round() as u64
}
