//! One, two and k independent samples, proportions and multiplicity against SciPy and statsmodels.

use serde_json::Value;
use snug_statistics::assumptions::{brown_forsythe, shapiro_wilk};
use snug_statistics::descriptive::{mean, one_sample_t, quantile, standard_deviation};
use snug_statistics::k_sample::{kruskal_wallis, one_way_anova, welch_anova};
use snug_statistics::multiplicity::benjamini_hochberg;
use snug_statistics::proportion::wilson;
use snug_statistics::two_sample::{
    TwoSampleT, mann_whitney, standardized_difference, student_t, welch_t,
};

use crate::reference::{assert_all_near, assert_near, cases, numbers, table};

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
        near(mean(&x).unwrap(), "mean", STATISTIC);
        near(standard_deviation(&x).unwrap(), "sd", tolerance);
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
        let found = one_sample_t(&x, 2.0, 0.95).unwrap();
        assert_all_near(
            &[found.interval.low, found.interval.high],
            &numbers(&case["interval"]),
            tolerance,
            0.0,
            name,
        );
        let t = found.test;
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
        let g = standardized_difference(&x, &y, 0.95).unwrap();
        let found = [g.cohens_d, g.hedges_g, g.interval.low, g.interval.high];
        assert_all_near(&found, &numbers(&case["g"]), P, 1e-3, &name);
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
        near(&brown_forsythe(&groups).unwrap(), "brown_forsythe");
        let welch = welch_anova(&groups).unwrap();
        let df = welch.degrees_of_freedom;
        let found = [welch.statistic, df[0], df[1], welch.p];
        assert_all_near(&found, &numbers(&case["welch"]), P, 0.0, &name);
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
}

#[test]
fn adjusted_p_values() {
    let table = table(include_str!("reference/multiplicity.json"));
    assert_all_near(
        &benjamini_hochberg(&numbers(&table["p"])).unwrap(),
        &numbers(&table["benjamini_hochberg"]),
        1e-13,
        0.0,
        "Benjamini–Hochberg",
    );
}
