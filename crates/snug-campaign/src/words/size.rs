//! The size of an effect: value, interval, unit, and what is remarkable about it.

use crate::effect::size::{EffectParameter, GroupSize, GroupSizes};
use crate::identification::interval::Interval;
use crate::words::effect_name::unit_text;
use crate::words::number::{rounded, short, significant};
use std::fmt::{self, Display, Formatter};

/// A parameter's size in pieces, so that a page can set each in its own type.
pub struct Size {
    /// What the parameter is, as its effect says it, else its name.
    pub name: String,
    /// The value, with as many digits as its interval supports.
    pub value: String,
    /// `[low, high]` at 95 %; `None` where the data do not determine it.
    pub interval: Option<String>,
    /// The unit, empty for a pure number.
    pub unit: String,
    /// That every tightening has its own, or whose it is.
    pub own: Option<String>,
    /// That it lies beyond what is plausible.
    pub beyond: Option<String>,
}

/// Interval width over value \[–\] up to which an interval says nothing: the estimate lies at the end of what a fit may reach.
/// Chosen.
const NO_WIDTH: f64 = 1e-6;

impl EffectParameter {
    /// Its size as people say it.
    pub fn size(&self) -> Size {
        let interval = self
            .low
            .zip(self.high)
            .filter(|(low, high)| high - low > NO_WIDTH * self.value.abs())
            .map(|(low, high)| Interval { low, high });
        let shown = rounded(self.value, interval);
        let unit = unit_text(&self.unit);
        let spread = |spread: f64| {
            format!(
                ", spread {} from tightening to tightening",
                with_unit(significant(spread, 2), &unit)
            )
        };
        Size {
            name: match self.meaning.as_str() {
                "" => self.name.clone(),
                meaning => meaning.to_owned(),
            },
            value: shown.value,
            interval: shown.interval,
            own: match &self.by_group {
                Some(sizes) => {
                    let of_some = sizes.groups.iter().any(GroupSize::is_without_end);
                    Some(format!(
                        "on average{}{}; {}",
                        if of_some { " where it is there" } else { "" },
                        self.spread_over(sizes),
                        sizes.sentence(&self.unit)
                    ))
                }
                None => self.per_tightening.then(|| {
                    "on average".to_owned() + &self.spread.map_or_else(String::new, spread)
                }),
            },
            beyond: (!self.is_plausible()).then(|| {
                format!(
                    "beyond the plausible {} to {}",
                    short(self.minimum),
                    with_unit(short(self.maximum), &unit)
                )
            }),
            unit,
        }
    }
}

impl EffectParameter {
    /// How much its groups differ beyond their errors, where all of them have it and are a sample of many more.
    fn spread_over(&self, sizes: &GroupSizes) -> String {
        let all_have_it = sizes.groups.iter().all(|group| group.present);
        match self.spread.filter(|spread| all_have_it && *spread > 0.0) {
            Some(spread) if sizes.factor.is_sample() => format!(
                ", standard deviation {} between {}",
                with_unit(significant(spread, 2), &unit_text(&self.unit)),
                sizes.factor.plural()
            ),
            _ => String::new(),
        }
    }
}

impl Display for Size {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.name, self.value)?;
        if let Some(interval) = &self.interval {
            write!(f, " {interval}")?;
        }
        if !self.unit.is_empty() {
            write!(f, "\u{a0}{}", self.unit)?;
        }
        if self.interval.is_none() {
            write!(f, " (no interval)")?;
        }
        if let Some(own) = &self.own {
            write!(f, " {own}")?;
        }
        match &self.beyond {
            Some(beyond) => write!(f, ", {beyond}"),
            None => Ok(()),
        }
    }
}

/// Each parameter with its size, one after the other.
pub fn sizes(parameters: &[EffectParameter]) -> String {
    let sizes = parameters.iter().map(|one| one.size().to_string());
    sizes.collect::<Vec<_>>().join("; ")
}

/// A value with three significant digits and its unit.
pub fn amount(value: f64, unit: &str) -> String {
    with_unit(significant(value, 3), &unit_text(unit))
}

fn with_unit(number: String, unit: &str) -> String {
    match unit {
        "" => number,
        unit => format!("{number}\u{a0}{unit}"),
    }
}
