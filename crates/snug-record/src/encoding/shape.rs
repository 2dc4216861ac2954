//! JSON values made fit for viewers, and the schema of values that come without one.
//!
//! Viewers read JSON Schema with exactly one type per property, lists of one kind of item, and no nulls. So nulls (and
//! numbers that are not finite, which JSON cannot hold) are left out, and lists of mixed kinds become objects.

use serde_json::{Map, Value, json};
use snug_campaign::words::capitalised;
use std::collections::BTreeMap;
use std::mem::discriminant;

/// Leaves out nulls and turns mixed or nested lists into objects with the keys `item_0`, `item_1`, …
pub(crate) fn tidy(value: Value) -> Value {
    match value {
        Value::Object(fields) => Value::Object(
            fields
                .into_iter()
                .filter(|(_, field)| !field.is_null())
                .map(|(name, field)| (name, tidy(field)))
                .collect(),
        ),
        Value::Array(items) => {
            let items: Vec<Value> = items.into_iter().map(tidy).collect();
            let uniform = items
                .windows(2)
                .all(|pair| discriminant(&pair[0]) == discriminant(&pair[1]));
            if uniform && !items.iter().any(|item| item.is_array() || item.is_null()) {
                return Value::Array(items);
            }
            let fields = items
                .into_iter()
                .enumerate()
                .filter(|(_, item)| !item.is_null());
            Value::Object(
                fields
                    .map(|(index, item)| (format!("item_{index}"), item))
                    .collect(),
            )
        }
        value => value,
    }
}

/// The kind of a tidy value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Shape {
    Flag,
    Number,
    Text,
    Object(BTreeMap<String, Shape>),
    /// `None` while no item has been seen.
    List(Option<Box<Shape>>),
}

impl Shape {
    /// `None` for null.
    pub(crate) fn of(value: &Value) -> Option<Self> {
        Some(match value {
            Value::Null => return None,
            Value::Bool(_) => Self::Flag,
            Value::Number(_) => Self::Number,
            Value::String(_) => Self::Text,
            Value::Array(items) => Self::List(
                items
                    .iter()
                    .filter_map(Self::of)
                    .reduce(Self::merge)
                    .map(Box::new),
            ),
            Value::Object(fields) => Self::Object(
                fields
                    .iter()
                    .filter_map(|(name, field)| Some((name.clone(), Self::of(field)?)))
                    .collect(),
            ),
        })
    }

    /// What covers both; of two different kinds the later.
    pub(crate) fn merge(self, later: Self) -> Self {
        match (self, later) {
            (Self::Object(mut fields), Self::Object(later)) => {
                for (name, shape) in later {
                    let merged = match fields.remove(&name) {
                        Some(earlier) => earlier.merge(shape),
                        None => shape,
                    };
                    fields.insert(name, merged);
                }
                Self::Object(fields)
            }
            (Self::List(Some(items)), Self::List(Some(later))) => {
                Self::List(Some(Box::new(items.merge(*later))))
            }
            (Self::List(items), Self::List(None)) => Self::List(items),
            (_, later) => later,
        }
    }

    /// JSON Schema of this shape.
    pub(crate) fn schema(&self) -> Value {
        match self {
            Self::Flag => json!({"type": "boolean"}),
            Self::Number => json!({"type": "number"}),
            Self::Text => json!({"type": "string"}),
            Self::List(items) => {
                let items = items
                    .as_ref()
                    .map_or_else(|| json!({"type": "object"}), |items| items.schema());
                json!({"type": "array", "items": items})
            }
            Self::Object(fields) => {
                let properties: Map<String, Value> = fields
                    .iter()
                    .map(|(name, shape)| {
                        let mut property = shape.schema();
                        property["title"] = capitalised(&name.replace('_', " ")).into();
                        property["description"] = name.as_str().into();
                        (name.clone(), property)
                    })
                    .collect();
                json!({"type": "object", "properties": properties})
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nulls_go_and_mixed_lists_become_objects() {
        let tidied = tidy(
            json!({"a": null, "b": ["m", "k", 0.9], "c": [1, null], "d": [[1], [2]], "e": []}),
        );
        assert_eq!(
            tidied,
            json!({
                "b": {"item_0": "m", "item_1": "k", "item_2": 0.9},
                "c": {"item_0": 1},
                "d": {"item_0": [1], "item_1": [2]},
                "e": [],
            })
        );
    }

    #[test]
    fn a_list_of_objects_has_the_fields_of_all_its_items() {
        let shape = Shape::of(&json!([{"a": 1}, {"b": "x", "c": []}, {"c": [true]}]))
            .expect("a list has a shape");
        let schema = shape.schema();
        let properties = &schema["items"]["properties"];
        assert_eq!(properties["a"]["type"], "number");
        assert_eq!(properties["b"]["type"], "string");
        assert_eq!(properties["c"]["items"]["type"], "boolean");
    }
}
