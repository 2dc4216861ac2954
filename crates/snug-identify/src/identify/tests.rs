//! Sweeps side by side against the general road: residual and Jacobian stored, J factored by reflections.
#![allow(clippy::unwrap_used)]

use super::*;
use snug_campaign::{
    Conditions, Correction, Intersample, Motion, NoiseFloor, NoiseSource, Rig, TighteningId,
    TimeBase,
};
use snug_model::Effect;

mod starts;

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
    fn task<'a>(&'a self, settings: &'a IdentifySettings) -> FitTask<'a> {
        FitTask::new(&self.tightening, &self.input, &self.model, settings)
    }
}

fn simulated(number: u32, plan: &Plan) -> Simulated {
    let torque_nm: Vec<f64> = (0..plan.samples)
        .map(|index| if index < 160 { 0.2 * index as f64 } else { 0.0 })
        .collect();
    let input = Input::new(&torque_nm, INTERVAL_S, plan.intersample);
    let truth = Model::new(RIG, &[Effect::CubicStiffness]).unwrap();
    let [m, c, k] = plan.truth;
    let motion = truth
        .simulate(&[m, c, k, plan.cubic_n_per_m3], &input)
        .unwrap();
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
                constant_of: Some(snug_campaign::Quantity::Acceleration),
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
        ..to_the_end()
    };
    vec![
        of(Quantity::Acceleration, 0),
        of(Quantity::Acceleration, 25),
        of(Quantity::Velocity, 0),
        of(Quantity::Displacement, 0),
        of(Quantity::Displacement, 40),
    ]
}

/// Fits that end so close to the optimum that two ways there can be compared.
fn to_the_end() -> IdentifySettings {
    IdentifySettings {
        solver: snug_least_squares::Settings::default(),
        ..IdentifySettings::default()
    }
}

/// As every other model is fitted, from the same start as in sweeps or from the usual one.
fn on_the_general_road(
    task: &FitTask<'_>,
    settings: &IdentifySettings,
    from_the_same_start: bool,
) -> Estimate {
    let mut attempt = Attempt::new(task).unwrap();
    if !from_the_same_start {
        attempt.starts = vec![attempt.usual_start.clone()];
    }
    let simulator = BatchSimulator::default();
    let estimate = attempt.estimate(task, None, settings, &simulator);
    alone(&simulator, estimate).unwrap()
}

/// What comes of a fit that has no company.
fn alone<T>(simulator: &BatchSimulator<'_>, fit: impl Future<Output = T>) -> T {
    simulator.finish([fit]).pop().unwrap()
}

#[test]
fn side_by_side_agrees_with_the_general_road() {
    let all = all();
    for settings in settings() {
        let tasks: Vec<FitTask<'_>> = all.iter().map(|one| one.task(&settings)).collect();
        let fitted = identify_all(&tasks);
        for (number, (task, found)) in tasks.iter().zip(fitted).enumerate() {
            let found = found.unwrap();
            for same_start in [true, false] {
                let expected = on_the_general_road(task, &settings, same_start);
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

/// A tightening during which the operator pushes with `force_n` from 0.12 s to 0.18 s, fitted with that effect.
fn pushed(number: u32, force_n: f64) -> Simulated {
    let mut one = simulated(number, &plan());
    one.model = Model::new(RIG, &[Effect::VoluntaryPush]).unwrap();
    let [m, c, k] = USUAL;
    let motion = (one.model)
        .simulate(&[m, c, k, force_n, 0.12, 0.06], &one.input)
        .unwrap();
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

#[test]
fn the_company_changes_no_bit() {
    let mut pushes: Vec<Simulated> = (1..=9)
        .map(|number| pushed(number, 4.0 * f64::from(number)))
        .collect();
    // One is shorter than the others, one has other effects.
    pushes[3].input = pushes[3].input.beginning(600);
    pushes[3].tightening = shortened(&pushes[3].tightening, 600);
    pushes[5].model = Model::new(RIG, &[Effect::CubicStiffness]).unwrap();
    for all in [all(), pushes] {
        company_changes_no_bit(&all);
    }
}

fn shortened(tightening: &Tightening, samples: usize) -> Tightening {
    let mut shorter = tightening.clone();
    shorter.torque_nm.truncate(samples);
    for quantity in [
        Quantity::Displacement,
        Quantity::Velocity,
        Quantity::Acceleration,
    ] {
        if let Some(signal) = tightening.motion.get(quantity) {
            shorter.motion.set(quantity, signal[..samples].to_vec());
        }
    }
    shorter
}

fn company_changes_no_bit(all: &[Simulated]) {
    for settings in settings() {
        let tasks: Vec<FitTask<'_>> = all.iter().map(|one| one.task(&settings)).collect();
        let together = identify_all(&tasks);
        let mut reversed = tasks.clone();
        reversed.reverse();
        let mut backwards = identify_all(&reversed);
        backwards.reverse();
        assert_eq!(together, backwards, "in the other order");
        for size in [1, 3, 8] {
            let groups = tasks.chunks(size);
            let apart: Vec<_> = groups.flat_map(|some| identify_all(some)).collect();
            assert_eq!(together, apart, "in groups of {size}");
        }
    }
}

#[test]
fn a_fit_without_the_fitted_output_leaves_the_others_alone() {
    let mut all = all();
    all[1].tightening.motion.acceleration_rad_per_s2 = None;
    let settings = IdentifySettings::default();
    let tasks: Vec<FitTask<'_>> = all.iter().map(|one| one.task(&settings)).collect();
    let found = identify_all(&tasks);
    let missing = IdentifyError::MissingOutput {
        quantity: Quantity::Acceleration,
    };
    assert_eq!(found[1], Err(missing));
    assert_eq!(
        found.iter().filter(|one| one.is_ok()).count(),
        all.len() - 1
    );
}
