//! Two hundred tools, of which every tenth has play: which ones to take to the workshop, and how long it takes to say.
//!
//! Only where `SNUG_PEOPLE` asks for `tools` (`cargo xtask test --people=tools`).

use crate::people_sealed::{picked, processor_s};
use snug_campaign::Factor;
use snug_study::{RunSettings, Study, Verb, diagnose};
use snug_synthetic::{
    CampaignPlan, ChannelNames, FilePlan, HiddenEffect, Joint, MatStyle, NoiseKind, Strategy,
    Whose, simulate,
};
use std::sync::atomic::AtomicBool;

const TOOLS: u32 = 200;
/// Seconds on two cores.
const MOST_TIME_S: f64 = 300.0;

/// 2688 tightenings, 13 or 14 of each tool.
fn plan(with_play: &[u32]) -> CampaignPlan {
    let file = |tool: u32| FilePlan {
        participant: tool,
        strategy: [Strategy::QuickStep, Strategy::TurboTight][tool as usize % 2],
        joint: [Joint::Soft, Joint::Hard][tool as usize / 2 % 2],
        pace_per_min: 8,
        tightenings: if tool <= 88 { 14 } else { 13 },
        channel_names: ChannelNames::Plain,
    };
    CampaignPlan {
        files: (1..=TOOLS).map(file).collect(),
        ..CampaignPlan::of_size(6, 4)
    }
    .with_noise(NoiseKind::Coloured)
    .with_bias(0.02)
    .hiding(HiddenEffect::CoulombFriction, 0.8)
    .of(Whose::Participants(with_play.to_vec()))
}

#[test]
fn two_hundred_tools_are_told_apart_in_five_minutes() {
    if !picked("tools") {
        println!("skipped: two hundred tools are simulated only when SNUG_PEOPLE=tools");
        return;
    }
    let with_friction: Vec<u32> = (1..=TOOLS).filter(|tool| tool % 10 == 3).collect();
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("data");
    let campaign = simulate(&plan(&with_friction), 7).unwrap();
    assert_eq!(campaign.truth.tightenings.len(), 2688);
    campaign.write(&data, MatStyle::default()).unwrap();
    drop(campaign);
    let mut study = Study::on(data);
    // Two of each tool.
    study.diagnosis.most_tightenings = 400;
    let settings = RunSettings::new(folder.path().join("out"));
    let (begun, clock) = (processor_s(), std::time::Instant::now());
    let never = AtomicBool::new(false);
    let outcome = diagnose(&study, &Verb::Improve, &settings, &|_| (), &never).unwrap();
    let time_s = (processor_s() - begun) / 2.0;
    let diagnosis = outcome.result.diagnosis.unwrap();
    println!(
        "{time_s:.0} s on two cores, {:.0} by the clock: {}",
        clock.elapsed().as_secs_f64(),
        diagnosis.headline
    );
    let [added] = diagnosis.added.as_slice() else {
        panic!("{:?}", diagnosis.headline)
    };
    let by_group = added.parameters[0].by_group.as_ref().unwrap();
    println!("{}", added.parameters[0].size());
    assert!(matches!(
        by_group.factor,
        Factor::Participant | Factor::File
    ));
    let found: Vec<&str> = (by_group.groups.iter())
        .filter(|one| one.present)
        .map(|one| one.group.as_str())
        .collect();
    let hidden: Vec<String> = with_friction
        .iter()
        .map(|tool| format!("TP{tool}"))
        .collect();
    let missed = hidden.iter().filter(|tool| !found.contains(&tool.as_str()));
    let added = found
        .iter()
        .filter(|tool| !hidden.contains(&(**tool).to_owned()));
    println!(
        "missed {:?}, added {:?}",
        missed.collect::<Vec<_>>(),
        added.collect::<Vec<_>>()
    );
    assert!(time_s <= MOST_TIME_S, "{time_s}");
}
