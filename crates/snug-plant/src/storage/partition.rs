//! The parts of a dataset that are written, replaced and read whole: one tool's tightenings of one day.

use crate::error::PlantError;
use arrow::array::{Array, ArrayRef, AsArray};
use arrow::datatypes::Date32Type;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What a day or tool is called that nobody stated.
pub const UNKNOWN: &str = "unknown";

/// Longest name of a tool or station \[characters\]: it names a folder.
const LONGEST: usize = 100;

/// One tool on one day.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Partition {
    /// `2026-03-01`, or [`UNKNOWN`].
    pub day: String,
    /// Name of the tool, or [`UNKNOWN`].
    pub tool: String,
}

impl fmt::Display for Partition {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.day, self.tool)
    }
}

impl Partition {
    /// A tool's day, both checked.
    ///
    /// # Errors
    /// [`PlantError::Setting`] says what days and names may be.
    pub fn new(day: &str, tool: &str) -> Result<Self, PlantError> {
        if day != UNKNOWN && days_since_1970(day).is_none() {
            return Err(PlantError::setting(
                "day",
                day,
                "YYYY-MM-DD, from 1970-01-01 on",
            ));
        }
        check_name("tool", tool)?;
        Ok(Self {
            day: day.to_owned(),
            tool: tool.to_owned(),
        })
    }

    /// Days since 1970-01-01; `None` for an unknown day.
    pub fn days(&self) -> Option<i32> {
        days_since_1970(&self.day)
    }
}

/// The columns of [`IDENTITY`](super::schema::IDENTITY) that say a row's partition.
pub const COLUMNS: [&str; 2] = ["day", "tool"];

/// The partition of a row, by its columns `day` and `tool`.
pub fn of_row(days: &ArrayRef, tools: &ArrayRef, row: usize) -> Result<Partition, PlantError> {
    let days = days.as_primitive::<Date32Type>();
    let day = match days.is_valid(row) {
        true => date_of(days.value(row)),
        false => UNKNOWN.to_owned(),
    };
    Partition::new(&day, tools.as_string::<i32>().value(row))
}

/// Refuses what is no name of a folder everywhere.
///
/// # Errors
/// [`PlantError::Setting`].
pub fn check_name(what: &'static str, name: &str) -> Result<(), PlantError> {
    let known = |letter: char| letter.is_ascii_alphanumeric() || "-_.".contains(letter);
    let fits = (1..=LONGEST).contains(&name.len())
        && name.chars().all(known)
        && !name.starts_with(['.', '_']);
    match fits {
        true => Ok(()),
        false => Err(PlantError::setting(
            what,
            name,
            "1 to 100 letters, digits, '-', '_' and '.', not beginning with '.' or '_'",
        )),
    }
}

/// Days of a date `YYYY-MM-DD` since 1970-01-01 in the Gregorian calendar; `None` for what is no date from then on.
pub fn days_since_1970(date: &str) -> Option<i32> {
    let is_digit = |place: usize| date.as_bytes()[place].is_ascii_digit();
    if date.len() != 10 || ![0, 1, 2, 3, 5, 6, 8, 9].into_iter().all(is_digit) {
        return None;
    }
    let number = |range: std::ops::Range<usize>| date.get(range)?.parse::<i32>().ok();
    let (year, month, day) = (number(0..4)?, number(5..7)?, number(8..10)?);
    let shape = date.as_bytes()[4] == b'-' && date.as_bytes()[7] == b'-';
    if !shape || year < 1970 || !(1..=12).contains(&month) || day < 1 {
        return None;
    }
    let days = days_from_civil(year, month, day);
    (date_of(days) == date).then_some(days)
}

/// Days since 1970-01-01 (H. Hinnant, days_from_civil).
fn days_from_civil(year: i32, month: i32, day: i32) -> i32 {
    let year = if month <= 2 { year - 1 } else { year };
    let era = year.div_euclid(400);
    let year_of_era = year.rem_euclid(400);
    let month = (month + 9) % 12;
    let day_of_year = (153 * month + 2) / 5 + day - 1;
    era * 146_097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year - 719_468
}

/// The date `YYYY-MM-DD` so many days after 1970-01-01 (H. Hinnant, civil_from_days).
pub fn date_of(days: i32) -> String {
    let shifted = days + 719_468;
    let era = shifted.div_euclid(146_097);
    let day_of_era = shifted.rem_euclid(146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = year_of_era + era * 400 + i32::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against Python's `date.toordinal() - 719163`.
    #[test]
    fn dates_are_counted_as_the_calendar_does() {
        for (date, days) in [
            ("1970-01-01", 0),
            ("2000-02-29", 11_016),
            ("2026-03-01", 20_513),
            ("2100-12-31", 47_846),
        ] {
            assert_eq!(days_since_1970(date), Some(days), "{date}");
            assert_eq!(date_of(days), date);
        }
    }

    #[test]
    fn what_is_no_date_or_name_is_refused() {
        for date in [
            "2026-02-29",
            "2026-13-01",
            "26-1-1",
            "2026/03/01",
            "1969-12-31",
            "２026-01-0",
        ] {
            assert_eq!(days_since_1970(date), None, "{date}");
        }
        for name in ["", "a/b", "..", "_x", "ä", "a b"] {
            assert!(Partition::new("2026-03-01", name).is_err(), "{name:?}");
        }
        assert!(Partition::new(UNKNOWN, "T-07_b.1").is_ok());
    }
}
