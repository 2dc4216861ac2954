//! One, two and k independent samples, correlation, proportions and multiplicity against SciPy
//! and statsmodels.

use serde_json::Value;
use snug_statistics::assumptions::{Center, levene, shapiro_wilk};
use snug_statistics::correlation::{pearson, spearman};
use snug_statistics::descriptive::{histogram, one_sample_t, quantile, summarize};
use snug_statistics::k_sample::{kruskal_wallis, one_way_anova, welch_anova};
use snug_statistics::multiplicity::Adjustment;
use snug_statistics::proportion::{chi_squared, fisher_exact, wilson};
use snug_statistics::two_sample::{
    TwoSampleT, brunner_munzel, mann_whitney, standardized_difference, student_t, welch_t,
    wilcoxon_signed_rank,
};

use crate::reference::{assert_all_near, assert_near, cases, ids, numbers, table};

/// Statistics agree to rounding; p values to the log-gamma function's error in their tails.
const STATISTIC: f64 = 1e-12;
const P: f64 = 1e-9;

fn sample(samples: &Value, name: &Value) -> Vec<f64> {
    numbers(&samples[name.as_str().unwrap()])
}

fn samples() -> Value {
    table(include_str!("reference/samples.json"))
}

#[test]
fn one_sample() {
    let samples = samples();
    for case in cases(include_str!("reference/one_sample.json")) {
        let x = sample(&samples, &case["sample"]);
        let name = case["sample"].as_str().unwrap();
        // The reference sums in plain f64: a common offset of 1e6 costs it six digits of the
        // spread.
        let tolerance = if name == "offset15" { 1e-8 } else { STATISTIC };
        let near = |found: f64, key: &str, tolerance: f64| {
            assert_near(found, case[key].as_f64().unwrap(), tolerance, 1e-9, name);
        };
        let found = summarize(&x, 0.95).unwrap();
        near(found.mean, "mean", STATISTIC);
        near(found.standard_deviation.unwrap(), "sd", tolerance);
        near(found.skewness.unwrap(), "skew", 100.0 * tolerance);
        let interval = found.mean_interval.unwrap();
        let limits = numbers(&case["interval"]);
        assert_all_near(
            &[interval.low, interval.high],
            &limits,
            tolerance,
            0.0,
            name,
        );
        let quantiles: Vec<f64> = [0.1, 0.25, 0.5, 0.75, 0.95]
            .iter()
            .map(|q| quantile(&x, *q).unwrap())
            .collect();
        assert_all_near(
            &quantiles,
            &numbers(&case["quantiles"]),
            STATISTIC,
            0.0,
            name,
        );
        assert_eq!(
            histogram(&x).unwrap().counts,
            ids(&case["counts"]),
            "{name}"
        );
        let t = one_sample_t(&x, 2.0, 0.95).unwrap().test;
        near(t.statistic, "t", tolerance);
        if t.p > 1e-200 {
            // With 14 degrees of freedom p falls as t to the power −14.
            near(t.p, "p", 100.0 * tolerance.max(P / 100.0));
        }
        // The reference's normal scores carry seven digits (AS 111 in single precision).
        let shapiro = shapiro_wilk(&x).unwrap();
        let expected = numbers(&case["shapiro"]);
        assert_near(shapiro.statistic, expected[0], 1e-6, 0.0, name);
        assert_near(shapiro.p, expected[1], 2e-4, 0.0, name);
    }
}

#[test]
fn two_samples() {
    let samples = samples();
    let values = |found: TwoSampleT| {
        let test = found.test;
        let df = test.degrees_of_freedom[0];
        [
            test.statistic,
            df,
            test.p,
            found.interval.low,
            found.interval.high,
        ]
    };
    for case in cases(include_str!("reference/two_sample.json")) {
        let (x, y) = (
            sample(&samples, &case["first"]),
            sample(&samples, &case["second"]),
        );
        let name = format!("{} {}", case["first"], case["second"]);
        let student = values(student_t(&x, &y, 0.95).unwrap());
        assert_all_near(&student, &numbers(&case["student"]), P, 0.0, &name);
        let welch = values(welch_t(&x, &y, 0.95).unwrap());
        assert_all_near(&welch, &numbers(&case["welch"]), P, 0.0, &name);
        let rank = mann_whitney(&x, &y).unwrap().test;
        let expected = numbers(&case["mann_whitney"]);
        assert_all_near(&[rank.statistic, rank.p], &expected, STATISTIC, 0.0, &name);
        let brunner = brunner_munzel(&x, &y).unwrap().test;
        let expected = numbers(&case["brunner_munzel"]);
        assert_all_near(&[brunner.statistic, brunner.p], &expected, P, 0.0, &name);
        let g = standardized_difference(&x, &y, 0.95).unwrap();
        let found = [g.cohens_d, g.hedges_g, g.interval.low, g.interval.high];
        assert_all_near(&found, &numbers(&case["g"]), P, 1e-3, &name);
    }
}

#[test]
fn signed_ranks() {
    for (index, case) in cases(include_str!("reference/wilcoxon.json"))
        .iter()
        .enumerate()
    {
        let found = wilcoxon_signed_rank(&numbers(&case["differences"])).unwrap();
        assert_eq!(
            found.exact,
            case["exact"].as_bool().unwrap(),
            "case {index}"
        );
        assert_eq!(
            found.test.statistic,
            case["w_plus"].as_f64().unwrap(),
            "case {index}"
        );
        let p = case["p"].as_f64().unwrap();
        assert_near(found.test.p, p, STATISTIC, 0.0, &format!("case {index}"));
    }
}

#[test]
fn k_samples() {
    let samples = samples();
    for case in cases(include_str!("reference/k_sample.json")) {
        let groups: Vec<Vec<f64>> = case["groups"]
            .as_array()
            .unwrap()
            .iter()
            .map(|name| sample(&samples, name))
            .collect();
        let name = case["groups"].to_string();
        let near = |test: &snug_statistics::TestResult, key: &str| {
            let expected = numbers(&case[key]);
            assert_all_near(
                &[test.statistic, test.p],
                &expected,
                P,
                0.0,
                &format!("{name} {key}"),
            );
        };
        near(&one_way_anova(&groups).unwrap().test, "anova");
        near(&kruskal_wallis(&groups).unwrap().test, "kruskal");
        near(&levene(&groups, Center::Median).unwrap(), "brown_forsythe");
        near(&levene(&groups, Center::Mean).unwrap(), "levene");
        let welch = welch_anova(&groups).unwrap();
        let df = welch.degrees_of_freedom;
        let found = [welch.statistic, df[0], df[1], welch.p];
        assert_all_near(&found, &numbers(&case["welch"]), P, 0.0, &name);
    }
}

#[test]
fn correlations() {
    for case in cases(include_str!("reference/correlation.json")) {
        let (x, y) = (numbers(&case["first"]), numbers(&case["second"]));
        let found = pearson(&x, &y, 0.95).unwrap();
        let interval = found.interval.unwrap();
        let found = [
            found.test.statistic,
            found.test.p,
            interval.low,
            interval.high,
        ];
        assert_all_near(&found, &numbers(&case["pearson"]), P, 0.0, "pearson");
        let found = spearman(&x, &y, 0.95).unwrap().test;
        assert_all_near(
            &[found.statistic, found.p],
            &numbers(&case["spearman"]),
            P,
            0.0,
            "rho",
        );
    }
}

#[test]
fn proportions() {
    let table = table(include_str!("reference/proportion.json"));
    for row in table["wilson"].as_array().unwrap() {
        let row = numbers(row);
        let found = wilson(row[0] as usize, row[1] as usize, 0.95)
            .unwrap()
            .interval;
        assert_all_near(
            &[found.low, found.high],
            &row[2..],
            STATISTIC,
            1.0,
            "wilson",
        );
    }
    for row in table["fisher"].as_array().unwrap() {
        let row = numbers(row);
        let count = |index: usize| row[index] as u32;
        let found = fisher_exact([[count(0), count(1)], [count(2), count(3)]]).unwrap();
        assert_near(found.test.p, row[4], P, 0.0, &format!("fisher {row:?}"));
    }
    for case in table["chi_squared"].as_array().unwrap() {
        let counts: Vec<Vec<usize>> = case["table"].as_array().unwrap().iter().map(ids).collect();
        let found = chi_squared(&counts).unwrap().test;
        let found = [found.statistic, found.p, found.degrees_of_freedom[0]];
        assert_all_near(&found, &numbers(&case["values"]), P, 0.0, "chi-squared");
    }
}

#[test]
fn adjusted_p_values() {
    let table = table(include_str!("reference/multiplicity.json"));
    let p = numbers(&table["p"]);
    for (key, adjustment) in [
        ("benjamini_hochberg", Adjustment::BenjaminiHochberg),
        ("benjamini_yekutieli", Adjustment::BenjaminiYekutieli),
        ("holm", Adjustment::Holm),
    ] {
        assert_all_near(
            &adjustment.adjust(&p).unwrap(),
            &numbers(&table[key]),
            1e-13,
            0.0,
            key,
        );
    }
}
