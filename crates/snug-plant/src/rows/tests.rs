//! Every field of a row through Parquet and back, and what is noticed when one changed.
#![allow(clippy::unwrap_used)]
use super::*;
use crate::storage::parquet_file;
use crate::storage::partition::Partition;
use crate::storage::schema;
use snug_preprocess::{PreprocessSettings, Preset, preprocess};
use snug_synthetic::{CampaignPlan, NoiseKind, simulate};

/// Of both presets, with what each has of its own.
fn rows(preset: Preset) -> Vec<Row> {
    let plan = CampaignPlan::of_size(3, 3)
        .with_noise(NoiseKind::Coloured)
        .with_bias(0.2);
    let settings = PreprocessSettings {
        preset,
        ..PreprocessSettings::default()
    };
    let campaign = simulate(&plan, 7).unwrap();
    let prepared = campaign.files.iter().flat_map(|file| {
        preprocess(&file.recording(), &settings, Quantity::Acceleration)
            .unwrap()
            .tightenings
    });
    let row = |prepared| Row {
        source: "00ff".into(),
        station: Some("S1".into()),
        time_of_day_s: Some(3600.5),
        prepared,
    };
    prepared.map(row).collect()
}

fn through_parquet(rows: &[Row]) -> Vec<Prepared> {
    let partition = Partition::new("2026-03-01", "T1").unwrap();
    let batch = batch(&partition, rows).unwrap();
    let file = parquet_file::written("a", &schema::tightenings(), &[batch]).unwrap();
    let batches = parquet_file::read("a", file.into()).unwrap();
    batches
        .iter()
        .flat_map(|batch| prepared(batch).unwrap())
        .collect()
}

#[test]
fn every_field_comes_back_bit_for_bit() {
    for preset in [Preset::Snug, Preset::Thesis] {
        let rows = rows(preset);
        assert_eq!(rows.len(), 9);
        for (row, back) in rows.iter().zip(through_parquet(&rows)) {
            assert_eq!(row.prepared, back);
            assert_eq!(
                checksum(&row.prepared.tightening),
                checksum(&back.tightening)
            );
        }
    }
}

#[test]
fn motion_that_is_no_sum_of_another_is_stored() {
    let mut rows = rows(Preset::Snug);
    let displacement = rows[0]
        .prepared
        .tightening
        .motion
        .displacement_rad
        .as_mut()
        .unwrap();
    displacement[100] = f64::from_bits(displacement[100].to_bits() + 1);
    rows[1].prepared.tightening.motion.velocity_rad_per_s = None;
    rows[2].prepared.tightening.noise = None;
    rows[2].prepared.tightening.motion.acceleration_rad_per_s2 = None;
    for (row, back) in rows.iter().zip(through_parquet(&rows)) {
        assert_eq!(row.prepared, back);
    }
}

#[test]
fn a_changed_sample_is_noticed() {
    let rows = rows(Preset::Snug);
    let partition = Partition::new("2026-03-01", "T1").unwrap();
    let good = batch(&partition, &rows).unwrap();
    let mut other = rows.clone();
    let torque = &mut other[4].prepared.tightening.torque_nm[10];
    *torque = f64::from_bits(torque.to_bits() ^ 1);
    let changed = batch(&partition, &other).unwrap();
    let mut columns = good.columns().to_vec();
    let place = schema::tightenings().index_of("torque_nm").unwrap();
    columns[place] = changed.column(place).clone();
    let damaged = arrow::array::RecordBatch::try_new(good.schema(), columns).unwrap();
    let error = prepared(&damaged).unwrap_err().to_string();
    assert!(
        error.contains(&rows[4].prepared.tightening.id.to_string()),
        "{error}"
    );
    assert!(error.contains("checksum"), "{error}");
}
