use rand::Rng;

use super::arrangements::Outcome;
use super::permutation_settings::PermutationSettings;
use crate::descriptive::Moments;
use crate::sample::check_sample;
use crate::{Result, StatisticsError, TestResult};

/// A permuted statistic this little (relative to the largest possible) below the observed one
/// equals it.
const TIE: f64 = 1e-12;

/// Exact test that one value per cluster (such as each participant's own difference between two
/// conditions) is symmetric about zero, by flipping signs.
///
/// The statistic is the mean. Valid also when clusters differ in how they respond. With n values
/// the smallest p is `2/2ⁿ`. All sign patterns up to `exact_limit`, else random ones; `scheme` is
/// not used.
///
/// # Errors
/// [`StatisticsError::TooFew`] for an empty sample; [`StatisticsError::NotFinite`];
/// [`StatisticsError::ZeroVariance`] when every value is zero; [`StatisticsError::OutOfRange`]
/// without permutations.
pub fn sign_flip_test(values: &[f64], settings: &PermutationSettings) -> Result<TestResult> {
    const METHOD: &str = "sign-flip test";
    settings.check()?;
    check_sample("values", values, METHOD, 1)?;
    let reach: f64 = values.iter().map(|value| value.abs()).sum();
    if reach == 0.0 {
        return Err(StatisticsError::ZeroVariance {
            sample: "values".into(),
            method: METHOD,
        });
    }
    let bar = values.iter().sum::<f64>().abs() - TIE * reach;
    let reaches = |signs: &mut dyn FnMut(usize) -> bool| {
        let signed = |(index, value): (usize, &f64)| if signs(index) { *value } else { -value };
        usize::from(values.iter().enumerate().map(signed).sum::<f64>().abs() >= bar)
    };
    let patterns = 2.0_f64.powi(i32::try_from(values.len()).unwrap_or(i32::MAX));
    let outcome = if patterns <= settings.exact_limit as f64 {
        let patterns = 1_usize << values.len();
        let reached = (0..patterns)
            .map(|mask| reaches(&mut |bit| mask >> bit & 1 == 1))
            .sum();
        Outcome {
            reached,
            arrangements: patterns,
            exact: true,
        }
    } else {
        let mut generator = settings.generator();
        let reached = (0..settings.permutations)
            .map(|_| reaches(&mut |_| generator.random()))
            .sum();
        Outcome {
            reached,
            arrangements: settings.permutations,
            exact: false,
        }
    };
    Ok(TestResult {
        method: METHOD,
        statistic_name: "mean",
        statistic: Moments::of(values).mean.to_f64(),
        degrees_of_freedom: vec![],
        p: outcome.p(),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn six_of_one_sign_reach_two_in_sixty_four() {
        let found = sign_flip_test(&[1.0, 2.0, 0.5, 3.0, 0.1, 0.2], &Default::default()).unwrap();
        assert_eq!(found.p, 2.0 / 64.0);
    }

    #[test]
    fn worked_by_hand() {
        // Sums of ±1 ±2 ±3: |6| twice, |4| twice, |2| twice, 0 twice; observed 4.
        let found = sign_flip_test(&[-1.0, 2.0, 3.0], &Default::default()).unwrap();
        assert_eq!(found.p, 0.5);
        assert!((found.statistic - 4.0 / 3.0).abs() < 1e-15);
    }

    #[test]
    fn random_flips_approach_the_exact_p() {
        let values = [0.9, -0.3, 1.4, 0.2, -0.8, 2.0, 1.1, 0.4];
        let exact = sign_flip_test(&values, &Default::default()).unwrap().p;
        let settings = PermutationSettings {
            exact_limit: 0,
            permutations: 20_000,
            ..Default::default()
        };
        let random = sign_flip_test(&values, &settings).unwrap().p;
        // Four standard errors of a share of 20 000.
        assert!((random - exact).abs() < 4.0 * (exact * (1.0 - exact) / 20_000.0).sqrt());
    }
}
