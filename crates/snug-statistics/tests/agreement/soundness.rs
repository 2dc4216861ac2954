//! Whatever the input, an answer is sound or there is an error: no panic, no NaN.

use proptest::prelude::*;
use snug_statistics::assumptions::{brown_forsythe, replicated, residuals, shapiro_wilk, tied};
use snug_statistics::clustered::{
    Design, PermutationSettings, fit_cluster_robust, fit_random_intercept, permutation_test,
};
use snug_statistics::descriptive::{mean, median, one_sample_t, standard_deviation};
use snug_statistics::k_sample::{kruskal_wallis, one_way_anova, welch_anova};
use snug_statistics::two_sample::{mann_whitney, standardized_difference, student_t, welch_t};
use snug_statistics::{Result, TestResult};

/// Values as bad data brings them: ties, zeros, extremes, holes.
fn value() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => (-3_i32..4).prop_map(f64::from),
        3 => -10.0_f64..10.0,
        1 => prop_oneof![Just(1e150), Just(-1e-200), Just(1e12), Just(0.1), Just(1e300)],
        1 => prop_oneof![19 => Just(-0.0), 1 => Just(f64::NAN), 1 => Just(f64::INFINITY)],
    ]
}

fn sample() -> impl Strategy<Value = Vec<f64>> {
    prop_oneof![
        8 => proptest::collection::vec(value(), 0..14),
        1 => (value(), 0_usize..9).prop_map(|(value, count)| vec![value; count]),
    ]
}

fn check(name: &str, found: Result<TestResult>) {
    if let Ok(test) = found {
        assert!((0.0..=1.0).contains(&test.p), "{name}: {test:?}");
        assert!(!test.statistic.is_nan(), "{name}: {test:?}");
        assert!(
            test.degrees_of_freedom.iter().all(|df| *df > 0.0),
            "{name}: {test:?}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..Default::default() })]

    #[test]
    fn samples(a in sample(), b in sample(), c in sample()) {
        check("one-sample t", one_sample_t(&a, 0.5, 0.95).map(|r| r.test));
        check("Student", student_t(&a, &b, 0.95).map(|r| r.test));
        check("Welch", welch_t(&a, &b, 0.95).map(|r| r.test));
        check("U", mann_whitney(&a, &b).map(|r| r.test));
        check("Shapiro", shapiro_wilk(&a));
        let groups = [a.clone(), b.clone(), c.clone()];
        check("F", one_way_anova(&groups).map(|r| r.test));
        check("Welch F", welch_anova(&groups));
        check("H", kruskal_wallis(&groups).map(|r| r.test));
        check("Brown–Forsythe", brown_forsythe(&groups));
        let groups = replicated(&groups);
        let left = residuals(&groups);
        prop_assert!(tied(&left) <= left.len());
        check("Shapiro of residuals", shapiro_wilk(&left));
        check("Brown–Forsythe of replicated groups", brown_forsythe(&groups));
        prop_assert!(mean(&a).map_or(true, |mean| !mean.is_nan()));
        prop_assert!(median(&a).map_or(true, |middle| !middle.is_nan()));
        prop_assert!(standard_deviation(&a).map_or(true, |spread| spread >= 0.0));
    }

    #[test]
    fn clusters(rows in proptest::collection::vec((value(), 0_usize..4, 0_usize..3), 0..24)) {
        let response: Vec<f64> = rows.iter().map(|row| row.0).collect();
        let cluster: Vec<usize> = rows.iter().map(|row| row.1).collect();
        let label: Vec<usize> = rows.iter().map(|row| row.2).collect();
        let settings = PermutationSettings { permutations: 20, exact_limit: 100, ..Default::default() };
        check("permutation", permutation_test(&response, &label, &cluster, &settings).map(|r| r.test));
        let Ok(design) = Design::intercept(rows.len()).factor("label", &label) else {
            return Ok(());
        };
        if let Ok(fit) = fit_random_intercept(&design, &cluster, &response) {
            prop_assert!(fit.between_variance >= 0.0 && fit.residual_variance > 0.0);
            prop_assert!(fit.restricted_deviance.is_finite());
            check("mixed F", fit.test_term("label"));
            check("mixed mean", fit.test_term("intercept"));
        }
        if let Ok(fit) = fit_cluster_robust(&design, &cluster, &response) {
            check("robust F", fit.test_term("label"));
            check("robust mean", fit.test_term("intercept"));
        }
    }

    #[test]
    fn differences(a in sample(), b in sample()) {
        // The noncentral t search is the slow one; a share of the cases is enough.
        if a.len() + b.len() < 8
            && let Ok(found) = standardized_difference(&a, &b, 0.95)
        {
            prop_assert!(found.interval.low <= found.interval.high, "{found:?}");
        }
    }
}
