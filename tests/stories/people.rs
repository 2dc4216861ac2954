//! People differ: an effect that scatters from person to person, that only some have, or that shows under one joint only is named,
//! with who has it and how much, and the error comes down to the floor; where people differ in mass, damping and stiffness only,
//! nothing is said of them.
//!
//! A few by default; with `SNUG_BLIND` more effects, forms and seeds.

use crate::blind;
use snug_campaign::{Diagnosis, Factor, Verdict};
use snug_diagnose::Goal;
use snug_synthetic::{
    CampaignPlan, ChannelNames, FilePlan, HiddenEffect as Hidden, Joint, NoiseKind, Strategy,
    Truth, Whose,
};

/// One of each kind.
const FEW: [(Hidden, f64, Form); 3] = [
    (Hidden::MaxwellBranch, 0.59, Form::Scattering),
    (Hidden::CubicStiffness, 0.5, Form::HardJoint),
    (Hidden::CoulombFriction, 0.5, Form::Some(&[2, 5])),
];

/// More of them.
const MORE: [(Hidden, f64, Form); 12] = [
    (Hidden::CubicStiffness, 0.5, Form::Scattering),
    (Hidden::CoulombFriction, 0.5, Form::Scattering),
    (Hidden::CoContraction, 0.8, Form::Scattering),
    (Hidden::VoluntaryPush, 1.0, Form::Scattering),
    (Hidden::StretchReflex, 0.8, Form::Scattering),
    (Hidden::Backlash, 0.3, Form::Some(&[2, 5])),
    (Hidden::StretchReflex, 1.0, Form::Some(&[2, 6])),
    (Hidden::MaxwellBranch, 0.8, Form::Some(&[1, 3, 4])),
    (Hidden::QuadraticDamping, 1.2, Form::Some(&[4])),
    (Hidden::TorqueDelay, 0.3, Form::TurboTight),
    (Hidden::CoulombFriction, 0.5, Form::HardJoint),
    (Hidden::DirectionalDamping, 0.8, Form::Some(&[1, 6])),
];

#[derive(Debug, Clone, Copy)]
enum Form {
    Scattering,
    Some(&'static [u32]),
    HardJoint,
    TurboTight,
}

impl Form {
    fn whose(self) -> Whose {
        match self {
            Self::Scattering => Whose::Scattering(0.6),
            Self::Some(those) => Whose::Participants(those.to_vec()),
            Self::HardJoint => Whose::Joint(Joint::Hard),
            Self::TurboTight => Whose::Strategy(Strategy::TurboTight),
        }
    }

    fn factor(self) -> Factor {
        match self {
            Self::Scattering | Self::Some(_) => Factor::Participant,
            Self::HardJoint => Factor::Joint,
            Self::TurboTight => Factor::Strategy,
        }
    }
}

/// Six people, each with two files of four tightenings under different conditions.
pub fn plan() -> CampaignPlan {
    let file = |index: usize| FilePlan {
        participant: index as u32 / 2 + 1,
        strategy: [Strategy::QuickStep, Strategy::TurboTight][(index / 2 + index) % 2],
        joint: [Joint::Soft, Joint::Hard][index % 2],
        pace_per_min: [5, 8][index / 4 % 2],
        tightenings: 4,
        channel_names: ChannelNames::Plain,
    };
    CampaignPlan {
        files: (0..12).map(file).collect(),
        ..CampaignPlan::of_size(6, 4)
    }
    .with_noise(NoiseKind::Coloured)
    .with_bias(0.02)
}

/// What is wrong with the groups that are said to have the first effect, and their sizes.
fn wrong_groups(diagnosis: &Diagnosis, truth: &Truth, hidden: Hidden, form: Form) -> Vec<String> {
    let Some(added) = diagnosis.added.first() else {
        return vec!["nothing was added".to_owned()];
    };
    let size = &added.parameters[0];
    let Some(by_group) = &size.by_group else {
        return vec![format!("one size for all: {}", size.size())];
    };
    let mut wrong = Vec::new();
    if by_group.factor != form.factor() {
        wrong.push(format!("it differs by {}", by_group.factor));
    }
    for group in &by_group.groups {
        let of_group = truth.tightenings.iter().find(|one| {
            let parts: Vec<&str> = one.file.split('_').collect();
            parts.contains(&group.group.as_str())
        });
        let real = of_group.and_then(|one| one.used.get(hidden.name()));
        if group.present != real.is_some() {
            wrong.push(format!("{}: said {}", group.group, group.present));
        }
    }
    wrong
}

fn wrong(hidden: Hidden, strength: f64, form: Form, seed: u64) -> Vec<String> {
    let plan = plan().hiding(hidden, strength).of(form.whose());
    let campaign = blind::campaign_of(snug_study::Preset::Snug, &plan, seed);
    let begun = std::time::Instant::now();
    let diagnosis = blind::ask(&campaign.cases, Goal::Improve);
    let names: Vec<&str> = diagnosis
        .added
        .iter()
        .map(|one| one.effect.as_str())
        .collect();
    let reached = blind::error(&diagnosis);
    let label = format!("{} {form:?}, seed {seed}", hidden.name());
    let whose = diagnosis
        .added
        .first()
        .map(|one| one.parameters[0].size().to_string());
    println!(
        "{label}: {names:?}, {reached:.3}, {:.1} s, {whose:?}",
        begun.elapsed().as_secs_f64()
    );
    let mut wrong = Vec::new();
    if names.len() != 1 || !diagnosis.added.iter().any(|one| blind::names(one, hidden)) {
        wrong.push(format!("{names:?} was added"));
    } else if names == [hidden.name()] {
        wrong.extend(wrong_groups(&diagnosis, &campaign.truth, hidden, form));
    }
    if reached > 1.02 {
        wrong.push(format!("the error ends at {reached:.3}"));
    }
    wrong
        .into_iter()
        .map(|what| format!("{label}: {what}"))
        .collect()
}

#[test]
fn an_effect_that_differs_from_person_to_person_is_told_with_whose_it_is() {
    let all = |those: &[(Hidden, f64, Form)], seed: u64| -> Vec<String> {
        let found = those.iter();
        found
            .flat_map(|&(hidden, strength, form)| wrong(hidden, strength, form, seed))
            .collect()
    };
    // The last where many are asked for.
    let few = if snug_tests::many() { FEW.len() } else { 2 };
    let mut found = all(&FEW[..few], 1);
    if snug_tests::blind() {
        found.extend(all(&MORE, 1));
        found.extend(all(&FEW, 2));
        found.extend(all(&MORE, 2));
    }
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn people_who_differ_in_mass_damping_and_stiffness_only_are_no_effect() {
    let mut plan = plan();
    plan.population.between_participants = [0.5, 0.4, 0.5];
    let seeds = if snug_tests::blind() { 8 } else { 1 };
    for seed in 1..=seeds {
        let campaign = blind::campaign_of(snug_study::Preset::Snug, &plan, seed);
        let diagnosis = blind::ask(&campaign.cases, Goal::Improve);
        let names: Vec<&str> = diagnosis
            .added
            .iter()
            .map(|one| one.effect.as_str())
            .collect();
        assert!(names.is_empty(), "seed {seed}: {names:?}");
        assert_eq!(diagnosis.verdict, Verdict::Adequate);
    }
}
