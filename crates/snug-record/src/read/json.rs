use super::decoded::{ARRAY_TOO_LONG, Decoded, LONGEST_ARRAY};
use serde_json::Value;
use std::fmt::Write as _;

/// Gives every number of a JSON message with its path.
pub(super) fn decode(data: &[u8], put: &mut impl FnMut(&str, f64)) -> Decoded {
    let value: Value =
        serde_json::from_slice(data).map_err(|_| "a message is not valid JSON and was left out")?;
    let mut path = String::new();
    visit(&value, &mut path, put)
}

fn visit(value: &Value, path: &mut String, put: &mut impl FnMut(&str, f64)) -> Decoded {
    let length = path.len();
    let mut decoded = Ok(());
    match value {
        Value::Number(number) => {
            if let Some(number) = number.as_f64() {
                put(path, number);
            }
        }
        Value::Bool(flag) => put(path, f64::from(u8::from(*flag))),
        Value::Array(items) if items.len() > LONGEST_ARRAY => decoded = Err(ARRAY_TOO_LONG),
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                write!(path, "[{index}]").expect("a String takes all text");
                decoded = visit(item, path, put).and(decoded);
                path.truncate(length);
            }
        }
        Value::Object(fields) => {
            for (name, field) in fields {
                if length > 0 {
                    path.push('.');
                }
                path.push_str(name);
                decoded = visit(field, path, put).and(decoded);
                path.truncate(length);
            }
        }
        Value::Null | Value::String(_) => {}
    }
    decoded
}
