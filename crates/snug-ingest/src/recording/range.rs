//! Declared stretches of a recording, as for estimation and validation, in place of a table of events.

use crate::error::IngestError;
use crate::file::finding_log::{About, FindingLog};
use serde::{Deserialize, Serialize};
use snug_campaign::Segment;

/// A named stretch of a recording, for estimation or validation. Ranges become segments 1, 2, … in the order of the list.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// Name, for example `estimation`; unique within the list.
    pub name: String,
    /// First sample, counted from 0 (after resampling, where the times are not uniform).
    pub start: usize,
    /// One past the last sample.
    pub end: usize,
}

pub(crate) fn check(ranges: &[Range]) -> Result<(), IngestError> {
    for (index, range) in ranges.iter().enumerate() {
        let twice = ranges[..index].iter().any(|other| other.name == range.name);
        if range.start >= range.end || twice {
            let value = format!("{:?} [{}, {})", range.name, range.start, range.end);
            let allowed = "start below end, and every name once";
            return Err(IngestError::setting("ranges", value, allowed));
        }
    }
    Ok(())
}

/// One segment per range; one over everything without ranges.
pub(crate) fn segments(ranges: &[Range], samples: usize, log: &mut FindingLog) -> Vec<Segment> {
    let segment = |number, start, end| Segment {
        number,
        start,
        end,
        event_times_s: None,
    };
    if ranges.is_empty() {
        return vec![segment(1, 0, samples)];
    }
    let mut segments = Vec::with_capacity(ranges.len());
    for (number, range) in (1..).zip(ranges) {
        if range.end > samples {
            let message = format!(
                "range {:?} [{}, {}) reaches beyond the {samples} samples of the file",
                range.name, range.start, range.end
            );
            if range.start >= samples {
                log.left_out("range_beyond_data", About::Tightening(number), message);
                continue;
            }
            log.note("range_beyond_data", About::Tightening(number), message);
        }
        segments.push(segment(number, range.start, range.end));
    }
    segments
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(name: &str, start: usize, end: usize) -> Range {
        Range {
            name: name.to_owned(),
            start,
            end,
        }
    }

    #[test]
    fn ranges_are_segments_in_order() {
        let mut log = FindingLog::new("x.csv".as_ref());
        let ranges = [
            range("late", 50, 80),
            range("early", 0, 20),
            range("cut", 90, 120),
            range("gone", 100, 101),
        ];
        let places: Vec<_> = segments(&ranges, 100, &mut log)
            .iter()
            .map(|s| (s.number, s.start, s.end))
            .collect();
        assert_eq!(places, [(1, 50, 80), (2, 0, 20), (3, 90, 120)]);
        assert_eq!(log.finish().len(), 2);
    }

    #[test]
    fn ranges_that_cannot_be() {
        assert!(check(&[range("a", 3, 3)]).is_err());
        assert!(check(&[range("a", 0, 3), range("a", 4, 5)]).is_err());
        assert!(check(&[range("a", 0, 3), range("b", 0, 3)]).is_ok());
    }
}
