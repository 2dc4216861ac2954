//! The CSV and JSON files as other programs read them.
#![allow(clippy::unwrap_used, missing_docs)]

mod specimen;

use serde_json::Value;
use snug_campaign::{Prediction, RestartedPrediction, Validation};
use snug_report::{files, findings_json, statistics_json, tightenings_csv};

/// The columns that other programs rely on, as agreed; further ones may follow.
const AGREED: &str = "file,tightening,participant,strategy,joint,pace_per_min,target_torque_nm,mass_kg,damping_kg_per_s,\
stiffness_n_per_m,natural_frequency_hz,fit_percent,selected,rejection,error_over_noise,mass_kg_low,mass_kg_high,\
damping_kg_per_s_low,damping_kg_per_s_high,stiffness_n_per_m_low,stiffness_n_per_m_high,k3_n_per_m3,k3_n_per_m3_low,\
k3_n_per_m3_high,";

fn rows(text: &str) -> (csv::StringRecord, Vec<csv::StringRecord>) {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().unwrap().clone();
    (header, reader.records().map(Result::unwrap).collect())
}

#[test]
fn the_first_columns_are_those_agreed() {
    let text = tightenings_csv(&specimen::campaign(8));
    assert!(text.starts_with(AGREED), "{}", text.lines().next().unwrap());
}

#[test]
fn numbers_keep_every_digit() {
    let result = specimen::campaign(24);
    let (header, records) = rows(&tightenings_csv(&result));
    assert_eq!(records.len(), 24);
    let column = |name: &str| header.iter().position(|column| column == name).unwrap();
    for (record, tightening) in records.iter().zip(&result.tightenings) {
        let estimate = tightening.estimate.as_ref();
        for name in [
            "mass_kg",
            "damping_kg_per_s",
            "stiffness_n_per_m",
            "k3_n_per_m3",
        ] {
            let parameter = estimate.and_then(|estimate| estimate.parameter(name));
            let read = |column_name: &str| record[column(column_name)].parse::<f64>().ok();
            assert_eq!(read(name), parameter.map(|p| p.value));
            let interval = parameter.and_then(|p| p.interval);
            assert_eq!(read(&format!("{name}_low")), interval.map(|i| i.low));
            assert_eq!(read(&format!("{name}_high")), interval.map(|i| i.high));
        }
        assert_eq!(
            &record[column("selected")],
            tightening.selection.selected().to_string()
        );
    }
}

#[test]
fn a_row_reads_as_written_here() {
    let mut result = specimen::campaign(10);
    let tightening = &mut result.tightenings[9];
    tightening.id.file = "a, \"quoted\" name.mat".into();
    tightening.target_torque_nm = 25.0;
    tightening.measures.natural_frequency_hz = Some(5.25);
    tightening.measures.fit_percent = Some(f64::NAN);
    tightening.measures.error_over_noise = Some(1e-7);
    for (parameter, value) in tightening
        .estimate
        .iter_mut()
        .flat_map(|estimate| &mut estimate.parameters)
        .zip([2.5, 100.125, 2000.0, 9.9e5])
    {
        parameter.value = value;
    }
    result.tightenings.drain(..9);
    let text = tightenings_csv(&result);
    let row = text.lines().nth(1).unwrap();
    let expected = "\"a, \"\"quoted\"\" name.mat\",2,TP3,QS,Hard,8,25,2.5,100.125,2000,5.25,,false,\
                    poor_fit;at_constraint,1e-7,,,";
    assert!(row.starts_with(expected), "{row}");
}

#[test]
fn an_empty_campaign_has_a_header_and_no_rows() {
    let text = tightenings_csv(&specimen::empty());
    assert_eq!(text.lines().count(), 1);
    assert!(text.starts_with("file,tightening,participant,"));
}

#[test]
fn statistics_hold_counts_moments_and_tests() {
    let result = specimen::campaign(24);
    let statistics: Value = serde_json::from_str(&statistics_json(&result)).unwrap();
    assert_eq!(statistics["format"], 1);
    assert_eq!(statistics["presets"][1]["preset"], "thesis");
    assert_eq!(
        statistics["presets"][0]["outcomes"]
            .as_array()
            .unwrap()
            .len(),
        24
    );
    assert_eq!(
        statistics["presets"][0]["outcomes"][9]["rejections"][1],
        "at_constraint"
    );
    let all = &statistics["conditions"][0];
    assert_eq!(
        (&all["factor"], &all["tightenings"], &all["selected"]),
        (&"all".into(), &24.into(), &20.into())
    );
    assert_eq!(all["quantities"][2]["unit"], "N/m");
    assert_eq!(all["quantities"][2]["selected"]["count"], 20);
    let moments = result.conditions[0].quantities[2]
        .selected
        .as_ref()
        .unwrap();
    assert_eq!(
        all["quantities"][2]["selected"]["mean"].as_f64(),
        Some(moments.mean)
    );
    assert_eq!(
        all["quantities"][2]["selected"]["mean_interval"]["low"].as_f64(),
        moments.mean_interval.map(|interval| interval.low)
    );
    for (row, test) in statistics["tests"]
        .as_array()
        .unwrap()
        .iter()
        .zip(&result.tests)
    {
        assert_eq!(row["method"], test.method.as_str());
        // Reading a number here may miss by a unit in the last place; what is written is exact.
        let difference = row["p"]
            .as_f64()
            .zip(test.p)
            .map(|(read, p)| (read - p).abs() / p);
        assert!(difference.is_none_or(|difference| difference < 1e-15));
        assert_eq!(row["p"].is_null(), test.p.is_none());
        assert_eq!(
            row["degrees_of_freedom"].as_array().unwrap().len(),
            test.degrees_of_freedom.len()
        );
        let checks = row["assumptions"].as_array().unwrap();
        assert_eq!(checks.len(), test.assumptions.len());
        for (check, expected) in checks.iter().zip(&test.assumptions) {
            assert_eq!(check["assumption"], expected.assumption.as_str());
            assert_eq!(check["p"].as_f64(), expected.p);
            assert_eq!(check["values"], expected.values);
        }
    }
}

#[test]
fn what_was_kept_for_validation_stands_in_the_output_s_unit() {
    let mut result = specimen::campaign(2);
    result.units.output = "m".into();
    result.units.output_per_rad = 0.5;
    let prediction = Prediction {
        fit_percent: Some(97.5),
        rms: Some(0.25),
    };
    result.tightenings[1].validation = Some(Validation {
        free_run: prediction,
        restarted: Some(RestartedPrediction {
            every_s: 0.125,
            prediction,
        }),
    });
    let statistics: Value = serde_json::from_str(&statistics_json(&result)).unwrap();
    let told = &statistics["validation"][0];
    let id = &result.tightenings[1].id;
    assert_eq!(
        (&told["file"], &told["tightening"]),
        (&id.file.clone().into(), &id.number.into())
    );
    assert_eq!(told["unit"], "m/s^2");
    assert_eq!(told["free_run"]["rms"], 0.125);
    assert_eq!(told["restarted"]["fit_percent"], 97.5);
    assert_eq!(told["restarted"]["every_s"], 0.125);
    assert_eq!(statistics["validation"].as_array().map(Vec::len), Some(1));
}

#[test]
fn what_is_not_finite_is_null() {
    let mut result = specimen::campaign(8);
    for moments in result.conditions[0]
        .quantities
        .iter_mut()
        .flat_map(|q| &mut q.selected)
    {
        moments.mean = f64::NAN;
    }
    result.tests[0].p = Some(f64::INFINITY);
    let statistics: Value = serde_json::from_str(&statistics_json(&result)).unwrap();
    assert!(statistics["conditions"][0]["quantities"][0]["selected"]["mean"].is_null());
    assert!(statistics["tests"][0]["p"].is_null());
}

#[test]
fn findings_are_listed_and_counted() {
    let findings: Value = serde_json::from_str(&findings_json(&specimen::campaign(1))).unwrap();
    assert_eq!(findings["format"], 1);
    assert_eq!(findings["counts"]["by_severity"]["left_out"], 1);
    assert_eq!(findings["counts"]["by_code"]["saturation"], 1);
    assert_eq!(findings["findings"][1]["tightening"], 3);
    assert_eq!(findings["findings"][2]["channel"], Value::Null);
}

#[test]
fn four_files_are_there() {
    let files = files(&specimen::campaign(2));
    let names: Vec<_> = files.iter().map(|(name, _)| *name).collect();
    assert_eq!(
        names,
        [
            "report.html",
            "tightenings.csv",
            "statistics.json",
            "findings.json"
        ]
    );
    assert!(files.iter().all(|(_, content)| !content.is_empty()));
}

/// What is to be shown, not calculated, in a spreadsheet (OWASP, "CSV Injection").
#[test]
fn names_of_files_reach_no_spreadsheet_as_formulas() {
    let mut result = specimen::campaign(4);
    let names = [
        "=HYPERLINK(\"http://x\",\"y\").mat",
        "+1+1.mat",
        "-cmd|' /C calc'!A0.mat",
        "@SUM(A1).mat",
    ];
    for (tightening, name) in result.tightenings.iter_mut().zip(names) {
        tightening.id.file = name.to_owned();
        tightening.conditions.participant = Some(name.to_owned());
    }
    let table = tightenings_csv(&result);
    let mut rows = csv::Reader::from_reader(table.as_bytes());
    for (row, name) in rows.records().zip(names) {
        let row = row.unwrap();
        assert_eq!(row[0], format!("'{name}"));
        assert_eq!(row[2], format!("'{name}"));
        assert!(row.iter().all(|cell| !cell.starts_with(['=', '+', '@'])));
    }
}
