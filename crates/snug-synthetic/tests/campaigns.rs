//! Whole campaigns: who is in them, what their files look like, and the embedded one.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use flate2::read::ZlibDecoder;
use snug_synthetic::{CampaignPlan, HandArm, MatStyle, SyntheticCampaign};
use snug_synthetic::{TighteningTruth, Truth, fixtures, simulate};
use std::collections::BTreeSet;
use std::fs;
use std::io::Read;
use std::path::Path;

/// A plan whose files are cheap: short segments, no noise.
fn quick(files: usize, tightenings: usize) -> CampaignPlan {
    let mut plan = CampaignPlan::of_size(files, tightenings);
    plan.quiet_s = 0.01;
    plan.segment_s = 0.03;
    plan
}

#[test]
fn everybody_is_lightly_damped_and_spreads_as_declared() {
    let plan = quick(240, 4);
    let campaign = simulate(&plan, 3).unwrap();
    let inertia = |label: &str| if label.contains("_QS_") { 0.275 } else { 0.15 };
    for truth in &campaign.truth.tightenings {
        let arm = HandArm {
            mass_kg: truth.m,
            damping_kg_per_s: truth.c,
            stiffness_n_per_m: truth.k,
        };
        assert!(truth.m > 0.0 && truth.c > 0.0 && truth.k > 0.0);
        let ratio = arm.damping_ratio(0.330, inertia(&truth.file));
        assert!(ratio > 0.25 && ratio < 0.8, "{ratio}");
        assert!((15.0..45.0).contains(&truth.target));
    }
    let mut masses: Vec<f64> = campaign.truth.tightenings.iter().map(|t| t.m).collect();
    masses.sort_by(f64::total_cmp);
    let median = masses[masses.len() / 2];
    assert!((median / 2.2 - 1.0).abs() < 0.12, "{median}");
}

#[test]
fn a_participant_is_the_same_person_in_every_file() {
    let mut plan = quick(8, 1);
    plan.population.within_participant = [0.0; 3];
    let truth = simulate(&plan, 4).unwrap().truth;
    let of = |label: &str| {
        let found = truth.tightenings.iter().find(|t| t.file == label).unwrap();
        (found.m, found.c, found.k)
    };
    assert_eq!(of("TP1_QS_Soft_5"), of("TP1_QS_Hard_5"));
    assert_ne!(of("TP1_QS_Soft_5"), of("TP2_QS_Hard_8"));
}

#[test]
fn eight_files_hold_every_combination_and_every_name_is_its_own() {
    let plan = CampaignPlan::of_size(16, 1);
    let labels: BTreeSet<String> = plan.files.iter().map(|file| file.label()).collect();
    assert_eq!(labels.len(), 16);
    let conditions = |label: &String| label.split_once('_').unwrap().1.to_owned();
    let first: BTreeSet<String> = plan.files[..8]
        .iter()
        .map(|f| conditions(&f.label()))
        .collect();
    assert_eq!(first.len(), 8);
}

#[test]
fn a_plan_survives_its_own_serialisation_and_refuses_typos() {
    let plan = fixtures::plan();
    let json = serde_json::to_string(&plan).unwrap();
    assert_eq!(serde_json::from_str::<CampaignPlan>(&json).unwrap(), plan);
    assert!(serde_json::from_str::<CampaignPlan>("{\"strenght\": 0.3}").is_err());
}

#[test]
fn events_carry_decimal_commas_and_channels_the_thesis_names() {
    let campaign = simulate(&quick(3, 1), 5).unwrap();
    let style = MatStyle {
        compressed: false,
        double_precision: true,
    };
    let names = [
        &["angle_acc_Acc_FIR150", "Inline_Torque", "F_op_J"][..],
        &["angle_acc_Acc_FIR150", "Inline", "F_op_J"],
        &["Data1_angle_acc_Acc_FIR150", "Data1_Inline"],
    ];
    for (file, names) in campaign.files.iter().zip(names) {
        let bytes = file.mat(style).unwrap();
        let holds = |text: &[u8]| bytes.windows(text.len()).any(|window| window == text);
        for name in names {
            assert!(holds(name.as_bytes()), "{name} in {}", file.name);
        }
        let wide: Vec<u8> = "12,5000"
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect();
        assert!(holds(&wide));
    }
}

#[test]
fn truth_has_the_form_of_the_practice_campaigns() {
    let Some(folder) = std::env::var_os("SNUG_PRACTICE") else {
        println!("skipped: SNUG_PRACTICE is not set");
        return;
    };
    for name in ["A", "B", "C", "D", "E"] {
        let path = Path::new(&folder).join(format!("{name}.truth.json"));
        let truth: Truth = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        assert_eq!(truth.tightenings.len(), 24);
        let back: Truth = serde_json::from_str(&truth.to_json().unwrap()).unwrap();
        assert_eq!(back, truth);
    }
}

/// A MAT file with every compressed element unpacked.
fn unpacked(file: &[u8]) -> Vec<u8> {
    let mut out = file[..128].to_vec();
    let mut rest = &file[128..];
    while let [15, 0, 0, 0, a, b, c, d, packed @ ..] = rest {
        let length = u32::from_le_bytes([*a, *b, *c, *d]) as usize;
        ZlibDecoder::new(&packed[..length])
            .read_to_end(&mut out)
            .unwrap();
        rest = &packed[length..];
    }
    assert!(rest.is_empty());
    out
}

/// Compared unpacked, so that another version of the compressor is no difference.
#[test]
fn the_committed_fixtures_are_what_the_generator_makes() {
    let fixtures_folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    if !fixtures_folder.is_dir() {
        println!("skipped: the crate stands alone, without the repository's fixtures");
        return;
    }
    for (name, campaign) in [
        (fixtures::CAMPAIGN, fixtures::campaign().unwrap()),
        (fixtures::MYSTERY, fixtures::mystery().unwrap()),
    ] {
        assert_committed(&fixtures_folder, name, &campaign);
    }
}

fn assert_committed(fixtures_folder: &Path, name: &str, campaign: &SyntheticCampaign) {
    let folder = fixtures_folder.join(name);
    let plain = MatStyle {
        compressed: false,
        ..MatStyle::default()
    };
    for file in &campaign.files {
        let committed = fs::read(folder.join(&file.name)).unwrap();
        assert!(
            unpacked(&committed) == file.mat(plain).unwrap(),
            "{} differs: make the fixtures again",
            file.name
        );
    }
    assert_eq!(
        fs::read_dir(&folder).unwrap().count(),
        campaign.files.len(),
        "nothing else stands there"
    );
    let truth = fs::read_to_string(fixtures_folder.join(format!("{name}.truth.json"))).unwrap();
    assert_same_truth(&serde_json::from_str(&truth).unwrap(), &campaign.truth);
}

/// Equal but for the last digits, in which another platform's `exp` may differ; the rounded samples hide that.
fn assert_same_truth(committed: &Truth, fresh: &Truth) {
    assert_eq!(
        (committed.seed, &committed.effects),
        (fresh.seed, &fresh.effects)
    );
    assert_eq!(committed.tightenings.len(), fresh.tightenings.len());
    for (committed, fresh) in committed.tightenings.iter().zip(&fresh.tightenings) {
        assert_eq!(
            (
                &committed.file,
                committed.index,
                &committed.fault,
                &committed.used
            ),
            (&fresh.file, fresh.index, &fresh.fault, &fresh.used)
        );
        let numbers = |t: &TighteningTruth| [t.m, t.c, t.k, t.target, t.bias, t.peak_rad];
        for (committed, fresh) in numbers(committed).into_iter().zip(numbers(fresh)) {
            assert!((committed - fresh).abs() <= 1e-9 * fresh.abs());
        }
    }
}

#[test]
fn writing_twice_gives_the_same_bytes_and_a_truth_beside_them() {
    let campaign = simulate(&quick(2, 2), 6).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str| {
        campaign
            .write(&folder.path().join(name), MatStyle::default())
            .unwrap()
    };
    let (first, second) = (write("first"), write("second"));
    assert_eq!(first.len(), 3);
    assert_eq!(first[2], folder.path().join("first.truth.json"));
    for (a, b) in first.iter().zip(&second) {
        assert_eq!(fs::read(a).unwrap(), fs::read(b).unwrap());
    }
}
