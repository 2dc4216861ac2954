//! What must not change when readings are shifted, scaled, reordered or relabelled.

use proptest::prelude::*;
use snug_statistics::assumptions::shapiro_wilk;
use snug_statistics::clustered::{Design, fit_cluster_robust, fit_random_intercept};
use snug_statistics::k_sample::{kruskal_wallis, one_way_anova, welch_anova};
use snug_statistics::multiplicity::benjamini_hochberg;
use snug_statistics::two_sample::{mann_whitney, welch_t};

/// Groups of distinct readings with two decimals, so that shifts are exact enough to keep ties.
fn groups() -> impl Strategy<Value = Vec<Vec<f64>>> {
    let reading = (-5000_i32..5000).prop_map(|hundredths| f64::from(hundredths) / 128.0);
    proptest::collection::vec(proptest::collection::vec(reading, 4..12), 3).prop_filter(
        "every group varies",
        |groups| {
            groups
                .iter()
                .all(|group| group.iter().any(|x| *x != group[0]))
        },
    )
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-8 * a.abs().max(b.abs()).max(1e-6)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..Default::default() })]

    #[test]
    fn tests_ignore_origin_and_unit(groups in groups(), shift in -4096_i32..4096, power in -20_i32..20) {
        // Powers of two and integer shifts are exact in f64.
        let map = |x: &f64| (x + f64::from(shift)) * 2.0_f64.powi(power);
        let moved: Vec<Vec<f64>> = groups.iter().map(|g| g.iter().map(map).collect()).collect();
        let both = [&groups, &moved].map(|g| [
            one_way_anova(g).unwrap().test.p,
            welch_anova(g).unwrap().p,
            kruskal_wallis(g).unwrap().test.p,
            welch_t(&g[0], &g[1], 0.9).unwrap().test.p,
            mann_whitney(&g[0], &g[1]).unwrap().test.p,
            shapiro_wilk(&g[2]).unwrap().p,
        ]);
        for (a, b) in both[0].iter().zip(&both[1]) {
            prop_assert!(close(*a, *b), "{both:?}");
        }
    }

    #[test]
    fn clustered_fits_ignore_unit_order_and_coding(groups in groups(), rotation in 1_usize..9) {
        let rows: Vec<(usize, f64, &str)> = groups
            .iter()
            .enumerate()
            .flat_map(|(cluster, g)| g.iter().enumerate().map(move |(i, y)| {
                (cluster, *y, ["soft", "hard"][i % 2])
            }))
            .collect();
        let fit = |rows: &[(usize, f64, &str)], ids: [usize; 3], unit: f64| {
            let labels: Vec<&str> = rows.iter().map(|row| row.2).collect();
            let cluster: Vec<usize> = rows.iter().map(|row| ids[row.0]).collect();
            let y: Vec<f64> = rows.iter().map(|row| unit * row.1).collect();
            let design = Design::intercept(rows.len()).factor("joint", &labels).unwrap();
            let mixed = fit_random_intercept(&design, &cluster, &y).unwrap();
            let test = mixed.test_term("joint").unwrap();
            let robust = fit_cluster_robust(&design, &cluster, &y).unwrap();
            let robust = robust.test_term("joint").unwrap();
            [
                test.statistic,
                mixed.between_variance / unit / unit,
                mixed.residual_variance / unit / unit,
                robust.statistic,
                robust.degrees_of_freedom[1],
            ]
        };
        let plain = fit(&rows, [0, 1, 2], 1.0);
        let mut turned = rows.clone();
        turned.rotate_left(rotation);
        let other = fit(&turned, [70, 3, 12], 1e3);
        for (a, b) in plain.iter().zip(&other) {
            // Variance ratios near the boundary are found to 1e-6 of the residual variance.
            prop_assert!((a - b).abs() <= 1e-6 * (a.abs() + plain[2] * 1e-2), "{plain:?} {other:?}");
        }
    }

    #[test]
    fn adjusted_p_values_keep_their_order(p in proptest::collection::vec(0.0_f64..=1.0, 1..30)) {
        let adjusted = benjamini_hochberg(&p).unwrap();
        for i in 0..p.len() {
            prop_assert!(adjusted[i] >= p[i] && adjusted[i] <= 1.0);
            for j in 0..p.len() {
                prop_assert!(p[i] > p[j] || adjusted[i] <= adjusted[j]);
            }
        }
    }
}
