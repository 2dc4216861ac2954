//! NIST StRD analysis-of-variance sets to their certified digits.
//!
//! Agreement is stated as NIST's log relative error: the number of agreeing digits, at most 15.

use std::path::PathBuf;

use snug_statistics::DoubleDouble;
use snug_statistics::k_sample::{OneWayAnova, one_way_anova};

/// `−log₁₀ |found − certified|/|certified|`, at most 15.
fn digits(found: f64, certified: f64) -> f64 {
    (-((found - certified).abs() / certified.abs()).log10()).min(15.0)
}

/// Fewest agreeing digits over sums of squares, F, R² and residual standard deviation.
fn worst(found: &OneWayAnova, certified: &[f64; 5]) -> f64 {
    [
        found.between_sum_of_squares,
        found.within_sum_of_squares,
        found.test.statistic,
        found.eta_squared,
        found.residual_standard_deviation,
    ]
    .iter()
    .zip(certified)
    .map(|(found, certified)| digits(*found, *certified))
    .fold(15.0, f64::min)
}

/// Readings as text by treatment, and the certified values.
fn read(name: &str) -> Option<(Vec<Vec<String>>, [f64; 5])> {
    let Some(folder) = std::env::var_os("SNUG_DATA").map(PathBuf::from) else {
        println!("skipped: {name}, because SNUG_DATA is not set");
        return None;
    };
    let file = folder.join("nist-strd/anova").join(format!("{name}.dat"));
    if !file.exists() {
        println!("skipped: {name}.dat is not there");
        return None;
    }
    let text = std::fs::read_to_string(file).unwrap();
    let line = |start: &str| -> Vec<f64> {
        let line = text
            .lines()
            .find(|line| line.trim_start().starts_with(start))
            .unwrap();
        line.split_whitespace()
            .filter_map(|word| word.parse().ok())
            .collect()
    };
    // Source, degrees of freedom, sum of squares, mean square, F.
    let (between, within) = (line("Between"), line("Within"));
    let deviation_line = text
        .lines()
        .skip_while(|line| !line.contains("Certified Residual"));
    let deviation = deviation_line
        .skip(1)
        .find_map(|line| line.split_whitespace().last())
        .unwrap();
    let certified = [
        between[1],
        within[1],
        between[3],
        line("Certified R-Squared")[0],
        deviation.parse().unwrap(),
    ];
    let mut groups: Vec<Vec<String>> = Vec::new();
    for row in text.lines().skip(60).filter(|line| !line.trim().is_empty()) {
        let mut words = row.split_whitespace();
        let treatment: usize = words.next().unwrap().parse().unwrap();
        groups.resize(groups.len().max(treatment), Vec::new());
        groups[treatment - 1].push(words.next().unwrap().to_owned());
    }
    Some((groups, certified))
}

fn parse<T: std::str::FromStr<Err: std::fmt::Debug>>(groups: &[Vec<String>]) -> Vec<Vec<T>> {
    groups
        .iter()
        .map(|g| g.iter().map(|text| text.parse().unwrap()).collect())
        .collect()
}

/// Every set with readings held as decimals: all certified digits.
#[test]
fn certified_digits_from_decimal_readings() {
    for name in [
        "SiRstv", "SmLs01", "SmLs02", "SmLs03", "SmLs04", "SmLs05", "SmLs06", "SmLs07", "SmLs08",
        "SmLs09", "AtmWtAg",
    ] {
        let Some((groups, certified)) = read(name) else {
            continue;
        };
        let found = one_way_anova(&parse::<DoubleDouble>(&groups)).unwrap();
        let digits = worst(&found, &certified);
        println!("{name}: {digits:.1} digits from decimal readings");
        assert!(digits >= 14.0, "{name}: {digits}");
    }
}

/// Readings rounded to `f64`: the digits that rounding leaves, which the exact rational result
/// of the rounded readings bounds.
#[test]
fn certified_digits_from_f64_readings() {
    for (name, attainable) in [
        ("SiRstv", 12.5),
        ("SmLs01", 14.0),
        ("SmLs02", 13.5),
        ("SmLs03", 13.5),
        ("SmLs04", 10.0),
        ("SmLs05", 10.0),
        ("SmLs06", 10.0),
        ("SmLs07", 4.0),
        ("SmLs08", 4.0),
        ("SmLs09", 4.0),
        ("AtmWtAg", 8.0),
    ] {
        let Some((groups, certified)) = read(name) else {
            continue;
        };
        let found = one_way_anova(&parse::<f64>(&groups)).unwrap();
        let digits = worst(&found, &certified);
        println!("{name}: {digits:.1} digits from f64 readings");
        assert!(digits >= attainable, "{name}: {digits}");
    }
}

/// Means of the nine treatments of the Simon–Lesage sets, without their constant.
const TREATMENTS: [&str; 9] = ["4", "3", "5", "3", "5", "3", "5", "3", "5"];

/// Simon and Lesage's construction: the mean once, then 0.1 below and above it in turn.
fn simon_lesage(leading: &str, replicates: usize) -> Vec<Vec<String>> {
    let reading = |tenth: u8| format!("{leading}.{tenth}");
    TREATMENTS
        .iter()
        .map(|tenth| {
            let tenth: u8 = tenth.parse().unwrap();
            let alternate = |i: usize| {
                reading(if i.is_multiple_of(2) {
                    tenth - 1
                } else {
                    tenth + 1
                })
            };
            std::iter::once(reading(tenth))
                .chain((1..replicates).map(|i| alternate(i - 1)))
                .collect()
        })
        .collect()
}

/// All nine Simon–Lesage sets, rebuilt; their exact table is `SSB = 0.08 r`,
/// `SSW = 0.09 (r − 1)`, F = r.
#[test]
fn simon_lesage_sets_rebuilt() {
    for leading in ["1", "1000000", "1000000000000"] {
        for replicates in [21, 201, 2001] {
            let r = replicates as f64;
            let (between, within) = (0.08 * r, 0.09 * (r - 1.0));
            let exact = [between, within, r, between / (between + within), 0.1];
            let groups = simon_lesage(leading, replicates);
            let found = one_way_anova(&parse::<DoubleDouble>(&groups)).unwrap();
            let digits = worst(&found, &exact);
            assert!(digits >= 14.0, "{leading} {replicates}: {digits}");
        }
    }
}

/// With `f64` readings the result is that of the readings as stored, by exact rational
/// arithmetic: no digit is lost beyond their rounding.
#[test]
fn rounded_readings_give_their_own_exact_result() {
    for (leading, f, between, within) in [
        ("1", 21.0, 1.680_000_000_000_001, 1.800_000_000_000_001),
        (
            "1000000",
            21.000_000_000_776_1,
            1.680_000_000_149_011_6,
            1.800_000_000_093_132_2,
        ),
        (
            "1000000000000",
            21.000_811_887_818_77,
            1.680_156_269_401_469_6,
            1.800_097_837_334_587_5,
        ),
    ] {
        let found = one_way_anova(&parse::<f64>(&simon_lesage(leading, 21))).unwrap();
        assert!(digits(found.test.statistic, f) > 14.5, "{leading}");
        assert!(
            digits(found.between_sum_of_squares, between) > 14.5,
            "{leading}"
        );
        assert!(
            digits(found.within_sum_of_squares, within) > 14.5,
            "{leading}"
        );
    }
}
