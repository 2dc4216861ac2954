//! Checks of what a test presumes, against published values and SciPy.

use snug_statistics::assumptions::{brown_forsythe, replicated, residuals, shapiro_wilk, tied};

use crate::reference::{assert_near, cases, numbers, table};

/// SciPy's normal scores carry seven digits, which W feels in its tenth: relative errors up to 6e-10.
const W: f64 = 2e-9;
/// What is left of them in p, the more so the further out: up to 4e-7 at p = 1e-36.
const P_OF_W: f64 = 1e-6;

/// Diameters of ten gears from each of ten batches (NIST/SEMATECH e-Handbook, GEAR.DAT), in
/// thousandths.
const GEARS: [[u16; 10]; 10] = [
    [1006, 996, 998, 1000, 992, 993, 1002, 999, 994, 1000],
    [998, 1006, 1000, 1002, 997, 998, 996, 1000, 1006, 988],
    [991, 987, 997, 999, 995, 994, 1000, 999, 996, 996],
    [1005, 1002, 994, 1000, 995, 994, 998, 996, 1002, 996],
    [998, 998, 982, 990, 1002, 984, 996, 993, 980, 996],
    [1009, 1013, 1009, 997, 988, 1002, 995, 998, 981, 996],
    [990, 1004, 996, 1001, 998, 1000, 1018, 1010, 996, 1002],
    [998, 1000, 1006, 1000, 1002, 996, 998, 996, 1002, 1006],
    [1002, 998, 996, 995, 996, 1004, 1004, 998, 999, 991],
    [991, 995, 984, 994, 997, 997, 991, 998, 1004, 997],
];

/// The handbook's section 1.3.5.10 prints W = 1.705910 on 9 and 90 degrees of freedom, about the
/// medians, of which five digits hold: rational arithmetic of the readings that it lists gives the
/// fraction below. Its p is SciPy 1.17.1's.
#[test]
fn variances_of_gear_diameters_as_nist_prints_them() {
    let batches = GEARS.map(|batch| batch.map(|reading| f64::from(reading) / 1000.0));
    let found = brown_forsythe(&batches).unwrap();
    assert_near(found.statistic, 1.705_910, 1e-5, 0.0, "W as printed");
    // Readings in steps of 0.001 that are rounded to f64 keep 13 digits of their differences.
    assert_near(found.statistic, 5679.0 / 3329.0, 1e-12, 0.0, "W");
    assert_eq!(found.degrees_of_freedom, [9.0, 90.0]);
    assert_near(found.p, 0.099_082_975_552_202_47, 1e-11, 0.0, "p");
}

/// Weights of eleven men (Shapiro and Wilk 1965, who find W = 0.79); SciPy 1.17.1 says more digits.
#[test]
fn normality_of_weights_as_published() {
    let weights = [
        148., 154., 158., 160., 161., 162., 166., 170., 182., 195., 236.,
    ];
    let found = shapiro_wilk(&weights).unwrap();
    assert_near(found.statistic, 0.788_814_694_863_171_6, W, 0.0, "W");
    assert_near(found.p, 0.006_703_814_061_898_823, P_OF_W, 0.0, "p");
}

/// Every branch of the approximation, from the smallest sample to the largest: points
/// `i √2 mod 1`, which are far from normal once there are many, and SciPy 1.17.1's answers.
#[test]
fn normality_from_three_to_five_thousand_values() {
    for (count, w, p) in [
        (3, 0.945_902_906_222_805_9, 0.551_684_149_128_789_5),
        (4, 0.976_093_967_677_523_1, 0.878_770_439_164_529_8),
        (5, 0.974_390_452_683_857_9, 0.902_610_693_862_467_3),
        (6, 0.990_377_601_602_488_9, 0.990_075_034_373_102),
        (11, 0.966_802_503_516_176_5, 0.852_552_377_103_143_9),
        (12, 0.962_981_929_130_979_1, 0.825_400_935_193_130_8),
        (50, 0.955_810_827_162_456_1, 0.059_378_362_159_910_2),
        (2000, 0.954_923_064_541_761_6, 2.217_227_509_132_103_5e-24),
        (5000, 0.954_896_920_214_671_4, 9.349_666_714_212_34e-37),
    ] {
        let points: Vec<f64> = (1..=count)
            .map(|i| f64::from(i) * std::f64::consts::SQRT_2 % 1.0)
            .collect();
        let found = shapiro_wilk(&points).unwrap();
        assert_near(found.statistic, w, W, 0.0, &format!("W of {count}"));
        assert_near(found.p, p, P_OF_W, 0.0, &format!("p of {count}"));
    }
}

/// `scipy.stats.shapiro` of the residuals about the groups' means, ties among them.
#[test]
fn normality_of_residuals() {
    let samples = table(include_str!("reference/samples.json"));
    for case in cases(include_str!("reference/k_sample.json")) {
        let name = case["groups"].to_string();
        let groups: Vec<Vec<f64>> = case["groups"]
            .as_array()
            .unwrap()
            .iter()
            .map(|name| numbers(&samples[name.as_str().unwrap()]))
            .collect();
        let left = residuals(&replicated(&groups));
        let expected = numbers(&case["residuals"]);
        let found = shapiro_wilk(&left).unwrap();
        assert_near(found.statistic, expected[0], W, 0.0, &name);
        assert_near(found.p, expected[1], P_OF_W, 0.0, &name);
        assert_eq!(tied(&left) as u64, case["tied"].as_u64().unwrap(), "{name}");
    }
}
