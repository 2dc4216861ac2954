//! Sums and products with about 32 digits.
//!
//! Variances of readings that share many leading digits lose all of their own digits in plain
//! `f64` sums. A pair of `f64` whose sum is the value (Dekker 1971; Knuth, TAOCP vol. 2, 4.2.2)
//! keeps them, at a cost that does not matter on samples of this size.

use std::ops::{Add, Div, Mul, Neg, Sub};
use std::str::FromStr;

/// A number as an unevaluated sum `high + low`, `|low| ≤ ulp(high)/2`: 106 bits.
///
/// `"1000000000000.4".parse::<DoubleDouble>()` keeps decimal readings that `f64` would round;
/// see [`crate::k_sample::one_way_anova`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

/// The text is not a plain decimal number such as `-12.5` or `1e-3`.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("`{text}` is not a decimal number")]
pub struct ParseDoubleDoubleError {
    /// The text given.
    pub text: String,
}

impl DoubleDouble {
    /// The nearest `f64`.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        self.high + self.low
    }

    /// True when neither part is NaN or infinite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }

    /// `high + low` for `|high| ≥ |low|`, renormalised.
    fn quick_sum(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self {
            high: sum,
            low: low - (sum - high),
        }
    }

    /// The sum of two `f64` without rounding.
    fn exact_sum(a: f64, b: f64) -> Self {
        let sum = a + b;
        let b_part = sum - a;
        Self {
            high: sum,
            low: (a - (sum - b_part)) + (b - b_part),
        }
    }

    /// The product of two `f64` without rounding.
    fn exact_product(a: f64, b: f64) -> Self {
        let product = a * b;
        Self {
            high: product,
            low: a.mul_add(b, -product),
        }
    }
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self {
            high: value,
            low: 0.0,
        }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = Self::exact_sum(self.high, other.high);
        let low = Self::exact_sum(self.low, other.low);
        let sum = Self::quick_sum(high.high, high.low + low.high);
        Self::quick_sum(sum.high, sum.low + low.low)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::exact_product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        Self::quick_sum(product.high, product.low + cross)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - Self::from(first) * other;
        let second = rest.high / other.high;
        let rest = rest - Self::from(second) * other;
        Self::quick_sum(first, second) + Self::from(rest.high / other.high)
    }
}

impl std::iter::Sum for DoubleDouble {
    fn sum<I: Iterator<Item = Self>>(values: I) -> Self {
        values.fold(Self::default(), Add::add)
    }
}

impl FromStr for DoubleDouble {
    type Err = ParseDoubleDoubleError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let error = || ParseDoubleDoubleError {
            text: text.to_owned(),
        };
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().map_err(|_| error())?),
            None => (text, 0),
        };
        let (negative, digits) = match mantissa.as_bytes() {
            [b'-', rest @ ..] => (true, rest),
            [b'+', rest @ ..] => (false, rest),
            rest => (false, rest),
        };
        let (whole, fraction) = match digits.iter().position(|byte| *byte == b'.') {
            Some(point) => (&digits[..point], &digits[point + 1..]),
            None => (digits, &digits[..0]),
        };
        let mut value = Self::default();
        for byte in whole.iter().chain(fraction) {
            if !byte.is_ascii_digit() {
                return Err(error());
            }
            value = value * Self::from(10.0) + Self::from(f64::from(byte - b'0'));
        }
        let places = i32::try_from(fraction.len()).map_err(|_| error())?;
        let power = exponent
            .checked_sub(places)
            .filter(|power| power.abs() <= 300);
        let (Some(power), false) = (power, whole.is_empty() && fraction.is_empty()) else {
            return Err(error());
        };
        let scale = (0..power.abs()).fold(Self::from(1.0), |scale, _| scale * Self::from(10.0));
        let value = if power < 0 {
            value / scale
        } else {
            value * scale
        };
        Ok(if negative { -value } else { value })
    }
}

/// Sum of the values, rounded once at the end.
pub(crate) fn sum(values: impl IntoIterator<Item = f64>) -> DoubleDouble {
    values.into_iter().map(DoubleDouble::from).sum()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn keeps_what_f64_sums_lose() {
        let total = sum([1e16, 1.0, -1e16, 1e-16]);
        assert_eq!((total - DoubleDouble::from(1.0)).to_f64(), 1e-16);
    }

    #[test]
    fn division_and_multiplication_undo_each_other() {
        let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
        let residue = third * DoubleDouble::from(3.0) - DoubleDouble::from(1.0);
        assert!(residue.to_f64().abs() < 1e-31);
    }

    #[test]
    fn reads_decimals_beyond_f64() {
        let a: DoubleDouble = "1000000000000.4".parse().unwrap();
        let b: DoubleDouble = "1000000000000.3".parse().unwrap();
        assert!(((a - b).to_f64() - 0.1).abs() < 1e-17);
        let c: DoubleDouble = "-12.5e-1".parse().unwrap();
        assert_eq!(c.to_f64(), -1.25);
        for text in ["", ".", "-", "1,5", "nan", "1e999", "--1", "1.2.3"] {
            assert!(text.parse::<DoubleDouble>().is_err(), "{text}");
        }
    }
}
