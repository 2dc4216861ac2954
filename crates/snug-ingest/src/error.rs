use crate::signal::{Signal, Unit};
use snug_campaign::{Finding, Severity, did_you_mean};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why measurement files could not be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum IngestError {
    /// The reason, with the file it is about.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: Box<IngestError>,
    },
    /// The operating system refused.
    #[error("cannot be read: {0}")]
    Read(#[source] std::io::Error),
    /// The data folder or file is not there.
    #[error("{} does not exist: the study's data path must name a folder or file", path.display())]
    NoSuchPath {
        /// The path.
        path: PathBuf,
    },
    /// The data path names a device, a pipe or the like.
    #[error("{} is neither a folder nor a regular file: the study's data path must name one of them", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The folder holds no file of the formats that the source reads.
    #[error("{} holds no file to read: {others} file(s) are there, none ends in {expected}; folders inside it are not looked into", folder.display())]
    NothingToRead {
        /// The folder.
        folder: PathBuf,
        /// The endings looked for.
        expected: String,
        /// Number of other files.
        others: usize,
    },
    /// A file named in the source is not in the folder.
    #[error("the source names the file {file}, which {} does not hold", folder.display())]
    NoSuchFile {
        /// The folder.
        folder: PathBuf,
        /// The name in the source.
        file: String,
    },
    /// The format was left out when this program was built.
    #[error("this program was built without {format} (feature {feature})")]
    FormatNotBuilt {
        /// The format.
        format: &'static str,
        /// The Cargo feature that brings it.
        feature: &'static str,
    },

    /// A file without content.
    #[error("the file is empty")]
    EmptyFile,
    /// Not a MAT file of any level.
    #[error(
        "not a MAT file: {bytes} bytes, starting with {first_bytes:02x?}, have no header of level 4, 5 or HDF5"
    )]
    NotMat {
        /// Length of the content.
        bytes: usize,
        /// Its start.
        first_bytes: Vec<u8>,
    },
    /// A level 5 header with a version other than 1.
    #[error(
        "MAT version {version:#06x} is unknown; 0x01xx (level 5) or HDF5 content (7.3) can be read"
    )]
    MatVersion {
        /// The version.
        version: u16,
    },
    /// The data end before something that must follow.
    #[error("{what} at byte {offset} needs {needed} bytes, but {available} are left")]
    Truncated {
        /// What was being read.
        what: &'static str,
        /// Where.
        offset: usize,
        /// Bytes it takes.
        needed: usize,
        /// Bytes that are there.
        available: usize,
    },
    /// An element has a type that cannot stand in its place.
    #[error("{what} at byte {offset} has element type {found}; expected {expected}")]
    ElementType {
        /// What was being read.
        what: &'static str,
        /// Where.
        offset: usize,
        /// What may stand there.
        expected: &'static str,
        /// The type's number.
        found: u32,
    },
    /// An element has a size that cannot be right.
    #[error("{what} at byte {offset} has {found} bytes; expected {expected}")]
    ElementSize {
        /// What was being read.
        what: &'static str,
        /// Where.
        offset: usize,
        /// What may stand there.
        expected: &'static str,
        /// Its bytes.
        found: usize,
    },
    /// An array has another number of values than its shape says.
    #[error("{what} at byte {offset}: the shape calls for {expected} values, {found} are there")]
    ValueCount {
        /// What was being read.
        what: &'static str,
        /// Where.
        offset: usize,
        /// Product of the shape.
        expected: usize,
        /// Values in the file.
        found: usize,
    },
    /// A negative length.
    #[error("dimension {number} at byte {offset} is negative")]
    NegativeDimension {
        /// Where.
        offset: usize,
        /// The dimension.
        number: i32,
    },
    /// A shape that no memory could hold, or none at all.
    #[error("the shape at byte {offset} is empty, or its product overflows")]
    TooManyElements {
        /// Where.
        offset: usize,
    },
    /// Cells in structs in cells …
    #[error("arrays nest deeper than {limit} levels at byte {offset}")]
    NestedTooDeep {
        /// Where.
        offset: usize,
        /// The limit.
        limit: usize,
    },
    /// A name with letters that names cannot have.
    #[error("{what} at byte {offset} is not ASCII text")]
    NameNotAscii {
        /// What was being read.
        what: &'static str,
        /// Where.
        offset: usize,
    },
    /// The parts of a sparse matrix contradict each other.
    #[error("the parts of the sparse matrix at byte {offset} contradict each other")]
    SparseParts {
        /// Where.
        offset: usize,
    },
    /// Inside a compressed element; offsets count its inflated bytes.
    #[error("in the compressed variable at byte {offset}: {source}")]
    InCompressed {
        /// Where the compressed element starts in the file.
        offset: usize,
        /// What is wrong inside.
        source: Box<IngestError>,
    },
    /// A compressed element cannot be inflated.
    #[error("cannot be inflated beyond {inflated} bytes: {reason}")]
    Inflate {
        /// Bytes that came out.
        inflated: usize,
        /// What happened.
        reason: &'static str,
    },
    /// A level 4 header that no IEEE machine wrote.
    #[error(
        "level 4 type code {code} at byte {offset} is unknown (VAX and Cray numbers cannot be read)"
    )]
    Level4TypeCode {
        /// Where.
        offset: usize,
        /// The code.
        code: u32,
    },
    /// The HDF5 inside a 7.3 file is broken or beyond the library.
    #[cfg(feature = "hdf5")]
    #[error("HDF5 object {object}: {source}")]
    Hdf5 {
        /// Path of the object.
        object: String,
        /// The library's reason.
        source: Box<hdf5_pure::Error>,
    },
    /// The HDF5 library gave up on the file.
    #[error("the HDF5 structure is damaged beyond reading")]
    Hdf5Panic,
    /// Objects refer to objects …
    #[error("HDF5 object {object}…: references nest deeper than {limit} levels")]
    Hdf5NestedTooDeep {
        /// Start of the object's path.
        object: String,
        /// The limit.
        limit: usize,
    },
    /// A dataset claims more than the file can hold.
    #[error(
        "HDF5 object {object} claims {claimed_bytes} bytes, but the file can hold {held_bytes} at most"
    )]
    Hdf5TooLarge {
        /// Path of the object.
        object: String,
        /// Size from its shape.
        claimed_bytes: u64,
        /// What its storage can inflate to.
        held_bytes: u64,
    },
    /// The fields of a struct array have different lengths.
    #[error("struct {object}: not every field has {expected} value(s)")]
    Hdf5Fields {
        /// Path of the struct.
        object: String,
        /// Elements of the struct array.
        expected: usize,
    },
    /// The parts of a sparse matrix are missing or contradict each other.
    #[error("the parts of the sparse matrix {object} are missing or contradict each other")]
    Hdf5SparseParts {
        /// Path of the matrix.
        object: String,
    },

    /// A setting cannot be.
    #[error("source setting {field} is {value}; allowed: {allowed}")]
    Setting {
        /// Name of the field.
        field: &'static str,
        /// What it was set to.
        value: String,
        /// What it may be.
        allowed: &'static str,
    },

    /// A channel's unit does not measure its signal.
    #[error(
        "source setting channels: {signal:?} is in {unit:?}; allowed: {}",
        units(allowed)
    )]
    UnitOfSignal {
        /// What the channel measures.
        signal: Signal,
        /// In which unit.
        unit: Unit,
        /// In which it may be.
        allowed: Vec<Unit>,
    },

    /// A channel stands in the file under none of its names.
    #[error(
        "no {channel} channel: expected {}, the file holds {}{}",
        accepted.join(" or "),
        listed(present),
        accepted.iter().map(|name| did_you_mean(name, present)).collect::<String>()
    )]
    MissingChannel {
        /// What is measured.
        channel: String,
        /// The names it may have.
        accepted: Vec<String>,
        /// The names in the file.
        present: Vec<String>,
    },
    /// A channel is there but is no row of numbers.
    #[error("the {channel} channel {variable} is {found}; expected a non-empty real vector")]
    UnusableChannel {
        /// What is measured.
        channel: String,
        /// Its name in the file.
        variable: String,
        /// Shape and class.
        found: String,
    },
    /// The table of events has no third column.
    #[error(
        "the event table {variable} is {found}; expected N×3 text or numbers with the time in the third column"
    )]
    EventTable {
        /// Its name in the file.
        variable: String,
        /// Shape and class.
        found: String,
    },
    /// The text of a CSV file breaks its own quoting, or cannot be read.
    #[error("line {line}: {source}")]
    CsvSyntax {
        /// 1-based line; 0 where it is unknown.
        line: u64,
        /// The reason.
        source: csv::Error,
    },
    /// A file without rows of data.
    #[error("no data: {lines} line(s), none of them a row of numbers")]
    NoRows {
        /// Lines in the file.
        lines: u64,
    },
    /// Too few samples have a usable time.
    #[error(
        "the times do not rise: {usable} of {rows} samples come after the one before them (first break at {place})"
    )]
    TimeNotRising {
        /// Samples.
        rows: usize,
        /// Samples later than all before.
        usable: usize,
        /// Where the first is that is not, `line 7` or `sample 7`.
        place: String,
    },
    /// A gap so long that filling it would be invention.
    #[error(
        "a gap of {gap_s} s at {time_s} s would take {samples} samples to fill, more than 20 times the {rows} measured"
    )]
    TimeGap {
        /// Length of the gap \[s\].
        gap_s: f64,
        /// Time of the sample before it \[s\].
        time_s: f64,
        /// Samples of the filled record.
        samples: f64,
        /// Samples in the file.
        rows: usize,
    },
    /// An MCAP file that cannot be opened as one.
    #[cfg(feature = "mcap")]
    #[error(transparent)]
    Mcap(#[from] snug_record::RecordError),
    /// An MCAP file without any measurement of Snug, where no channels of others are declared.
    #[error(
        "holds no measurement that Snug wrote; to read other topics, declare them: {}",
        listed(present)
    )]
    NoRecordings {
        /// Topics and fields that hold numbers.
        present: Vec<String>,
    },
}

fn units(units: &[Unit]) -> String {
    let names: Vec<String> = units.iter().map(|unit| format!("{unit:?}")).collect();
    names.join(", ")
}

/// The first names of a list, and how many more there are.
fn listed(names: &[String]) -> String {
    const SHOWN: usize = 12;
    match names.len() {
        0 => "nothing".to_owned(),
        1..=SHOWN => names.join(", "),
        count => format!("{} and {} more", names[..SHOWN].join(", "), count - SHOWN),
    }
}

impl IngestError {
    /// The finding that says this file was left out.
    pub fn finding(&self) -> Finding {
        let file = match self {
            Self::File { path, .. } => path.file_name(),
            Self::NoSuchPath { path }
            | Self::NotAFile { path }
            | Self::NothingToRead { folder: path, .. } => path.file_name(),
            _ => None,
        };
        Finding {
            severity: Severity::LeftOut,
            code: self.code().to_owned(),
            file: file.unwrap_or_default().to_string_lossy().into_owned(),
            tightening: None,
            channel: self.channel().map(str::to_owned),
            message: match self {
                Self::File { source, .. } => format!("file left out: {source}"),
                other => other.to_string(),
            },
        }
    }

    /// Stable name of the kind of error, as in findings.
    pub fn code(&self) -> &'static str {
        match self {
            Self::File { source, .. } => source.code(),
            Self::NoSuchPath { .. }
            | Self::NotAFile { .. }
            | Self::NothingToRead { .. }
            | Self::NoSuchFile { .. } => "missing_data",
            Self::Setting { .. } | Self::UnitOfSignal { .. } => "bad_setting",
            Self::FormatNotBuilt { .. } => "unknown_format",
            Self::MissingChannel { .. } => "missing_channel",
            Self::UnusableChannel { .. } => "unusable_channel",
            Self::EventTable { .. } => "unusable_events",
            Self::NoRows { .. } | Self::NoRecordings { .. } | Self::EmptyFile => "no_data",
            Self::TimeNotRising { .. } | Self::TimeGap { .. } => "unusable_time",
            _ => "unreadable_file",
        }
    }

    fn channel(&self) -> Option<&str> {
        match self {
            Self::File { source, .. } => source.channel(),
            Self::MissingChannel { channel, .. } => Some(channel),
            Self::UnusableChannel { variable, .. } | Self::EventTable { variable, .. } => {
                Some(variable)
            }
            _ => None,
        }
    }

    /// Adds the file, unless it is already named.
    pub(crate) fn in_file(self, path: &Path) -> Self {
        match self {
            named @ Self::File { .. } => named,
            source => Self::File {
                path: path.to_owned(),
                source: Box::new(source),
            },
        }
    }
}
