//! Rigs that were made up here, by small steps of the midpoint rule, of which an engineer would say at once what they lack.

mod changing;
mod drives;
mod encoder;
mod ended;
mod free_motion;
mod held;
mod hysteresis;
mod loads;
mod loops;
mod restarted;
mod rig;
mod ringing;
mod ripples;
mod sensors;
mod stops;
mod unheld;
mod valves;
mod zeros;

use held::pendulum;
use rig::{Noise, Rig, moved};
use snug_campaign::{Diagnosis, Verdict};
use snug_study::Verb;

fn names(diagnosis: &Diagnosis) -> Vec<&str> {
    let added = diagnosis.added.iter();
    added.map(|one| one.effect.as_str()).collect()
}

/// Whether one of the reasons holds these words.
fn says(diagnosis: &Diagnosis, words: &str) -> bool {
    let mut reasons = diagnosis.reasons.iter().map(ToString::to_string);
    reasons.any(|one| one.contains(words))
}

/// A motor that is turned one way in one recording and the other way in the next: dry friction and what its torque sensor reads at rest
/// show together only, and a friction with a shape is nearer to either alone. Its recordings are long for how slowly it moves.
#[test]
fn a_motor_turned_both_ways_lacks_dry_friction_and_an_offset() {
    let mut noise = Noise(1);
    let recording = |way: f64, noise: &mut Noise| -> Vec<[f64; 2]> {
        let levels: Vec<f64> = (0..8).map(|_| way * (0.8 + 1.2 * noise.even())).collect();
        let inputs: Vec<f64> = (0..8000).map(|k| levels[k / 1000]).collect();
        let rate =
            |[_, v]: [f64; 2], u: f64| [v, (u - 0.1 * v - 0.3 * (v / 0.01).tanh() - 0.08) / 0.05];
        let speeds = moved(&inputs, 6, rate).map(|[_, v]| v);
        noise.with(&inputs, speeds, 0.03)
    };
    let ways = [1.0, -1.0, 1.0, -1.0];
    let rig = Rig::that_turns_at_speeds(ways.map(|way| recording(way, &mut noise)).to_vec());
    let diagnosis = rig.told(&Verb::Improve);
    let mut added: Vec<(&str, f64)> = (diagnosis.added.iter())
        .map(|one| (one.effect.as_str(), one.parameters[0].value))
        .collect();
    added.sort_by(|a, b| a.0.cmp(b.0));
    let [("coulomb_friction", friction), ("torque_offset", offset)] = added[..] else {
        panic!("{added:?}: {}", diagnosis.headline)
    };
    assert!(
        (friction - 0.3).abs() < 0.01 && (offset - 0.08).abs() < 0.01,
        "{added:?}"
    );
    assert_eq!(
        diagnosis.verdict,
        Verdict::Adequate,
        "{}",
        diagnosis.headline
    );
}

/// A positioner that sticks and slips: what stands in for its dry friction first, a law of the root of the speed, may be nothing beside it
/// and is taken out again.
#[test]
fn a_valve_that_sticks_lacks_dry_friction_and_no_law_that_nobody_knows() {
    let mut noise = Noise(5);
    let mut recording = || -> Vec<[f64; 2]> {
        let levels: Vec<f64> = (0..12).map(|_| 120.0 * noise.even() - 60.0).collect();
        let inputs: Vec<f64> = (0..3000).map(|k| levels[k / 260]).collect();
        let rate = |[x, v]: [f64; 2], u: f64| {
            let friction = 6.0 + 4.0 * (-(v / 0.01).powi(2)).exp();
            [
                v,
                (u - 30.0 * v - 900.0 * x - friction * (v / 1e-3).tanh()) / 2.0,
            ]
        };
        let places = moved(&inputs, 20, rate).map(|[x, _]| x);
        noise.with(&inputs, places, 2e-5)
    };
    let rig = Rig::declared(
        ["signal: Torque, unit: Newton", "Displacement", "Metre"],
        (0..3).map(|_| recording()).collect(),
    );
    let diagnosis = rig.told(&Verb::Improve);
    assert_ne!(
        diagnosis.verdict,
        Verdict::UnlistedEffect,
        "{}",
        diagnosis.headline
    );
    let names = names(&diagnosis);
    let frictions = ["coulomb_friction", "stribeck_friction"];
    assert!(
        names.first().is_some_and(|first| frictions.contains(first)),
        "{}",
        diagnosis.headline
    );
    for size in diagnosis.added.iter().map(|one| &one.parameters[0]) {
        let holds_nothing = size
            .low
            .zip(size.high)
            .is_some_and(|(low, high)| low < 0.0 && high > 0.0);
        assert!(!holds_nothing, "{size:?}");
    }
}

/// A spring whose force grows with the square of its stretch, measured by an accelerometer of much noise: a cubic spring comes
/// near, and beside it play takes most of the rest. One law that leaves less than both is the likelier story.
#[test]
fn a_spring_of_its_own_kind_is_no_cubic_one_with_play() {
    let mut noise = Noise(37);
    let mut recording = || -> Vec<[f64; 2]> {
        let inputs = noise.tones([0.5, 40.0], 5.0, 1500);
        let rate =
            |[x, v]: [f64; 2], u: f64| [v, (u - 6.0 * v - 2e3 * x - 6e5 * x * x.abs()) / 0.8];
        let states: Vec<[f64; 2]> = moved(&inputs, 10, rate).collect();
        let accelerations = states.iter().zip(&inputs).map(|(&at, &u)| rate(at, u)[1]);
        noise.with(&inputs, accelerations, 1.0)
    };
    let rig = Rig::declared(
        [
            "signal: Force, unit: Newton",
            "Acceleration",
            "MetrePerSecondSquared",
        ],
        (0..2).map(|_| recording()).collect(),
    );
    let diagnosis = rig.told_with("intersample: ZeroOrder", &Verb::Improve);
    let headline = &diagnosis.headline;
    let [law] = &diagnosis.added[..] else {
        panic!("{:?}: {headline}", names(&diagnosis))
    };
    assert_eq!(law.expression.as_deref(), Some("p*x*abs(x)"), "{headline}");
    let size = law.parameters[0].value;
    assert!((size / 6e5 - 1.0).abs() < 0.01, "{size}");
}

/// A drive that begins at rest, with a torque that comes late: before the first sample nothing turned it, and the delay is a delay.
#[test]
fn a_servo_that_answers_late_lacks_a_delay_and_no_lag() {
    let mut noise = Noise(11);
    let mut recording = || {
        let inputs = noise.levels([-1.0, 1.0], 100, 3000);
        let late: Vec<f64> = [&[0.0; 8][..], &inputs[..2992]].concat();
        let rate = |[_, v]: [f64; 2], u: f64| [v, (u - 0.05 * v) / 0.01];
        let angles = moved(&late, 4, rate).map(|[x, _]| x);
        noise.with(&inputs, angles, 2e-3)
    };
    let rig = Rig::that_turns((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    assert_eq!(
        names(&diagnosis),
        ["torque_delay"],
        "{}",
        diagnosis.headline
    );
    // A held torque, taken as straight, comes half a millisecond early.
    let delay_s = diagnosis.added[0].parameters[0].value;
    assert!((0.00795..0.00855).contains(&delay_s), "{delay_s}");
}

/// A suspension, its damper in one place, driven at the body and measured at the wheel: two modes that drive each other.
#[test]
fn a_suspension_measured_at_the_wheel_lacks_a_second_mode_and_nothing_else() {
    const NOISE: f64 = 2e-6;
    let mut noise = Noise(12);
    let mut recording = || {
        let inputs = noise.tones([2.0, 200.0], 100.0, 3000);
        let rate = |[x, v, y, w]: [f64; 4], u: f64| {
            let between = 7e5 * (y - x) + 7000.0 * (w - v);
            let at_wheel = -between - 7e6 * y - 700.0 * w;
            [v, (u + between) / 250.0, w, at_wheel / 40.0]
        };
        let wheel = moved(&inputs, 10, rate).map(|[_, _, y, _]| y);
        noise.with(&inputs, wheel, NOISE)
    };
    let rig = Rig::that_slides((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    assert_eq!(names(&diagnosis), ["second_mode"], "{}", diagnosis.headline);
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * NOISE, "{left}");
}

/// A valve against a spring that stiffens, so heavily damped that nothing shows of its mass: effects can be tried all the same.
#[test]
fn what_moves_without_a_mass_that_shows_is_asked_what_it_lacks() {
    let mut noise = Noise(13);
    let mut recording = || {
        let inputs = noise.levels([0.0, 50.0], 120, 3000);
        let rate = |[x, _]: [f64; 2], u: f64| [(u - 0.8 * x - 0.004 * x * x) / 0.4, 0.0];
        let angles = moved(&inputs, 4, rate).map(|[x, _]| x);
        noise.with(&inputs, angles, 0.03)
    };
    let rig = Rig::that_turns((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    assert_eq!(
        names(&diagnosis),
        ["quadratic_stiffness"],
        "{}",
        diagnosis.headline
    );
    let size = diagnosis.added[0].parameters[0].value;
    assert!((size / 0.004 - 1.0).abs() < 0.02, "{size}");
}

/// Three recordings of a slide that lacks nothing, whose input is logged turned round or not, measured with noise of this size \[m\].
fn plain_slide(seed: u64, turned: f64, noise_m: f64) -> Vec<Vec<[f64; 2]>> {
    let mut noise = Noise(seed);
    let recording = |_| {
        let inputs = noise.tones([1.0, 40.0], 4.0, 2000);
        let rate = |[x, v]: [f64; 2], u: f64| [v, (turned * u - 12.0 * v - 6400.0 * x) / 2.0];
        let places = moved(&inputs, 10, rate).map(|[x, _]| x);
        noise.with(&inputs, places, noise_m)
    };
    (0..3).map(recording).collect()
}

/// An input logged with the other sign leads no fit anywhere, and recordings' numbers apart: the sign is said, and no unit.
#[test]
fn an_input_of_the_other_sign_is_said_before_anything_else() {
    let rig = Rig::that_slides(plain_slide(14, -1.0, 1e-5));
    let diagnosis = rig.told(&Verb::Diagnose);
    let headline = diagnosis.headline.to_string();
    assert_eq!(diagnosis.verdict, Verdict::NotFitted, "{headline}");
    assert!(headline.contains("other sign"), "{headline}");
}

/// Input and output declared the other way round: no chain of effects that happens to look like it is looked for, the columns are named.
#[test]
fn swapped_columns_are_said_before_anything_else() {
    let mut recordings = plain_slide(16, 1.0, 1e-6);
    (recordings.iter_mut().flatten()).for_each(|row| row.reverse());
    let rig = Rig::that_slides(recordings);
    let diagnosis = rig.told(&Verb::Improve);
    let headline = diagnosis.headline.to_string();
    assert_eq!(diagnosis.verdict, Verdict::NotFitted, "{headline}");
    assert!(headline.contains("swapped"), "{headline}");
}

/// Half of what is measured is noise of the sensor: what is left knows nothing of its neighbours, and is called noise.
#[test]
fn noise_as_large_as_the_motion_is_called_noise() {
    let rig = Rig::that_slides(plain_slide(15, 1.0, 4e-3));
    let diagnosis = rig.told(&Verb::Improve);
    assert_eq!(names(&diagnosis), [""; 0], "{}", diagnosis.headline);
    assert_eq!(
        diagnosis.verdict,
        Verdict::NotFitted,
        "{}",
        diagnosis.headline
    );
    assert!(
        says(&diagnosis, "what is left is white"),
        "{:?}",
        diagnosis.reasons
    );
}

/// Less of it, and still too much for a recording to be used, was "more than noise" beside "0.00 is white noise".
#[test]
fn noise_of_which_there_is_too_much_is_called_noise() {
    let rig = Rig::that_slides(plain_slide(15, 1.0, 1.6e-3));
    let diagnosis = rig.told(&Verb::Improve);
    let headline = diagnosis.headline.to_string();
    assert_eq!(diagnosis.verdict, Verdict::Undecided, "{headline}");
    assert!(diagnosis.added.is_empty(), "{headline}");
    assert!(headline.contains("as white as noise"), "{headline}");
    assert!(!headline.contains("more than noise"), "{headline}");
    assert_eq!(diagnosis.ladder[0].selected_fraction, 0.0);
}

/// A fan that runs when recording begins: how it runs then is no effect, what resists it is its air and its bearing.
#[test]
fn a_fan_that_runs_already_lacks_what_air_and_bearing_do() {
    if !snug_tests::long("a fan that runs already") {
        return;
    }
    const NOISE: f64 = 0.04;
    let mut noise = Noise(13);
    let mut recording = || {
        let inputs = noise.levels([0.3, 6.0], 100, 4000);
        let resists = |w: f64| 0.002 * w + 0.0015 * w * w.abs() + 0.15 * (w / 0.05).tanh();
        let rate = |[w]: [f64; 1], u: f64| [(u - resists(w)) / 0.005];
        let speeds: Vec<f64> = moved(&inputs, 4, rate).map(|[w]| w).collect();
        noise.with(&inputs[1050..], speeds[1050..].iter().copied(), NOISE)
    };
    let rig = Rig::that_turns_at_speeds((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let names = names(&diagnosis);
    assert_eq!(names[..2], ["initial_motion", "quadratic_damping"]);
    let air = &diagnosis.added[1].parameters[0];
    assert!((air.value / 0.0015 - 1.0).abs() < 0.02, "{air:?}");
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * NOISE, "{left}: {}", diagnosis.headline);
}

/// A drive that rests at first, and a tachometer that reads 2 rad/s too much: nothing begins in motion.
#[test]
fn a_tachometer_that_reads_too_much_at_rest_is_no_motion() {
    let mut noise = Noise(17);
    let mut recording = || {
        let mut inputs = noise.levels([0.1, 1.0], 250, 2500);
        inputs[..300].fill(0.0);
        let rate = |[w]: [f64; 1], u: f64| [(u - 0.02 * w) / 0.01];
        let speeds: Vec<f64> = moved(&inputs, 4, rate).map(|[w]| w + 2.0).collect();
        noise.with(&inputs, speeds.into_iter(), 0.01)
    };
    let rig = Rig::that_turns_at_speeds((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Diagnose);
    assert!(
        !says(&diagnosis, "begin in motion"),
        "{:?}",
        diagnosis.reasons
    );
    let best = &diagnosis.ranking[0];
    assert_eq!(best.effect, "output_offset", "{}", diagnosis.headline);
    let offset = &best.parameters[0];
    assert!((offset.value - 2.0).abs() < 0.02, "{offset:?}");
    assert_eq!(offset.unit, "rad/s");
}

/// One recording rests while the tachometer reads 2 rad/s too much, the other is driven from its first sample on: what is read at rest in
/// one is no motion in the other.
#[test]
fn what_one_recording_reads_at_rest_is_no_motion_in_the_other() {
    let mut noise = Noise(20);
    let driven = noise.levels([-1.0, 1.0], 250, 2000);
    let rate = |[w]: [f64; 1], u: f64| [(u - 0.02 * w) / 0.01];
    let speeds: Vec<f64> = moved(&driven, 4, rate).map(|[w]| w + 2.0).collect();
    let resting = noise.with(&[0.0; 2000], std::iter::repeat(2.0), 0.01);
    let rig =
        Rig::that_turns_at_speeds(vec![resting, noise.with(&driven, speeds.into_iter(), 0.01)]);
    let diagnosis = rig.told(&Verb::Improve);
    assert_eq!(
        names(&diagnosis),
        ["output_offset"],
        "{}",
        diagnosis.headline
    );
    let offset = &diagnosis.added[0].parameters[0];
    assert!((offset.value - 2.0).abs() < 0.01, "{offset:?}");
}

/// A folder that holds a recording three times: a copy is no evidence, and is said to be one.
#[test]
fn a_recording_and_its_copies_are_one_recording() {
    let recording = pendulum().recordings.swap_remove(0);
    let rig = Rig::that_turns(vec![recording; 3]);
    let diagnosis = rig.told(&Verb::Compare);
    assert_eq!(diagnosis.tightenings, 1);
    assert!(says(&diagnosis, "same samples"), "{:?}", diagnosis.reasons);
}
