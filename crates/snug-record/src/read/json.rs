//! Numbers of JSON messages, read without building a tree: `[[],[]]` would take thirty times its length.

use super::decoded::{ARRAY_TOO_LONG, Decoded, LONGEST_ARRAY};
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::fmt::{Formatter, Write as _};

/// Gives every number of a JSON message with its path.
pub(super) fn decode(data: &[u8], put: &mut impl FnMut(&str, f64)) -> Decoded {
    // Once without giving anything, so that a malformed message leaves no half of its values behind, and so that the
    // length of every array is known when it begins.
    let mut survey = Walk::new(&[], |_: &str, _| {});
    survey.muted = 1;
    survey.message(data)?;
    let mut long = survey.found_long;
    long.sort_unstable();
    if !long.is_empty() {
        Walk::new(&long, put).message(data)?;
        return Err(ARRAY_TOO_LONG);
    }
    Walk::new(&[], put).message(data)
}

struct Walk<'a, P> {
    path: String,
    put: P,
    /// Arrays that were begun, in the order of their beginnings.
    arrays: usize,
    /// Places in that order of the arrays that are too long, ascending.
    long: &'a [usize],
    found_long: Vec<usize>,
    /// Within how many arrays that are too long, and one more in the survey; no number is given then.
    muted: usize,
}

impl<'a, P: FnMut(&str, f64)> Walk<'a, P> {
    fn new(long: &'a [usize], put: P) -> Self {
        Self {
            path: String::new(),
            put,
            arrays: 0,
            long,
            found_long: Vec::new(),
            muted: 0,
        }
    }

    fn message(&mut self, data: &[u8]) -> Decoded {
        let mut deserializer = serde_json::Deserializer::from_slice(data);
        self.deserialize(&mut deserializer)
            .and_then(|()| deserializer.end())
            .map_err(|_| "a message is not valid JSON and was left out")
    }

    fn number(&mut self, number: f64) {
        if self.muted == 0 {
            (self.put)(&self.path, number);
        }
    }
}

impl<'de, P: FnMut(&str, f64)> DeserializeSeed<'de> for &mut Walk<'_, P> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de, P: FnMut(&str, f64)> Visitor<'de> for &mut Walk<'_, P> {
    type Value = ();

    fn expecting(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("JSON")
    }

    fn visit_bool<E: Error>(self, flag: bool) -> Result<(), E> {
        self.number(f64::from(u8::from(flag)));
        Ok(())
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<(), E> {
        self.number(number as f64);
        Ok(())
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<(), E> {
        self.number(number as f64);
        Ok(())
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<(), E> {
        self.number(number);
        Ok(())
    }

    fn visit_str<E: Error>(self, _: &str) -> Result<(), E> {
        Ok(())
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<(), A::Error> {
        let place = self.arrays;
        self.arrays += 1;
        let muted = usize::from(self.long.binary_search(&place).is_ok());
        self.muted += muted;
        let length = self.path.len();
        let mut count = 0;
        loop {
            if self.muted == 0 {
                write!(self.path, "[{count}]").expect("a String takes all text");
            }
            let item = items.next_element_seed(&mut *self)?;
            self.path.truncate(length);
            if item.is_none() {
                break;
            }
            count += 1;
        }
        self.muted -= muted;
        if count > LONGEST_ARRAY {
            self.found_long.push(place);
        }
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut fields: A) -> Result<(), A::Error> {
        let length = self.path.len();
        loop {
            if length > 0 && self.muted == 0 {
                self.path.push('.');
            }
            let path = (self.muted == 0).then_some(&mut self.path);
            let field = fields.next_key_seed(Name(path))?;
            if field.is_some() {
                fields.next_value_seed(&mut *self)?;
            }
            self.path.truncate(length);
            if field.is_none() {
                return Ok(());
            }
        }
    }
}

/// Appends a field's name to the path, if there is one.
struct Name<'a>(Option<&'a mut String>);

impl<'de> DeserializeSeed<'de> for Name<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for Name<'_> {
    type Value = ();

    fn expecting(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("the name of a field")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<(), E> {
        if let Some(path) = self.0 {
            path.push_str(name);
        }
        Ok(())
    }
}
