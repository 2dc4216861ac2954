//! `/finding` with every field, and `/log` for the viewers' log panel.

use crate::schema::{Field, Kind, Message, field};
use serde_json::{Value, json};
use snug_campaign::{Finding, Severity};

/// The table of `/finding`.
pub(crate) const FINDING: Message = Message {
    name: "snug.Finding",
    about: "What was left out, repaired or is worth knowing",
    fields: &[
        field("severity", Kind::Text, "", "note, repaired or left_out"),
        field("code", Kind::Text, "", "Kind of the finding"),
        field("file", Kind::Text, "", "Measurement file"),
        field("tightening", Kind::Count, "", "Number within the file"),
        field("channel", Kind::Text, "", "Channel as the file names it"),
        field(
            "message",
            Kind::Text,
            "",
            "What was found, allowed and done",
        ),
    ],
};

const TIMESTAMP: &[Field] = &[
    field("sec", Kind::Count, "s", "Whole seconds"),
    field("nsec", Kind::Count, "ns", "Nanoseconds within the second"),
];

/// The table of `/log`: a well-known schema, which log panels look for by its name.
pub(crate) const LOG: Message = Message {
    name: "foxglove.Log",
    about: "A finding as a log line",
    fields: &[
        field(
            "timestamp",
            Kind::Object(TIMESTAMP),
            "",
            "Time on the recording's axis",
        ),
        field(
            "level",
            Kind::Count,
            "",
            "2 information, 3 warning, 4 error",
        ),
        field(
            "message",
            Kind::Text,
            "",
            "What was found, allowed and done",
        ),
        field("name", Kind::Text, "", "Kind of the finding"),
        field("file", Kind::Text, "", "Measurement file"),
        field(
            "line",
            Kind::Count,
            "",
            "Number of the tightening within the file",
        ),
    ],
};

/// The finding as a log line.
pub(crate) fn log_line(finding: &Finding, log_time_ns: u64) -> Value {
    let level = match finding.severity {
        Severity::Note => 2,
        Severity::Repaired => 3,
        Severity::LeftOut => 4,
    };
    json!({
        "timestamp": {"sec": log_time_ns / 1_000_000_000, "nsec": log_time_ns % 1_000_000_000},
        "level": level,
        "message": finding.message,
        "name": finding.code,
        "file": finding.file,
        "line": finding.tightening.unwrap_or(0),
    })
}
