//! The thesis' table of events to segments; one damaged row costs its own tightening where the others leave its place.

use crate::file::finding_log::{About, FindingLog};
use crate::mat::{Content, Value};
use snug_campaign::Segment;
use snug_campaign::excerpt;

/// No tightening of hand-held tools lasts this many samples.
const LONGEST_SAMPLES: f64 = 1e9;

/// The third column of a table of events: a time in s, or the text that is none.
pub(super) type EventTime = Result<f64, String>;

/// How many rows, at most, the table has that are in the file.
pub(super) fn rows(table: &Value) -> usize {
    match &table.content {
        Content::Cell(cells) => cells.len(),
        Content::Numeric { real, .. } => real.len(),
        _ => 0,
    }
}

/// The event times of an N×3 (or 3×N) cell of text or numbers, or of such a matrix; `None` when the table is something else.
pub(super) fn times(table: &Value) -> Option<Vec<EventTime>> {
    let &[rows, columns] = table.dims.as_slice() else {
        return None;
    };
    if columns < 3 {
        // Without any event the table may be `{}`.
        let empty = rows == 0 || columns == 0;
        return (empty && !matches!(table.content, Content::Unsupported(_))).then(Vec::new);
    }
    // A table lying on its side has its times in the third row.
    let on_its_side = rows == 3 && columns > 3;
    // The shape is believed only as far as there are elements, of which each `get` makes sure.
    let (count, first, step) = match on_its_side {
        true => (columns, 2, 3),
        false => (rows, rows.checked_mul(2)?, 1),
    };
    let third = |index: usize| step * index + first;
    match &table.content {
        Content::Cell(cells) => (0..count)
            .map(|index| cells.get(third(index)).map(time))
            .collect(),
        Content::Numeric { .. } => {
            let numbers = table.to_f64()?;
            let known = |time: f64| finite(time).ok_or_else(|| time.to_string());
            (0..count)
                .map(|index| numbers.get(third(index)).copied().map(known))
                .collect()
        }
        _ => None,
    }
}

fn time(cell: &Value) -> EventTime {
    if let Some(text) = cell.text() {
        return number(&text).ok_or_else(|| excerpt(&text));
    }
    match cell.to_f64().as_deref() {
        Some(&[time]) => finite(time).ok_or_else(|| time.to_string()),
        _ => Err(cell.describe()),
    }
}

/// A number with a decimal point or comma.
pub(super) fn number(text: &str) -> Option<f64> {
    finite(text.trim().replace(',', ".").parse().ok()?)
}

fn finite(number: f64) -> Option<f64> {
    number.is_finite().then_some(number)
}

/// What the three rows of one tightening say.
struct Triple {
    number: u32,
    samples: usize,
    times_s: Option<[f64; 3]>,
}

/// The segments that the events call for, back to back from sample 0: the event clock's gaps between tightenings do not
/// count. A segment may end beyond the recording.
///
/// A tightening whose rows are wrong has no known length. If it is the only one, its length is what the others leave of
/// the recording, and the others keep their places; else everything from the first such one on is left out.
pub(super) fn segments(
    times: &[EventTime],
    rate_hz: f64,
    samples: usize,
    log: &mut FindingLog,
) -> Vec<Segment> {
    let (rows, incomplete) = times.as_chunks::<3>();
    if !incomplete.is_empty() {
        log.left_out(
            "event_rows",
            About::File,
            format!(
                "{} rows of events are no multiple of 3 (start, torque, stop); the last {} are left out",
                times.len(),
                incomplete.len()
            ),
        );
    } else if rows.is_empty() {
        log.left_out(
            "no_tightenings",
            About::File,
            "the table of events is empty".to_owned(),
        );
    }
    let triples: Vec<Result<Triple, u32>> = (1..)
        .zip(rows)
        .map(|(number, rows)| triple(number, rows, rate_hz, log))
        .collect();
    let known: usize = triples.iter().flatten().map(|triple| triple.samples).sum();
    let bad = triples.iter().filter(|triple| triple.is_err()).count();
    let left = samples
        .checked_sub(known)
        .filter(|&left| left > 0 && bad == 1);
    if bad == 0 && incomplete.is_empty() && !rows.is_empty() {
        compare_lengths(known, samples, rows.len(), log);
    }
    place(triples, left, log)
}

fn triple(
    number: u32,
    rows: &[EventTime; 3],
    rate_hz: f64,
    log: &mut FindingLog,
) -> Result<Triple, u32> {
    let first_row = 3 * number - 2;
    let mut time = |offset: u32, name: &str| {
        rows[offset as usize].as_ref().map_err(|text| {
            log.left_out(
                "event_time_unreadable",
                About::Tightening(number),
                format!(
                    "events row {}: {name} time {text:?} is no number of seconds",
                    first_row + offset
                ),
            );
            number
        })
    };
    let (start, stop) = (time(0, "start")?, time(2, "stop")?);
    let length = ((stop - start) * rate_hz).round();
    if !(1.0..=LONGEST_SAMPLES).contains(&length) {
        log.left_out(
            "event_order",
            About::Tightening(number),
            format!(
                "events rows {first_row} to {}: stop {stop} s is not after start {start} s by 1 to {LONGEST_SAMPLES:e} samples",
                first_row + 2
            ),
        );
        return Err(number);
    }
    let times_s = rows[1].as_ref().ok().map(|&torque| [*start, torque, *stop]);
    match &rows[1] {
        Err(text) => log.note(
            "event_time_unreadable",
            About::Tightening(number),
            format!(
                "events row {}: torque time {text:?} is no number of seconds",
                first_row + 1
            ),
        ),
        Ok(torque) if !(start..=stop).contains(&torque) => log.note(
            "event_order",
            About::Tightening(number),
            format!(
                "events row {}: torque {torque} s is not between start {start} s and stop {stop} s",
                first_row + 1
            ),
        ),
        Ok(_) => {}
    }
    Ok(Triple {
        number,
        samples: length as usize,
        times_s,
    })
}

/// Rounding may cost one sample per tightening; more says that events and channels do not belong together.
fn compare_lengths(called: usize, samples: usize, tightenings: usize, log: &mut FindingLog) {
    if called.abs_diff(samples) > tightenings {
        log.note(
            "events_and_samples_differ",
            About::File,
            format!(
                "the {tightenings} tightenings' events call for {called} samples, the channels hold {samples}"
            ),
        );
    }
}

fn place(
    triples: Vec<Result<Triple, u32>>,
    missing: Option<usize>,
    log: &mut FindingLog,
) -> Vec<Segment> {
    let mut segments = Vec::new();
    let mut start = 0;
    let mut lost = None;
    for triple in triples {
        match (triple, missing) {
            (Err(number), Some(length)) => {
                log.repaired(
                    "events_placed",
                    About::Tightening(number),
                    format!(
                        "the other tightenings' events leave {length} samples from sample {start} on for this one; \
                         what follows is placed behind them"
                    ),
                );
                start += length;
            }
            (Err(number), None) => {
                lost.get_or_insert(number);
            }
            (Ok(triple), _) => {
                if let Some(cause) = lost {
                    log.left_out(
                        "place_unknown",
                        About::Tightening(triple.number),
                        format!("its place in the recording is unknown, because the length of tightening {cause} is"),
                    );
                    continue;
                }
                let end = start + triple.samples;
                segments.push(Segment {
                    number: triple.number,
                    start,
                    end,
                    event_times_s: triple.times_s,
                });
                start = end;
            }
        }
    }
    segments
}
