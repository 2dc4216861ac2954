//! The views of a misfit on made-up residuals whose place is known.

#![allow(clippy::unwrap_used)]

mod correlation;
mod drift;
mod response;
mod tone;

use super::missing_force::missing_force_n;
use super::residual::Residuals;
use super::{Seen, compare, drifts, locate};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use snug_campaign::words::remark::Remark;
use snug_campaign::{
    Conditions, Estimate, FitStatus, Identifiability, Intersample, Motion, NoiseFloor, NoiseSource,
    ParameterEstimate, Quantity, Rig, Tightening, TighteningId, TimeBase,
};
use snug_model::{Input, Model};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const INTERVAL_S: f64 = 1e-4;
const ONSET: usize = 200;
const SAMPLES: usize = 3000;
const NOISE: f64 = 0.5;

/// One made-up tightening with its simulation and the parameters of it.
struct Made {
    tightening: Tightening,
    simulated: Motion,
    estimate: Estimate,
}

impl Made {
    fn seen(&self) -> Seen<'_> {
        Seen {
            tightening: &self.tightening,
            simulated: &self.simulated,
            estimate: &self.estimate,
            unscored: 0,
        }
    }
}

fn seen(made: &[Made]) -> Vec<Seen<'_>> {
    made.iter().map(Made::seen).collect()
}

fn estimate(values: [f64; 3]) -> Estimate {
    let parameters = snug_model::BASE_PARAMETERS
        .iter()
        .zip(values)
        .map(|(name, value)| ParameterEstimate {
            name: (*name).to_owned(),
            unit: String::new(),
            value,
            standard_error: None,
            interval: None,
            fixed: false,
        })
        .collect();
    Estimate {
        parameters,
        covariance: Vec::new(),
        status: FitStatus::Converged,
        active_constraints: Vec::new(),
        identifiability: Identifiability {
            rank: 3,
            free: 3,
            condition: 1.0,
            strongest_correlation: None,
        },
        iterations: 1,
        evaluations: 1,
        conic_solves: 0,
    }
}

/// A straight rise over 40 ms to `target_nm` and a fall over 20 ms.
fn torque_nm(target_nm: f64) -> Vec<f64> {
    (0..SAMPLES)
        .map(|index| {
            let t = (index as f64 - ONSET as f64) * INTERVAL_S;
            target_nm * (t / 0.04).min((0.06 - t) / 0.02).clamp(0.0, 1.0)
        })
        .collect()
}

/// Standard normal by Box and Muller.
fn normal(generator: &mut ChaCha8Rng) -> f64 {
    let u: f64 = 1.0 - generator.random::<f64>();
    let v: f64 = generator.random();
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

/// A tightening that is its own simulation plus, in each quantity, what `error` says of (sample, time since onset).
fn made(number: u32, values: [f64; 3], target_nm: f64) -> Made {
    let torque_nm = torque_nm(target_nm);
    let input = Input::new(&torque_nm, INTERVAL_S, Intersample::Linear);
    let simulated = Model::new(RIG, &[])
        .unwrap()
        .simulate(&values, &input)
        .unwrap();
    let person = number % 4 + 1;
    Made {
        tightening: Tightening {
            id: TighteningId {
                file: format!("TP{person}.mat"),
                number,
            },
            conditions: Conditions {
                participant: Some(format!("TP{person}")),
                ..Conditions::default()
            },
            rig: RIG,
            time_base: TimeBase {
                start_s: 1.48,
                interval_s: INTERVAL_S,
            },
            peak_torque_nm: target_nm,
            target_torque_nm: target_nm,
            torque_nm,
            motion: simulated.clone(),
            grip_force_n: None,
            onset: Some(ONSET),
            noise: Some(NoiseFloor {
                source: NoiseSource::PreRoll,
                quantity: Quantity::Acceleration,
                standard_deviation: NOISE,
                autoregression: Vec::new(),
                innovation_sd: NOISE,
                samples: 14_000,
            }),
            corrections: Vec::new(),
        },
        simulated,
        estimate: estimate(values),
    }
}

const HAND: [f64; 3] = [2.3, 90.0, 2300.0];

/// Tightenings whose acceleration holds white noise and, besides, `misfit(tightening, time since onset)`.
fn campaign(count: u32, seed: u64, misfit: impl Fn(u32, f64) -> f64) -> Vec<Made> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    (0..count)
        .map(|number| {
            let mut made = made(number + 1, HAND, 20.0 + 5.0 * f64::from(number % 4));
            let acceleration = made.tightening.motion.acceleration_rad_per_s2.as_mut();
            for (index, value) in acceleration.unwrap().iter_mut().enumerate() {
                let t = (index as f64 - ONSET as f64) * INTERVAL_S;
                *value += NOISE * normal(&mut generator) + misfit(number, t);
            }
            made
        })
        .collect()
}

/// 1 between 60 and 100 ms.
fn late(t: f64) -> f64 {
    f64::from(u8::from((0.06..0.1).contains(&t)))
}

#[test]
fn noise_alone_is_one_everywhere() {
    let (mut inside, mut parts) = (0, 0);
    for seed in 0..3 {
        let made = campaign(12, seed, |_, _| 0.0);
        let location = locate(&seen(&made), 1);
        for share in location.aspects.iter().flat_map(|aspect| &aspect.parts) {
            let samples = share.samples as f64;
            assert!(
                (share.error_over_noise - 1.0).abs() < 4.5 / (2.0 * samples).sqrt() + 0.01,
                "{share:?}"
            );
            assert_eq!(share.share_of_excess, 0.0);
            let interval = share.interval.unwrap();
            parts += 1;
            inside += usize::from(interval.low <= 1.0 && 1.0 <= interval.high);
        }
        assert_eq!(location.repeatable_share, Some(0.0));
        assert_eq!(location.remarks.len(), 1, "{:?}", location.remarks);
    }
    let coverage = f64::from(inside as u32) / f64::from(parts);
    assert!((0.89..=0.995).contains(&coverage), "{coverage} of {parts}");
}

/// A misfit of known size in a known place: 3 noises high, from 60 to 100 ms.
#[test]
fn a_misfit_is_found_where_and_as_large_as_it_is() {
    let made = campaign(12, 4, |_, t| 3.0 * NOISE * late(t));
    let location = locate(&seen(&made), 1);
    let aspect = |name: &str| {
        let mut aspects = location.aspects.iter();
        &aspects.find(|aspect| aspect.aspect == name).unwrap().parts
    };
    let time = aspect("time_since_onset_s");
    let here: Vec<_> = time
        .iter()
        .filter(|part| part.from.unwrap() > 0.059 && part.to.unwrap() < 0.101)
        .collect();
    assert_eq!(here.len(), 2);
    for part in &here {
        assert!(
            (part.error_over_noise - 10_f64.sqrt()).abs() < 0.1,
            "{part:?}"
        );
    }
    let share: f64 = here.iter().map(|part| part.share_of_excess).sum();
    assert!((share - 1.0).abs() < 0.03, "{share}");
    let all: f64 = time.iter().map(|part| part.share_of_excess).sum();
    assert!((all - 1.0).abs() < 1e-9, "{all}");
    let people = aspect("participant");
    assert_eq!(people.len(), 4);
    assert!(
        people
            .iter()
            .all(|part| (part.share_of_excess - 0.25).abs() < 0.03)
    );
    // A pulse of 40 ms has its power below 1/0.04 s = 25 Hz, and most of it below half of that.
    let slow: f64 = aspect("frequency_hz")
        .iter()
        .filter(|part| part.to.unwrap() <= 20.0)
        .map(|part| part.share_of_excess)
        .sum();
    assert!(slow > 0.8, "{slow}");
    assert!(location.repeatable_share.unwrap() > 0.95);
    let told = said(&location.remarks);
    assert!(told.contains("60 to 100 ms"), "{told}");
}

/// The same misfit with a sign of its own per tightening comes back in no other; half of the campaign the same way does.
#[test]
fn only_what_comes_back_is_repeatable() {
    let signs = [
        1.0, -1.0, -1.0, 1.0, 1.0, -1.0, 1.0, -1.0, -1.0, 1.0, -1.0, 1.0,
    ];
    let share = |of: &dyn Fn(u32, f64) -> f64| {
        let made = campaign(12, 5, of);
        locate(&seen(&made), 1).repeatable_share.unwrap()
    };
    let own = share(&|number, t| 3.0 * NOISE * late(t) * signs[number as usize]);
    assert!(own < 0.1, "{own}");
    // Two misfits of the same energy: one shared, one anywhere else in each tightening.
    let half = share(&|number, t| {
        let elsewhere = 0.1 + 0.01 * f64::from(number);
        let there = (elsewhere..elsewhere + 0.04).contains(&t);
        3.0 * NOISE * (late(t) + signs[number as usize] * f64::from(u8::from(there)))
    });
    assert!((half - 0.5).abs() < 0.12, "{half}");
}

/// A force that is known along a known motion: measured α = (T − l (k x + c v + F)) / I, with x, v its own integrals.
fn hidden(
    number: u32,
    target_nm: f64,
    force_n: impl Fn(f64, f64, f64) -> f64,
    generator: &mut ChaCha8Rng,
) -> Made {
    let mut made = made(number, HAND, target_nm);
    let l = RIG.lever_arm_m;
    let inertia = RIG.known_inertia_kg_m2 + HAND[0] * l * l;
    let (mut angle, mut velocity) = (0.0, 0.0);
    let mut signals: [Vec<f64>; 3] = Default::default();
    for (index, torque) in made.tightening.torque_nm.iter().enumerate() {
        let t = (index as f64 - ONSET as f64) * INTERVAL_S;
        let (x, v) = (l * angle, l * velocity);
        let hand = HAND[2] * x + HAND[1] * v + force_n(t, x, v);
        let acceleration = (torque - l * hand) / inertia;
        let measured = [angle, velocity, acceleration + NOISE * normal(generator)];
        signals
            .iter_mut()
            .zip(measured)
            .for_each(|(s, y)| s.push(y));
        // The trajectory need not obey the equations to the last digit; α does at every sample.
        velocity += INTERVAL_S * acceleration;
        angle += INTERVAL_S * velocity;
    }
    let [angle, velocity, acceleration] = signals;
    made.tightening.motion = Motion {
        displacement_rad: Some(angle),
        velocity_rad_per_s: Some(velocity),
        acceleration_rad_per_s2: Some(acceleration),
    };
    made
}

#[test]
fn the_missing_force_is_the_one_that_was_hidden() {
    let mut generator = ChaCha8Rng::seed_from_u64(6);
    let push = |t: f64| 25.0 * (-((t - 0.08) / 0.02).powi(2)).exp();
    let cubic = |x: f64| 4e5 * x * x * x;
    let made: Vec<Made> = (1..=16)
        .map(|number| hidden(number, 30.0, |t, x, _| push(t) + cubic(x), &mut generator))
        .collect();
    let seen = seen(&made);
    let location = locate(&seen, 1);
    let curve = &location.force_over_time;
    assert!(curve.at.len() == 60 && curve.low_n.len() == 60);
    // All move alike, so the truth over time is that of the first: its mean over each bin.
    let width = curve.at[1] - curve.at[0];
    let angle = made[0].tightening.motion.displacement_rad.as_ref().unwrap();
    let mut inside = 0;
    for bin in 0..60 {
        let here: Vec<f64> = (0..SAMPLES)
            .map(|index| (index, (index as f64 - ONSET as f64) * INTERVAL_S))
            .filter(|(_, t)| (t - curve.at[bin]).abs() <= 0.5 * width)
            .map(|(index, t)| push(t) + cubic(RIG.lever_arm_m * angle[index]))
            .collect();
        let truth = here.iter().sum::<f64>() / here.len() as f64;
        assert!((curve.force_n[bin] - truth).abs() < 0.5, "{bin}: {truth}");
        inside +=
            usize::from(curve.low_n[bin] - 0.05 <= truth && truth <= curve.high_n[bin] + 0.05);
    }
    assert!(inside >= 54, "{inside} of 60");
    let map = &location.force_map;
    assert_eq!(map.force_n.len(), map.x_m.len() * map.v_m_per_s.len());
    assert!(map.force_n.iter().flatten().count() > 20);
}

/// Laws, each told by its own name, and predicted from other files although every tightening has another target.
#[test]
fn the_missing_force_follows_the_law_that_was_hidden() {
    type Law = fn(f64, f64) -> f64;
    let laws: [(&str, Law); 4] = [
        ("x³,", |x, _| 5e6 * x * x * x),
        ("the sign of the velocity,", |_, v| 8.0 * (v / 0.01).tanh()),
        ("x² v,", |x, v| 4e5 * x * x * v),
        ("v|v|,", |_, v| 80.0 * v * v.abs()),
    ];
    for (name, law) in laws {
        let mut generator = ChaCha8Rng::seed_from_u64(11);
        let made: Vec<Made> = (1..=12)
            .map(|number| {
                let target_nm = 15.0 + 5.0 * f64::from(number % 5);
                hidden(number, target_nm, |_, x, v| law(x, v), &mut generator)
            })
            .collect();
        let location = locate(&seen(&made), 1);
        let told = said(&location.remarks);
        assert!(
            told.contains(&format!("The missing force follows {name}")),
            "{name} {told}"
        );
        let share = location.repeatable_share.unwrap();
        assert!(share > 0.8, "{name} {share}");
    }
}

/// Without an effect the missing force is exactly the equation error along the measured motion.
#[test]
fn the_missing_force_is_the_equation_error() {
    let mut generator = ChaCha8Rng::seed_from_u64(7);
    let made = [hidden(
        1,
        30.0,
        |_, x, v| 9e3 * x * x + 40.0 * v * v.abs(),
        &mut generator,
    )];
    let residuals = Residuals::of(&seen(&made));
    let force = missing_force_n(&residuals.all[0]).unwrap();
    let tightening = &made[0].tightening;
    let l = RIG.lever_arm_m;
    let inertia = RIG.known_inertia_kg_m2 + HAND[0] * l * l;
    for index in (0..SAMPLES).step_by(37) {
        let of = |quantity| tightening.motion.get(quantity).unwrap()[index];
        let expected = (tightening.torque_nm[index] - inertia * of(Quantity::Acceleration)) / l
            - HAND[2] * l * of(Quantity::Displacement)
            - HAND[1] * l * of(Quantity::Velocity);
        assert!((force[index] - expected).abs() < 1e-9 * 100.0, "{index}");
    }
}

#[test]
fn same_seed_same_bits_and_another_seed_other_bands() {
    let made = campaign(6, 8, |_, t| NOISE * late(t));
    let seen = seen(&made);
    let first = locate(&seen, 3);
    assert_eq!(first, locate(&seen, 3));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    assert_eq!(first, pool.install(|| locate(&seen, 3)));
    assert_ne!(first, locate(&seen, 4));
}

/// One long record without onset or noise floor, measured in displacement alone.
#[test]
fn a_single_long_record_is_looked_at_as_far_as_it_goes() {
    let mut made = made(1, HAND, 30.0);
    let samples = 65_000;
    let wave = |size: f64| (0..samples).map(|i| size * f64::from(i).sin()).collect();
    made.tightening.torque_nm = wave(1.0);
    made.tightening.onset = None;
    made.tightening.noise = None;
    made.tightening.conditions = Conditions::default();
    made.tightening.motion = Motion {
        displacement_rad: Some(wave(0.11)),
        ..Motion::default()
    };
    made.simulated = Motion {
        displacement_rad: Some(wave(0.1)),
        ..Motion::default()
    };
    let seen = [made.seen()];
    let location = locate(&seen, 1);
    let names: Vec<&str> = location.aspects.iter().map(|a| a.aspect.as_str()).collect();
    assert!(
        names.contains(&"frequency_hz") && !names.contains(&"phase"),
        "{names:?}"
    );
    assert!(location.aspects.iter().all(|a| a.parts.len() <= 42));
    assert_eq!(location.repeatable_share, None);
    assert!(location.force_over_time.at.is_empty());
    assert!(drifts(&seen).is_empty());
    let pooled = compare(&seen).pooled;
    assert_eq!(pooled.len(), 1);
    // 0.11 against 0.1: an error of 0.01/0.11.
    assert!((pooled[0].relative_percent.unwrap() - 100.0 / 11.0).abs() < 1e-9);
    assert_eq!(pooled[0].over_noise, None);
    assert_eq!(locate(&[], 1), Default::default());
    assert_eq!(compare(&[]), Default::default());
}

#[test]
fn the_comparison_is_in_units_percent_and_noise_worst_first() {
    let made = campaign(3, 9, |number, _| 2.0 * NOISE * f64::from(number));
    let comparison = compare(&seen(&made));
    let order: Vec<u32> = comparison.tightenings.iter().map(|t| t.id.number).collect();
    assert_eq!(order, [3, 2, 1]);
    let worst = &comparison.tightenings[0].misfits;
    let [acceleration, velocity, _, force] = &worst[..] else {
        panic!("four quantities: {worst:?}");
    };
    // A constant of 4 noises and the noise itself: √17.
    let expected = 17_f64.sqrt();
    assert!((acceleration.over_noise.unwrap() / expected - 1.0).abs() < 0.02);
    assert!((acceleration.rms / (NOISE * expected) - 1.0).abs() < 0.02);
    assert_eq!((velocity.rms, velocity.fit_percent), (0.0, Some(100.0)));
    let ratio = RIG.known_inertia_kg_m2 / RIG.lever_arm_m;
    assert!((force.rms / (ratio * acceleration.rms) - 1.0).abs() < 1e-9);
    // 0, 2 and 4 noises: a mean square of 1 + 20/3.
    let pooled = comparison.pooled[0].over_noise.unwrap();
    assert!(
        (pooled / (23.0_f64 / 3.0).sqrt() - 1.0).abs() < 0.02,
        "{pooled}"
    );
}

fn said(remarks: &[Remark]) -> String {
    remarks
        .iter()
        .map(Remark::to_string)
        .collect::<Vec<_>>()
        .join(" ")
}
