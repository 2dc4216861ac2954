//! Random-intercept fits with closed-form or published answers.

use snug_statistics::StatisticsError;
use snug_statistics::clustered::{Design, fit_cluster_robust, fit_random_intercept};
use snug_statistics::descriptive::one_sample_t;
use snug_statistics::k_sample::one_way_anova;

use crate::reference::assert_near;

/// Yield of dyestuff from five samples of each of six batches (Davies 1947; Box and Tiao 1973).
const DYESTUFF: [f64; 30] = [
    1545., 1440., 1440., 1520., 1580., 1540., 1555., 1490., 1560., 1495., 1595., 1550., 1605.,
    1510., 1560., 1445., 1440., 1595., 1465., 1545., 1595., 1630., 1515., 1635., 1625., 1520.,
    1455., 1450., 1480., 1445.,
];

fn batches(size: usize, count: usize) -> Vec<usize> {
    (0..size * count).map(|row| row / size).collect()
}

#[test]
fn dyestuff_as_published() {
    let batch = batches(5, 6);
    let fit = fit_random_intercept(&Design::intercept(30), &batch, &DYESTUFF).unwrap();
    // lme4's documentation prints 1764, 2451 and the REML criterion 319.6543. Balanced, the
    // estimates are the mean squares': (11271.5 − 2451.25)/5 and 2451.25.
    assert_near(fit.between_variance, 1764.05, 1e-10, 0.0, "between");
    assert_near(fit.residual_variance, 2451.25, 1e-12, 0.0, "within");
    assert_near(fit.restricted_deviance, 319.6543, 2e-7, 0.0, "criterion");
    // The mean over its standard error, squared: six batches leave five degrees of freedom.
    let mean = fit.test_term("intercept").unwrap();
    let exact = 1527.5_f64.powi(2) / (11271.5 / 30.0);
    assert_near(mean.statistic, exact, 1e-10, 0.0, "mean over its error");
    assert_eq!(mean.degrees_of_freedom, [1.0, 5.0]);
}

#[test]
fn a_large_common_offset_changes_nothing() {
    let batch = batches(5, 6);
    let shifted = DYESTUFF.map(|y| y + 1e9);
    let plain = fit_random_intercept(&Design::intercept(30), &batch, &DYESTUFF).unwrap();
    let moved = fit_random_intercept(&Design::intercept(30), &batch, &shifted).unwrap();
    assert_near(
        moved.between_variance,
        plain.between_variance,
        1e-12,
        0.0,
        "between",
    );
    let mean = moved.test_term("intercept").unwrap();
    let exact = (1e9 + 1527.5_f64).powi(2) / (11271.5 / 30.0);
    assert_near(mean.statistic, exact, 1e-10, 0.0, "mean over its error");
}

/// Balanced data, a factor between clusters: the F test is the analysis of variance of the
/// cluster means, whatever the variance components.
#[test]
fn a_balanced_factor_between_clusters_is_tested_on_cluster_means() {
    let batch = batches(5, 6);
    let supplier: Vec<usize> = batch.iter().map(|b| b % 2).collect();
    let design = Design::intercept(30).factor("supplier", &supplier).unwrap();
    let fit = fit_random_intercept(&design, &batch, &DYESTUFF).unwrap();
    let means: Vec<f64> = DYESTUFF
        .chunks(5)
        .map(|c| c.iter().sum::<f64>() / 5.0)
        .collect();
    let even = [means[0], means[2], means[4]];
    let odd = [means[1], means[3], means[5]];
    let exact = one_way_anova(&[even, odd]).unwrap().test;
    let found = fit.test_term("supplier").unwrap();
    assert_near(found.statistic, exact.statistic, 1e-9, 0.0, "F");
    assert_eq!(found.degrees_of_freedom, [1.0, 4.0]);
    assert_near(found.p, exact.p, 1e-8, 0.0, "p");
}

/// Balanced data, a factor within clusters: the F test is the block-design's.
#[test]
fn a_balanced_factor_within_clusters_is_tested_against_the_block_residual() {
    let batch = batches(5, 6);
    let position: Vec<usize> = (0..30).map(|row| row % 5).collect();
    let design = Design::intercept(30).factor("position", &position).unwrap();
    let fit = fit_random_intercept(&design, &batch, &DYESTUFF).unwrap();
    let mean = |values: &dyn Fn(usize) -> bool| {
        let chosen: Vec<f64> = (0..30)
            .filter(|i| values(*i))
            .map(|i| DYESTUFF[i])
            .collect();
        chosen.iter().sum::<f64>() / chosen.len() as f64
    };
    let grand = mean(&|_| true);
    let row_means: Vec<f64> = (0..6).map(|b| mean(&|i| i / 5 == b)).collect();
    let column_means: Vec<f64> = (0..5).map(|p| mean(&|i| i % 5 == p)).collect();
    let between: f64 = column_means.iter().map(|m| 6.0 * (m - grand).powi(2)).sum();
    let rest: f64 = (0..30)
        .map(|i| (DYESTUFF[i] - row_means[i / 5] - column_means[i % 5] + grand).powi(2))
        .sum();
    let exact = (between / 4.0) / (rest / 20.0);
    let found = fit.test_term("position").unwrap();
    assert_near(found.statistic, exact, 1e-9, 0.0, "F");
    assert_eq!(found.degrees_of_freedom, [4.0, 20.0]);
}

/// Two balanced conditions in each cluster, clusters in the design: the cluster-robust test is
/// the paired t test of the clusters' differences, however they vary.
#[test]
fn cluster_robust_with_clusters_in_the_design_is_the_paired_t_test() {
    let batch = batches(4, 6);
    let response = &DYESTUFF[..24];
    let joint: Vec<usize> = (0..24).map(|row| row % 2).collect();
    let design = Design::intercept(24)
        .factor("batch", &batch)
        .unwrap()
        .factor("joint", &joint)
        .unwrap();
    let found = fit_cluster_robust(&design, &batch, response).unwrap();
    let found = found.test_term("joint").unwrap();
    let differences: Vec<f64> = response
        .chunks(4)
        .map(|c| (c[1] + c[3] - c[0] - c[2]) / 2.0)
        .collect();
    let exact = one_sample_t(&differences, 0.0, 0.95).unwrap().test;
    assert_near(found.statistic, exact.statistic.powi(2), 1e-10, 0.0, "t²");
    assert_near(found.degrees_of_freedom[1], 5.0, 1e-10, 0.0, "df");
}

#[test]
fn unusable_designs_are_named() {
    let batch = batches(5, 6);
    let position: Vec<usize> = (0..30).map(|row| row % 5).collect();
    let plain = Design::intercept(30);
    let fit = |design: &Design, cluster: &[usize], y: &[f64]| {
        fit_random_intercept(design, cluster, y).err().unwrap()
    };
    let one = fit(&plain, &[4; 30], &DYESTUFF);
    assert!(matches!(
        one,
        StatisticsError::TooFewGroups {
            what: "clusters",
            found: 1,
            ..
        }
    ));
    let taken = plain.clone().factor("batch", &batch).unwrap();
    let taken = fit(&taken, &batch, &DYESTUFF);
    assert!(matches!(
        taken,
        StatisticsError::NoFreedomLeft {
            what: "variation between clusters",
            ..
        }
    ));
    let alone: Vec<usize> = (0..30).collect();
    let alone = fit(&plain, &alone, &DYESTUFF);
    assert!(matches!(
        alone,
        StatisticsError::NoFreedomLeft {
            what: "variation within clusters",
            ..
        }
    ));
    let doubled: Vec<f64> = position.iter().map(|p| 3.0 * *p as f64 - 1.0).collect();
    let doubled = plain
        .clone()
        .factor("position", &position)
        .unwrap()
        .covariate("again", &doubled);
    let doubled = fit(&doubled.unwrap(), &batch, &DYESTUFF);
    assert!(matches!(doubled, StatisticsError::RankDeficient { column } if column == "again"));
}

#[test]
fn unusable_responses_and_contrasts_are_named() {
    let batch = batches(5, 6);
    let plain = Design::intercept(30);
    let fit =
        |cluster: &[usize], y: &[f64]| fit_random_intercept(&plain, cluster, y).err().unwrap();
    assert!(matches!(
        fit(&batch, &[0.1; 30]),
        StatisticsError::ZeroVariance { .. }
    ));
    let steps: Vec<f64> = batch.iter().map(|b| (*b as f64).sqrt()).collect();
    let steps = fit(&batch, &steps);
    assert!(matches!(
        steps,
        StatisticsError::VarianceRatioUnbounded { .. }
    ));
    let mut hole = DYESTUFF;
    hole[7] = f64::NAN;
    assert!(matches!(
        fit(&batch, &hole),
        StatisticsError::NotFinite { index: 7, .. }
    ));
    let short = fit(&batch[1..], &DYESTUFF);
    assert!(matches!(short, StatisticsError::LengthMismatch { .. }));
    let sound = fit_random_intercept(&plain, &batch, &DYESTUFF).unwrap();
    let none = sound.test_contrasts(&[vec![0.0]]);
    assert!(matches!(
        none,
        Err(StatisticsError::DependentContrasts { .. })
    ));
    let twice = sound.test_contrasts(&[vec![1.0], vec![2.0]]);
    assert!(matches!(
        twice,
        Err(StatisticsError::DependentContrasts { .. })
    ));
}
