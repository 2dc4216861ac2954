//! Structures that ring: struck by a hammer, or moved by more than was recorded.

use super::names;
use super::rig::{FORCE, Noise, Rig, moved};
use snug_campaign::Verdict;
use snug_study::Verb;
use std::f64::consts::TAU;

/// Mass \[kg\], damping \[kg/s\] and stiffness \[N/m\], linear and cubic \[N/m³\], of a plate.
const PLATE: [f64; 4] = [1.8, 2.8, 8e3, 6.4e7];
const NOISE_M_PER_S2: f64 = 0.02;

/// A second after the blow of a hammer of 20 ms and up to this force \[N\]: force, and what an accelerometer reads.
fn struck(noise: &mut Noise, most_n: f64) -> Vec<[f64; 2]> {
    let blow = |k: u32| match k {
        50..70 => most_n * (TAU / 40.0 * f64::from(k - 50)).sin().powi(2),
        _ => 0.0,
    };
    let forces: Vec<f64> = (0..1000).map(blow).collect();
    let [mass, damping, linear, cubic] = PLATE;
    let accelerates = |[x, v]: [f64; 2], force: f64| {
        (force - damping * v - linear * x - cubic * x.powi(3)) / mass
    };
    let rate = |state: [f64; 2], force: f64| [state[1], accelerates(state, force)];
    let states = moved(&forces, 40, rate).zip(&forces);
    let read = states.map(|(state, &force)| accelerates(state, force));
    noise.with(&forces, read, NOISE_M_PER_S2)
}

/// It rings long after the blow and with far more than the typical force, which is next to nothing: no cubic spring could be as stiff. A spring
/// of another law was told, or that no model was found.
#[test]
fn a_plate_that_a_hammer_strikes_lacks_its_cubic_spring() {
    let mut noise = Noise(31);
    let blows = [30.0, 80.0, 160.0, 240.0];
    let rig = Rig::declared(
        [FORCE, "Acceleration", "MetrePerSecondSquared"],
        blows.map(|most_n| struck(&mut noise, most_n)).to_vec(),
    );
    let diagnosis = rig.told(&Verb::Improve);
    let headline = &diagnosis.headline;
    assert_eq!(names(&diagnosis), ["cubic_stiffness"], "{headline}");
    assert_eq!(diagnosis.verdict, Verdict::Adequate, "{headline}");
    let found = diagnosis.added[0].parameters[0].value;
    assert!((found / PLATE[3] - 1.0).abs() < 0.01, "{found}: {headline}");
}

/// Two and a half seconds of a tower: the force that was recorded, and where wind of this size moves it to beside that.
fn in_the_wind(noise: &mut Noise, size: f64) -> Vec<[f64; 2]> {
    let forces = noise.tones([2.5, 75.0], 8e3, 2500);
    let gusts: Vec<f64> = (0..2540).map(|_| noise.draw()).collect();
    let smooth = |all: &[f64]| -> Vec<f64> { all.windows(20).map(|w| w.iter().sum()).collect() };
    let wind = smooth(&smooth(&gusts));
    let all: Vec<f64> = (forces.iter().zip(wind))
        .map(|(force, wind)| force + size * wind)
        .collect();
    let rate = |[x, v]: [f64; 2], force: f64| [v, (force - 500.0 * v - 1.2e6 * x) / 140.0];
    let places = moved(&all, 20, rate).map(|[x, _]| x);
    noise.with(&forces, places, 8e-5)
}

/// Much of what moves it no channel shows. Restarted from its measured motion, a second mode at the frequency of the first went on from window
/// to window, foretold the wind, and was told to be all that is missing.
#[test]
fn a_tower_that_the_wind_moves_too_lacks_nothing() {
    let mut noise = Noise(32);
    let rig = Rig::that_slides((0..4).map(|_| in_the_wind(&mut noise, 110.0)).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let headline = &diagnosis.headline;
    let none: [&str; 0] = [];
    assert_eq!(names(&diagnosis), none, "{headline}");
    assert_eq!(diagnosis.verdict, Verdict::Undecided, "{headline}");
}
