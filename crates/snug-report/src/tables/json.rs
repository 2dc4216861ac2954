//! How the report's JSON files are written, and the names that they give to kinds.

use serde::Serialize;
use serde_json::Value;

/// A file's whole text, indented.
pub fn text(file: &impl Serialize) -> String {
    let text = serde_json::to_string_pretty(file).expect("plain structs with text keys serialise");
    text + "\n"
}

/// Stable snake-case name of a status, severity or source, as in files.
pub fn name(kind: impl Serialize) -> String {
    match serde_json::to_value(kind) {
        Ok(Value::String(name)) => name,
        _ => String::new(),
    }
}
