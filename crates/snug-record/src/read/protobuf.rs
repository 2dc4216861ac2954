//! Protobuf messages by their own descriptor set.

use super::budget::Budget;
use super::decoded::{
    ARRAY_TOO_LONG, Decoded, LONGEST_ARRAY, LONGEST_NAME_BYTES, MOST_DECLARED, WORK_SPENT, work,
};
use crate::encoding::wire::{Fields, Value, take_fixed32, take_fixed64, take_varint};
use std::collections::HashMap;
use std::fmt::Write as _;

/// Nested messages deeper than this are not followed.
const DEEPEST: usize = 64;
const MALFORMED: &str = "a message does not fit its protobuf schema and was left out";

/// Field types of `google.protobuf.FieldDescriptorProto.Type` that carry numbers, and messages.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Double,
    Single,
    /// `int32`, `int64`, `enum`: two's complement.
    Signed,
    /// `uint32`, `uint64`.
    Unsigned,
    /// `sint32`, `sint64`.
    ZigZag,
    Flag,
    Fixed32,
    Fixed64,
    SignedFixed32,
    SignedFixed64,
    Message(usize),
    /// Text, bytes and groups.
    Other,
}

#[derive(Debug)]
struct Field {
    name: String,
    kind: Kind,
    repeated: bool,
    /// Absence means zero (proto3 without `optional`).
    zero_when_absent: bool,
}

#[derive(Debug, Default)]
struct Message {
    fields: Vec<Field>,
    by_number: HashMap<u32, usize>,
}

/// Decodes the messages of one channel by its `FileDescriptorSet`.
#[derive(Debug)]
pub(super) struct Decoder {
    messages: Vec<Message>,
    root: usize,
}

/// A message type before its fields' types are looked up.
struct Declared<'a> {
    proto3: bool,
    fields: Vec<&'a [u8]>,
}

impl Decoder {
    /// `None` when the bytes are no descriptor set, `root` is not in it, or it declares more than any real one.
    pub(super) fn new(descriptor_set: &[u8], root: &str) -> Option<Self> {
        let mut names = HashMap::new();
        let mut declared = Vec::new();
        for field in Fields::of(descriptor_set) {
            if let (1, Value::Bytes(file)) = field? {
                declare_file(file, &mut names, &mut declared)?;
            }
        }
        let root = *names.get(root.trim_start_matches('.'))?;
        let fields: usize = declared.iter().map(|message| message.fields.len()).sum();
        if fields > MOST_DECLARED {
            return None;
        }
        let messages = declared
            .iter()
            .map(|message| link(message, &names))
            .collect::<Option<Vec<_>>>()?;
        Some(Self { messages, root })
    }

    /// Every field of every message on the way costs a step of `budget`, whether it is there or not.
    pub(super) fn decode(
        &self,
        data: &[u8],
        budget: &mut Budget,
        put: &mut impl FnMut(&str, f64),
    ) -> Decoded {
        // The whole message is checked first, so that a malformed one leaves no half of its values behind.
        self.check(self.root, data, 0)?;
        let mut visit = Visit {
            decoder: self,
            path: String::new(),
            budget,
            put,
        };
        visit.message(self.root, data, 0)
    }

    fn check(&self, message: usize, data: &[u8], depth: usize) -> Decoded {
        let message = &self.messages[message];
        for field in Fields::of(data) {
            let (number, value) = field.ok_or(MALFORMED)?;
            let Some(&index) = message.by_number.get(&number) else {
                continue;
            };
            match message.fields[index].kind {
                Kind::Other => {}
                Kind::Message(inner) if depth < DEEPEST => {
                    self.check(inner, value.bytes().ok_or(MALFORMED)?, depth + 1)?;
                }
                Kind::Message(_) => {}
                kind => each_number(kind, value, &mut |_| {})?,
            }
        }
        Ok(())
    }
}

/// One message on its way into numbers.
struct Visit<'a, P> {
    decoder: &'a Decoder,
    path: String,
    budget: &'a mut Budget,
    put: &'a mut P,
}

impl<P: FnMut(&str, f64)> Visit<'_, P> {
    /// Gives every number of a message with its path; the message was checked.
    fn message(&mut self, message: usize, data: &[u8], depth: usize) -> Decoded {
        let message = &self.decoder.messages[message];
        work(self.budget, 1 + message.fields.len())?;
        let occurrences = message.occurrences(data)?;
        let decoded = message.put_singular(&occurrences, &mut self.path, self.put);
        self.repeated_and_nested(message, &occurrences, data, depth)
            .and(decoded)
    }

    /// Elements of arrays, and what stands in nested messages. An array that is too long is passed over.
    fn repeated_and_nested(
        &mut self,
        message: &Message,
        occurrences: &[Occurrences],
        data: &[u8],
        depth: usize,
    ) -> Decoded {
        let length = self.path.len();
        let mut decoded = Ok(());
        let mut position = vec![0usize; message.fields.len()];
        for (number, value) in Fields::of(data).flatten() {
            let Some(&index) = message.by_number.get(&number) else {
                continue;
            };
            let field = &message.fields[index];
            if field.repeated && occurrences[index].count > LONGEST_ARRAY {
                continue;
            }
            join(&mut self.path, &field.name);
            let stem = self.path.len();
            let mut element = |path: &mut String| {
                write!(path, "[{}]", position[index]).expect("a String takes all text");
                position[index] += 1;
            };
            match field.kind {
                Kind::Message(inner) if depth < DEEPEST => {
                    if field.repeated {
                        element(&mut self.path);
                    }
                    let bytes = value.bytes().unwrap_or_default();
                    let inner = self.message(inner, bytes, depth + 1);
                    if inner == Err(WORK_SPENT) {
                        return inner;
                    }
                    decoded = inner.and(decoded);
                }
                Kind::Message(_) | Kind::Other => {}
                kind if field.repeated => each_number(kind, value, &mut |number| {
                    element(&mut self.path);
                    (self.put)(&self.path, number);
                    self.path.truncate(stem);
                })?,
                _ => {}
            }
            self.path.truncate(length);
        }
        decoded
    }
}

/// How often a field stands in a message, and its last number.
#[derive(Debug, Clone, Copy, Default)]
struct Occurrences {
    count: usize,
    last: Option<f64>,
}

impl Message {
    /// Counts every field of an encoded message.
    fn occurrences(&self, data: &[u8]) -> Result<Vec<Occurrences>, &'static str> {
        let mut occurrences = vec![Occurrences::default(); self.fields.len()];
        for (number, value) in Fields::of(data).flatten() {
            let Some(&index) = self.by_number.get(&number) else {
                continue;
            };
            let field = &mut occurrences[index];
            match self.fields[index].kind {
                Kind::Message(_) => field.count += 1,
                Kind::Other => {}
                kind => each_number(kind, value, &mut |number| {
                    field.count += 1;
                    field.last = Some(number);
                })?,
            }
        }
        Ok(occurrences)
    }

    /// Numbers that stand once; an array that is too long is told.
    fn put_singular(
        &self,
        occurrences: &[Occurrences],
        path: &mut String,
        put: &mut impl FnMut(&str, f64),
    ) -> Decoded {
        let length = path.len();
        let mut decoded = Ok(());
        for (field, found) in self.fields.iter().zip(occurrences) {
            join(path, &field.name);
            if field.repeated && found.count > LONGEST_ARRAY {
                decoded = Err(ARRAY_TOO_LONG);
            } else if !field.repeated && !matches!(field.kind, Kind::Message(_) | Kind::Other) {
                // Of a singular field that stands twice the last value counts, as protobuf asks.
                let value = found.last.or(field.zero_when_absent.then_some(0.0));
                if let Some(value) = value {
                    put(path, value);
                }
            }
            path.truncate(length);
        }
        decoded
    }
}

fn join(path: &mut String, name: &str) {
    if !path.is_empty() {
        path.push('.');
    }
    path.push_str(name);
}

/// The numbers of one wire value: one, or those of a packed array.
fn each_number(kind: Kind, value: Value<'_>, put: &mut impl FnMut(f64)) -> Decoded {
    let number = match (kind, value) {
        (Kind::Double, Value::Fixed64(bits)) => f64::from_bits(bits),
        (Kind::Fixed64, Value::Fixed64(bits)) => bits as f64,
        (Kind::SignedFixed64, Value::Fixed64(bits)) => bits as i64 as f64,
        (Kind::Single, Value::Fixed32(bits)) => f64::from(f32::from_bits(bits)),
        (Kind::Fixed32, Value::Fixed32(bits)) => f64::from(bits),
        (Kind::SignedFixed32, Value::Fixed32(bits)) => f64::from(bits as i32),
        (Kind::Signed, Value::Varint(bits)) => bits as i64 as f64,
        (Kind::Unsigned, Value::Varint(bits)) => bits as f64,
        (Kind::ZigZag, Value::Varint(bits)) => ((bits >> 1) as i64 ^ -((bits & 1) as i64)) as f64,
        (Kind::Flag, Value::Varint(bits)) => f64::from(u8::from(bits != 0)),
        (_, Value::Bytes(mut packed)) => {
            while !packed.is_empty() {
                let value = match kind {
                    Kind::Double | Kind::Fixed64 | Kind::SignedFixed64 => {
                        take_fixed64(&mut packed).map(Value::Fixed64)
                    }
                    Kind::Single | Kind::Fixed32 | Kind::SignedFixed32 => {
                        take_fixed32(&mut packed).map(Value::Fixed32)
                    }
                    _ => take_varint(&mut packed).map(Value::Varint),
                };
                each_number(kind, value.ok_or(MALFORMED)?, put)?;
            }
            return Ok(());
        }
        _ => return Err(MALFORMED),
    };
    put(number);
    Ok(())
}

/// Collects the message types of one `FileDescriptorProto`.
fn declare_file<'a>(
    file: &'a [u8],
    names: &mut HashMap<String, usize>,
    declared: &mut Vec<Declared<'a>>,
) -> Option<()> {
    let mut package = "";
    // Editions without a stated presence feature track presence, as proto2 does.
    let mut proto3 = false;
    for field in Fields::of(file) {
        match field? {
            (2, value) => package = value.text()?,
            (12, value) => proto3 = value.text()? == "proto3",
            _ => {}
        }
    }
    for field in Fields::of(file) {
        if let (4, Value::Bytes(message)) = field? {
            declare_message(message, package, proto3, names, declared, 0)?;
        }
    }
    Some(())
}

fn declare_message<'a>(
    message: &'a [u8],
    scope: &str,
    proto3: bool,
    names: &mut HashMap<String, usize>,
    declared: &mut Vec<Declared<'a>>,
    depth: usize,
) -> Option<()> {
    if depth > DEEPEST {
        return None;
    }
    let mut name = "";
    let mut fields = Vec::new();
    let mut nested = Vec::new();
    for field in Fields::of(message) {
        match field? {
            (1, value) => name = value.text()?,
            (2, value) => fields.push(value.bytes()?),
            (3, value) => nested.push(value.bytes()?),
            _ => {}
        }
    }
    let full = if scope.is_empty() {
        name.to_owned()
    } else {
        format!("{scope}.{name}")
    };
    if full.len() > LONGEST_NAME_BYTES || declared.len() >= MOST_DECLARED {
        return None;
    }
    names.insert(full.clone(), declared.len());
    declared.push(Declared { proto3, fields });
    for inner in nested {
        declare_message(inner, &full, proto3, names, declared, depth + 1)?;
    }
    Some(())
}

/// Resolves one message type's `FieldDescriptorProto`s.
fn link(declared: &Declared<'_>, names: &HashMap<String, usize>) -> Option<Message> {
    let mut message = Message::default();
    for bytes in &declared.fields {
        let (mut name, mut type_name) = ("", "");
        let (mut number, mut label, mut kind) = (0, 0, 0);
        let mut in_choice = false;
        for field in Fields::of(bytes) {
            match field? {
                (1, value) => name = value.text()?,
                (3, value) => number = u32::try_from(value.varint()?).ok()?,
                (4, value) => label = value.varint()?,
                (5, value) => kind = value.varint()?,
                (6, value) => type_name = value.text()?,
                // A oneof's member has presence; proto3's `optional` is a oneof of one.
                (9, _) => in_choice = true,
                _ => {}
            }
        }
        if name.len() > LONGEST_NAME_BYTES {
            return None;
        }
        let repeated = label == 3;
        message.by_number.insert(number, message.fields.len());
        message.fields.push(Field {
            name: name.to_owned(),
            kind: kind_of(kind, type_name, names),
            repeated,
            zero_when_absent: declared.proto3 && !repeated && !in_choice,
        });
    }
    Some(message)
}

fn kind_of(number: u64, type_name: &str, names: &HashMap<String, usize>) -> Kind {
    match number {
        1 => Kind::Double,
        2 => Kind::Single,
        3 | 5 | 14 => Kind::Signed,
        4 | 13 => Kind::Unsigned,
        6 => Kind::Fixed64,
        7 => Kind::Fixed32,
        8 => Kind::Flag,
        11 => names
            .get(type_name.trim_start_matches('.'))
            .map_or(Kind::Other, |&message| Kind::Message(message)),
        15 => Kind::SignedFixed32,
        16 => Kind::SignedFixed64,
        17 | 18 => Kind::ZigZag,
        _ => Kind::Other,
    }
}
