//! The damping λ of a step, and how it follows what steps came to.

use crate::solver::thresholds::{GOOD_GAIN, GOOD_RELIEF, LEAST_RELIEF};

/// λ relative to the squared length of each parameter's sensitivity.
pub struct Damping {
    /// λ.
    pub value: f64,
    /// Factor of the next increase.
    growth: f64,
    least: f64,
    first: f64,
}

impl Damping {
    /// Never below `least`; a rise begins at `first` at least.
    pub fn new(value: f64, least: f64, first: f64) -> Self {
        Self {
            value,
            growth: 2.0,
            least,
            first,
        }
    }

    /// After an accepted step with this gain, the decrease over the decrease predicted: λ ← λ max(1 − (2 gain − 1)³, ⅕)
    /// (Nielsen 1999), less where the model is good.
    pub fn relax(&mut self, gain: f64) {
        let surprise = (2.0 * gain - 1.0).clamp(-1.0, 1.0);
        let relief = match gain > GOOD_GAIN {
            true => GOOD_RELIEF,
            false => (1.0 - surprise.powi(3)).max(LEAST_RELIEF),
        };
        self.value = (self.value * relief).max(self.least);
        self.growth = 2.0;
    }

    /// After a rejected step: twice as much, four times, eight times, …
    pub fn raise(&mut self) {
        self.value = self.value.max(self.first) * self.growth;
        self.growth *= 2.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_falls_after_good_steps_and_rises_ever_faster_after_bad_ones() {
        let mut damping = Damping::new(1.0, 1e-3, 1e-2);
        damping.relax(1.0);
        assert_eq!(damping.value, 0.05);
        damping.relax(0.75);
        // 1 − 0.5³.
        assert_eq!(damping.value, 0.05 * 0.875);
        damping.relax(0.0);
        assert_eq!(
            damping.value,
            0.05 * 0.875 * 2.0,
            "worse than expected, though lower"
        );
        (0..9).for_each(|_| damping.relax(1.0));
        assert_eq!(damping.value, 1e-3);
        damping.raise();
        damping.raise();
        assert_eq!(damping.value, 1e-2 * 2.0 * 4.0);
    }
}
