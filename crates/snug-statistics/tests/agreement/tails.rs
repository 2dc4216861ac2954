//! Tail areas and quantiles against SciPy.

use serde_json::Value;
use snug_statistics::distributions as d;

use crate::reference::{assert_near, numbers, table};

fn compare(rows: &Value, tolerance: f64, found: impl Fn(&[f64]) -> f64) {
    for row in rows.as_array().unwrap() {
        let row = numbers(row);
        let (arguments, expected) = (&row[..row.len() - 1], row[row.len() - 1]);
        assert_near(
            found(arguments),
            expected,
            tolerance,
            0.0,
            &format!("{arguments:?}"),
        );
    }
}

#[test]
fn tails_and_quantiles() {
    let table = table(include_str!("reference/tails.json"));
    // The log-gamma function's 1e-15 times its size at 2685 degrees of freedom is 1e-11.
    compare(&table["student_two_sided"], 1e-10, |a| {
        d::student_t_two_sided(a[0], a[1])
    });
    compare(&table["student_quantile"], 1e-10, |a| {
        d::student_t_quantile(a[0], a[1])
    });
    compare(&table["f_upper"], 1e-10, |a| d::f_upper(a[0], a[1], a[2]));
    compare(&table["chi_squared_upper"], 1e-10, |a| {
        d::chi_squared_upper(a[0], a[1])
    });
    compare(&table["normal_quantile"], 1e-13, |a| {
        d::normal_quantile(a[0])
    });
    compare(&table["normal_upper"], 1e-12, |a| d::normal_upper(a[0]));
    compare(&table["noncentral_t"], 1e-10, |a| {
        d::noncentral_t_cdf(a[0], a[1], a[2])
    });
}
