//! ROS 1 and ROS 2 messages by their concatenated `.msg` definitions.

use super::budget::Budget;
use super::decoded::{
    ARRAY_TOO_LONG, Decoded, LONGEST_ARRAY, LONGEST_NAME_BYTES, MOST_DECLARED, WORK_SPENT, work,
};
use crate::encoding::wire::take;
use std::collections::HashMap;
use std::fmt::Write as _;

/// Nested messages deeper than this are malformed: ROS messages cannot contain themselves.
const DEEPEST: usize = 32;
const MALFORMED: &str = "a message does not fit its ROS definition and was left out";

/// How values are laid out in memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Wire {
    /// ROS 2: common data representation, values aligned to their size after a header of four bytes.
    Cdr,
    /// ROS 1: packed, little-endian.
    Ros1,
}

/// Takes one number off the message.
type Read = fn(&mut Cursor<'_, '_>) -> Result<f64, &'static str>;

#[derive(Debug, Clone, Copy)]
enum Kind {
    Number(Read),
    Text,
    Message(usize),
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Count {
    One,
    Fixed(usize),
    Sequence,
}

#[derive(Debug)]
struct Field {
    name: String,
    kind: Kind,
    count: Count,
}

/// Decodes the messages of one channel by its concatenated `.msg` definitions.
#[derive(Debug)]
pub(super) struct Decoder {
    messages: Vec<Vec<Field>>,
    wire: Wire,
}

impl Decoder {
    /// `None` when the definition uses a type that is neither built in nor defined in it, or declares more than any real
    /// one.
    pub(super) fn new(definition: &[u8], root: &str, wire: Wire) -> Option<Self> {
        let text = std::str::from_utf8(definition).ok()?;
        let mut sections: Vec<(String, Vec<&str>)> = vec![(short(root), Vec::new())];
        for line in text.lines() {
            let line = line.trim();
            if line.len() >= 3 && line.bytes().all(|byte| byte == b'=') {
                sections.push((String::new(), Vec::new()));
            } else if let Some(name) = line.strip_prefix("MSG:") {
                sections.last_mut()?.0 = short(name.trim());
            } else {
                sections.last_mut()?.1.push(line);
            }
        }
        let longest = sections.iter().map(|(name, _)| name.len()).max();
        if longest > Some(LONGEST_NAME_BYTES) || sections.len() > MOST_DECLARED {
            return None;
        }
        let names: HashMap<String, usize> = sections
            .iter()
            .enumerate()
            .map(|(index, (name, _))| (name.clone(), index))
            .collect();
        let mut messages = Vec::new();
        let mut declared = 0;
        for (name, lines) in &sections {
            let package = name.rsplit_once('/').map_or("", |(package, _)| package);
            let mut fields = Vec::new();
            for line in lines {
                fields.extend(field(line, package, &names, wire)?);
            }
            declared += fields.len();
            if declared > MOST_DECLARED {
                return None;
            }
            messages.push(fields);
        }
        Some(Self { messages, wire })
    }

    /// Every field of every message on the way costs a step of `budget`.
    pub(super) fn decode(
        &self,
        data: &[u8],
        budget: &mut Budget,
        put: &mut dyn FnMut(&str, f64),
    ) -> Decoded {
        // Once without giving anything, so that a malformed message leaves no half of its values behind.
        let dry = self.read(data, budget, &mut |_, _| {});
        if dry == Err(MALFORMED) || dry == Err(WORK_SPENT) {
            return dry;
        }
        self.read(data, budget, put)
    }

    fn read(&self, data: &[u8], budget: &mut Budget, put: &mut dyn FnMut(&str, f64)) -> Decoded {
        let (data, big_endian) = match self.wire {
            Wire::Ros1 => (data, false),
            Wire::Cdr => {
                let (header, data) = data.split_first_chunk::<4>().ok_or(MALFORMED)?;
                if header[0] != 0 || header[1] > 1 {
                    return Err("the CDR encapsulation is not plain CDR; the message was left out");
                }
                (data, header[1] == 0)
            }
        };
        let mut cursor = Cursor {
            data,
            budget,
            position: 0,
            aligned: self.wire == Wire::Cdr,
            big_endian,
            long: false,
            steps: 0,
        };
        self.message(0, &mut cursor, &mut String::new(), put, 0)?;
        if cursor.long {
            return Err(ARRAY_TOO_LONG);
        }
        Ok(())
    }

    fn message(
        &self,
        message: usize,
        cursor: &mut Cursor<'_, '_>,
        path: &mut String,
        put: &mut dyn FnMut(&str, f64),
        depth: usize,
    ) -> Decoded {
        let fields = &self.messages[message];
        work(cursor.budget, 1 + fields.len())?;
        cursor.steps += 1;
        if depth > DEEPEST || cursor.steps > DEEPEST * (cursor.data.len() + DEEPEST) {
            return Err(MALFORMED);
        }
        if fields.is_empty() && self.wire == Wire::Cdr {
            // ROS 2 gives an empty structure one filling byte.
            cursor.word::<1>()?;
        }
        let length = path.len();
        for field in fields {
            if length > 0 {
                path.push('.');
            }
            path.push_str(&field.name);
            let count = match field.count {
                Count::One => {
                    self.value(field.kind, cursor, path, put, depth)?;
                    path.truncate(length);
                    continue;
                }
                Count::Fixed(count) => count,
                Count::Sequence => u32::from_ne_bytes(cursor.word()?) as usize,
            };
            // An element takes at least one byte, except messages without any field in ROS 1.
            if count > cursor.data.len().saturating_sub(cursor.position) {
                return Err(MALFORMED);
            }
            let stem = path.len();
            cursor.long |= count > LONGEST_ARRAY && !matches!(field.kind, Kind::Text);
            for index in 0..count {
                if count > LONGEST_ARRAY {
                    self.value(field.kind, cursor, path, &mut |_: &str, _| {}, depth)?;
                } else {
                    write!(path, "[{index}]").expect("a String takes all text");
                    self.value(field.kind, cursor, path, put, depth)?;
                    path.truncate(stem);
                }
            }
            path.truncate(length);
        }
        Ok(())
    }

    fn value(
        &self,
        kind: Kind,
        cursor: &mut Cursor<'_, '_>,
        path: &mut String,
        put: &mut dyn FnMut(&str, f64),
        depth: usize,
    ) -> Decoded {
        match kind {
            Kind::Number(read) => {
                put(path, read(cursor)?);
                Ok(())
            }
            Kind::Text => {
                let length = u32::from_ne_bytes(cursor.word()?) as usize;
                cursor.skip(length)
            }
            Kind::Message(message) => self.message(message, cursor, path, put, depth + 1),
        }
    }
}

struct Cursor<'a, 'b> {
    data: &'a [u8],
    budget: &'b mut Budget,
    position: usize,
    aligned: bool,
    big_endian: bool,
    /// An array was too long to spread out.
    long: bool,
    /// Messages entered, against definitions that contain themselves.
    steps: usize,
}

impl Cursor<'_, '_> {
    /// The next value of `N` bytes in this machine's byte order.
    fn word<const N: usize>(&mut self) -> Result<[u8; N], &'static str> {
        if self.aligned {
            self.position = self.position.next_multiple_of(N);
        }
        let mut rest = self.data.get(self.position..).ok_or(MALFORMED)?;
        let bytes = take(&mut rest, N).ok_or(MALFORMED)?;
        let mut word: [u8; N] = bytes.try_into().expect("take gave N bytes");
        self.position += N;
        if self.big_endian != cfg!(target_endian = "big") {
            word.reverse();
        }
        Ok(word)
    }

    fn skip(&mut self, length: usize) -> Decoded {
        self.position = self
            .position
            .checked_add(length)
            .filter(|&end| end <= self.data.len())
            .ok_or(MALFORMED)?;
        Ok(())
    }
}

/// `package/Type` of `package/msg/Type`.
fn short(name: &str) -> String {
    name.replace("/msg/", "/")
}

/// One line of a definition: `Some(None)` for blank lines, comments and constants, `None` for an unknown
/// type.
fn field(
    line: &str,
    package: &str,
    names: &HashMap<String, usize>,
    wire: Wire,
) -> Option<Option<Field>> {
    let line = line.split('#').next().unwrap_or_default().trim();
    let Some((kind, rest)) = line.split_once(char::is_whitespace) else {
        return Some(None);
    };
    let rest = rest.trim_start();
    let end = rest
        .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .unwrap_or(rest.len());
    let (name, tail) = rest.split_at(end);
    if tail.trim_start().starts_with('=') {
        return Some(None);
    }
    let (element, count) = match kind.split_once('[') {
        None => (kind, Count::One),
        Some((element, bound)) => {
            let bound = bound.trim_end_matches(']');
            let count = bound.parse().map_or(Count::Sequence, Count::Fixed);
            (element, count)
        }
    };
    if name.len() > LONGEST_NAME_BYTES {
        return None;
    }
    let element = element.split("<=").next().unwrap_or_default();
    let kind = match number(element, wire) {
        Some(read) => Kind::Number(read),
        None if element == "string" => Kind::Text,
        None => Kind::Message(resolve(element, package, names)?),
    };
    Some(Some(Field {
        name: name.to_owned(),
        kind,
        count,
    }))
}

/// How a built-in type is read; `None` for any other.
fn number(name: &str, wire: Wire) -> Option<Read> {
    Some(match name {
        "bool" => |cursor| Ok(f64::from(u8::from(cursor.word::<1>()? != [0]))),
        // ROS 1's deprecated `char` is unsigned, and ROS 2 kept that.
        "uint8" | "byte" | "char" => |cursor| Ok(u8::from_ne_bytes(cursor.word()?).into()),
        "int8" => |cursor| Ok(i8::from_ne_bytes(cursor.word()?).into()),
        "uint16" => |cursor| Ok(u16::from_ne_bytes(cursor.word()?).into()),
        "int16" => |cursor| Ok(i16::from_ne_bytes(cursor.word()?).into()),
        "uint32" => |cursor| Ok(u32::from_ne_bytes(cursor.word()?).into()),
        "int32" => |cursor| Ok(i32::from_ne_bytes(cursor.word()?).into()),
        "uint64" => |cursor| Ok(u64::from_ne_bytes(cursor.word()?) as f64),
        "int64" => |cursor| Ok(i64::from_ne_bytes(cursor.word()?) as f64),
        "float32" => |cursor| Ok(f32::from_ne_bytes(cursor.word()?).into()),
        "float64" => |cursor| Ok(f64::from_ne_bytes(cursor.word()?)),
        // Seconds and nanoseconds.
        "time" if wire == Wire::Ros1 => |cursor| {
            let seconds = f64::from(u32::from_ne_bytes(cursor.word()?));
            Ok(seconds + f64::from(u32::from_ne_bytes(cursor.word()?)) * 1e-9)
        },
        "duration" if wire == Wire::Ros1 => |cursor| {
            let seconds = f64::from(i32::from_ne_bytes(cursor.word()?));
            Ok(seconds + f64::from(i32::from_ne_bytes(cursor.word()?)) * 1e-9)
        },
        _ => return None,
    })
}

fn resolve(name: &str, package: &str, names: &HashMap<String, usize>) -> Option<usize> {
    let name = short(name);
    names
        .get(&name)
        .or_else(|| names.get(&format!("{package}/{name}")))
        .or_else(|| names.get(&format!("std_msgs/{name}")))
        .copied()
}
