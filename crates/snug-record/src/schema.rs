//! One table per message: from it come the JSON Schema, the protobuf descriptor and the field numbers.

use crate::wire::{put_bytes, put_unsigned};
use serde_json::{Map, Value, json};

/// What a field holds.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Kind {
    /// 64-bit floating point.
    Double,
    /// 32-bit floating point in protobuf: for what is looked at, not computed with.
    Single,
    /// A whole number from 0.
    Count,
    /// True or false.
    Flag,
    /// Text.
    Text,
    /// Named fields.
    Object(&'static [Field]),
    /// Any number of the same.
    List(&'static Kind),
}

/// One field of a message.
#[derive(Debug)]
pub(crate) struct Field {
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    /// Unit as people write it; empty for pure numbers and text.
    pub(crate) unit: &'static str,
    /// What it is, in a few words.
    pub(crate) about: &'static str,
}

pub(crate) const fn field(
    name: &'static str,
    kind: Kind,
    unit: &'static str,
    about: &'static str,
) -> Field {
    Field {
        name,
        kind,
        unit,
        about,
    }
}

/// One message type.
#[derive(Debug)]
pub(crate) struct Message {
    /// Full name, `snug.` and the type.
    pub(crate) name: &'static str,
    pub(crate) about: &'static str,
    /// Fields; protobuf numbers them from 1 in this order, so the list only ever grows at its end.
    pub(crate) fields: &'static [Field],
}

impl Message {
    /// JSON Schema: an object whose every property has title, description, type and (where it has one) unit.
    pub(crate) fn json_schema(&self) -> Vec<u8> {
        let mut schema = object(self.fields);
        schema.insert("title".into(), self.name.into());
        schema.insert("description".into(), self.about.into());
        Value::Object(schema).to_string().into_bytes()
    }

    /// A serialized `google.protobuf.FileDescriptorSet` with this message and the groups nested in it.
    pub(crate) fn descriptor_set(&self) -> Vec<u8> {
        let (package, name) = self.name.split_once('.').expect("names are snug.Type");
        let mut file = Vec::new();
        put_bytes(&mut file, 1, format!("{}.proto", self.name).as_bytes());
        put_bytes(&mut file, 2, package.as_bytes());
        put_bytes(
            &mut file,
            4,
            &descriptor(name, self.fields, &format!(".{}", self.name)),
        );
        put_bytes(&mut file, 12, b"proto3");
        let mut set = Vec::new();
        put_bytes(&mut set, 1, &file);
        set
    }
}

fn object(fields: &[Field]) -> Map<String, Value> {
    let properties: Map<String, Value> = fields
        .iter()
        .map(|field| {
            let mut property = value(field.kind);
            property.insert("title".into(), field.about.into());
            let description = if field.unit.is_empty() {
                field.about.to_owned()
            } else {
                property.insert("unit".into(), field.unit.into());
                format!("{} [{}]", field.about, field.unit)
            };
            property.insert("description".into(), description.into());
            (field.name.to_owned(), Value::Object(property))
        })
        .collect();
    let mut schema = Map::new();
    schema.insert("type".into(), "object".into());
    schema.insert("properties".into(), Value::Object(properties));
    schema
}

/// The type keywords. Viewers want exactly one type per property, so what may be missing is left out of the message
/// instead of being null.
fn value(kind: Kind) -> Map<String, Value> {
    let plain = |name: &str| Map::from_iter([("type".to_owned(), json!(name))]);
    match kind {
        Kind::Double | Kind::Single => plain("number"),
        Kind::Count => plain("integer"),
        Kind::Flag => plain("boolean"),
        Kind::Text => plain("string"),
        Kind::Object(fields) => object(fields),
        Kind::List(items) => {
            let mut list = plain("array");
            list.insert("items".into(), Value::Object(value(*items)));
            list
        }
    }
}

/// A `DescriptorProto`; groups become nested types named after their field.
fn descriptor(name: &str, fields: &[Field], scope: &str) -> Vec<u8> {
    const OPTIONAL: u64 = 1;
    const REPEATED: u64 = 3;
    let mut message = Vec::new();
    put_bytes(&mut message, 1, name.as_bytes());
    for (number, field) in (1..).zip(fields) {
        let (label, kind) = match field.kind {
            Kind::List(items) => (REPEATED, *items),
            kind => (OPTIONAL, kind),
        };
        let mut bytes = Vec::new();
        put_bytes(&mut bytes, 1, field.name.as_bytes());
        put_unsigned(&mut bytes, 3, number);
        put_unsigned(&mut bytes, 4, label);
        let (type_number, nested) = match kind {
            Kind::Double => (1, None),
            Kind::Single => (2, None),
            Kind::Count => (4, None),
            Kind::Flag => (8, None),
            Kind::Text => (9, None),
            Kind::Object(inner) => (11, Some(inner)),
            Kind::List(_) => unreachable!("no message has a list of lists"),
        };
        put_unsigned(&mut bytes, 5, type_number);
        if let Some(inner) = nested {
            let type_name = capitalised(field.name);
            let full = format!("{scope}.{type_name}");
            put_bytes(&mut bytes, 6, full.as_bytes());
            put_bytes(&mut message, 3, &descriptor(&type_name, inner, &full));
        }
        put_bytes(&mut message, 2, &bytes);
    }
    message
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters
        .next()
        .map(|first| first.to_ascii_uppercase().to_string() + letters.as_str())
        .unwrap_or_default()
}
