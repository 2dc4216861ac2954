//! Reads measurement files: `cargo run --release --example 01_read -- FILE …`, without one a file of the embedded campaign.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use snug_ingest::{IngestError, Source, read};
use std::path::PathBuf;

/// From the turning axis to the grip: by it, lengths that a file holds become angles.
const LEVER_ARM_M: f64 = 0.33;

fn main() -> Result<(), IngestError> {
    let mut files: Vec<PathBuf> = std::env::args().skip(1).map(PathBuf::from).collect();
    if files.is_empty() {
        let fixtures = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures");
        files.push(
            [fixtures, "campaign", "TP1_QS_Soft_5_01.mat"]
                .iter()
                .collect(),
        );
    }
    // MAT files in the layout of the thesis; other rigs declare their columns in a `CsvLayout` or `McapLayout`.
    let source = Source::default();
    for file in &files {
        let ingested = read(&source, file, LEVER_ARM_M)?;
        for recording in &ingested.recordings {
            println!("{}: {} samples", recording.file, recording.torque_nm.len());
            println!("  sampled every {} s", recording.time_base.interval_s);
            println!("  {:?}", recording.conditions);
            for segment in &recording.segments {
                let torque_nm =
                    &recording.torque_nm[segment.start..segment.end.min(recording.torque_nm.len())];
                let peak_nm = torque_nm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                println!(
                    "  tightening {}: peak torque {peak_nm:.1} Nm",
                    segment.number
                );
            }
        }
        // What had to be left out or repaired; a file that cannot be read at all is an error, which makes a finding, too.
        for finding in &ingested.findings {
            println!("  {}", finding.message);
        }
    }
    Ok(())
}
