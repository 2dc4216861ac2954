//! In whatever unit a rig was measured, it is fitted as well, and the same is found missing: multiplying input, output or time by any
//! factor gives the same fit, its sizes multiplied by what their units make of the factors.
//!
//! One reason not to: a law that knows the angle, as that of a weight on an arm, knows that it is in radians. It is a candidate of few
//! turns only, and not what these rigs lack. Factors are powers of two where a search is long, so that rounding does not decide
//! between two candidates that explain equally much; between the extremes lie six decades.

use snug_campaign::{CampaignResult, Quantity};
use snug_study::{RunSettings, Study, Verb, diagnose, run};
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// Three decades, once up and once down.
const UP: f64 = 1024.0;
const DOWN: f64 = 1.0 / 1024.0;

const INTERVAL_S: f64 = 0.005;
const SAMPLES: u32 = 500;
/// By how much results may differ \[–\]: rounding, where a factor is no power of two.
const SAME: f64 = 1e-6;
/// Standard errors by which two fits of the same data may differ \[–\]: each is within 1e-7 · √(samples) of its optimum
/// (`snug_least_squares::Settings::gradient_tolerance`), in whatever way it came there.
const STOPS: f64 = 2.0 * 1e-7 * 22.4;

/// What input, output and time are multiplied with.
#[derive(Debug, Clone, Copy)]
struct Factors {
    input: f64,
    output: f64,
    time: f64,
}

const NONE: Factors = Factors {
    input: 1.0,
    output: 1.0,
    time: 1.0,
};

/// One channel at a time, and all at once.
const ALL: [Factors; 4] = [
    Factors { input: UP, ..NONE },
    Factors {
        output: DOWN,
        ..NONE
    },
    Factors { time: UP, ..NONE },
    Factors {
        input: DOWN,
        output: UP,
        time: DOWN,
    },
];

/// A rig, made by small steps of the midpoint rule: its record as (input, output), and what it lacks.
struct Rig {
    rows: Vec<(f64, f64)>,
    quantity: Quantity,
    lacks: &'static str,
}

impl Rig {
    /// `acceleration` follows from input, displacement and velocity.
    fn new(
        quantity: Quantity,
        lacks: &'static str,
        tones: &[(f64, f64)],
        acceleration: impl Fn(f64, f64, f64) -> f64,
    ) -> Self {
        let input = |t: f64| -> f64 { tones.iter().map(|(w, a)| a * (w * t + a).sin()).sum() };
        let steps = 50;
        let h = INTERVAL_S / f64::from(steps);
        let (mut x, mut v) = (0.0, 0.0);
        let mut rows = Vec::new();
        for sample in 0..SAMPLES {
            let t = f64::from(sample) * INTERVAL_S;
            let motion = match quantity {
                Quantity::Displacement => x,
                Quantity::Velocity => v,
                Quantity::Acceleration => acceleration(input(t), x, v),
            };
            rows.push((input(t), motion));
            for step in 0..steps {
                let (start, middle) = (t + f64::from(step) * h, t + (f64::from(step) + 0.5) * h);
                let a = acceleration(input(start), x, v);
                let (x_mid, v_mid) = (x + 0.5 * h * v, v + 0.5 * h * a);
                let a = acceleration(input(middle), x_mid, v_mid);
                (x, v) = (x + h * v_mid, v + h * a);
            }
        }
        let power = rows.iter().map(|(_, y)| y * y).sum::<f64>() / rows.len() as f64;
        // Something to be left over: a fast tone, a thousandth of the motion.
        for (index, (_, y)) in rows.iter_mut().enumerate() {
            *y += 1e-3 * power.sqrt() * (2.9 * index as f64).sin();
        }
        Self {
            rows,
            quantity,
            lacks,
        }
    }

    /// How often the angle is differentiated in its output.
    fn order(&self) -> i32 {
        match self.quantity {
            Quantity::Displacement => 0,
            Quantity::Velocity => 1,
            Quantity::Acceleration => 2,
        }
    }

    /// The study of its record in other units, as README teaches it: no start, no bound, no scale.
    fn study(&self, folder: &Path, by: Factors) -> Study {
        let table = folder.join("rig.csv");
        let rows = self.rows.iter();
        let rows = rows.map(|(u, y)| format!("{:?},{:?}\n", u * by.input, y * by.output));
        let text: String = std::iter::once("u,y\n".to_owned()).chain(rows).collect();
        std::fs::write(&table, text).unwrap();
        let (signal, unit) = match self.quantity {
            Quantity::Displacement => ("Displacement", "Radian"),
            Quantity::Velocity => ("Velocity", "RadianPerSecond"),
            Quantity::Acceleration => ("Acceleration", "RadianPerSecondSquared"),
        };
        let hz = 1.0 / (INTERVAL_S * by.time);
        let text = format!(
            r#"(
                source: (path: {table:?}, format: Csv(
                    channels: [
                        (column: Name("u"), signal: Torque, unit: NewtonMetre),
                        (column: Name("y"), signal: {signal}, unit: {unit}),
                    ],
                    sampling: Rate(hz: {hz:?}),
                )),
                preprocess: (window: Whole, rig: (lever_arm_m: 1.0, known_inertia: Fixed(0.0))),
                identify: (fitted_output: {signal}, constraints: [Positive]),
            )"#
        );
        Study::parse(&text, Path::new("rig.ron")).unwrap()
    }

    /// What the verb, or a run, finds of it in these units.
    fn found(&self, verb: Option<&Verb>, by: Factors) -> CampaignResult {
        let (data, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let study = self.study(data.path(), by);
        let (settings, never) = (RunSettings::new(out.path()), AtomicBool::new(false));
        let quiet = |_: snug_study::ProgressEvent<'_>| ();
        let outcome = match verb {
            Some(verb) => diagnose(&study, verb, &settings, &quiet, &never),
            None => run(&study, &settings, &quiet, &never),
        };
        outcome.unwrap().result
    }

    /// Asserts that in other units the same is found.
    fn assert_same(&self, verb: Option<&Verb>, in_units: &[Factors]) {
        let first = self.found(verb, NONE);
        for &by in in_units {
            let other = self.found(verb, by);
            let label = format!("{} by {verb:?} with {by:?}", self.quantity.name());
            let near = |one: f64, another: f64, what: &str| {
                let apart = (one / another - 1.0).abs();
                assert!(
                    apart < SAME,
                    "{label}: {what} {one:e}, expected {another:e}"
                );
            };
            let of = |result: &CampaignResult| result.tightenings[0].clone();
            let (was, is) = (of(&first), of(&other));
            let fit = |one: &snug_campaign::TighteningResult| {
                one.measures.fit_percent_fitted_output.unwrap()
            };
            near(100.0 - fit(&is), 100.0 - fit(&was), "what is not fitted");
            let parameters =
                |one: &snug_campaign::TighteningResult| one.estimate.clone().unwrap().parameters;
            for (was, is) in parameters(&was).iter().zip(parameters(&is)) {
                assert_eq!(was.name, is.name);
                let times = self.times(&was.unit, by);
                let apart = (is.value - was.value * times).abs();
                // A number that the data do not tell from nothing is as near as the fit goes on.
                let stops = STOPS * was.standard_error.unwrap_or(0.0) * times;
                assert!(
                    apart <= SAME * (was.value * times).abs() + stops,
                    "{label}: {} {:e}, expected {:e} ± {stops:e}",
                    was.name,
                    is.value,
                    was.value * times
                );
            }
            if let (Some(was), Some(is)) = (&first.diagnosis, &other.diagnosis) {
                let names = |one: &snug_campaign::Diagnosis| -> Vec<String> {
                    one.added.iter().map(|one| one.effect.clone()).collect()
                };
                assert_eq!(names(is), names(was), "{label}");
                assert_eq!(names(was)[0], self.lacks, "{label}");
                for (was, is) in was.ladder.iter().zip(&is.ladder) {
                    let expected = was.rms_fitted_output * by.output;
                    near(is.rms_fitted_output, expected, "the error");
                }
            }
        }
    }

    /// What a value in `unit` is multiplied with.
    fn times(&self, unit: &str, by: Factors) -> f64 {
        let angle = by.output * by.time.powi(self.order());
        let symbol = |symbol: &str| match symbol {
            "1" => 1.0,
            "N" | "Nm" => by.input,
            "m" | "rad" => angle,
            "s" => by.time,
            "Hz" => 1.0 / by.time,
            "kg" => by.input * by.time * by.time / angle,
            other => panic!("{other}"),
        };
        let power = |text: &str| match text.split_once('^') {
            Some((base, exponent)) => symbol(base).powi(exponent.parse().unwrap()),
            None => symbol(text),
        };
        let product = |text: &str| text.split(' ').map(power).product::<f64>();
        let mut parts = unit.split('/');
        let above = product(parts.next().unwrap());
        above / parts.map(product).product::<f64>()
    }
}

/// A mass on a spring that stiffens.
fn spring(quantity: Quantity) -> Rig {
    let tones = [(4.1, 5.0), (11.3, 4.0), (23.7, 4.0), (37.9, 3.0)];
    let force = |u: f64, x: f64, v: f64| u - 6.0 * v - 800.0 * x - 4e5 * x.powi(3);
    Rig::new(quantity, "cubic_stiffness", &tones, |u, x, v| {
        force(u, x, v) / 2.0
    })
}

/// A motor with dry friction and no spring.
fn motor() -> Rig {
    let tones = [(2.3, 3.0), (6.7, 2.0)];
    let friction = |v: f64| 0.4 * (v / 1e-3).tanh();
    Rig::new(
        Quantity::Velocity,
        "coulomb_friction",
        &tones,
        move |u, _, v| (u - 1.9 * v - friction(v)) / 0.11,
    )
}

/// Whoever runs it: also by factors that are no powers of two.
#[test]
fn a_run_fits_as_well_in_any_unit() {
    let decimal = |one: fn(f64) -> Factors| [one(1e3), one(1e-3)];
    let by: Vec<Factors> = [
        decimal(|input| Factors { input, ..NONE }),
        decimal(|output| Factors { output, ..NONE }),
        decimal(|time| Factors { time, ..NONE }),
    ]
    .concat();
    for quantity in [Quantity::Displacement, Quantity::Acceleration] {
        spring(quantity).assert_same(None, &by);
    }
    // Its spring comes out as nothing, at the bound: that is as small in any unit.
    motor().assert_same(None, &by);
}

#[test]
fn an_effect_is_added_as_well_in_any_unit() {
    for rig in [spring(Quantity::Acceleration), motor()] {
        let verb = Verb::Add(vec![rig.lacks.to_owned()]);
        rig.assert_same(Some(&verb), &ALL[3..]);
    }
}

#[test]
fn a_spring_lacks_the_same_in_any_unit_of_displacement() {
    spring(Quantity::Displacement).assert_same(Some(&Verb::Improve), &ALL);
}

#[test]
fn a_spring_lacks_the_same_in_any_unit_of_acceleration() {
    spring(Quantity::Acceleration).assert_same(Some(&Verb::Improve), &ALL);
}

#[test]
fn a_motor_lacks_the_same_in_any_unit_of_speed() {
    motor().assert_same(Some(&Verb::Improve), &ALL);
}

/// A parameter that is held says nothing of where the others begin: these come from the data all the same, in any unit.
#[test]
fn what_is_held_is_no_start() {
    let (rig, data) = (motor(), tempfile::tempdir().unwrap());
    for time in [1.0, UP] {
        let by = Factors { time, ..NONE };
        let mut study = rig.study(data.path(), by);
        let held = snug_model::ParameterSettings {
            value: Some(0.0),
            fixed: true,
            ..Default::default()
        };
        let parameters = &mut study.model.parameters;
        parameters.insert("stiffness_n_per_m".into(), held);
        let out = tempfile::tempdir().unwrap();
        let settings = RunSettings::new(out.path());
        let never = AtomicBool::new(false);
        let outcome = run(&study, &settings, &|_| (), &never).unwrap();
        let written = Study::read(&out.path().join("study.ron")).unwrap();
        let told = |name: &str| written.model.parameters[name].clone();
        assert!(told("stiffness_n_per_m").fixed);
        for (name, unit, truth) in [("mass_kg", "kg", 0.11), ("damping_kg_per_s", "kg/s", 2.1)] {
            let begins = told(name).value.unwrap() / rig.times(unit, by);
            assert!(
                (begins / truth - 1.0).abs() < 0.3,
                "{name} begins at {begins}"
            );
        }
        let fit = outcome.result.tightenings[0]
            .measures
            .fit_percent_fitted_output;
        assert!(fit.unwrap() > 90.0, "{fit:?}");
    }
}
