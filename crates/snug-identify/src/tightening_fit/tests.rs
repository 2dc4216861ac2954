//! Sweeps side by side against the general road: residual and Jacobian stored, J factored by reflections.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::race::race;
use crate::rough_starts::RoughRecord;
use crate::starts::best;
use crate::valleys::RULES;
use crate::{DenseResidual, Residual, ResidualNoise, solve_from_starts};
use snug_campaign::{
    Conditions, Correction, Intersample, Motion, NoiseFloor, NoiseSource, Rig, TighteningId,
    TimeBase,
};
use snug_model::{Effect, Run, simulate_side_by_side};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const INTERVAL_S: f64 = 5e-4;

/// What a simulated tightening is like.
#[derive(Clone)]
struct Plan {
    truth: [f64; 3],
    samples: usize,
    /// Of the acceleration's noise; none: not known.
    autoregression: Option<Vec<f64>>,
    noise_rad_per_s2: f64,
    intersample: Intersample,
    /// A cubic spring that the base model does not have \[N/m³\].
    cubic_n_per_m3: f64,
}

const USUAL: [f64; 3] = [2.3, 38.0, 2315.0];

fn plan() -> Plan {
    Plan {
        truth: USUAL,
        samples: 900,
        autoregression: Some(vec![-0.6, 0.2]),
        noise_rad_per_s2: 0.05,
        intersample: Intersample::Linear,
        cubic_n_per_m3: 0.0,
    }
}

/// Usual ones, of several lengths, and all that is out of the ordinary.
fn plans() -> Vec<Plan> {
    let usual = (0..9).map(|index: u32| Plan {
        truth: [
            1.5 + 0.2 * f64::from(index),
            30.0 + f64::from(index),
            2315.0,
        ],
        samples: 700 + 37 * (index as usize % 4),
        autoregression: Some(
            (0..index % 4)
                .map(|lag| 0.3 - 0.2 * f64::from(lag))
                .collect(),
        ),
        ..plan()
    });
    usual
        .chain([
            // Too much damping: the optimum lies on the cone.
            Plan {
                truth: [2.3, 520.0, 2315.0],
                ..plan()
            },
            // Far from every start.
            Plan {
                truth: [0.05, 3.0, 40_000.0],
                ..plan()
            },
            Plan {
                cubic_n_per_m3: 4e6,
                ..plan()
            },
            Plan {
                autoregression: None,
                ..plan()
            },
            Plan {
                intersample: Intersample::BandLimited,
                ..plan()
            },
            Plan {
                intersample: Intersample::ZeroOrder,
                samples: 1100,
                ..plan()
            },
        ])
        .collect()
}

struct Simulated {
    model: Model,
    input: Input,
    tightening: Tightening,
}

impl Simulated {
    fn subject(&self) -> Subject<'_> {
        Subject {
            model: &self.model,
            input: &self.input,
            tightening: &self.tightening,
        }
    }
}

fn simulated(number: u32, plan: &Plan) -> Simulated {
    let torque_nm: Vec<f64> = (0..plan.samples)
        .map(|index| if index < 160 { 0.2 * index as f64 } else { 0.0 })
        .collect();
    let input = Input::new(&torque_nm, INTERVAL_S, plan.intersample);
    let truth = Model::new(RIG, &[Effect::CubicStiffness]).unwrap();
    let [m, c, k] = plan.truth;
    let motion = truth.simulate(&[m, c, k, plan.cubic_n_per_m3], &input);
    let mut acceleration = motion.acceleration_rad_per_s2.unwrap();
    let coefficients = plan.autoregression.clone().unwrap_or_default();
    let noise = coloured(number, plan, &coefficients);
    acceleration
        .iter_mut()
        .zip(noise)
        .for_each(|(a, noise)| *a += noise);
    let velocity = integrated(&acceleration);
    let displacement = integrated(&velocity);
    Simulated {
        model: Model::new(RIG, &[]).unwrap(),
        input: input.with_rest_before(0.01),
        tightening: Tightening {
            id: TighteningId {
                file: "simulated".to_owned(),
                number,
            },
            conditions: Conditions::default(),
            rig: RIG,
            time_base: TimeBase {
                start_s: 0.0,
                interval_s: INTERVAL_S,
            },
            torque_nm,
            motion: Motion {
                displacement_rad: Some(displacement),
                velocity_rad_per_s: Some(velocity),
                acceleration_rad_per_s2: Some(acceleration),
            },
            grip_force_n: None,
            peak_torque_nm: 32.0,
            target_torque_nm: 30.0,
            onset: None,
            noise: plan
                .autoregression
                .clone()
                .map(|autoregression| NoiseFloor {
                    source: NoiseSource::Declared,
                    quantity: Quantity::Acceleration,
                    standard_deviation: plan.noise_rad_per_s2,
                    autoregression,
                    innovation_sd: plan.noise_rad_per_s2,
                    samples: 1000,
                }),
            corrections: vec![Correction {
                effect: "acceleration_bias".to_owned(),
                value: 0.0,
                unit: "rad/s²".to_owned(),
                significant: false,
                standard_error: 0.01 * f64::from(number % 3),
            }],
        },
    }
}

/// Uniform innovations from a fixed congruential sequence, coloured.
fn coloured(seed: u32, plan: &Plan, coefficients: &[f64]) -> Vec<f64> {
    let mut state = u64::from(seed) + 99;
    let mut noise: Vec<f64> = Vec::new();
    for t in 0..plan.samples {
        state =
            (state.wrapping_mul(6_364_136_223_846_793_005)).wrapping_add(1_442_695_040_888_963_407);
        let uniform = (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
        let mut value = plan.noise_rad_per_s2 * 12.0_f64.sqrt() * uniform;
        for (lag, a) in coefficients.iter().enumerate().take(t) {
            value -= a * noise[t - 1 - lag];
        }
        noise.push(value);
    }
    noise
}

fn integrated(signal: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let pairs = signal
        .windows(2)
        .map(|pair| 0.5 * INTERVAL_S * (pair[0] + pair[1]));
    std::iter::once(0.0)
        .chain(pairs.map(|area| {
            sum += area;
            sum
        }))
        .collect()
}

fn all() -> Vec<Simulated> {
    (0..)
        .zip(plans())
        .map(|(number, plan)| simulated(number, &plan))
        .collect()
}

fn settings() -> Vec<IdentifySettings> {
    let of = |fitted_output, unscored_samples| IdentifySettings {
        fitted_output,
        unscored_samples,
        ..IdentifySettings::default()
    };
    vec![
        of(Quantity::Acceleration, 0),
        of(Quantity::Acceleration, 25),
        of(Quantity::Velocity, 0),
        of(Quantity::Displacement, 0),
        of(Quantity::Displacement, 40),
    ]
}

/// As every other model is fitted, from the same start as in sweeps or from the usual one.
fn on_the_general_road(
    subject: &Subject<'_>,
    settings: &IdentifySettings,
    from_the_same_start: bool,
) -> Estimate {
    let whitening = Whitening::of(subject.tightening, settings.fitted_output);
    let mut attempt = Attempt::new(subject, whitening.as_ref(), settings).unwrap();
    if !from_the_same_start {
        attempt.starts = vec![attempt.usual_start.clone()];
    }
    attempt.estimate(subject, settings).unwrap()
}

#[test]
fn side_by_side_agrees_with_the_general_road() {
    let all = all();
    let subjects: Vec<Subject<'_>> = all.iter().map(Simulated::subject).collect();
    for settings in settings() {
        let fitted = identify_all(&subjects, &settings);
        for (number, (subject, found)) in subjects.iter().zip(fitted).enumerate() {
            let found = found.unwrap();
            for same_start in [true, false] {
                let expected = on_the_general_road(subject, &settings, same_start);
                let what = format!(
                    "{number} {:?} {same_start}: {found:?} {expected:?}",
                    settings.fitted_output
                );
                agree(&found, &expected, same_start, &what);
            }
        }
    }
}

/// A search ends within some 1e-8 standard errors of the optimum, as its settings say; on a cone, where steps shrink
/// slowly, or from another start it may end farther away.
fn agree(found: &Estimate, expected: &Estimate, same_start: bool, what: &str) {
    assert_eq!(found.status, expected.status, "{what}");
    assert_eq!(
        found.active_constraints, expected.active_constraints,
        "{what}"
    );
    let is_inside = found.active_constraints.is_empty();
    let share = if same_start && is_inside { 1e-8 } else { 1e-6 };
    for (one, other) in found.parameters.iter().zip(&expected.parameters) {
        let allowed = 1e-9 * other.value + share * other.standard_error.unwrap_or(0.0);
        assert!((one.value - other.value).abs() < allowed, "{what}");
        match (one.standard_error, other.standard_error) {
            (Some(one), Some(other)) => assert!((one / other - 1.0).abs() < 1e-6, "{what}"),
            (one, other) => assert_eq!(one, other, "{what}"),
        }
    }
}

#[test]
fn the_company_changes_no_bit() {
    let all = all();
    let subjects: Vec<Subject<'_>> = all.iter().map(Simulated::subject).collect();
    for settings in settings() {
        let together = identify_all(&subjects, &settings);
        let mut reversed = subjects.clone();
        reversed.reverse();
        let mut backwards = identify_all(&reversed, &settings);
        backwards.reverse();
        assert_eq!(together, backwards, "in the other order");
        for size in [1, 3, 8] {
            let groups = subjects.chunks(size);
            let apart: Vec<_> = groups
                .flat_map(|some| identify_all(some, &settings))
                .collect();
            assert_eq!(together, apart, "in groups of {size}");
        }
    }
}

/// Where an effect has several starts, trying them on a rough record leads to the optimum that all of them together find.
#[test]
fn rough_starts_lead_to_the_best_optimum_of_all() {
    let truth = Model::new(RIG, &[Effect::MaxwellBranch]).unwrap();
    let [m, c, k] = USUAL;
    for (number, tau_s) in [(1, 0.008), (2, 0.03), (3, 0.09)] {
        let mut one = simulated(number, &plan());
        let motion = truth.simulate(&[m, c, k, 800.0, tau_s], &one.input);
        let noise = coloured(number, &plan(), &[-0.6, 0.2]);
        let pairs = motion
            .acceleration_rad_per_s2
            .unwrap()
            .into_iter()
            .zip(noise);
        one.tightening.motion.acceleration_rad_per_s2 = Some(pairs.map(|(a, n)| a + n).collect());
        one.model = truth.clone();
        let (subject, settings) = (one.subject(), IdentifySettings::default());
        let whitening = Whitening::of(subject.tightening, settings.fitted_output);
        let mut attempt = Attempt::new(&subject, whitening.as_ref(), &settings).unwrap();
        assert!(attempt.starts.len() > 1);
        let rough = attempt.valleys(&subject, &settings).lowest().unwrap();
        let mut problem = DenseResidual::new(&mut attempt.residual);
        let all = solve_from_starts(
            &mut problem,
            &attempt.starts,
            &attempt.set,
            &settings.solver,
        );
        let all = all.unwrap();
        assert!(rough.status.is_converged() && rough.cost <= all.cost * (1.0 + 1e-9));
        for (found, expected) in rough.values.iter().zip(&all.values) {
            assert!((found / expected - 1.0).abs() < 1e-7, "{rough:?} {all:?}");
        }
    }
}

/// A tightening during which the operator pushes with `force_n` from 0.12 s to 0.18 s, fitted with that effect.
fn pushed(number: u32, force_n: f64) -> Simulated {
    let mut one = simulated(number, &plan());
    one.model = Model::new(RIG, &[Effect::VoluntaryPush]).unwrap();
    let [m, c, k] = USUAL;
    let motion = (one.model).simulate(&[m, c, k, force_n, 0.12, 0.06], &one.input);
    let noise = coloured(number, &plan(), &[-0.6, 0.2]);
    let exact = motion.acceleration_rad_per_s2.unwrap();
    let acceleration: Vec<f64> = exact.iter().zip(noise).map(|(a, n)| a + n).collect();
    let velocity = integrated(&acceleration);
    one.tightening.motion = Motion {
        displacement_rad: Some(integrated(&velocity)),
        velocity_rad_per_s: Some(velocity),
        acceleration_rad_per_s2: Some(acceleration),
    };
    one
}

/// Along the measured motion the truth is found from starts far away, and the fit from there is taken for the answer; an
/// effect that is not there never is.
#[test]
fn starts_led_along_the_motion_end_at_an_effect_that_is_there() {
    let [m, c, k] = USUAL;
    let settings = IdentifySettings::default();
    for (number, force_n) in [(1, 20.0), (2, -35.0), (3, 0.0)] {
        let one = pushed(number, force_n);
        let subject = one.subject();
        let whitening = Whitening::of(subject.tightening, settings.fitted_output);
        let attempt = Attempt::new(&subject, whitening.as_ref(), &settings).unwrap();
        let rough = RoughRecord::of(&subject, settings.fitted_output).unwrap();
        let valleys = attempt.valleys(&subject, &settings);
        let guided = valleys.guided(&rough).unwrap().unwrap();
        let ends = race(
            &attempt.residual,
            &guided.starts,
            &attempt.set,
            &settings.solver,
            RULES,
        );
        let fit = best(ends.unwrap().0, guided.work).unwrap();
        let is_there = force_n != 0.0;
        assert_eq!(
            valleys.is_beyond_doubt(&fit),
            is_there,
            "{force_n}: {fit:?}"
        );
        let answer = valleys.lowest().unwrap();
        assert!(answer.cost <= fit.cost);
        if is_there {
            assert_eq!(answer.values, fit.values);
            let errors = fit.covariance(ResidualNoise::Unit).standard_errors;
            let truth = [m, c, k, force_n, 0.12, 0.06];
            for ((found, truth), error) in fit.values.iter().zip(truth).zip(errors) {
                assert!((found - truth).abs() < 4.0 * error.unwrap(), "{fit:?}");
            }
        }
    }
}

#[test]
fn what_is_unusual_is_there() {
    let all = all();
    let subjects: Vec<Subject<'_>> = all.iter().map(Simulated::subject).collect();
    let found = identify_all(&subjects, &IdentifySettings::default());
    let found: Vec<Estimate> = found.into_iter().map(Result::unwrap).collect();
    assert_eq!(found[9].active_constraints, ["light_damping"]);
    assert!(found[9].conic_solves > 0);
    let passes = found.iter().map(|estimate| estimate.evaluations);
    let usual = found[0].evaluations;
    assert!(passes.max().unwrap() > usual, "a straggler");
    // The cubic spring widens what the noise alone would leave.
    let errors = |number: usize| found[number].parameters[2].standard_error.unwrap();
    assert!(errors(11) > 3.0 * errors(0), "{} {}", errors(11), errors(0));
}

#[test]
fn a_fit_without_the_fitted_output_leaves_the_others_alone() {
    let mut all = all();
    all[1].tightening.motion.acceleration_rad_per_s2 = None;
    let subjects: Vec<Subject<'_>> = all.iter().map(Simulated::subject).collect();
    let found = identify_all(&subjects, &IdentifySettings::default());
    let missing = IdentifyError::MissingOutput {
        quantity: Quantity::Acceleration,
    };
    assert_eq!(found[1], Err(missing));
    assert_eq!(
        found.iter().filter(|one| one.is_ok()).count(),
        all.len() - 1
    );
}

/// Searches that race are answered by simulations side by side; a fit may not depend on how many still run.
#[test]
fn what_is_simulated_beforehand_has_the_same_bits() {
    let mut one = simulated(1, &plan());
    one.model = Model::new(RIG, &[Effect::MaxwellBranch]).unwrap();
    let (subject, settings) = (one.subject(), IdentifySettings::default());
    let whitening = Whitening::of(subject.tightening, settings.fitted_output);
    let attempt = Attempt::new(&subject, whitening.as_ref(), &settings).unwrap();
    let free = attempt.residual.free().to_vec();
    for with_slopes in [true, false] {
        let evaluate = |mut residual: TighteningResidual<'_>, start: &[f64]| {
            let count = residual.residual_count();
            let (mut r, mut slopes) = (vec![0.0; count], vec![0.0; count * free.len()]);
            let asked = with_slopes.then_some(&mut slopes[..]);
            residual.evaluate(start, &mut r, asked).unwrap();
            (r, slopes)
        };
        let mut prepared = vec![attempt.residual.clone(); attempt.starts.len()];
        let mut runs: Vec<Run<'_>> = (prepared.iter_mut().zip(&attempt.starts))
            .map(|(residual, start)| residual.foresee(start, with_slopes))
            .collect();
        simulate_side_by_side(&mut runs, if with_slopes { &free } else { &[] });
        assert!(prepared.len() > 2);
        for (residual, start) in prepared.into_iter().zip(&attempt.starts) {
            let alone = evaluate(attempt.residual.clone(), start);
            assert_eq!(evaluate(residual, start), alone);
        }
    }
}
