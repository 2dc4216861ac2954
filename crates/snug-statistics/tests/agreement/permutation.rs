//! Permutation tests against full enumerations by another program, and their guarantee.

use snug_statistics::StatisticsError;
use snug_statistics::clustered::{PermutationSettings, Scheme, permutation_test};

use crate::reference::{assert_near, cases, ids, numbers};

#[test]
fn full_enumerations() {
    for case in cases(include_str!("reference/permutation.json")) {
        let (label, cluster) = (ids(&case["label"]), ids(&case["cluster"]));
        let response = numbers(&case["response"]);
        let found =
            permutation_test(&response, &label, &cluster, &PermutationSettings::default()).unwrap();
        let scheme: Scheme = serde_json::from_value(case["scheme"].clone()).unwrap();
        assert_eq!((found.scheme, found.exact), (scheme, true));
        assert_eq!(
            found.arrangements as u64,
            case["arrangements"].as_u64().unwrap()
        );
        assert_near(found.test.p, case["p"].as_f64().unwrap(), 1e-12, 0.0, "p");
        assert_near(
            found.test.statistic,
            case["eta"].as_f64().unwrap(),
            1e-10,
            0.0,
            "η²",
        );

        let random = PermutationSettings {
            exact_limit: 0,
            ..Default::default()
        };
        let again = permutation_test(&response, &label, &cluster, &random).unwrap();
        let p = found.test.p;
        // Four standard errors of a share of 9999.
        assert!((again.test.p - p).abs() < 4.0 * (p * (1.0 - p) / 9999.0).sqrt() + 1e-4);
        assert_eq!(
            again,
            permutation_test(&response, &label, &cluster, &random).unwrap()
        );
    }
}

#[test]
fn p_is_never_zero_and_counts_the_observed_arrangement() {
    let response: Vec<f64> = (0..40)
        .map(|i| f64::from(i % 2) * 100.0 + f64::from(i))
        .collect();
    let label: Vec<usize> = (0..40).map(|i| i % 2).collect();
    let cluster: Vec<usize> = (0..40).map(|i| i / 10).collect();
    let settings = PermutationSettings {
        permutations: 99,
        ..Default::default()
    };
    let found = permutation_test(&response, &label, &cluster, &settings).unwrap();
    assert!(!found.exact);
    assert_eq!(found.test.p, 0.01);
}

#[test]
fn unusable_labels_are_named() {
    let settings = PermutationSettings::default();
    let y = [1.0, 2.0, 3.0, 5.0];
    let one = permutation_test(&y, &[1; 4], &[1, 1, 2, 2], &settings);
    assert!(matches!(
        one,
        Err(StatisticsError::TooFewGroups { what: "labels", .. })
    ));
    let flat = permutation_test(&[0.1; 4], &[1, 2, 1, 2], &[1, 1, 2, 2], &settings);
    assert!(matches!(flat, Err(StatisticsError::ZeroVariance { .. })));
    let none = PermutationSettings {
        permutations: 0,
        ..settings
    };
    let none = permutation_test(&y, &[1, 2, 1, 2], &[1, 1, 2, 2], &none);
    assert!(matches!(
        none,
        Err(StatisticsError::OutOfRange {
            argument: "permutations",
            ..
        })
    ));
}
