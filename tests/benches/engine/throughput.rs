//! Measurement files in, recording out: how fast data pass through, beside what the machine does with plain bytes.

use crate::campaign::Campaign;
use crate::effects::one_core;
use crate::measure::{Clock, Times, race};
use crate::table::{Reference, section, short, times_the};
use snug_campaign::{FitMeasures, Quantity, Recording, Selection, TighteningResult, Traces};
use snug_identify::FitTask;
use snug_preprocess::{PreprocessSettings, preprocess};
use snug_record::{RecordSettings, Recorder};
use std::hint::black_box;
use std::path::{Path, PathBuf};

/// Tightenings that are read, prepared, recorded.
const TIGHTENINGS: usize = 96;
const MB: f64 = 1e6;

pub fn fill(_is_long: bool) {
    section("Data in and out; per tightening, one core");
    let campaign = Campaign::hiding(&[], TIGHTENINGS);
    one_core().install(|| {
        let recordings = read(&campaign);
        prepare(&recordings);
        record(&campaign);
    });
}

/// MAT files to recordings.
fn read(campaign: &Campaign) -> Vec<Recording> {
    let study = campaign.study();
    let lever_arm_m = study.preprocess.rig.lever_arm_m;
    let files: Vec<PathBuf> = snug_ingest::list(&study.source, &campaign.data())
        .expect("the files were just written")
        .files;
    let bytes: u64 = files.iter().map(|file| size(file)).sum();
    let mut recordings = Vec::new();
    let [plain, ours] = race(
        Clock::Wall,
        [
            (TIGHTENINGS, &mut || {
                for file in &files {
                    black_box(std::fs::read(file).expect("it was just written"));
                }
            }),
            (TIGHTENINGS, &mut || {
                recordings.clear();
                for file in &files {
                    let ingested = snug_ingest::read(&study.source, file, lever_arm_m);
                    recordings.extend(ingested.expect("it was just written").recordings);
                }
            }),
        ],
    );
    let reference = Reference {
        name: "reading the bytes",
        times: &plain,
    };
    let what = format!("ingest of MAT files: {}", rate(&ours, bytes as f64));
    times_the(&reference, &ours, &what);
    recordings
}

/// Recordings to tightenings.
fn prepare(recordings: &[Recording]) {
    let settings = PreprocessSettings::default();
    let samples: usize = (recordings.iter())
        .map(|recording| 2 * recording.torque_nm.len())
        .sum();
    let [plain, ours] = race(
        Clock::Wall,
        [
            (TIGHTENINGS, &mut || {
                for recording in recordings {
                    black_box(recording.clone());
                }
            }),
            (TIGHTENINGS, &mut || {
                for recording in recordings {
                    let prepared = preprocess(recording, &settings, Quantity::Acceleration);
                    black_box(prepared.expect("the default settings are allowed"));
                }
            }),
        ],
    );
    let reference = Reference {
        name: "copying the samples",
        times: &plain,
    };
    let bytes = samples * size_of::<f64>();
    let what = format!(
        "preprocessing of torque and acceleration: {}",
        rate(&ours, bytes as f64)
    );
    times_the(&reference, &ours, &what);
}

/// Tightenings with all their signals to an MCAP recording.
fn record(campaign: &Campaign) {
    let cases = campaign.cases();
    let results: Vec<(TighteningResult, Traces)> = cases.iter().map(result).collect();
    let (path, beside) = (campaign.beside("recording.mcap"), campaign.beside("plain"));
    write(&path, &results);
    let content = std::fs::read(&path).expect("it was just written");
    let [plain, ours] = race(
        Clock::Wall,
        [
            (cases.len(), &mut || {
                std::fs::write(&beside, &content).expect("a temporary folder can be written");
            }),
            (cases.len(), &mut || write(&path, &results)),
        ],
    );
    let reference = Reference {
        name: "writing the bytes",
        times: &plain,
    };
    let what = format!(
        "recording of all signals as MCAP: {} written",
        rate(&ours, content.len() as f64)
    );
    times_the(&reference, &ours, &what);
}

fn write(path: &Path, results: &[(TighteningResult, Traces)]) {
    let file = std::fs::File::create(path).expect("a temporary folder can be written");
    let mut recorder = Recorder::new(std::io::BufWriter::new(file), RecordSettings::default())
        .expect("a temporary folder can be written");
    for (result, traces) in results {
        (recorder.tightening(result, traces, None)).expect("a temporary folder can be written");
    }
    recorder
        .finish()
        .expect("a temporary folder can be written");
}

/// A tightening with the signals of the model it starts from.
fn result(case: &FitTask<'_>) -> (TighteningResult, Traces) {
    let tightening = &case.tightening;
    let values: Vec<f64> = (case.model.parameters().iter())
        .map(|parameter| parameter.value)
        .collect();
    let simulated = case
        .model
        .simulate(&values, &case.input)
        .expect("a case can be simulated");
    let force = |motion: &snug_campaign::Motion| {
        let acceleration = motion.acceleration_rad_per_s2.as_deref().unwrap_or(&[]);
        snug_model::inverse_dynamics_force(&tightening.rig, &tightening.torque_nm, acceleration)
    };
    let traces = Traces {
        before: snug_campaign::Motion::default(),
        time_base: tightening.time_base,
        torque_nm: tightening.torque_nm.clone(),
        measured: tightening.motion.clone(),
        euler_displacement_rad: Vec::new(),
        force_f1_n: snug_model::spring_damper_force(&tightening.rig, &values, &simulated)
            .expect("a case has m, c, k"),
        force_f2_n: force(&tightening.motion),
        force_f3_n: force(&simulated),
        grip_force_n: tightening.grip_force_n.clone(),
        simulated,
    };
    let result = TighteningResult {
        started_at_s: None,
        id: tightening.id.clone(),
        conditions: tightening.conditions.clone(),
        rig: tightening.rig,
        peak_torque_nm: tightening.peak_torque_nm,
        target_torque_nm: tightening.target_torque_nm,
        estimate: None,
        measures: FitMeasures::default(),
        selection: Selection::default(),
        corrections: tightening.corrections.clone(),
        noise: tightening.noise.clone(),
        validation: None,
    };
    (result, traces)
}

/// MB/s and tightenings/s, from the time of one tightening and the bytes of all.
fn rate(ours: &Times, bytes: f64) -> String {
    let per_second = 1.0 / ours.median_s();
    format!(
        "{} MB/s, {} tightenings/s",
        short(bytes / MB / TIGHTENINGS as f64 * per_second),
        short(per_second)
    )
}

fn size(file: &Path) -> u64 {
    std::fs::metadata(file).map_or(0, |metadata| metadata.len())
}
