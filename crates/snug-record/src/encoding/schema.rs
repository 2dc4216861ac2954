//! One table per message: from it come the JSON Schema, the protobuf descriptor and the field numbers.

use crate::encoding::wire::{put_bytes, put_unsigned};
use serde_json::{Map, Value, json};
use snug_campaign::words::capitalised;

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
    Group(&'static [Field]),
}

/// One field of a message.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Field {
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    /// Any number of them.
    pub(crate) listed: bool,
    /// Unit as people write it; empty for pure numbers and text.
    pub(crate) unit: &'static str,
    /// What it is, in a few words.
    pub(crate) about: &'static str,
}

impl Field {
    const fn new(name: &'static str, kind: Kind, about: &'static str) -> Self {
        Self {
            name,
            kind,
            listed: false,
            unit: "",
            about,
        }
    }

    pub(crate) const fn in_unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }
}

/// A list of what the field holds.
pub(crate) const fn list(field: Field) -> Field {
    Field {
        listed: true,
        ..field
    }
}

/// A 64-bit number in its unit.
pub(crate) const fn number(name: &'static str, unit: &'static str, about: &'static str) -> Field {
    Field::new(name, Kind::Double, about).in_unit(unit)
}

/// A 64-bit number without a unit.
pub(crate) const fn pure_number(name: &'static str, about: &'static str) -> Field {
    Field::new(name, Kind::Double, about)
}

/// A 32-bit number in its unit.
pub(crate) const fn single(name: &'static str, unit: &'static str, about: &'static str) -> Field {
    Field::new(name, Kind::Single, about).in_unit(unit)
}

/// A whole number from 0.
pub(crate) const fn count(name: &'static str, about: &'static str) -> Field {
    Field::new(name, Kind::Count, about)
}

/// True or false.
pub(crate) const fn flag(name: &'static str, about: &'static str) -> Field {
    Field::new(name, Kind::Flag, about)
}

/// Text.
pub(crate) const fn text(name: &'static str, about: &'static str) -> Field {
    Field::new(name, Kind::Text, about)
}

/// Named fields.
pub(crate) const fn group(
    name: &'static str,
    fields: &'static [Field],
    about: &'static str,
) -> Field {
    Field::new(name, Kind::Group(fields), about)
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
            let mut property = value(field);
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
fn value(field: &Field) -> Map<String, Value> {
    let plain = |name: &str| Map::from_iter([("type".to_owned(), json!(name))]);
    let one = match field.kind {
        Kind::Double | Kind::Single => plain("number"),
        Kind::Count => plain("integer"),
        Kind::Flag => plain("boolean"),
        Kind::Text => plain("string"),
        Kind::Group(fields) => object(fields),
    };
    if !field.listed {
        return one;
    }
    let mut list = plain("array");
    list.insert("items".into(), Value::Object(one));
    list
}

/// A `DescriptorProto`; groups become nested types named after their field.
fn descriptor(name: &str, fields: &[Field], scope: &str) -> Vec<u8> {
    const OPTIONAL: u64 = 1;
    const REPEATED: u64 = 3;
    let mut message = Vec::new();
    put_bytes(&mut message, 1, name.as_bytes());
    for (number, field) in (1..).zip(fields) {
        let label = if field.listed { REPEATED } else { OPTIONAL };
        let mut bytes = Vec::new();
        put_bytes(&mut bytes, 1, field.name.as_bytes());
        put_unsigned(&mut bytes, 3, number);
        put_unsigned(&mut bytes, 4, label);
        let type_number = match field.kind {
            Kind::Double => 1,
            Kind::Single => 2,
            Kind::Count => 4,
            Kind::Flag => 8,
            Kind::Text => 9,
            Kind::Group(_) => 11,
        };
        put_unsigned(&mut bytes, 5, type_number);
        if let Kind::Group(inner) = field.kind {
            let type_name = capitalised(field.name);
            let full = format!("{scope}.{type_name}");
            put_bytes(&mut bytes, 6, full.as_bytes());
            put_bytes(&mut message, 3, &descriptor(&type_name, inner, &full));
        }
        put_bytes(&mut message, 2, &bytes);
    }
    message
}
