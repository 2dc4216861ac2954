//! Why measurement files could not be read.

mod finding;
mod wording;

use crate::signal::Signal;
use crate::unit::Unit;
use snug_campaign::excerpt;
use std::path::PathBuf;
use thiserror::Error;
use wording::{listed, meant, megabytes, units};

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
    /// The file asks for more memory than it may take.
    #[error(
        "{what} would take {} MB of memory, and the file may take {} MB; if it is not damaged, raise source.memory_mb, or \
         make room in the machine's memory",
        megabytes(needed_bytes),
        megabytes(budget_bytes)
    )]
    OverBudget {
        /// What the memory was to be for.
        what: &'static str,
        /// What the file would take with it.
        needed_bytes: u64,
        /// What it may take.
        budget_bytes: u64,
    },
    /// The data folder or file is not there.
    #[error("{} does not exist: the study's data path must name a folder or file", path.display())]
    NoSuchPath {
        /// The path.
        path: PathBuf,
    },
    /// The data path, or a file that the source names, is a link that leads nowhere.
    #[error("{} is a link that leads nowhere: what it named was moved or removed", path.display())]
    DanglingLink {
        /// The link.
        path: PathBuf,
    },
    /// The data path, or a file that the source names, is a link that leads back to itself.
    #[error("{} is a link that leads back to itself", path.display())]
    LinkLoop {
        /// The link.
        path: PathBuf,
    },
    /// The data path names a device, a pipe or the like, or a file that the source names is none.
    #[error("{} is {found}; it must be {expected}", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
        /// What is there.
        found: &'static str,
        /// What it should be.
        expected: &'static str,
    },
    /// The folder holds no file of the formats that the source reads.
    #[error(
        "{} holds no file to read, that is none that ends in {expected}: {}; folders inside it are not looked into",
        folder.display(), if found.is_empty() { "it is empty".to_owned() } else { format!("there are {}", listed(found)) }
    )]
    NothingToRead {
        /// The folder.
        folder: PathBuf,
        /// The endings looked for.
        expected: String,
        /// What is there instead, by name.
        found: Vec<String>,
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

    /// A file of which nothing can be told without a declaration.
    #[error(
        "cannot be looked at: only .csv, .tsv, .txt, .mat and .json can be read without a study"
    )]
    NotSurveyed,
    /// A file without content.
    #[error("the file is empty")]
    EmptyFile,
    /// Not a MAT file of any level.
    #[error(
        "not a MAT file: {bytes} bytes, starting with {first_bytes:02x?}, have no header of level 4, 5 or HDF5"
    )]
    NotMat {
        /// Length of the content.
        bytes: u64,
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
    #[error("HDF5 object {object}: {}", excerpt(&source.to_string()))]
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
    /// A file whose parts name the same bytes over and over.
    #[cfg(feature = "hdf5")]
    #[error(
        "the HDF5 file of {file_bytes} bytes makes its reader read more than {limit_bytes} bytes"
    )]
    Hdf5ReadOver {
        /// Length of the file.
        file_bytes: u64,
        /// What may be read of it, the same bytes counted as often as they are.
        limit_bytes: u64,
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
        meant(accepted, present)
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
    /// The file's own sampling rate is no rate.
    #[error("the sample rate {variable} is {found}; expected one positive number")]
    UnusableRate {
        /// Its name in the file.
        variable: String,
        /// What stands there.
        found: String,
    },
    /// A variable that is needed is there, but damaged.
    #[error("the {channel} variable {variable} cannot be read: {source}")]
    DamagedVariable {
        /// What it holds.
        channel: String,
        /// Its name in the file.
        variable: String,
        /// What is wrong with it.
        source: Box<IngestError>,
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
    /// Bytes that no text has.
    #[error("not text: byte {offset} is zero, which no text in UTF-8 or an 8-bit encoding has")]
    NotText {
        /// The first such byte.
        offset: usize,
    },
    /// A line, or what a quote holds together, that is no row of numbers.
    #[error("the row at line {line} is longer than {limit} bytes; a quote may be open")]
    RowTooLong {
        /// 1-based line where it starts; 0 where that is unknown.
        line: u64,
        /// The limit.
        limit: usize,
    },
    /// The text of a CSV file breaks its own quoting, or cannot be read.
    #[error("line {line}: {}", excerpt(&source.to_string()))]
    CsvSyntax {
        /// 1-based line; 0 where it is unknown.
        line: u64,
        /// The reason.
        source: csv::Error,
    },
    /// Text that is no JSON.
    #[error("line {line}, column {column}: no JSON: {}", excerpt(reason))]
    JsonSyntax {
        /// 1-based line.
        line: usize,
        /// 1-based column \[bytes\].
        column: usize,
        /// The reason.
        reason: String,
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
    /// A file that does not start as MCAP files do.
    #[error("not an MCAP file: it starts with {first_bytes:02x?}")]
    NotMcap {
        /// Its start.
        first_bytes: Vec<u8>,
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
