//! What a measurement file's name says of tool, day, station and time: measurement formats know none of them.

use crate::error::PlantError;
use crate::storage::partition::{Partition, UNKNOWN, check_name};

/// How files are named, and what holds for all of them.
#[derive(Debug, Clone, Default)]
pub struct Naming {
    template: Vec<Part>,
    /// Tool of files whose names say none.
    tool: Option<String>,
    /// Day of files whose names say none.
    day: Option<String>,
    /// Station of files whose names say none.
    station: Option<String>,
}

#[derive(Debug, Clone, PartialEq)]
enum Part {
    Text(String),
    Field(Field),
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Field {
    Tool,
    Day,
    Station,
    Time,
    Skip,
}

const FIELDS: [(&str, Field); 5] = [
    ("tool", Field::Tool),
    ("day", Field::Day),
    ("station", Field::Station),
    ("time", Field::Time),
    ("skip", Field::Skip),
];

/// What is known of one file.
#[derive(Debug, Clone, PartialEq)]
pub struct Named {
    /// Its tool and day.
    pub partition: Partition,
    /// Its station.
    pub station: Option<String>,
    /// When its recording began, since midnight \[s\].
    pub time_of_day_s: Option<f64>,
}

impl Naming {
    /// What holds for every file whose name says nothing else.
    pub fn of_all(tool: Option<String>, day: Option<String>, station: Option<String>) -> Self {
        Self {
            template: Vec::new(),
            tool,
            day,
            station,
        }
    }

    /// Takes a template such as `{tool}_{day}_{time}`; fields are `{tool}`, `{day}` (YYYY-MM-DD or YYYYMMDD), `{station}`,
    /// `{time}` (HHMMSS or HH-MM-SS) and `{skip}`; what follows the last field is ignored.
    ///
    /// # Errors
    /// [`PlantError::Setting`] for a field that is none, and for two fields with nothing between them.
    pub fn with_template(mut self, template: &str) -> Result<Self, PlantError> {
        let refused = |value: &str| {
            let allowed = "{tool}, {day}, {station}, {time} and {skip}, with text between them";
            PlantError::setting("names", value, allowed)
        };
        let mut rest = template;
        while !rest.is_empty() {
            let part = match rest.strip_prefix('{') {
                Some(inner) => {
                    let (name, after) = inner.split_once('}').ok_or_else(|| refused(template))?;
                    let known = FIELDS.iter().find(|(known, _)| *known == name);
                    rest = after;
                    Part::Field(known.ok_or_else(|| refused(name))?.1)
                }
                None => {
                    let end = rest.find('{').unwrap_or(rest.len());
                    let (text, after) = rest.split_at(end);
                    rest = after;
                    Part::Text(text.to_owned())
                }
            };
            let is_field = |part: &Part| matches!(part, Part::Field(_));
            if is_field(&part) && self.template.last().is_some_and(is_field) {
                return Err(refused(template));
            }
            self.template.push(part);
        }
        Ok(self)
    }

    /// What a file's stem says; a name that does not follow the template is refused.
    ///
    /// # Errors
    /// [`PlantError::Setting`] names file, field and what is allowed.
    pub fn of(&self, stem: &str) -> Result<Named, PlantError> {
        let mut named = [
            self.tool.clone(),
            self.day.clone(),
            self.station.clone(),
            None,
        ];
        for (field, word) in self.captured(stem)? {
            let place = match field {
                Field::Tool => 0,
                Field::Day => 1,
                Field::Station => 2,
                Field::Time => 3,
                Field::Skip => continue,
            };
            named[place] = Some(word.to_owned());
        }
        let [tool, day, station, time] = named;
        if let Some(station) = &station {
            check_name("station", station)?;
        }
        let day = day.as_deref().unwrap_or(UNKNOWN);
        let partition = Partition::new(&dashed(day), tool.as_deref().unwrap_or(UNKNOWN))?;
        let time_of_day_s = time.as_deref().map(seconds).transpose()?;
        Ok(Named {
            partition,
            station,
            time_of_day_s,
        })
    }

    fn captured<'a>(&self, stem: &'a str) -> Result<Vec<(Field, &'a str)>, PlantError> {
        let refused = || PlantError::setting("file name", stem, "a name that follows --names");
        let mut rest = stem;
        let mut found = Vec::new();
        for (index, part) in self.template.iter().enumerate() {
            match part {
                Part::Text(text) => rest = rest.strip_prefix(text.as_str()).ok_or_else(refused)?,
                Part::Field(field) => {
                    let end = match self.template.get(index + 1) {
                        Some(Part::Text(text)) => rest.find(text.as_str()).ok_or_else(refused)?,
                        _ => rest.find(['_', '.', ' ']).unwrap_or(rest.len()),
                    };
                    found.push((*field, &rest[..end]));
                    rest = &rest[end..];
                }
            }
        }
        Ok(found)
    }
}

/// `20260301` as `2026-03-01`; everything else as it is.
fn dashed(day: &str) -> String {
    let is_plain = day.len() == 8 && day.bytes().all(|byte| byte.is_ascii_digit());
    match is_plain {
        true => format!("{}-{}-{}", &day[..4], &day[4..6], &day[6..]),
        false => day.to_owned(),
    }
}

fn seconds(time: &str) -> Result<f64, PlantError> {
    let refused = || PlantError::setting("time", time, "HHMMSS or HH-MM-SS");
    let digits: String = time
        .chars()
        .filter(|letter| !"-:".contains(*letter))
        .collect();
    if digits.len() != 6 || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(refused());
    }
    let part = |range: std::ops::Range<usize>| digits[range].parse::<u32>().map_err(|_| refused());
    let (hours, minutes, seconds) = (part(0..2)?, part(2..4)?, part(4..6)?);
    if hours > 23 || minutes > 59 || seconds > 60 {
        return Err(refused());
    }
    Ok(f64::from(3600 * hours + 60 * minutes + seconds))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_name_says_tool_day_and_time() {
        let naming = Naming::default()
            .with_template("{tool}_{day}_{time}")
            .unwrap();
        let named = naming.of("T-07_20260301_14-05-09_x").unwrap();
        assert_eq!(named.partition.to_string(), "2026-03-01/T-07");
        assert_eq!(named.time_of_day_s, Some(50_709.0));
        let error = naming.of("T-07-20260301").unwrap_err().to_string();
        assert!(error.contains("T-07-20260301"), "{error}");
        assert!(naming.of("T_20260231_140509").is_err());
        assert!(naming.of("T_20260301_250000").is_err());
    }

    #[test]
    fn what_names_do_not_say_is_as_told_or_unknown() {
        let naming = Naming {
            tool: Some("T1".into()),
            ..Naming::default()
        };
        assert_eq!(
            naming.of("anything").unwrap().partition.to_string(),
            "unknown/T1"
        );
        for template in ["{tool}{day}", "{tol}", "{tool"] {
            assert!(
                Naming::default().with_template(template).is_err(),
                "{template}"
            );
        }
    }
}
