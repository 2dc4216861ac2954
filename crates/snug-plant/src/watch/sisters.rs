//! Whether a group differs from its sisters beyond how much these differ among each other: a random-effects model of the others
//! (restricted maximum likelihood), and this one's externally studentised deleted residual (Viechtbauer and Cheung 2010).
//!
//! Groups that lie outside by their median absolute deviation (Hampel 1974) are no yardstick, so that several alike do not hide
//! each other.

use super::thresholds::{FEWEST_SISTERS, OUTLYING_MADS};
use snug_statistics::StatisticsError;
use snug_statistics::descriptive::{MAD_OF_NORMAL, median};
use snug_statistics::distributions::student_t_two_sided;
use snug_statistics::random_effects::random_effects;

/// A group beside its sisters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beside {
    /// What the others have on average, in the quantity's unit.
    pub mean: f64,
    /// Standard deviation between them, beyond their own errors, in the quantity's unit.
    pub spread: f64,
    /// That a sister would lie so far out.
    pub p: f64,
}

/// Every group beside its sisters; `None` where these are too few or do not differ at all.
///
/// # Errors
/// As [`random_effects`].
pub fn beside(
    estimates: &[f64],
    variances: &[f64],
) -> Result<Vec<Option<Beside>>, StatisticsError> {
    let yardsticks = yardsticks(estimates)?;
    let all: Vec<usize> = (0..estimates.len())
        .filter(|&index| yardsticks[index])
        .collect();
    let mut of_all = None;
    let mut found = Vec::with_capacity(estimates.len());
    for index in 0..estimates.len() {
        let others: Vec<usize> = all
            .iter()
            .copied()
            .filter(|&other| other != index)
            .collect();
        if others.len() < FEWEST_SISTERS {
            found.push(None);
            continue;
        }
        // Those that are no yardstick all have the same sisters.
        let known = (!yardsticks[index]).then_some(of_all).flatten();
        let (mean, error, spread) = match known {
            Some(known) => known,
            None => {
                let pick = |values: &[f64]| {
                    others
                        .iter()
                        .map(|&other| values[other])
                        .collect::<Vec<_>>()
                };
                let model = random_effects(&pick(estimates), &pick(variances))?;
                let known = (model.mean, model.standard_error, model.spread);
                if !yardsticks[index] {
                    of_all = Some(known);
                }
                known
            }
        };
        let deviation = (variances[index] + spread * spread + error * error).sqrt();
        let t = (estimates[index] - mean) / deviation;
        let p = student_t_two_sided(t, (others.len() - 1) as f64);
        found.push(Some(Beside { mean, spread, p }));
    }
    Ok(found)
}

fn yardsticks(estimates: &[f64]) -> Result<Vec<bool>, StatisticsError> {
    if estimates.is_empty() {
        return Ok(Vec::new());
    }
    let middle = median(estimates)?;
    let away: Vec<f64> = estimates.iter().map(|one| (one - middle).abs()).collect();
    let reach = OUTLYING_MADS * median(&away)? / MAD_OF_NORMAL;
    Ok(away.iter().map(|away| *away <= reach).collect())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn three_alike_among_twelve_do_not_hide_each_other() {
        let scatter = [0.3, -0.5, 0.1, 0.9, -0.2, -0.8, 0.4, 0.0, -0.1];
        let mut estimates = scatter.to_vec();
        estimates.extend([8.0, 8.3, 7.7]);
        let found = beside(&estimates, &[0.04; 12]).unwrap();
        let p: Vec<f64> = found.iter().map(|one| one.unwrap().p).collect();
        assert!(p[..9].iter().all(|p| *p > 0.05), "{p:?}");
        assert!(p[9..].iter().all(|p| *p < 1e-5), "{p:?}");
        assert!((found[9].unwrap().mean - 0.011).abs() < 0.05);
    }

    #[test]
    fn few_sisters_say_nothing() {
        assert!(
            beside(&[1.0, 2.0, 9.0], &[0.1; 3])
                .unwrap()
                .iter()
                .all(Option::is_none)
        );
        assert!(beside(&[], &[]).unwrap().is_empty());
    }
}
