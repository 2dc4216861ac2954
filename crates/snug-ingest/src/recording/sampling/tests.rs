//! Jitter, gaps, repeated and missing times, and what becomes of the samples beside them.
#![allow(clippy::unwrap_used)]

use super::*;
use snug_campaign::Finding;

fn run(times_s: &[f64], values: &[f64]) -> Result<(TimeBase, Vec<f64>, Vec<Finding>), IngestError> {
    let mut log = FindingLog::new("x.csv".as_ref());
    let mut channels = [values.to_vec()];
    let timed = Timed {
        times_s: times_s.to_vec(),
        channels: &mut channels,
        place: &|index| format!("line {}", index + 2),
        budget: &Budget::new(Some(100)),
    };
    let grid = uniform(timed, 0.1, &mut log)?;
    let [values] = channels;
    Ok((grid, values, log.finish()))
}

#[test]
fn jitter_within_tolerance_changes_nothing() {
    let times: Vec<f64> = (0..100)
        .map(|i| 5.0 + 0.01 * f64::from(i) + 0.0005 * f64::from(i % 2))
        .collect();
    let values: Vec<f64> = times.iter().map(|t| t.sin()).collect();
    let (grid, read, findings) = run(&times, &values).unwrap();
    assert_eq!(read, values);
    assert!(findings.is_empty());
    assert_eq!(grid.start_s, 5.0);
    assert!((grid.interval_s - 0.01).abs() < 1e-5);
}

#[test]
fn a_gap_is_filled_with_a_straight_line_and_named() {
    // A straight line survives linear interpolation exactly.
    let mut times: Vec<f64> = (0..50).map(|i| 0.01 * f64::from(i)).collect();
    times.drain(20..23);
    let values: Vec<f64> = times.iter().map(|t| 3.0 - 2.0 * t).collect();
    let (grid, read, findings) = run(&times, &values).unwrap();
    assert_eq!(read.len(), 50);
    for (index, value) in read.iter().enumerate() {
        assert!(
            (value - (3.0 - 2.0 * grid.at(index))).abs() < 1e-12,
            "{index}"
        );
    }
    assert!(
        findings[0].message.contains("40.000 ms") && findings[0].message.contains("0.1900 s"),
        "{}",
        findings[0].message
    );
}

#[test]
fn nan_does_not_spread_beyond_its_neighbours() {
    let mut times: Vec<f64> = (0..50).map(|i| 0.25 * f64::from(i)).collect();
    times.remove(30);
    let mut values = vec![1.0; 49];
    values[10] = f64::NAN;
    let (_, read, _) = run(&times, &values).unwrap();
    assert_eq!(read.iter().filter(|value| value.is_nan()).count(), 1);
}

#[test]
fn times_that_stand_still_or_are_missing_are_dropped() {
    let times = [0.0, 1.0, 1.0, f64::NAN, 2.0, 3.0, 2.5, 4.0];
    let values = [0.0, 1.0, 9.0, 9.0, 2.0, 3.0, 9.0, 4.0];
    let (grid, read, findings) = run(&times, &values).unwrap();
    assert_eq!(read, [0.0, 1.0, 2.0, 3.0, 4.0]);
    assert_eq!(grid.interval_s, 1.0);
    assert!(findings[0].message.contains("3 of 8") && findings[0].message.contains("line 4"));
}

#[test]
fn times_that_are_none_are_refused() {
    assert_eq!(
        run(&[3.0, 2.0, 1.0], &[0.0; 3]).unwrap_err().code(),
        "unusable_time"
    );
    assert_eq!(run(&[1.0], &[0.0]).unwrap_err().code(), "unusable_time");
    let error = run(&[0.0, 1.0, 2.0, 1e12], &[0.0; 4]).unwrap_err();
    assert!(matches!(error, IngestError::TimeGap { .. }), "{error}");
}
