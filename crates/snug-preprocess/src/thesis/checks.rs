//! Codes 1 and 2 of the original program, which look at the shape of the displacement before any fit.

use crate::thesis::offset::after_third;
use serde::{Deserialize, Serialize};
use snug_campaign::Rejection;

/// The original program's look at the displacement, before any fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct ThesisChecks {
    /// The displacement does not come back: at the window's end it is still above half of the largest value reached
    /// between 1-based samples round(n/3) and n. Evidence only: the original overwrites this code with the outcome of
    /// the other check, so that it never rejects.
    pub goes_up: bool,
    /// The largest excursion is negative: max θ < −min θ.
    pub goes_down: bool,
}

impl ThesisChecks {
    /// Looks at the displacement of a window, its offset already taken out \[rad\].
    ///
    /// The exact conditions of the original are not at hand; these are the plain readings of its descriptions.
    pub fn of(displacement_rad: &[f64]) -> Self {
        let largest = maximum(displacement_rad);
        let smallest = -maximum_of(displacement_rad.iter().map(|value| -value));
        let late = maximum(&displacement_rad[after_third(displacement_rad.len())]);
        let end = displacement_rad.last().copied().unwrap_or(0.0);
        Self {
            goes_up: late > 0.0 && end > 0.5 * late,
            goes_down: largest < -smallest,
        }
    }

    /// The code that stays: 2 (goes down) or none; code 1 is always overwritten.
    pub fn rejection(self) -> Option<Rejection> {
        self.goes_down.then_some(Rejection::GoesDown)
    }
}

fn maximum(values: &[f64]) -> f64 {
    maximum_of(values.iter().copied())
}

fn maximum_of(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::NEG_INFINITY, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(f: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..2999).map(|i| f(f64::from(i) / 2998.0)).collect()
    }

    #[test]
    fn a_pulse_that_returns_passes() {
        let checks = ThesisChecks::of(&curve(|t| (std::f64::consts::PI * t).sin()));
        assert_eq!(checks.rejection(), None);
        assert!(!checks.goes_up);
    }

    #[test]
    fn a_parabola_downwards_is_code_2() {
        let checks = ThesisChecks::of(&curve(|t| 0.1 * t - t * t));
        assert_eq!(checks.rejection(), Some(Rejection::GoesDown));
    }

    #[test]
    fn going_up_is_seen_but_never_rejects() {
        let checks = ThesisChecks::of(&curve(|t| t * t));
        assert!(checks.goes_up);
        assert_eq!(checks.rejection(), None);
    }
}
