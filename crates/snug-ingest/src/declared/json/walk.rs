//! One walk through a JSON text that keeps the numbers at the wanted places and passes over all else.

use crate::declared::path::joined;
use crate::declared::{Block, Order, Segment, Wanted};
use crate::error::IngestError;
use crate::memory::Budget;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;
use std::cell::RefCell;
use std::fmt;

/// Names that are remembered for a message.
const MOST_NAMES: usize = 100;

/// Places that are looked for, and what was found there until now.
pub(super) struct Search<'a> {
    wanted: &'a [Wanted],
    budget: &'a Budget,
    places: RefCell<Vec<Place>>,
    failure: RefCell<Option<IngestError>>,
}

/// What stands at a wanted place.
#[derive(Debug, Default)]
pub(super) struct Place {
    pub(super) values: Vec<f64>,
    /// How many of them are no numbers.
    pub(super) gaps: usize,
    /// Something stood there.
    is_found: bool,
    /// Rows of a list of lists, and the length of the first.
    rows: Option<(usize, usize)>,
    /// What stood there that is no list of numbers.
    other: Option<&'static str>,
    /// What stood where the path ended, by how deep that was.
    seen: (usize, Vec<String>),
}

impl<'a> Search<'a> {
    pub(super) fn new(wanted: &'a [Wanted], budget: &'a Budget) -> Self {
        let places = wanted.iter().map(|_| Place::default()).collect();
        Self {
            wanted,
            budget,
            places: RefCell::new(places),
            failure: RefCell::new(None),
        }
    }

    /// Why the walk was ended, where that was not the text's fault.
    pub(super) fn failed(&self) -> Option<IngestError> {
        self.failure.take()
    }

    /// What was found, in the order of what is wanted.
    pub(super) fn finish(self) -> Vec<Place> {
        self.places.into_inner()
    }

    /// Adds a number to every place that `active` says.
    fn push<E: Error>(&self, active: &[Active], number: f64, is_gap: bool) -> Result<(), E> {
        let mut places = self.places.borrow_mut();
        for one in active.iter().filter(|one| self.is_there(one)) {
            let place = &mut places[one.target];
            place.is_found = true;
            place.gaps += usize::from(is_gap);
            if place.rows.is_some() && one.nested < 2 {
                place.other = Some("a list of numbers and lists");
            }
            if let Err(error) = self.budget.push("a channel", &mut place.values, number) {
                *self.failure.borrow_mut() = Some(error);
                return Err(E::custom("over budget"));
            }
        }
        Ok(())
    }

    /// Whether the walk is where its path ends, or in a list there.
    fn is_there(&self, active: &Active) -> bool {
        active.depth == self.wanted[active.target].path.segments.len()
    }

    /// The next step of its path; `None` at its end.
    fn segment(&self, active: &Active) -> Option<&Segment> {
        self.wanted[active.target].path.segments.get(active.depth)
    }

    /// Remembers what stands where the path looks for something.
    fn saw(&self, active: &Active, segment: &Segment) {
        let mut places = self.places.borrow_mut();
        let (depth, names) = &mut places[active.target].seen;
        if active.depth > *depth {
            names.clear();
            *depth = active.depth;
        }
        if active.depth == *depth && names.len() < MOST_NAMES {
            let before = self.wanted[active.target].path.start(active.depth);
            let name = joined(&before, segment);
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }

    /// Notes that what stands at a place is no list of numbers.
    fn other(&self, active: &[Active], what: &'static str) {
        let mut places = self.places.borrow_mut();
        for one in active.iter().filter(|one| self.is_there(one)) {
            places[one.target].is_found = true;
            places[one.target].other = Some(what);
        }
    }

    /// Ends a row of a list of lists that began with so many values.
    fn end_row(&self, active: &Active, before: usize) {
        let place = &mut self.places.borrow_mut()[active.target];
        let length = place.values.len() - before;
        place.rows = match place.rows {
            None if before > 0 => {
                place.other = Some("a list of numbers and lists");
                None
            }
            None => Some((1, length)),
            Some((rows, first)) => {
                if first != length {
                    place.other = Some("a list of lists of different lengths");
                }
                Some((rows + 1, first))
            }
        };
    }
}

impl Place {
    /// The samples of the part that is wanted.
    pub(super) fn samples(self, wanted: &Wanted, budget: &Budget) -> Result<Vec<f64>, IngestError> {
        if !self.is_found {
            return Err(IngestError::MissingChannel {
                channel: wanted.what.clone(),
                accepted: vec![wanted.path.to_string()],
                present: self.seen.1,
            });
        }
        let count = self.values.len();
        let unusable = |found: String| IngestError::UnusableChannel {
            channel: wanted.what.clone(),
            variable: wanted.path.to_string(),
            found,
        };
        if let Some(other) = self.other {
            return Err(unusable(other.to_owned()));
        }
        if count > 0 && self.gaps == count {
            return Err(unusable(format!("without any number in {count} values")));
        }
        let (rows, columns) = self.rows.unwrap_or((count, 1));
        let described = match self.rows {
            Some(_) => format!("a list of {rows} lists of {columns} numbers"),
            None => format!("a list of {count} numbers"),
        };
        Block {
            values: self.values,
            rows,
            columns,
            order: Order::Rows,
            described,
        }
        .part(wanted, budget)
    }
}

/// A wanted place that may stand below where the walk is.
#[derive(Debug, Clone, Copy)]
struct Active {
    target: usize,
    /// Steps of its path that were gone.
    depth: usize,
    /// Lists entered beyond the path's end.
    nested: u8,
}

/// The walk at one value.
pub(super) struct Walk<'s, 'a> {
    search: &'s Search<'a>,
    active: Vec<Active>,
}

impl<'s, 'a> Walk<'s, 'a> {
    pub(super) fn from_the_top(search: &'s Search<'a>) -> Self {
        let active = |target| Active {
            target,
            depth: 0,
            nested: 0,
        };
        Self {
            search,
            active: (0..search.wanted.len()).map(active).collect(),
        }
    }

    /// What may stand below one step further.
    fn below(&self, is_taken: impl Fn(&Segment) -> bool) -> Vec<Active> {
        let deeper = |one: &Active| Active {
            depth: one.depth + 1,
            ..*one
        };
        self.active
            .iter()
            .filter(|one| self.search.segment(one).is_some_and(&is_taken))
            .map(deeper)
            .collect()
    }
}

impl<'de> DeserializeSeed<'de> for Walk<'_, '_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Walk<'_, '_> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("any JSON value")
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<(), E> {
        self.search
            .push(&self.active, f64::from(u8::from(value)), false)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<(), E> {
        self.search.push(&self.active, value as f64, false)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<(), E> {
        self.search.push(&self.active, value as f64, false)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<(), E> {
        self.search.push(&self.active, value, false)
    }

    /// Some programs write numbers as text.
    fn visit_str<E: Error>(self, text: &str) -> Result<(), E> {
        match text.trim().parse() {
            Ok(number) => self.search.push(&self.active, number, false),
            Err(_) => self.search.push(&self.active, f64::NAN, true),
        }
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        self.search.push(&self.active, f64::NAN, true)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        self.search.other(&self.active, "an object");
        while let Some(key) = map.next_key::<Cow<'de, str>>()? {
            let below = self.below(|segment| matches!(segment, Segment::Key(name) if *name == key));
            if below.is_empty() {
                map.next_value::<IgnoredAny>()?;
            } else {
                map.next_value_seed(Walk {
                    search: self.search,
                    active: below,
                })?;
            }
            let seen = Segment::Key(key.into_owned());
            for one in &self.active {
                if matches!(self.search.segment(one), Some(Segment::Key(_))) {
                    self.search.saw(one, &seen);
                }
            }
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let ended: Vec<Active> = (self.active.iter().copied())
            .filter(|one| self.search.is_there(one))
            .collect();
        if ended.iter().any(|one| one.nested > 1) {
            self.search.other(&ended, "a list of lists of lists");
        }
        let before: Vec<usize> = {
            let mut places = self.search.places.borrow_mut();
            let enter = |one: &Active| {
                places[one.target].is_found = true;
                places[one.target].values.len()
            };
            ended.iter().map(enter).collect()
        };
        for index in 0.. {
            let mut active = self.below(|segment| match segment {
                Segment::Index(place) => *place == index,
                Segment::Each => true,
                Segment::Key(_) => false,
            });
            active.extend(ended.iter().map(|one| Active {
                nested: (one.nested + 1).min(3),
                ..*one
            }));
            let walk = Walk {
                search: self.search,
                active,
            };
            if list.next_element_seed(walk)?.is_none() {
                break;
            }
            for one in &self.active {
                if !self.search.is_there(one) && index < MOST_NAMES {
                    self.search.saw(one, &Segment::Index(index));
                }
            }
        }
        for (one, before) in ended.iter().zip(before) {
            if one.nested == 1 {
                self.search.end_row(one, before);
            }
        }
        Ok(())
    }
}
