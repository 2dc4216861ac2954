//! A whole run on one measurement file whose numbers and events are changed: what is odd is a finding.

use super::{LEVER_ARM_M, Target};
use crate::mutation::Mutation;
use rand::Rng;
use rand::seq::IndexedRandom;
use snug_study::{RunSettings, Study, StudyError, run};
use snug_synthetic::{MatValue, mat5};
use std::path::Path;
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;

pub const TARGET: Target = Target {
    name: "pipeline",
    file: "TP1_QS_Soft_5_01.mat",
    mutate,
    attempt,
};

/// What a good file holds.
struct Good {
    torque: Vec<f64>,
    acceleration: Vec<f64>,
    force: Vec<f64>,
    times_s: Vec<f64>,
}

static GOOD: LazyLock<Good> = LazyLock::new(|| {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/campaign/TP1_QS_Soft_5_01.mat");
    let source = Study::default().source;
    let recording = snug_ingest::read(&source, &file, LEVER_ARM_M)
        .unwrap()
        .recordings
        .remove(0);
    let times = |index: usize| recording.segments[index].event_times_s.unwrap();
    Good {
        times_s: (0..2).flat_map(times).collect(),
        torque: recording.torque_nm,
        acceleration: recording.motion.acceleration_rad_per_s2.unwrap(),
        force: recording.grip_force_n.unwrap(),
    }
});

/// Values that sensors and loggers write when something is wrong.
const ODD: [f64; 9] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    1e300,
    -1e300,
    5e-324,
    32767.0,
];

fn mutate(mutation: &mut Mutation) -> Vec<u8> {
    let good = &*GOOD;
    let random = &mut mutation.random;
    let samples = good.torque.len() / 2;
    let mut channels =
        [&good.torque, &good.acceleration, &good.force].map(|channel| channel[..samples].to_vec());
    for _ in 0..random.random_range(0..4) {
        let channel = &mut channels[random.random_range(0..3)];
        let start = random.random_range(0..channel.len().max(1));
        let end = (start + (1 << random.random_range(0..15))).min(channel.len());
        let odd = *ODD.choose(random).expect("there are some");
        match random.random_range(0..6) {
            0 => channel.truncate(start),
            1 => channel[start..end].fill(odd),
            2 => channel[start..end]
                .iter_mut()
                .for_each(|value| *value *= odd),
            3 => channel.iter_mut().for_each(|value| *value = -*value * 1e3),
            4 => channel[start..end].reverse(),
            _ => channel[start..end]
                .iter_mut()
                .step_by(7)
                .for_each(|value| *value += odd),
        }
    }
    let mut times = good.times_s.clone();
    for _ in 0..random.random_range(0..3) {
        let place = random.random_range(0..times.len());
        times[place] = *[-1.0, 0.0, 1e9, f64::NAN, times[0]]
            .choose(random)
            .expect("some");
    }
    let texts = times.iter().flat_map(|time| {
        [
            "1".to_owned(),
            "x".to_owned(),
            format!("{time:.4}").replace('.', ","),
        ]
    });
    let mut texts: Vec<String> = texts.collect();
    if random.random_range(0..5) == 0 {
        texts.truncate(3 * random.random_range(0..times.len()));
    }
    let [torque, acceleration, force] = &channels;
    let mut variables = vec![
        ("Inline_Torque", MatValue::Double(torque)),
        ("angle_acc_Acc_FIR150", MatValue::Double(acceleration)),
    ];
    if random.random_bool(0.7) {
        variables.push(("F_op_J", MatValue::Double(force)));
    }
    if random.random_bool(0.8) {
        variables.push(("Events", MatValue::CellOfText { columns: 3, texts }));
    }
    mat5(&variables, random.random_bool(0.5)).unwrap()
}

fn attempt(file: &Path, _: &[u8]) {
    let study = Study::on(file.to_path_buf());
    let settings = RunSettings {
        threads: Some(1),
        ..RunSettings::new("out")
    };
    match run(&study, &settings, &|_| (), &AtomicBool::new(false)) {
        Ok(outcome) => {
            let told = outcome.result.tightenings.len() + outcome.result.findings.len();
            assert!(told > 0, "nothing is passed over in silence");
        }
        Err(StudyError::Ingest(_)) => {}
        Err(error) => panic!("{error}"),
    }
}
