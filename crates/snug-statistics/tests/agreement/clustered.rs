//! Random-intercept and cluster-robust fits against statsmodels and dense-matrix evaluations.

use serde_json::Value;
use snug_statistics::clustered::{Design, fit_cluster_robust, fit_random_intercept};

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

/// The contrast that picks one coefficient: its F is the square of estimate over standard error.
fn unit(column: usize, columns: usize) -> Vec<Vec<f64>> {
    let mut row = vec![0.0; columns];
    row[column] = 1.0;
    vec![row]
}

fn squared_t(expected: &Value) -> f64 {
    let number = |key: &str| expected[key].as_f64().unwrap();
    (number("estimate") / number("se")).powi(2)
}

#[test]
fn random_intercepts() {
    for case in cases(include_str!("reference/clustered.json")) {
        let name = case["name"].as_str().unwrap();
        let response = numbers(&case["response"]);
        let design = design(&case);
        let fit = fit_random_intercept(&design, &ids(&case["cluster"]), &response).unwrap();
        // The reference minimises without derivatives: its variances are good to 1e-7 or so.
        let number = |key: &str| case[key].as_f64().unwrap();
        assert_near(fit.restricted_deviance, number("reml"), 1e-11, 0.0, name);
        assert_near(fit.between_variance, number("between"), 2e-6, 1e-3, name);
        assert_near(fit.residual_variance, number("residual"), 2e-6, 0.0, name);
        let columns = design.names().len();
        for (column, expected) in case["coefficients"].as_array().unwrap().iter().enumerate() {
            let test = fit.test_contrasts(&unit(column, columns)).unwrap();
            let what = format!("{name}: {}", design.names()[column]);
            assert_near(test.statistic, squared_t(expected), 1e-6, 1e-2, &what);
        }
        let test = fit.test_term("target").unwrap();
        assert_near(test.statistic, number("target_test"), 1e-5, 0.0, name);
        // Four columns vary within clusters: joint, two of target, pace.
        let freedom = (response.len() - fit.clusters - 4) as f64;
        assert_eq!(test.degrees_of_freedom, [2.0, freedom], "{name}");
        let other = &case["statsmodels"];
        if !other.is_null() {
            let number = |key: &str| other[key].as_f64().unwrap();
            assert_near(fit.between_variance, number("between"), 1e-4, 0.0, name);
            assert_near(fit.residual_variance, number("residual"), 1e-4, 0.0, name);
        }
    }
}

#[test]
fn cluster_robust() {
    for case in cases(include_str!("reference/clustered.json")) {
        let name = case["name"].as_str().unwrap();
        let response = numbers(&case["response"]);
        let design = design(&case);
        let fit = fit_cluster_robust(&design, &ids(&case["cluster"]), &response).unwrap();
        let columns = design.names().len();
        for (column, expected) in case["robust"].as_array().unwrap().iter().enumerate() {
            let test = fit.test_contrasts(&unit(column, columns)).unwrap();
            let what = format!("{name}: {}", design.names()[column]);
            assert_near(test.statistic, squared_t(expected), 1e-9, 1e-2, &what);
            let df = expected["df"].as_f64().unwrap();
            assert_near(test.degrees_of_freedom[1], df, 1e-9, 0.0, &what);
        }
        let test = fit.test_term("target").unwrap();
        let found = [test.statistic, test.degrees_of_freedom[1], test.p];
        assert_all_near(&found, &numbers(&case["robust_target"]), 1e-9, 0.0, name);
    }
}
