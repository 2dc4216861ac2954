//! How large an effect is in one group.

use crate::effect::size::GroupSize;
use crate::identification::interval::Interval;
use crate::words::number::rounded;

impl GroupSize {
    /// Its value with as many digits as its interval supports.
    pub(super) fn amount(&self, unit: &str) -> String {
        let interval = (self.low.zip(self.high)).map(|(low, high)| Interval { low, high });
        let value = rounded(self.value, interval).value;
        format!("{value}\u{a0}{unit}").trim_end().to_owned()
    }

    /// What its size is below, if it is there at all.
    pub(super) fn at_most(&self) -> Option<f64> {
        Some(self.low?.abs().max(self.high?.abs()))
    }
}
