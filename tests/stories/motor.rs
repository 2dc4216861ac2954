//! Four tests of one motor, voltage in and speed out, as robotics teams make them: two slow ramps and two steps. Each by itself is
//! explained by a mass and a damper of its own; all four by dry friction, as a plain regression says in milliseconds.

use snug_campaign::words::headline::{Headline, NoModel};
use snug_campaign::words::reason::Reason;
use snug_campaign::words::suspicion::Suspicion;
use snug_campaign::{Diagnosis, Verdict};
use snug_study::{RunSettings, Study, Verb, diagnose};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// V = kS sgn v + kV v + kA dv/dt.
const FRICTION_V: f64 = 0.23;
const DAMPING_V_S_PER_RAD: f64 = 1.9;
const INERTIA_V_S2_PER_RAD: f64 = 0.109;
const RATE_HZ: f64 = 200.0;

/// What differs from one test to another.
#[derive(Clone, Copy)]
struct Bench {
    /// Volts and speeds are written in units that make them so many times as large.
    units: [f64; 2],
    /// So many times as heavy and as damped, and driven by as many times the voltage.
    load: f64,
}

const USUAL: Bench = Bench {
    units: [1.0, 1.0],
    load: 1.0,
};

/// A test under `volt`, by small steps of the midpoint rule, the speed with noise of 0.01 rad/s.
fn recorded(volt: impl Fn(f64) -> f64, seconds: f64, bench: Bench) -> String {
    let (load, [volts, speeds]) = (bench.load, bench.units);
    let volt = |t: f64| load * volt(t);
    const STEPS: u32 = 100;
    let h = 1.0 / RATE_HZ / f64::from(STEPS);
    let rate = |t: f64, v: f64| {
        let friction = FRICTION_V * (v / 1e-3).tanh();
        (volt(t) - load * DAMPING_V_S_PER_RAD * v - friction) / (load * INERTIA_V_S2_PER_RAD)
    };
    let (mut v, mut table) = (0.0, "volt,speed\n".to_owned());
    for row in 0..(seconds * RATE_HZ) as u32 {
        let start = f64::from(row) / RATE_HZ;
        // Twelve numbers of no pattern, less their mean: nearly normal.
        let draw = |k: u32| {
            let number = (f64::from(12 * row + k) * 12.9898 + seconds).sin() * 43_758.545;
            number - number.floor() - 0.5
        };
        let noise: f64 = (0..12).map(draw).sum();
        let measured = speeds * (v + 0.01 * noise);
        writeln!(table, "{:?},{measured:?}", volts * volt(start)).unwrap();
        for step in 0..STEPS {
            let t = start + f64::from(step) * h;
            v += h * rate(t + 0.5 * h, v + 0.5 * h * rate(t, v));
        }
    }
    table
}

/// One test: its name, its voltage, how long it took \[s\], and the bench.
type Test = (&'static str, fn(f64) -> f64, f64, Bench);

/// Two ramps and two steps, each on a bench of its own.
fn ramps_and_steps(benches: [Bench; 4]) -> [Test; 4] {
    [
        ("ramp_up", |t| 0.25 * t, 20.0, benches[0]),
        ("ramp_down", |t| -0.25 * t, 20.1, benches[1]),
        (
            "step_up",
            |t| if t > 0.302 { 4.0 } else { 0.0 },
            4.0,
            benches[2],
        ),
        (
            "step_down",
            |t| if t > 0.302 { -4.0 } else { 0.0 },
            4.1,
            benches[3],
        ),
    ]
}

/// What `verb` says of them.
fn told(verb: &Verb, tests: &[Test], hz: f64) -> Diagnosis {
    let tables = tests
        .iter()
        .map(|(name, volt, seconds, bench)| (*name, recorded(volt, *seconds, *bench)));
    told_of(verb, &tables.collect::<Vec<_>>(), hz)
}

/// What `verb` says of these tables of volts and speeds.
fn told_of(verb: &Verb, tables: &[(&str, String)], hz: f64) -> Diagnosis {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("tests");
    std::fs::create_dir(&data).unwrap();
    for (name, table) in tables {
        std::fs::write(data.join(name).with_extension("csv"), table).unwrap();
    }
    let text = format!(
        r#"(
            source: (path: {data:?}, format: Csv(
                channels: [
                    (column: Name("volt"), signal: Torque, unit: Volt),
                    (column: Name("speed"), signal: Velocity, unit: RadianPerSecond),
                ],
                sampling: Rate(hz: {hz:?}),
            )),
            preprocess: (window: Whole, rig: (lever_arm_m: 1.0, known_inertia: Fixed(0.0))),
            identify: (fitted_output: Velocity, constraints: [Positive]),
        )"#
    );
    let study = Study::parse(&text, Path::new("rig.ron")).unwrap();
    let out = tempfile::tempdir().unwrap();
    let quiet = |_: snug_study::ProgressEvent<'_>| ();
    let never = AtomicBool::new(false);
    let settings = RunSettings::new(out.path());
    let outcome = diagnose(&study, verb, &settings, &quiet, &never).unwrap();
    outcome.result.diagnosis.unwrap()
}

/// In volts and rad/s, and in millivolts, sevenths of a turn per minute and seconds that are said to be 200 times as long.
#[test]
fn four_tests_of_a_motor_lack_dry_friction_and_nothing_else_in_any_unit() {
    for (units, hz) in [([1.0, 1.0], RATE_HZ), ([1000.0, 7.0 * 60.0 / TAU], 1.0)] {
        let added = told(
            &Verb::Improve,
            &ramps_and_steps([Bench { units, ..USUAL }; 4]),
            hz,
        )
        .added;
        let [friction] = added.as_slice() else {
            panic!("{added:?}")
        };
        assert_eq!(friction.effect, "coulomb_friction");
        let volts = friction.parameters[0].value / units[0];
        assert!((volts / FRICTION_V - 1.0).abs() < 0.03, "{added:?}");
    }
}

/// Half of them were logged in millivolts, or in a speed a thousand times as large: each by itself is fitted as well as ever, and the
/// motor seems a thousand times as heavy.
#[test]
fn recordings_in_other_units_than_the_others_are_no_physics() {
    for units in [[1000.0, 1.0], [1.0, 1e-3]] {
        let other = Bench { units, ..USUAL };
        let told = told(
            &Verb::Compare,
            &ramps_and_steps([USUAL, other, USUAL, other]),
            RATE_HZ,
        );
        assert_eq!(told.verdict, Verdict::NotFitted);
        let Headline::NoModel(NoModel::OtherUnits(units)) = &told.headline else {
            panic!("{}", told.headline)
        };
        assert!(units.larger.contains("down") && units.smaller.contains("up"));
        assert!((units.factor / 1000.0).ln().abs() < 0.7, "{units}");
    }
}

/// With a flywheel and a brake 146 times as heavy and as damped: no unit is wrong, and the friction is the motor's.
#[test]
fn another_load_is_told_and_what_is_missing_is_found_all_the_same() {
    let flywheel = Bench {
        load: 146.0,
        ..USUAL
    };
    let to_and_fro: fn(f64) -> f64 = |t| 5.0 * (0.6 * t).sin() + 3.0 * (1.7 * t).sin();
    let tests: [Test; 2] = [
        ("light", to_and_fro, 40.0, USUAL),
        ("flywheel", to_and_fro, 40.1, flywheel),
    ];
    let told = told(&Verb::Improve, &tests, RATE_HZ);
    let [friction] = told.added.as_slice() else {
        panic!("{}", told.headline)
    };
    assert_eq!(friction.effect, "coulomb_friction");
    let volts = friction.parameters[0].value;
    assert!((volts / FRICTION_V - 1.0).abs() < 0.03, "{volts}");
    assert_ne!(told.verdict, Verdict::NotFitted);
    let load = told.reasons.iter().find_map(|reason| match reason {
        Reason::Check(Suspicion::Units(load)) => Some(load),
        _ => None,
    });
    let load = load.expect("another load is told");
    assert!(
        !load.is_prefix && (load.factor / 146.0 - 1.0).abs() < 0.1,
        "{load}"
    );
}

/// A tachometer that lets the speed through 20 ms late, its own equation beside the motor's: no delay, and no mode.
#[test]
fn a_filtered_speed_is_a_lag_of_the_motion() {
    if !snug_tests::long("a filtered speed") {
        return;
    }
    const LAG_S: f64 = 0.02;
    let hz = 500.0;
    // A drive's command, 4 V either way, changed after uneven times.
    let command = |row: u32| {
        let at = f64::from(row / 70);
        if (at * 12.9898).sin() * 43_758.545 % 1.0 > 0.0 {
            4.0
        } else {
            -4.0
        }
    };
    let (mut v, mut seen, mut table) = (0.0, 0.0, "volt,speed\n".to_owned());
    for row in 0..6000 {
        let noise = (f64::from(row) * 78.233).sin() * 43_758.545 % 1.0 * 0.01;
        writeln!(table, "{:?},{:?}", command(row), seen + noise).unwrap();
        const STEPS: u32 = 50;
        let h = 1.0 / hz / f64::from(STEPS);
        for _ in 0..STEPS {
            let middle = v + 0.5 * h * (command(row) - 0.5 * v) / 0.1;
            seen += h * (middle - seen) / LAG_S;
            v += h * (command(row) - 0.5 * middle) / 0.1;
        }
    }
    let told = told_of(&Verb::Improve, &[("prbs", table)], hz);
    let [lag] = told.added.as_slice() else {
        panic!("{}", told.headline)
    };
    assert_eq!(lag.effect, "acceleration_lag");
    // The acceleration is taken as straight between samples, and jumps: half a sample of 2 ms.
    let lag_s = lag.parameters[0].value;
    assert!((lag_s - LAG_S).abs() < 0.0015, "{lag_s}");
}

/// A drive that gives no more than 5 V, whatever is asked.
#[test]
fn a_drive_that_saturates_lacks_its_limit() {
    let hz = 500.0;
    let (mut v, mut table) = (0.0, "volt,speed\n".to_owned());
    for row in 0..6000 {
        let t = f64::from(row) / hz;
        let side = (f64::from(row / 80) * 12.9898).sin() * 43_758.545 % 1.0;
        let asked = 5.0 * side.signum() + 4.0 * (2.5 * t).sin() + 3.0 * (6.9 * t + 1.0).sin();
        let noise = (f64::from(row) * 78.233).sin() * 43_758.545 % 1.0 * 0.02;
        writeln!(table, "{asked:?},{:?}", v + noise).unwrap();
        const STEPS: u32 = 20;
        let h = 1.0 / hz / f64::from(STEPS);
        for _ in 0..STEPS {
            v += h * (asked.clamp(-5.0, 5.0) - 0.4 * v) / 0.05;
        }
    }
    let told = told_of(&Verb::Improve, &[("saturating", table)], hz);
    assert_eq!(told.verdict, Verdict::Adequate, "{}", told.headline);
    let [limit] = told.added.as_slice() else {
        panic!("{}", told.headline)
    };
    assert_eq!(limit.effect, "torque_limit");
    let volts = limit.parameters[0].value;
    assert!((volts - 5.0).abs() < 0.05, "{volts}");
}
