//! How large an effect is in one group, or would be at most.

use crate::effect::size::GroupSize;
use crate::identification::interval::Interval;
use crate::words::number::{rounded, significant};

impl GroupSize {
    /// Its value with as many digits as its interval supports.
    pub(super) fn amount(&self, unit: &str) -> String {
        let interval = (self.low.zip(self.high)).map(|(low, high)| Interval { low, high });
        let value = rounded(self.value, interval).value;
        format!("{value}\u{a0}{unit}").trim_end().to_owned()
    }

    /// What its size is below, if it is there at all; above, of one that is the larger the less there is of it.
    pub(super) fn unless(&self) -> Option<Unless> {
        match (self.low?, self.high) {
            (low, Some(high)) => Some(Unless::Below(low.abs().max(high.abs()))),
            (low, None) => Some(Unless::Above(low)),
        }
    }
}

/// How large a size that nobody sees would be at most, in its unit.
#[derive(Debug, Clone, Copy)]
pub(super) enum Unless {
    Below(f64),
    /// Of a size that is the larger the less there is of it.
    Above(f64),
}

impl Unless {
    /// What holds of both.
    pub(super) fn or(self, other: Self) -> Self {
        match (self, other) {
            (Self::Below(one), Self::Below(other)) => Self::Below(one.max(other)),
            (Self::Above(one), Self::Above(other)) => Self::Above(one.min(other)),
            // Of one size either is, never both.
            (one, _) => one,
        }
    }

    pub(super) fn said(self, unit: &str) -> String {
        let (word, size) = match self {
            Self::Below(size) => ("below", size),
            Self::Above(size) => ("above", size),
        };
        format!("{word} {}\u{a0}{unit}", significant(size, 2))
    }
}
