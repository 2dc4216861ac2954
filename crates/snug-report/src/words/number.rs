//! Numbers in the page: a dash with its reason for what is missing, intervals in small type, what a figure draws.

use maud::{Markup, html};
use snug_campaign::Interval;
pub use snug_campaign::words::number::{
    DASH, fixed, p_value, percent, percent_interval, rounded, share, short, significant,
    superscript,
};

/// A value with its interval below it, as a table cell shows them; a dash that says `why` without a value.
pub fn measured(value: Option<f64>, interval: Option<Interval>, why: &str) -> Markup {
    let Some(value) = value.filter(|value| value.is_finite()) else {
        return missing(why);
    };
    let shown = rounded(value, interval);
    html! {
        (shown.value)
        @if let Some(interval) = shown.interval { " " span.interval { (interval) } }
    }
}

/// A value with `digits` significant digits; a dash that says `why` without one.
pub fn plain(value: Option<f64>, digits: i32, why: &str) -> Markup {
    match value.filter(|value| value.is_finite()) {
        Some(value) => html! { (significant(value, digits)) },
        None => missing(why),
    }
}

/// The interval between two ends; `None` unless both are known.
pub fn between(low: Option<f64>, high: Option<f64>) -> Option<Interval> {
    let (low, high) = (low?, high?);
    Some(Interval { low, high })
}

/// A dash with its reason in the title.
pub fn missing(why: &str) -> Markup {
    html! { span.missing title=(why) { (DASH) } }
}

/// A number rounded for drawing: `digits` significant digits, shortest form; `None` when not finite.
pub fn drawn(value: f64, digits: i32) -> Option<f64> {
    if value == 0.0 {
        return Some(0.0);
    }
    value.is_finite().then(|| {
        format!("{value:.*e}", (digits - 1) as usize)
            .parse()
            .expect("a printed float parses")
    })
}

/// What a table is sorted by; a missing value has none and stays last.
pub fn sort_key(value: Option<f64>) -> Option<String> {
    Some(drawn(value?, 6)?.to_string())
}

/// A cell of a table that can be sorted.
pub fn sortable(value: Option<f64>, digits: i32, why: &str) -> Markup {
    html! { td data-v=[sort_key(value)] { (plain(value, digits, why)) } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawing_keeps_six_digits_and_drops_what_is_not_finite() {
        assert_eq!(drawn(0.123456789, 6), Some(0.123457));
        assert_eq!(drawn(-1234567.0, 6), Some(-1234570.0));
        assert_eq!(drawn(f64::INFINITY, 6), None);
    }
}
