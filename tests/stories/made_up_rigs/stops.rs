//! Rigs that meet a stop.

use super::names;
use super::rig::{Noise, Rig, moved};
use snug_campaign::Diagnosis;
use snug_study::Verb;
use std::sync::atomic::AtomicBool;

const NOISE_M: f64 = 2e-5;

/// What is told of a slide on a soft spring that is moved against such a `stop` \[N\].
fn told(seed: u64, stop: impl Fn(f64) -> f64) -> Diagnosis {
    let mut noise = Noise(seed);
    let mut recording = || {
        let inputs = noise.tones([1.0, 16.0], 10.0, 3000);
        let rate = |[x, v]: [f64; 2], u: f64| [v, (u - 7.5 * v - 800.0 * x - stop(x)) / 0.75];
        let places = moved(&inputs, 40, rate).map(|[x, _]| x);
        noise.with(&inputs, places, NOISE_M)
    };
    let rig = Rig::that_slides((0..2).map(|_| recording()).collect());
    rig.told_with("intersample: ZeroOrder", &Verb::Improve)
}

/// That the law was found with these sizes and no other, and what is left is noise.
fn lacks_just<const N: usize>(diagnosis: &Diagnosis, law: &str, sizes: [f64; N]) {
    let headline = &diagnosis.headline;
    assert_eq!(names(diagnosis), [law], "{headline}");
    for (one, size) in diagnosis.added[0].parameters.iter().zip(sizes) {
        let found = one.value;
        assert!((found / size - 1.0).abs() < 0.01, "{found}: {headline}");
    }
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * NOISE_M, "{left}: {headline}");
}

/// No free run of a model without the stop follows such a slide; restarted from the measured motion again and again, it lacked a mass on a
/// spring beside the stop.
#[test]
fn a_slide_that_meets_a_rubber_stop_lacks_that_alone() {
    let diagnosis = told(61, |x| 3e4 * (x - 0.02).max(0.0));
    lacks_just(&diagnosis, "end_stop_law", [3e4, 0.02]);
}

/// Thrown back and forth it follows next to nothing but the truth: a mass of a tenth of a gram led there that is none. In one step from sample to
/// sample the blows are not resolved, which left twice the noise: the search asks for shorter ones.
#[test]
fn a_slide_between_two_rubber_stops_lacks_them_alone() {
    if !snug_tests::long("a slide between two stops") {
        return;
    }
    let beyond = |x: f64| x - x.clamp(-0.02, 0.02);
    let diagnosis = told(61, |x| 3e4 * beyond(x));
    lacks_just(&diagnosis, "slack_spring_law", [-3e4, 0.02]);
}

/// A joint that rests nearer to one of its two stops was told forces of the fifth, fourth and second power of its angle, which together
/// came nearest to it.
#[test]
fn a_slide_between_stops_at_different_places_lacks_both_as_one_law() {
    let beyond = |x: f64| x - x.clamp(-0.03, 0.02);
    let diagnosis = told(62, |x| 5e3 * beyond(x));
    lacks_just(&diagnosis, "uneven_slack_spring_law", [-5e3, 0.03, 0.02]);
}

/// Seven times as stiff beyond ±4 mm: each recording alone began on the line through the bent force, and came no further than 0.64 kg and
/// a fit of −130 %, beside a law that all together had found to the fourth digit.
#[test]
fn each_recording_alone_begins_where_all_together_end() {
    let mut noise = Noise(63);
    let mut recording = || {
        let inputs = noise.tones([0.5, 30.0], 3.0, 3000);
        let beyond = |x: f64| x - x.clamp(-0.004, 0.004);
        let rate = |[x, v]: [f64; 2], u: f64| {
            let force = 1500.0 * x + 9000.0 * beyond(x);
            [v, (u - 6.0 * v - force) / 0.8]
        };
        let places = moved(&inputs, 40, rate).map(|[x, _]| x);
        noise.with(&inputs, places, 8e-6)
    };
    let rig = Rig::that_slides((0..2).map(|_| recording()).collect());
    let law = r#"intersample: ZeroOrder, effects: ["slack"], custom: [(name: "slack", place: Force,
        expression: "p * max(-b, min(b, x))", parameters: [
            (name: "p", unit: "N/m", minimum: -1e6, maximum: 1e6, start: -8000.0),
            (name: "b", unit: "m", minimum: 1e-4, maximum: 0.02, start: 0.0035),
        ])]"#;
    let never = AtomicBool::new(false);
    let result = rig.came_of(law, &Verb::Compare, &|_| (), &never);
    for one in &result.tightenings {
        let estimate = one.estimate.as_ref().unwrap();
        let [mass, ..] = &estimate.parameters[..] else {
            panic!("no mass")
        };
        assert!((mass.value / 0.8 - 1.0).abs() < 0.01, "{}", mass.value);
    }
}
