//! Random-intercept and cluster-robust fits against statsmodels and dense-matrix evaluations.

use serde_json::Value;
use snug_statistics::clustered::{
    ContrastEstimate, DenominatorFreedom, Design, fit_cluster_robust, fit_random_intercept,
};

use crate::reference::{assert_all_near, assert_near, cases, ids, numbers, texts};

fn design(case: &Value) -> Design {
    let pace = numbers(&case["pace"]);
    let design = Design::intercept(pace.len())
        .factor("joint", &texts(&case["joint"]))
        .unwrap()
        .factor("target", &texts(&case["target"]))
        .unwrap()
        .covariate("pace", &pace)
        .unwrap();
    if case["sex"].is_null() {
        design
    } else {
        design.factor("sex", &texts(&case["sex"])).unwrap()
    }
}

fn compare(found: &[ContrastEstimate], expected: &Value, df_tolerance: f64, name: &str) {
    for (found, expected) in found.iter().zip(expected.as_array().unwrap()) {
        let what = format!("{name}: {}", found.name);
        let near = |found: f64, key: &str, tolerance: f64| {
            assert_near(
                found,
                expected[key].as_f64().unwrap(),
                tolerance,
                1e-2,
                &what,
            );
        };
        near(found.estimate, "estimate", 1e-7);
        near(found.standard_error, "se", 1e-7);
        near(found.test.degrees_of_freedom[0], "df", df_tolerance);
    }
}

#[test]
fn random_intercepts() {
    for case in cases(include_str!("reference/clustered.json")) {
        let name = case["name"].as_str().unwrap();
        let response = numbers(&case["response"]);
        let fit = fit_random_intercept(&design(&case), &ids(&case["cluster"]), &response).unwrap();
        // The reference minimises without derivatives: its variances are good to 1e-7 or so.
        let number = |key: &str| case[key].as_f64().unwrap();
        assert_near(fit.restricted_deviance, number("reml"), 1e-11, 0.0, name);
        assert_near(fit.between_variance, number("between"), 2e-6, 1e-3, name);
        assert_near(fit.residual_variance, number("residual"), 2e-6, 0.0, name);
        let found = fit
            .coefficients(DenominatorFreedom::Satterthwaite, 0.95)
            .unwrap();
        // Their Hessian is by finite differences.
        compare(&found, &case["coefficients"], 1e-5, name);
        let test = fit
            .test_term("target", DenominatorFreedom::Satterthwaite)
            .unwrap();
        let found = [test.statistic, test.degrees_of_freedom[1], test.p];
        assert_all_near(&found, &numbers(&case["target_test"]), 1e-5, 0.0, name);
        let other = &case["statsmodels"];
        if !other.is_null() {
            let found = fit
                .coefficients(DenominatorFreedom::BetweenWithin, 0.95)
                .unwrap();
            let estimates: Vec<f64> = found.iter().map(|c| c.estimate).collect();
            assert_all_near(&estimates, &numbers(&other["fe"]), 1e-4, 1e-2, name);
            assert_near(
                fit.between_variance,
                other["between"].as_f64().unwrap(),
                1e-4,
                0.0,
                name,
            );
            assert_near(
                fit.residual_variance,
                other["residual"].as_f64().unwrap(),
                1e-4,
                0.0,
                name,
            );
        }
    }
}

#[test]
fn cluster_robust() {
    for case in cases(include_str!("reference/clustered.json")) {
        let name = case["name"].as_str().unwrap();
        let response = numbers(&case["response"]);
        let fit = fit_cluster_robust(&design(&case), &ids(&case["cluster"]), &response).unwrap();
        compare(
            &fit.coefficients(0.95).unwrap(),
            &case["robust"],
            1e-9,
            name,
        );
        let test = fit.test_term("target").unwrap();
        let found = [test.statistic, test.degrees_of_freedom[1], test.p];
        assert_all_near(&found, &numbers(&case["robust_target"]), 1e-9, 0.0, name);
    }
}
