//! False-alarm rates on simulated participants that differ, with nothing else going on.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use snug_statistics::assumptions::{brown_forsythe, residuals, shapiro_wilk};
use snug_statistics::clustered::{
    Design, PermutationSettings, fit_cluster_robust, fit_random_intercept, permutation_test,
};
use snug_statistics::distributions::normal_quantile;
use snug_statistics::two_sample::welch_t;

const CAMPAIGNS: usize = 500;
/// Nominal 5 % plus four standard errors of a share of 500.
const MOST: usize = 45;

fn normal(generator: &mut ChaCha8Rng) -> f64 {
    normal_quantile(generator.random_range(1e-12..1.0))
}

/// Eight participants of 20 rows, SD 1 between and 1 within; labels as given.
fn false_alarms(label: impl Fn(usize, usize) -> usize, respond: f64) -> [usize; 4] {
    let mut generator = ChaCha8Rng::seed_from_u64(5);
    let cluster: Vec<usize> = (0..160).map(|row| row / 20).collect();
    let labels: Vec<usize> = (0..160).map(|row| label(row / 20, row % 20)).collect();
    let mut alarms = [0; 4];
    for seed in 0..CAMPAIGNS {
        let level: Vec<f64> = (0..8).map(|_| normal(&mut generator)).collect();
        let own: Vec<f64> = (0..8).map(|_| respond * normal(&mut generator)).collect();
        let y: Vec<f64> = (0..160)
            .map(|row| {
                let cluster = row / 20;
                level[cluster] + own[cluster] * labels[row] as f64 + normal(&mut generator)
            })
            .collect();
        let pick = |wanted: usize| -> Vec<f64> {
            (0..160)
                .filter(|row| labels[*row] == wanted)
                .map(|row| y[row])
                .collect()
        };
        let design = Design::intercept(160).factor("label", &labels).unwrap();
        let mixed = fit_random_intercept(&design, &cluster, &y).unwrap();
        let robust = fit_cluster_robust(&design, &cluster, &y).unwrap();
        let settings = PermutationSettings {
            permutations: 199,
            seed: seed as u64,
            ..Default::default()
        };
        let p = [
            welch_t(&pick(0), &pick(1), 0.95).unwrap().test.p,
            mixed.test_term("label").unwrap().p,
            robust.test_term("label").unwrap().p,
            permutation_test(&y, &labels, &cluster, &settings)
                .unwrap()
                .test
                .p,
        ];
        alarms
            .iter_mut()
            .zip(p)
            .for_each(|(count, p)| *count += usize::from(p <= 0.05));
    }
    alarms
}

#[test]
fn labels_between_participants() {
    let [naive, mixed, robust, permutation] = false_alarms(|cluster, _| cluster % 2, 0.0);
    println!("{naive} {mixed} {robust} {permutation} of {CAMPAIGNS}");
    assert!(naive > CAMPAIGNS / 3, "rows as if independent: {naive}");
    for count in [mixed, robust, permutation] {
        assert!((5..=MOST).contains(&count), "{count}");
    }
}

#[test]
fn labels_within_participants() {
    let [_, mixed, robust, permutation] =
        false_alarms(|cluster, row| usize::from(row < 6 + cluster), 0.0);
    for count in [mixed, robust, permutation] {
        assert!((5..=MOST).contains(&count), "{count}");
    }
}

/// Participants that each respond in their own way: only the cluster-robust test still holds,
/// which is what it is for.
#[test]
fn participants_that_respond_differently() {
    let [_, mixed, robust, _] = false_alarms(|_, row| row % 2, 1.0);
    assert!(mixed > CAMPAIGNS / 5, "random intercept alone: {mixed}");
    assert!(robust <= MOST, "{robust}");
}

/// Four groups of twelve values with different means: how often normality of the residuals and
/// equality of the variances are doubted.
fn doubts(value: impl Fn(usize, f64) -> f64) -> [usize; 2] {
    let mut generator = ChaCha8Rng::seed_from_u64(7);
    let mut doubts = [0; 2];
    for _ in 0..CAMPAIGNS {
        let groups: Vec<Vec<f64>> = (0..4)
            .map(|group| {
                (0..12)
                    .map(|_| 3.0 * group as f64 + value(group, normal(&mut generator)))
                    .collect()
            })
            .collect();
        let checks = [
            shapiro_wilk(&residuals(&groups)).unwrap().p,
            brown_forsythe(&groups).unwrap().p,
        ];
        doubts
            .iter_mut()
            .zip(checks)
            .for_each(|(count, p)| *count += usize::from(p <= 0.05));
    }
    doubts
}

/// A check doubts what holds in 5 % of the cases or less, and mostly finds what does not.
#[test]
fn assumptions_are_doubted_where_they_do_not_hold() {
    let [residuals, variances] = doubts(|_, z| z);
    println!("{residuals} and {variances} of {CAMPAIGNS} sound campaigns doubted");
    assert!((5..=MOST).contains(&residuals), "{residuals}");
    assert!((5..=MOST).contains(&variances), "{variances}");
    let [skewed, _] = doubts(|_, z| z.exp());
    assert!(skewed > CAMPAIGNS * 9 / 10, "log-normal values: {skewed}");
    let [_, unequal] = doubts(|group, z| if group == 0 { 4.0 * z } else { z });
    assert!(
        unequal > CAMPAIGNS * 3 / 4,
        "one group four times as wide: {unequal}"
    );
}
