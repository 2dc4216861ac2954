//! The confidence interval of a proportion that behaves near 0 and 1.

use serde::Serialize;

use crate::distributions::normal_quantile;
use crate::sample::check_confidence;
use crate::{Interval, Result, StatisticsError};

/// A share of independent trials.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Proportion {
    /// Successes.
    pub successes: usize,
    /// Trials.
    pub trials: usize,
    /// `successes/trials`.
    pub share: f64,
    /// Wilson score interval of the share.
    pub interval: Interval,
}

/// Share with Wilson's score interval (Wilson 1927), which stays inside 0 to 1 and is sound for
/// shares near them.
///
/// `(p̂ + z²/2n ± z √(p̂(1 − p̂)/n + z²/4n²))/(1 + z²/n)`
///
/// # Errors
/// [`StatisticsError::TooFew`] without trials, [`StatisticsError::OutOfRange`] for more
/// successes than trials or for `confidence`.
pub fn wilson(successes: usize, trials: usize, confidence: f64) -> Result<Proportion> {
    check_confidence(confidence)?;
    if trials == 0 {
        return Err(StatisticsError::TooFew {
            sample: "trials".into(),
            method: "Wilson interval",
            required: 1,
            found: 0,
        });
    }
    if successes > trials {
        return Err(StatisticsError::OutOfRange {
            argument: "successes",
            value: successes as f64,
            allowed: "no more than trials",
        });
    }
    let n = trials as f64;
    let share = successes as f64 / n;
    let z = normal_quantile(0.5 + 0.5 * confidence);
    let shrink = 1.0 + z * z / n;
    let centre = (share + z * z / (2.0 * n)) / shrink;
    let reach = z / shrink * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    // At the ends the limit is the share itself; rounding must not carry it past.
    let low = if successes == 0 { 0.0 } else { centre - reach };
    let high = if successes == trials {
        1.0
    } else {
        centre + reach
    };
    Ok(Proportion {
        successes,
        trials,
        share,
        interval: Interval {
            low,
            high,
            confidence,
        },
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn limits_solve_the_score_equation() {
        let found = wilson(931, 2687, 0.95).unwrap();
        for limit in [found.interval.low, found.interval.high] {
            let z = (found.share - limit) / (limit * (1.0 - limit) / 2687.0).sqrt();
            assert!((z.abs() - 1.959_963_984_540_054).abs() < 1e-9);
        }
    }

    #[test]
    fn none_and_all_touch_the_ends() {
        assert_eq!(wilson(0, 12, 0.95).unwrap().interval.low, 0.0);
        assert_eq!(wilson(12, 12, 0.95).unwrap().interval.high, 1.0);
        assert!(matches!(
            wilson(0, 0, 0.95),
            Err(StatisticsError::TooFew { .. })
        ));
        assert!(matches!(
            wilson(3, 2, 0.95),
            Err(StatisticsError::OutOfRange { .. })
        ));
    }
}
