//! Numbers as people read them: as many digits as the interval supports, a true minus sign, a dash for what is missing.

use crate::identification::interval::Interval;

/// What stands in place of a number that is not there.
pub const DASH: &str = "–";

/// Size below which a power of ten is written out, in the number's unit. Chosen.
const PLAIN_FROM: f64 = 1e-3;
/// Size from which a power of ten is written out, in the number's unit. Chosen likewise.
const PLAIN_TO: f64 = 1e5;
/// Decimals beyond which more help nobody, however narrow the interval. Chosen.
const MOST_DECIMALS: i32 = 8;
/// Steps in one unit of a number whose last digits are left off. Chosen.
const PER_UNIT: f64 = 1e7;

/// `value` with `digits` significant digits; a dash when not finite.
pub fn significant(value: f64, digits: i32) -> String {
    if !value.is_finite() {
        return DASH.into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let exponent = exponent_after_rounding(value, digits);
    if value.abs() >= PLAIN_FROM && value.abs() < PLAIN_TO {
        return fixed(value, digits - 1 - exponent);
    }
    let mantissa = fixed(value / 10f64.powi(exponent), digits - 1);
    format!("{mantissa}\u{a0}×\u{a0}10{}", superscript(exponent))
}

/// `value` with a fixed number of decimals (none when negative) and a true minus sign.
pub fn fixed(value: f64, decimals: i32) -> String {
    if !value.is_finite() {
        return DASH.into();
    }
    let text = format!("{value:.*}", decimals.max(0) as usize);
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.into(),
        Some(digits) => format!("−{digits}"),
        None => text,
    }
}

/// A count or setting without digits that say nothing: `8`, `12.5`.
pub fn short(value: f64) -> String {
    let text = significant(value, 4);
    if text.contains('.') && !text.contains('×') {
        text.trim_end_matches('0').trim_end_matches('.').into()
    } else {
        text
    }
}

/// A share 0..1 in percent, one decimal.
pub fn percent(share: f64) -> String {
    if share.is_finite() {
        format!("{} %", fixed(100.0 * share, 1))
    } else {
        DASH.into()
    }
}

/// A share 0..1 in whole percent, kept on one line.
pub(crate) fn whole_percent(share: f64) -> String {
    format!("{}\u{a0}%", fixed(100.0 * share, 0))
}

/// `part` of `whole` as a share 0..1; `None` when there is nothing to share.
pub fn share(part: usize, whole: usize) -> Option<f64> {
    (whole > 0).then(|| part as f64 / whole as f64)
}

/// A p value: three decimals, honest at both ends.
pub fn p_value(p: Option<f64>) -> String {
    match p {
        Some(p) if !p.is_finite() => DASH.into(),
        Some(p) if p < 0.001 => "< 0.001".into(),
        Some(p) if p > 0.999 => "> 0.999".into(),
        Some(p) => fixed(p, 3),
        None => DASH.into(),
    }
}

/// A value and its interval, rounded alike.
pub struct Rounded {
    /// The value.
    pub value: String,
    /// `[low, high]`; `None` without a finite interval.
    pub interval: Option<String>,
}

/// Rounds a value so that half its interval keeps two significant digits; four digits without an interval.
pub fn rounded(value: f64, interval: Option<Interval>) -> Rounded {
    let finite = interval.filter(|range| range.low.is_finite() && range.high.is_finite());
    let Some(range) = finite.filter(|range| range.high > range.low && value.is_finite()) else {
        return Rounded {
            value: significant(value, 4),
            interval: finite
                .map(|range| bracketed(&significant(range.low, 4), &significant(range.high, 4))),
        };
    };
    let largest = value.abs().max(range.low.abs()).max(range.high.abs());
    let half_width = 0.5 * (range.high - range.low);
    // The value leads, unless its interval dwarfs it.
    let leading = value.abs().max(largest / 100.0);
    let exponent = if (PLAIN_FROM..PLAIN_TO).contains(&leading) {
        0
    } else {
        leading.log10().floor() as i32
    };
    let unit = 10f64.powi(exponent);
    let decimals = (1 - exponent_after_rounding(half_width / unit, 2)).clamp(0, MOST_DECIMALS);
    let power = if exponent == 0 {
        String::new()
    } else {
        format!("\u{a0}×\u{a0}10{}", superscript(exponent))
    };
    let digits = |number: f64| fixed(number / unit, decimals);
    Rounded {
        value: digits(value) + &power,
        interval: Some(bracketed(&digits(range.low), &digits(range.high)) + &power),
    }
}

fn bracketed(low: &str, high: &str) -> String {
    // No line break within an interval.
    format!("[{low},\u{a0}{high}]")
}

/// An interval of shares 0..1 in percent.
pub fn percent_interval(interval: Interval) -> String {
    format!(
        "[{},\u{a0}{}]\u{a0}%",
        fixed(100.0 * interval.low, 1),
        fixed(100.0 * interval.high, 1)
    )
}

/// Without the last digits that arithmetic leaves: rounded to 1e-7 of the number's unit, and never −0.
pub fn without_last_digits(value: f64) -> f64 {
    (value * PER_UNIT).round() / PER_UNIT + 0.0
}

/// The power of ten of the leading digit once `value` is rounded to `digits` digits (9.99 to two digits is 10).
fn exponent_after_rounding(value: f64, digits: i32) -> i32 {
    let printed = format!("{:.*e}", (digits - 1).max(0) as usize, value.abs());
    let (_, exponent) = printed.split_once('e').unwrap_or(("", "0"));
    exponent.parse().unwrap_or(0)
}

/// An exponent in raised digits.
pub fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    exponent
        .to_string()
        .chars()
        .map(|character| match character.to_digit(10) {
            Some(digit) => DIGITS[digit as usize],
            None => '⁻',
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_significant_digits_across_magnitudes() {
        assert_eq!(significant(2314.84, 3), "2315");
        assert_eq!(significant(2.3149, 3), "2.31");
        assert_eq!(significant(-0.012345, 3), "−0.0123");
        assert_eq!(significant(9.999, 2), "10");
        assert_eq!(significant(990_000.0, 2), "9.9\u{a0}×\u{a0}10⁵");
        assert_eq!(significant(0.00012, 2), "1.2\u{a0}×\u{a0}10⁻⁴");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(significant(f64::NAN, 3), DASH);
        assert_eq!((short(8.0), short(12.5)), ("8".into(), "12.5".into()));
    }

    #[test]
    fn rounds_a_value_to_what_its_interval_supports() {
        let narrow = rounded(
            2.312345,
            Some(Interval {
                low: 2.298,
                high: 2.3267,
            }),
        );
        assert_eq!(narrow.value, "2.312");
        assert_eq!(narrow.interval.as_deref(), Some("[2.298,\u{a0}2.327]"));
        let large = rounded(
            9.9e5,
            Some(Interval {
                low: 9.6e5,
                high: 1.02e6,
            }),
        );
        assert_eq!(large.value, "9.90\u{a0}×\u{a0}10⁵");
        assert_eq!(
            large.interval.as_deref(),
            Some("[9.60,\u{a0}10.20]\u{a0}×\u{a0}10⁵")
        );
        let none = rounded(
            1.0,
            Some(Interval {
                low: f64::NAN,
                high: 2.0,
            }),
        );
        assert_eq!(none.value, "1.000");
        assert!(none.interval.is_none());
    }

    #[test]
    fn p_values_do_not_pretend() {
        assert_eq!(p_value(Some(0.0)), "< 0.001");
        assert_eq!(p_value(Some(0.8705)), "0.871");
        assert_eq!(p_value(Some(0.9999)), "> 0.999");
        assert_eq!(p_value(None), DASH);
        assert_eq!(p_value(Some(f64::NAN)), DASH);
    }

    #[test]
    fn a_rounded_zero_has_no_sign() {
        assert_eq!(fixed(-0.0001, 2), "0.00");
        assert_eq!(fixed(-0.5, 1), "−0.5");
    }
}
