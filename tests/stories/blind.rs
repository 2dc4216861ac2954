//! Effects hidden by a simulator of its own (another integrator, an eighth of the step, a continuous torque) under coloured
//! noise, a spread of people and a small bias: the climb must name them, reach the floor and stay quiet where nothing is.
//!
//! A handful by default; with `SNUG_BLIND` every effect at three strengths, pairs, every unlisted law and more campaigns
//! that hide nothing.

use snug_campaign::{AddedEffect, Diagnosis, Verdict};
use snug_diagnose::{DiagnoseSettings, Goal, Question, Watch, examine};
use snug_identify::FitTask;
use snug_model::Law;
use snug_study::{Preset, Study};
use snug_synthetic::{
    CampaignPlan, HiddenEffect as Hidden, MatStyle, NoiseKind, Truth, ZeroErrors, simulate,
};

/// One effect of each kind, at strengths that raise the error by about a fifth, and a gap so wide that some tightenings fall
/// behind the others.
const FEW: [(Hidden, f64); 5] = [
    (Hidden::TorqueDependentStiffness, 0.67),
    (Hidden::TorqueDelay, 0.16),
    (Hidden::Backlash, 1.0),
    (Hidden::CubicStiffness, 0.35),
    (Hidden::TorqueRipple, 0.15),
];

/// Every effect of the catalogue but an offset of the torque, which the quiet part shows, at strengths that raise the error by about 3 % and about a fifth, and strong: at its
/// largest plausible size or so.
const EVERY: [(Hidden, [f64; 3]); 25] = [
    (Hidden::CubicStiffness, [0.10, 0.35, 1.5]),
    (Hidden::QuadraticStiffness, [0.23, 0.78, 1.6]),
    (Hidden::CoulombFriction, [0.10, 0.32, 3.0]),
    (Hidden::QuadraticDamping, [0.21, 0.82, 3.0]),
    (Hidden::DirectionalDamping, [0.16, 0.53, 3.0]),
    (Hidden::Backlash, [0.005, 0.10, 1.0]),
    (Hidden::MaxwellBranch, [0.18, 0.59, 3.0]),
    (Hidden::SecondMass, [0.20, 0.79, 3.0]),
    (Hidden::GripSlip, [0.17, 0.53, 3.0]),
    (Hidden::BoucWen, [0.18, 0.57, 3.0]),
    (Hidden::StretchReflex, [0.18, 0.54, 2.0]),
    (Hidden::VoluntaryPush, [0.24, 0.74, 3.0]),
    (Hidden::CoContraction, [0.20, 0.58, 2.0]),
    (Hidden::TorqueDependentStiffness, [0.20, 0.67, 2.0]),
    (Hidden::TorqueDelay, [0.05, 0.16, 1.0]),
    (Hidden::TorqueLag, [0.033, 0.10, 0.5]),
    (Hidden::AccelerationLag, [0.033, 0.11, 1.0]),
    (Hidden::AccelerationBias, [0.94, 2.9, 5.0]),
    (Hidden::InitialMotion, [0.21, 0.64, 2.0]),
    (Hidden::OutputOffset, [0.6, 1.71, 3.0]),
    (Hidden::CentripetalCrosstalk, [0.81, 1.5, 3.0]),
    (Hidden::GravityLeakage, [0.61, 1.2, 3.0]),
    (Hidden::ExponentialStiffness, [0.10, 0.35, 1.5]),
    (Hidden::StribeckFriction, [0.10, 0.32, 2.0]),
    (Hidden::TorqueRipple, [0.05, 0.15, 1.0]),
];

/// Two at once, at strengths at which each raises the error by about a fifth.
const PAIRS: [([Hidden; 2], f64); 10] = [
    ([Hidden::CubicStiffness, Hidden::CoulombFriction], 0.35),
    ([Hidden::CoulombFriction, Hidden::AccelerationBias], 1.5),
    ([Hidden::MaxwellBranch, Hidden::CubicStiffness], 0.5),
    ([Hidden::VoluntaryPush, Hidden::QuadraticDamping], 0.7),
    ([Hidden::TorqueDelay, Hidden::CubicStiffness], 0.3),
    ([Hidden::BoucWen, Hidden::GravityLeakage], 0.8),
    ([Hidden::GripSlip, Hidden::DirectionalDamping], 0.5),
    ([Hidden::CoContraction, Hidden::CoulombFriction], 0.5),
    ([Hidden::Backlash, Hidden::CoulombFriction], 0.3),
    ([Hidden::StretchReflex, Hidden::TorqueDelay], 0.4),
];

pub struct Campaign {
    pub cases: Vec<FitTask<'static>>,
    pub truth: Truth,
}

fn campaign(effects: &[Hidden], strength: f64, seed: u64) -> Campaign {
    campaign_as(Preset::Snug, effects, strength, seed)
}

fn campaign_as(preset: Preset, effects: &[Hidden], strength: f64, seed: u64) -> Campaign {
    let mut plan = CampaignPlan::of_size(6, 4)
        .with_noise(NoiseKind::Coloured)
        .with_bias(0.02);
    for &effect in effects {
        plan = plan.hiding(effect, strength);
    }
    // What the quiet part shows is measured there and taken out; the climb has to find what it does not show.
    if effects.contains(&Hidden::AccelerationBias) {
        plan.sensors.zero_errors = ZeroErrors::WindowOnly;
    }
    campaign_of(preset, &plan, seed)
}

/// The campaign of a plan, written, read and prepared as a user's.
pub fn campaign_of(preset: Preset, plan: &CampaignPlan, seed: u64) -> Campaign {
    let simulated = simulate(plan, seed).unwrap();
    let folder = tempfile::tempdir().unwrap();
    simulated
        .write(&folder.path().join("data"), MatStyle::default())
        .unwrap();
    let mut study = Study::on(folder.path().join("data"));
    study.set_preset(preset);
    let listing = snug_ingest::list(&study.source, &study.source.path).unwrap();
    let cases = snug_study::cases(&study, &listing.files, usize::MAX).unwrap();
    Campaign {
        cases,
        truth: simulated.truth,
    }
}

pub fn ask(cases: &[FitTask<'_>], goal: Goal) -> Diagnosis {
    ask_telling(cases, goal, &|_| ())
}

/// The same, telling of every stage.
pub fn ask_telling(cases: &[FitTask<'_>], goal: Goal, tell: &(dyn Fn(&str) + Sync)) -> Diagnosis {
    let question = Question::new(cases, goal);
    examine(&question, &DiagnoseSettings::default(), &Watch::new(tell))
        .unwrap()
        .diagnosis
}

pub fn error(diagnosis: &Diagnosis) -> f64 {
    diagnosis.ladder.last().unwrap().error_over_noise.unwrap()
}

/// What is left where nothing is hidden: the same people, pulses and noise.
fn floor(seed: u64) -> f64 {
    error(&ask(&campaign(&[], 0.0, seed).cases, Goal::Compare))
}

/// What an effect is called in the acceleration, where an offset of the output is a bias.
fn name(effect: Hidden) -> &'static str {
    match effect {
        Hidden::OutputOffset => "acceleration_bias",
        other => other.name(),
    }
}

pub fn names(added: &AddedEffect, effect: Hidden) -> bool {
    added.effect == name(effect) || added.twins.iter().any(|twin| twin == name(effect))
}

/// How many of the sizes' intervals hold the truth, and how many there are.
fn covered(added: &AddedEffect, truth: &Truth) -> (usize, usize) {
    let Some(values) = truth.tightenings[0].used.get(&added.effect) else {
        return (0, 0);
    };
    let sizes = added.parameters.iter().zip(values);
    let shared = sizes.filter(|(size, _)| !size.per_tightening);
    shared.fold((0, 0), |(inside, all), (size, truth)| {
        let holds = size.low.is_some_and(|low| low <= *truth)
            && size.high.is_some_and(|high| high >= *truth);
        (inside + usize::from(holds), all + 1)
    })
}

/// What is wrong with the answer to hidden effects, and how many of the sizes' intervals hold the truth.
fn verdict_on(effects: &[Hidden], strength: f64, seed: u64) -> (Vec<String>, (usize, usize)) {
    let Campaign { cases, truth } = campaign(effects, strength, seed);
    let diagnosis = ask(&cases, Goal::Improve);
    let mut wrong = Vec::new();
    let hidden: Vec<&str> = effects.iter().map(|&effect| name(effect)).collect();
    let label = format!("{} at {strength}, seed {seed}", hidden.join(" and "));
    let added: Vec<&str> = diagnosis
        .added
        .iter()
        .map(|one| one.effect.as_str())
        .collect();
    let is_named = |&effect: &Hidden| diagnosis.added.iter().any(|one| names(one, effect));
    if added.len() != effects.len() || !effects.iter().all(is_named) {
        wrong.push(format!("{label}: {added:?} was added"));
    }
    let (reached, floor) = (error(&diagnosis), floor(seed));
    if reached > 1.05 * floor {
        wrong.push(format!(
            "{label}: the error ends at {reached:.3}, the floor is {floor:.3}"
        ));
    }
    let of_hidden = (diagnosis.added.iter()).filter(|one| hidden.contains(&one.effect.as_str()));
    let intervals = of_hidden.fold((0, 0), |(inside, all), one| {
        let (holding, sizes) = covered(one, &truth);
        (inside + holding, all + sizes)
    });
    println!("{label}: {added:?}, error {reached:.3} of {floor:.3}, intervals {intervals:?}");
    (wrong, intervals)
}

/// Each of the campaigns has its effects named, its floor reached and nearly all of its intervals right.
fn hold(campaigns: impl Iterator<Item = (Vec<Hidden>, f64)>) {
    let (mut wrong, mut inside, mut all) = (Vec::new(), 0, 0);
    for (effects, strength) in campaigns {
        let (found, (covered, sizes)) = verdict_on(&effects, strength, 1);
        wrong.extend(found);
        inside += covered;
        all += sizes;
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    // 95 % of the intervals: one of a few may miss, of 30 no more than 4 (with a chance of 1.6 %).
    let misses = all - inside;
    assert!(
        misses <= 1 + all / 10,
        "{misses} of {all} intervals miss the truth"
    );
}

/// Every effect alone at one of its three strengths.
fn every(strength: usize) -> impl Iterator<Item = (Vec<Hidden>, f64)> {
    let asked_for = if snug_tests::blind() {
        EVERY.len()
    } else {
        println!("skipped: every effect is hidden only when SNUG_BLIND is set");
        0
    };
    let all = EVERY.into_iter().take(asked_for);
    all.map(move |(effect, strengths)| (vec![effect], strengths[strength]))
}

#[test]
fn a_hidden_effect_is_named_and_the_floor_reached() {
    // The last two where many are asked for.
    let few = if snug_tests::many() { FEW.len() } else { 3 };
    let few = FEW.into_iter().take(few);
    hold(few.map(|(effect, strength)| (vec![effect], strength)));
    hold(every(1));
}

#[test]
fn a_faint_effect_is_named_and_the_floor_reached() {
    hold(every(0));
}

#[test]
fn a_strong_effect_is_named_and_the_floor_reached() {
    hold(every(2));
}

#[test]
fn two_effects_at_once_are_named_and_the_floor_reached() {
    let asked_for = if snug_tests::blind() { PAIRS.len() } else { 1 };
    let pairs = PAIRS.into_iter().take(asked_for);
    hold(pairs.map(|(effects, strength)| (effects.to_vec(), strength)));
}

/// The torque reads 1 Nm too much all the time: seen in the quiet part and taken out, or, as the original program left
/// it, to be found.
#[test]
fn an_offset_of_the_torque_is_named_whoever_finds_it() {
    let offset = |preset| campaign_as(preset, &[Hidden::TorqueOffset], 1.0, 1).cases;
    let measured = ask(&offset(Preset::Snug), Goal::Improve);
    let corrected = (measured.corrected.iter()).find(|one| one.effect == "torque_offset");
    let corrected = corrected.unwrap();
    assert_eq!(corrected.share, 1.0, "{}", measured.headline);
    assert!((corrected.size - 1.0).abs() < 0.01, "{}", corrected.size);
    assert_eq!(measured.verdict, Verdict::Adequate);
    assert!(measured.added.is_empty(), "{:?}", measured.added);
    let found = ask(&offset(Preset::Thesis), Goal::Improve);
    let is_named = found
        .added
        .iter()
        .any(|one| names(one, Hidden::TorqueOffset));
    assert!(is_named, "{}", found.headline);
}

#[test]
fn nothing_is_named_where_nothing_is_hidden() {
    let seeds = if snug_tests::blind() { 20 } else { 1 };
    let mut alarms = Vec::new();
    for seed in 1..=seeds {
        let diagnosis = ask(&campaign(&[], 0.0, seed).cases, Goal::Improve);
        if !diagnosis.added.is_empty() || diagnosis.verdict != Verdict::Adequate {
            alarms.push((seed, diagnosis.verdict, diagnosis.headline));
        }
    }
    // One in twenty is what the level allows; more than two of twenty happens with a chance of 8 %, three with 2 %.
    let allowed = if seeds > 1 { 2 } else { 0 };
    assert!(alarms.len() <= allowed, "{alarms:#?}");
}

#[test]
fn a_law_outside_the_catalogue_is_called_so() {
    let every = [
        Hidden::X2vDamping,
        Hidden::XvDamping,
        Hidden::PositionFriction,
        Hidden::CubicDamping,
        Hidden::QuinticStiffness,
        Hidden::EndStop,
    ];
    let laws = if snug_tests::blind() {
        &every[..]
    } else {
        &every[..1]
    };
    let mut wrong = Vec::new();
    for &law in laws {
        let diagnosis = ask(&campaign(&[law], 0.3, 1).cases, Goal::Improve);
        if diagnosis.verdict != Verdict::UnlistedEffect || diagnosis.unlisted.is_none() {
            wrong.push((law.name(), diagnosis.verdict, diagnosis.headline));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// What is offered to be pasted into a study is a law that a study can declare, and describes what was hidden.
#[test]
fn a_law_with_two_numbers_is_found_and_can_be_pasted() {
    let diagnosis = ask(&campaign(&[Hidden::EndStop], 0.4, 1).cases, Goal::Improve);
    let unlisted = diagnosis.unlisted.unwrap();
    assert_eq!(
        unlisted.expression, "p*max(0,x-x0)",
        "{}",
        diagnosis.headline
    );
    for (found, hidden) in diagnosis.added[0].parameters.iter().zip([2000.0, 0.007]) {
        assert!((found.value / hidden - 1.0).abs() < 0.05, "{found:?}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.ron");
    std::fs::write(&path, format!("(model: (custom: [{}]))", unlisted.ron)).unwrap();
    let declared = Study::read(&path).unwrap().model.custom_effects().unwrap();
    let parameters = declared[0].description().parameters;
    let starts: Vec<f64> = parameters.iter().map(|one| one.starts[0]).collect();
    for (start, found) in starts.iter().zip(&diagnosis.added[0].parameters) {
        assert!(
            (start / found.value - 1.0).abs() < 1e-3,
            "{start} {found:?}"
        );
    }
}
