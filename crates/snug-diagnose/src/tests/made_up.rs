//! Made-up tightenings, candidates and rankings for tests: of a few numbers, small enough to be worked out by hand.

use crate::data::cases::{Cases, Tally};
use crate::data::clusters::Clusters;
use crate::data::watch::Watch;
use crate::library::terms;
use crate::pooled::fitted::Fitted;
use crate::pooled::sharing::Sharing;
use crate::ranking::rank::{Candidate, Ranking};
use crate::selection::model_selection::ModelSelection;
use crate::settings::DiagnoseSettings;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use snug_campaign::{Intersample, Motion, NoiseFloor, Quantity, Rig, Tightening, TighteningId};
use snug_identify::{ConstraintKind, FitTask, IdentifySettings};
use snug_model::{
    CustomEffectSettings, CustomParameterSettings, Effect, Input, Model, Place, Scale,
};
use std::borrow::Cow;

pub(crate) const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
pub(crate) const INTERVAL_S: f64 = 1e-3;
pub(crate) const SAMPLES: usize = 250;
/// Standard deviation of the acceleration's noise \[rad/s²\].
pub(crate) const NOISE: f64 = 0.3;
/// Every tightening is a cluster.
pub(crate) const WHOLE: Clusters = Clusters { per_case: 1 };

/// m, c, k of the hand that holds the tool in tightening `number`.
pub(crate) fn hand(number: usize) -> [f64; 3] {
    [2.0 + 0.1 * number as f64, 90.0, 2200.0]
}

/// Tightening `number`: a torque that rises over 60 ms, to more from one to the next, and the motion of the base model with
/// `effects` of these `sizes`, exactly. Its noise is stated, and there is none.
pub(crate) fn exact(number: usize, effects: &[Effect], sizes: &[f64]) -> FitTask<'static> {
    let peak_nm = 20.0 + 5.0 * number as f64;
    let rise = 60;
    let torque_nm: Vec<f64> = (0..SAMPLES)
        .map(|k| {
            if k < rise {
                peak_nm * k as f64 / rise as f64
            } else {
                0.0
            }
        })
        .collect();
    let input = Input::new(&torque_nm, INTERVAL_S, Intersample::Linear);
    let truth = Model::new(RIG, effects).expect("the effects go together");
    let motion = truth
        .simulate(&[&hand(number), sizes].concat(), &input)
        .expect("as many values as parameters");
    case(number, torque_nm, input, motion)
}

fn case(number: usize, torque_nm: Vec<f64>, input: Input, motion: Motion) -> FitTask<'static> {
    let mut tightening = Tightening::from_torque(RIG, INTERVAL_S, torque_nm)
        .with_noise(NoiseFloor::white(Quantity::Acceleration, NOISE));
    tightening.id = TighteningId {
        file: "made_up.mat".into(),
        number: number as u32 + 1,
    };
    tightening.motion = motion;
    tightening.onset = Some(0);
    FitTask {
        tightening: Cow::Owned(tightening),
        input: Cow::Owned(input),
        model: Cow::Owned(Model::new(RIG, &[]).expect("the rig is one")),
        settings: Cow::Owned(IdentifySettings {
            constraints: vec![ConstraintKind::Positive],
            ..IdentifySettings::default()
        }),
    }
}

/// The same with the noise that it states on the acceleration.
pub(crate) fn noisy(number: usize, effects: &[Effect], sizes: &[f64]) -> FitTask<'static> {
    let mut case = exact(number, effects, sizes);
    let mut random = ChaCha8Rng::seed_from_u64(number as u64);
    let acceleration = &mut case.tightening.to_mut().motion.acceleration_rad_per_s2;
    for value in acceleration.iter_mut().flatten() {
        let draw: f64 = StandardNormal.sample(&mut random);
        *value += NOISE * draw;
    }
    case
}

/// A machine of 0.4 kg m², 1.9 Nm s/rad and 30 Nm/rad whose velocity is written down, a sum of two sines, with the torque that this
/// takes beside dry friction of `friction_nm`: 15 s at 200 Hz.
pub(crate) fn machine_with_friction(friction_nm: f64) -> FitTask<'static> {
    machine_sampled(5e-3, friction_nm)
}

/// The same with 3000 samples every `interval_s`.
pub(crate) fn machine_sampled(interval_s: f64, friction_nm: f64) -> FitTask<'static> {
    let scale = Scale::Rig {
        torque_nm: 15.0,
        angle_rad: 0.8,
        time_s: 0.15,
    };
    let (mut torque_nm, mut measured) = (Vec::new(), Vec::new());
    for sample in 0..3000 {
        let t = f64::from(sample) * interval_s;
        let (x, y) = (5.0 * t, 11.0 * t);
        let angle = x.sin() + 0.5 * y.sin();
        let velocity = 5.0 * x.cos() + 5.5 * y.cos();
        let acceleration = -25.0 * x.sin() - 60.5 * y.sin();
        let friction = friction_nm * velocity.signum();
        torque_nm.push(0.4 * acceleration + 1.9 * velocity + 30.0 * angle + friction);
        measured.push(velocity);
    }
    on_machine(scale, interval_s, torque_nm, Quantity::Velocity, measured)
}

/// A recording of a machine of this scale, on an arm of 1 m.
pub(crate) fn on_machine(
    scale: Scale,
    interval_s: f64,
    torque_nm: Vec<f64>,
    quantity: Quantity,
    measured: Vec<f64>,
) -> FitTask<'static> {
    let rig = Rig {
        lever_arm_m: 1.0,
        known_inertia_kg_m2: 0.0,
    };
    let task = FitTask::from_arrays(rig, interval_s, torque_nm, quantity, measured);
    FitTask {
        model: Cow::Owned(Model::scaled(rig, &[], scale).expect("the rig is one")),
        ..task.expect("its parts do not contradict each other")
    }
}

/// A candidate that leaves nothing but noise, in as many tightenings as it has `gains`.
pub(crate) fn candidate(effect: Effect, p_family: f64, gains: &[f64]) -> Candidate {
    Candidate {
        is_told_from_nothing: true,
        shows_beside_restarts: true,
        effect,
        score: 0.0,
        p_family,
        fitted: Fitted::made_up(&[effect], &vec![100.0; gains.len()], 100),
        gains: gains.to_vec(),
    }
}

/// These candidates in this order, and nothing else.
pub(crate) fn ranking(candidates: Vec<Candidate>) -> Ranking {
    Ranking {
        candidates,
        ..Ranking::default()
    }
}

/// Runs `look` with a search among `cases`.
pub(crate) fn with_selection<T>(
    cases: &[FitTask<'_>],
    settings: &DiagnoseSettings,
    look: impl FnOnce(&ModelSelection<'_>) -> T,
) -> T {
    let (tally, watch) = (Tally::default(), silent());
    look(&ModelSelection {
        cases: Cases::new(cases, &tally),
        own: &[],
        sharing: &Sharing::default(),
        custom: &[],
        clusters: WHOLE,
        settings,
        watch: &watch,
        may_ask_for_steps: false,
        until: None,
    })
}

/// Settings without control campaigns: so many sign flips, one start.
pub(crate) fn quick(sign_flips: usize) -> DiagnoseSettings {
    DiagnoseSettings {
        control_campaigns: 0,
        sign_flips,
        starts: 1,
        ..DiagnoseSettings::default()
    }
}

/// A machine that moves as far and as fast as a hand, so that what is a hand's is its own.
const LIKE_A_HAND: Scale = Scale::Rig {
    torque_nm: 10.0,
    angle_rad: 0.03,
    time_s: 0.04,
};

/// The term called `name`, which is in no catalogue.
pub(crate) fn term(name: &str) -> Effect {
    let [of_hand, of_machine] = [Scale::HandOnTool, LIKE_A_HAND]
        .map(|scale| terms(scale, &RIG).expect("the terms are well formed"));
    let mut all = of_hand.into_iter().chain(of_machine);
    all.find(|term| term.name() == name)
        .expect("there is such a term")
}

/// A force `expression` of one number p that begins at `start` and may be anything.
pub(crate) fn custom_force(name: &str, expression: &str, start: f64) -> Effect {
    Effect::custom(&CustomEffectSettings {
        name: name.to_owned(),
        place: Place::Force,
        expression: expression.to_owned(),
        parameters: vec![CustomParameterSettings {
            name: "p".to_owned(),
            unit: "N".to_owned(),
            start,
            further_starts: Vec::new(),
            minimum: f64::NEG_INFINITY,
            maximum: f64::INFINITY,
            shared: true,
        }],
    })
    .expect("the law is well formed")
}

/// Nobody listens.
pub(crate) fn silent() -> Watch<'static> {
    Watch::new(&|_| {})
}

/// Asserts that two numbers agree to `share` of the second.
#[track_caller]
pub(crate) fn close(found: f64, expected: f64, share: f64) {
    let apart = (found - expected).abs();
    assert!(
        apart <= share * expected.abs(),
        "{found} found, {expected} expected"
    );
}
