//! What a column's name says: signal, time, or neither; and what a unit's text means.

use snug_ingest::csv::TimeUnit;
use snug_ingest::{Signal, Unit};

/// What a column may be, by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    Time,
    Signal(Signal),
    /// Drives the rig, whatever it measures.
    Input,
    /// Moves, whatever it measures.
    Output,
    /// What was wanted, not what was measured.
    Wanted,
    /// Kept for validation.
    Validation,
    Unknown,
}

/// Words by which columns are named, the first that fits counts; those that end in `*` may go on.
const WORDS: &[(Meaning, &[&str])] = &[
    (
        Meaning::Wanted,
        &[
            "ref",
            "reference*",
            "setpoint*",
            "target*",
            "desired",
            "des",
            "soll",
            "cmd",
            "command*",
            "nominal*",
            "goal",
        ],
    ),
    (Meaning::Validation, &["val", "valid*", "test"]),
    (
        Meaning::Signal(Signal::Acceleration),
        &[
            "acc", "acc*", "beschl*", "ax", "ay", "az", "alpha", "ddq", "xdd",
        ],
    ),
    (
        Meaning::Signal(Signal::Velocity),
        &[
            "vel",
            "veloc*",
            "speed*",
            "geschw*",
            "drehzahl*",
            "omega",
            "rpm",
            "dq",
            "xd",
            "w",
        ],
    ),
    (Meaning::Signal(Signal::GripForce), &["grip*", "hand*"]),
    (
        Meaning::Signal(Signal::Torque),
        &[
            "torque*",
            "moment*",
            "drehmoment*",
            "tau",
            "trq",
            "tq",
            "md",
            "mz",
        ],
    ),
    (
        Meaning::Signal(Signal::Force),
        &["force*", "kraft*", "fx", "fy", "fz", "f"],
    ),
    (
        Meaning::Signal(Signal::Displacement),
        &[
            "pos",
            "posit*",
            "angle*",
            "winkel*",
            "disp*",
            "weg",
            "phi",
            "theta",
            "q",
            "x",
            "travel",
            "stroke",
            "deflection",
        ],
    ),
    (Meaning::Time, &["time*", "zeit*", "t", "sec", "seconds"]),
    (
        Meaning::Input,
        &[
            "u",
            "in",
            "input*",
            "v1",
            "volt*",
            "current*",
            "strom",
            "excitation",
        ],
    ),
    (Meaning::Output, &["y", "out", "output*", "v2", "response"]),
];

/// What a name says.
pub(super) fn meaning(name: &str) -> Meaning {
    let words = words(name);
    let fits = |pattern: &str| {
        words.iter().any(|word| match pattern.strip_suffix('*') {
            Some(start) => word.starts_with(start),
            None => word == pattern,
        })
    };
    let found = WORDS
        .iter()
        .find(|(_, patterns)| patterns.iter().any(|pattern| fits(pattern)));
    found.map_or(Meaning::Unknown, |(meaning, _)| *meaning)
}

/// `uEst`, `motor_speed 2` in words of small letters.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut was_small = false;
    for letter in name.chars() {
        if !letter.is_alphanumeric() || (letter.is_uppercase() && was_small) {
            words.push(String::new());
        }
        if letter.is_alphanumeric() {
            words
                .last_mut()
                .expect("begins with one word")
                .extend(letter.to_lowercase());
        }
        was_small = letter.is_lowercase();
    }
    words.retain(|word| !word.is_empty());
    words
}

/// The unit that a text means, where it measures the signal.
pub(super) fn unit(text: &str, signal: Signal) -> Option<Unit> {
    let is_written = |text: &str| {
        let mut measure =
            (Unit::ALL.iter().copied()).filter(|unit| unit.factor(signal, 1.0).is_some());
        measure.find(|unit| unit.written().contains(&text))
    };
    let text = text.trim();
    is_written(text).or_else(|| is_written(&text.to_lowercase()))
}

/// The unit at the end of a name, `speed_rpm`.
pub(super) fn unit_in_name(name: &str, signal: Signal) -> Option<Unit> {
    let (before, last) = name.rsplit_once(['_', ' '])?;
    let joined = before
        .rsplit_once(['_', ' '])
        .filter(|(_, per)| *per == "per");
    match joined {
        Some((start, _)) => {
            let (_, first) = start.rsplit_once(['_', ' '])?;
            unit(&format!("{first}/{last}"), signal)
        }
        None => unit(last, signal),
    }
}

/// The unit of times.
pub(super) fn time_unit(unit: &str, name: &str) -> Option<TimeUnit> {
    let last = name.rsplit(['_', ' ']).next().unwrap_or_default();
    [unit, last]
        .into_iter()
        .find_map(|text| match text.to_lowercase().as_str() {
            "s" | "sec" | "seconds" => Some(TimeUnit::Second),
            "ms" | "msec" | "millis" => Some(TimeUnit::Millisecond),
            "us" | "µs" | "μs" | "usec" => Some(TimeUnit::Microsecond),
            "ns" => Some(TimeUnit::Nanosecond),
            _ => None,
        })
}

/// Whether a number of this name is a sampling rate \[Hz\], or else the time between samples \[s\].
pub(super) fn is_rate(name: &str) -> Option<bool> {
    let last = name
        .rsplit(['.', '"'])
        .next()
        .unwrap_or(name)
        .to_lowercase();
    match last.trim_matches([']', ' ']) {
        "fs" | "f_s" | "samplerate" | "sample_rate" | "sampling_rate" | "sample rate" | "rate"
        | "rate_hz" | "fsample" => Some(true),
        "ts" | "t_s" | "dt" | "h" | "sampletime" | "sample_time" | "sampling_time" => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_read_as_it_is_written() {
        for (text, signal, expected) in [
            ("MN", Signal::Force, Unit::Meganewton),
            ("mN", Signal::Force, Unit::Millinewton),
            ("µN", Signal::Force, Unit::Micronewton),
            ("nm", Signal::Displacement, Unit::Nanometre),
            ("Nm", Signal::Torque, Unit::NewtonMetre),
            ("NM", Signal::Torque, Unit::NewtonMetre),
            ("kgf", Signal::Force, Unit::KilogramForce),
            ("km/h", Signal::Velocity, Unit::KilometrePerHour),
        ] {
            assert_eq!(unit(text, signal), Some(expected), "{text}");
        }
        assert_eq!(unit("nm", Signal::Velocity), None);
    }
}
