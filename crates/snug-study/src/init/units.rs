//! In which unit a column probably is: as the file says, as its name says, as its numbers say, or the usual one.

use super::numbers::largest;
use super::roles::{self, Meaning};
use snug_ingest::csv::TimeUnit;
use snug_ingest::survey::{Survey, SurveyedColumn};
use snug_ingest::{Signal, Unit};

/// Length of a year with its share of a leap day \[s\].
const YEAR_S: f64 = 365.25 * 86_400.0;

/// In which unit a column probably is, and why.
pub(super) fn unit_of(
    found: &Survey,
    column: &SurveyedColumn,
    signal: Signal,
    linear: bool,
) -> (Unit, String) {
    if let Some(unit) = roles::unit(&column.unit, signal) {
        return (unit, format!("the file says {}", column.unit));
    }
    if let Some(unit) = roles::unit_in_name(&column.name, signal) {
        return (unit, "its name says the unit".to_owned());
    }
    let is_said = |name: &str| {
        let name = name.to_lowercase();
        name.contains("unit") && signal == Signal::Torque && name.contains("torque")
    };
    let said = found.texts.iter().find(|(name, _)| is_said(name));
    if let Some((unit, text)) =
        said.and_then(|(name, text)| Some((roles::unit(text, signal)?, (name, text))))
    {
        return (unit, format!("the file says {} {}", text.0, text.1));
    }
    let most = largest(&column.values);
    let is_named = matches!(roles::meaning(&column.name), Meaning::Signal(_));
    let name = column.name.to_lowercase();
    match signal {
        _ if name.starts_with('v') && name[1..].parse::<u8>().is_ok() => {
            (Unit::Volt, "a voltage, by its name".to_owned())
        }
        Signal::Displacement if !linear && (name.contains("angle") || is_named) && most > 50.0 => (
            Unit::Degree,
            format!("no unit given: up to {most:.0} is degrees, not rad"),
        ),
        Signal::Velocity if name.contains("rpm") || name.contains("drehzahl") => {
            (Unit::RevolutionPerMinute, "by its name".to_owned())
        }
        _ if !is_named && !column.name.is_empty() => {
            (Unit::One, "no unit given: a pure number".to_owned())
        }
        _ => (
            usual(signal, linear),
            "no unit given: the usual one".to_owned(),
        ),
    }
}

/// In which unit a clock counts since 1970, where its first reading then falls into this century.
pub(super) fn since_1970(values: &[f64]) -> Option<TimeUnit> {
    let units = [
        TimeUnit::Second,
        TimeUnit::Millisecond,
        TimeUnit::Microsecond,
        TimeUnit::Nanosecond,
    ];
    let first = values.iter().copied().find(|value| value.is_finite())?;
    let is_now = |unit: &TimeUnit| (30.0..130.0).contains(&(first * unit.seconds() / YEAR_S));
    units.into_iter().find(is_now)
}

fn usual(signal: Signal, linear: bool) -> Unit {
    match (signal, linear) {
        (Signal::Force | Signal::GripForce, _) => Unit::Newton,
        (Signal::Displacement, true) => Unit::Metre,
        (Signal::Velocity, true) => Unit::MetrePerSecond,
        (Signal::Acceleration, true) => Unit::MetrePerSecondSquared,
        (Signal::Displacement, false) => Unit::Radian,
        (Signal::Velocity, false) => Unit::RadianPerSecond,
        (Signal::Acceleration, false) => Unit::RadianPerSecondSquared,
        _ => Unit::NewtonMetre,
    }
}
