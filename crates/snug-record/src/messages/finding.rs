//! `/finding` with every field, and `/log` for the viewers' log panel.

use crate::encoding::schema::{Field, Message, count, group, text};
use serde_json::{Value, json};
use snug_campaign::{Finding, Severity};

/// The table of `/finding`.
pub(crate) const FINDING: Message = Message {
    name: "snug.Finding",
    about: "What was left out, repaired or is worth knowing",
    fields: &[
        text("severity", "note, repaired or left_out"),
        text("code", "Kind of the finding"),
        text("file", "Measurement file"),
        count("tightening", "Number within the file"),
        text("channel", "Channel as the file names it"),
        text("message", "What was found, allowed and done"),
    ],
};

const TIMESTAMP: &[Field] = &[
    count("sec", "Whole seconds").in_unit("s"),
    count("nsec", "Nanoseconds within the second").in_unit("ns"),
];

/// The table of `/log`: a well-known schema, which log panels look for by its name.
pub(crate) const LOG: Message = Message {
    name: "foxglove.Log",
    about: "A finding as a log line",
    fields: &[
        group("timestamp", TIMESTAMP, "Time on the recording's axis"),
        count("level", "2 information, 3 warning, 4 error"),
        text("message", "What was found, allowed and done"),
        text("name", "Kind of the finding"),
        text("file", "Measurement file"),
        count("line", "Number of the tightening within the file"),
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
