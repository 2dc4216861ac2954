//! Whether a series changed its level, and on which day: the likelihood-ratio test of a shift in a normal mean at an unknown place
//! (Worsley 1979), whose p value is bounded by the sum over places (Bonferroni).

use super::thresholds::{FEWEST_DAYS, FEWEST_DAYS_BESIDE};
use snug_statistics::distributions::{student_t_quantile, student_t_two_sided};

/// A change of level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Index of the first value after it.
    pub first: usize,
    /// Mean before it, in the values' unit.
    pub before: f64,
    /// Mean from it on, in the values' unit.
    pub after: f64,
    /// 95 % interval of the difference, in the values' unit: Student's t, the place taken as known.
    pub difference: (f64, f64),
    /// Standard deviation within the two parts, in the values' unit.
    pub spread: f64,
    /// Bound of the p value.
    pub p: f64,
}

/// The likeliest change of a series; `None` where there are too few values or they do not differ at all.
pub fn change(values: &[f64]) -> Option<Change> {
    let count = values.len();
    if count < FEWEST_DAYS || values.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let squares = |part: &[f64]| {
        let mean = mean(part);
        part.iter().map(|value| (value - mean).powi(2)).sum::<f64>()
    };
    let freedom = (count - 2) as f64;
    let places = FEWEST_DAYS_BESIDE..=count - FEWEST_DAYS_BESIDE;
    let within = |first: usize| squares(&values[..first]) + squares(&values[first..]);
    let first = places
        .clone()
        .min_by(|&a, &b| within(a).total_cmp(&within(b)))?;
    if squares(values) == 0.0 {
        return None;
    }
    let (before, after) = (mean(&values[..first]), mean(&values[first..]));
    let spread = (within(first) / freedom).sqrt();
    let error = spread * (1.0 / first as f64 + 1.0 / (count - first) as f64).sqrt();
    let t = (after - before) / error;
    let tried = places.count() as f64;
    let p = match t.is_finite() {
        true => (tried * student_t_two_sided(t, freedom)).min(1.0),
        // Both parts are constant: nothing but the number of places speaks against a change of one value.
        false => (tried * student_t_two_sided(f64::MAX.sqrt(), freedom)).min(1.0),
    };
    let reach = student_t_quantile(0.975, freedom) * error;
    Some(Change {
        first,
        before,
        after,
        difference: (after - before - reach, after - before + reach),
        spread,
        p,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Normal deviates, by adding twelve uniform ones of a linear congruential generator (Knuth's constants).
    fn noise(seed: u64) -> impl Iterator<Item = f64> {
        let mut state = seed;
        std::iter::repeat_with(move || {
            let twelve = (0..12).map(|_| {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                (state >> 11) as f64 / (1u64 << 53) as f64
            });
            twelve.sum::<f64>() - 6.0
        })
    }

    #[test]
    fn a_shift_is_dated_and_sized() {
        let values: Vec<f64> = noise(5)
            .take(20)
            .enumerate()
            .map(|(day, noise)| noise + if day >= 12 { 6.0 } else { 0.0 })
            .collect();
        let found = change(&values).unwrap();
        assert_eq!(found.first, 12);
        assert!(found.p < 1e-6);
        assert!(found.difference.0 < 6.0 && 6.0 < found.difference.1);
    }

    /// Of 4000 series in which nothing changes, at most as many are found as the bound says; the binomial error is 0.0034.
    #[test]
    fn what_does_not_change_is_found_no_oftener_than_told() {
        let mut noise = noise(1);
        let found = (0..4000).filter(|_| {
            let values: Vec<f64> = noise.by_ref().take(20).collect();
            change(&values).unwrap().p < 0.05
        });
        let share = found.count() as f64 / 4000.0;
        assert!((0.005..0.05 + 3.0 * 0.0034).contains(&share), "{share}");
    }

    #[test]
    fn too_little_says_nothing() {
        assert_eq!(change(&[0.0, 0.0, 0.0, 9.0, 9.0]), None);
        assert_eq!(change(&[1.0; 30]), None);
        assert_eq!(change(&[f64::NAN; 30]), None);
        let step = change(&[1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0]).unwrap();
        assert_eq!((step.first, step.before, step.after), (4, 1.0, 2.0));
        assert!(step.p < 1e-6);
    }
}
