//! A part of every window, where the rest is not to count.

use crate::error::{PreprocessError, in_range};
use crate::prepared::Prepared;
use serde::{Deserialize, Serialize};
use snug_campaign::Quantity;

/// A part of every window, in time since the window's start: what comes before it is simulated and not scored, so that the model moves
/// from rest into it; what comes after it is left off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stretch {
    /// Where it begins \[s\].
    pub from_s: f64,
    /// Where it ends \[s\].
    pub to_s: f64,
}

impl Stretch {
    /// Samples before it.
    pub fn samples_before(self, interval_s: f64) -> usize {
        (self.from_s / interval_s).round() as usize
    }

    /// Checks both ends.
    ///
    /// # Errors
    /// [`PreprocessError::SettingOutOfRange`] for one that is not allowed.
    pub fn check(self) -> Result<(), PreprocessError> {
        let Self { from_s, to_s } = self;
        in_range("stretch.from_s", from_s, 0.0, 1e9, "0 or more (seconds)")?;
        let least_s = from_s.next_up();
        in_range("stretch.to_s", to_s, least_s, 1e9, "above from_s (seconds)")
    }

    /// Leaves off what comes after it.
    pub(crate) fn end(self, prepared: &mut Prepared) {
        let one = &mut prepared.tightening;
        let samples = (self.to_s / one.time_base.interval_s).round() as usize + 1;
        one.torque_nm.truncate(samples);
        if let Some(force) = &mut one.grip_force_n {
            force.truncate(samples);
        }
        for quantity in Quantity::ALL {
            if let Some(signal) = one.motion.get(quantity).and_then(|all| all.get(..samples)) {
                let kept = signal.to_vec();
                one.motion.set(quantity, kept);
            }
        }
    }
}
