//! What the effects' own tests share: one tightening, and SciPy's motion of it in `tests/reference/effects.csv`.

use crate::assembly::model::Model;
use crate::effects::Effect;
use crate::input::torque::Input;
use crate::law::{Instant, Law};
use snug_campaign::{Intersample, Rig};
use std::f64::consts::PI;

const TABLE: &str = include_str!("../../tests/reference/effects.csv");
const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const BASE: [f64; 3] = [2.3, 103.0, 2315.0];
const SAMPLES: usize = 3001;
const ONSET_S: f64 = 0.02;
/// Sizes of θ \[rad\], ω \[rad/s\] and α \[rad/s²\] that errors are relative to.
const SIZES: [f64; 3] = [0.05, 0.9, 40.0];

/// Time between samples \[s\].
pub const INTERVAL_S: f64 = 1e-4;

/// An instant at which 20 Nm act, 0.1 s after the onset.
pub fn at(x_m: f64, v_m_per_s: f64) -> Instant<f64> {
    Instant {
        torque_nm: 20.0,
        x_m,
        v_m_per_s,
        since_onset_s: 0.1,
        lever_arm_m: RIG.lever_arm_m,
    }
}

/// What a law without states adds to the hand force there \[N\].
pub fn force(law: &impl Law, own: &[f64], x_m: f64, v_m_per_s: f64) -> f64 {
    let force_n = law.force(own, &at(x_m, v_m_per_s), &[]);
    force_n.expect("the law answers `force`")
}

/// Both are one number, to some roundings of what it is computed from.
#[track_caller]
pub fn assert_near(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-11 * (1.0 + expected.abs()),
        "{found} against {expected}"
    );
}

/// One tightening.
pub struct Trial {
    torque_nm: Vec<f64>,
    rest_before_s: f64,
}

impl Trial {
    /// Torque that rises to 30 Nm between 0.02 s and 0.1 s and ends at once.
    pub fn ramp() -> Self {
        Self::under(|index| match index {
            200..=1000 => 30.0 * (index - 200) as f64 / 800.0,
            1001..1010 => 3.0 * (1010 - index) as f64,
            _ => 0.0,
        })
    }

    /// 30 sin²(π t / 0.2 s) Nm until 0.2 s: for what needs the torque's slope.
    pub fn sine_squared() -> Self {
        Self::under(|index| match index {
            0..2000 => 30.0 * (PI * index as f64 / 2000.0).sin().powi(2),
            _ => 0.0,
        })
    }

    fn under(torque_nm: impl Fn(usize) -> f64) -> Self {
        Self {
            torque_nm: (0..SAMPLES).map(torque_nm).collect(),
            rest_before_s: 0.0,
        }
    }

    /// The same with the integration of the sensor's signal begun so long before the first sample.
    pub fn rested_before(self, rest_before_s: f64) -> Self {
        Self {
            rest_before_s,
            ..self
        }
    }

    /// Measured θ \[rad\], ω \[rad/s\] and α \[rad/s²\] with an effect whose parameters are `own`.
    pub fn motion(&self, effect: Effect, own: &[f64]) -> [Vec<f64>; 3] {
        self.motion_of(&[effect], own)
    }

    /// The same with any effects, or with none.
    pub fn motion_of(&self, effects: &[Effect], own: &[f64]) -> [Vec<f64>; 3] {
        let model = Model::new(RIG, effects).expect("a valid rig");
        let values: Vec<f64> = BASE.iter().chain(own).copied().collect();
        let input = Input::new(&self.torque_nm, INTERVAL_S, Intersample::Linear)
            .with_onset(ONSET_S)
            .with_rest_before(self.rest_before_s);
        let motion = model.simulate(&values, &input).expect("a valid simulation");
        [
            motion.displacement_rad,
            motion.velocity_rad_per_s,
            motion.acceleration_rad_per_s2,
        ]
        .map(|signal| signal.expect("a simulation gives every quantity"))
    }

    /// Holds every number that SciPy's table has of `effect` against its motion here; `tolerance` is what the law's smoothness
    /// allows a fixed step of 0.1 ms to reach, relative to the usual sizes.
    pub fn agrees_with_scipy(&self, effect: Effect, tolerance: f64) {
        let name = effect.name();
        let number = |text: &str| text.parse::<f64>().expect("a number of the table");
        let rows: Vec<Vec<&str>> = TABLE
            .lines()
            .map(|line| line.split(',').collect())
            .filter(|row: &Vec<&str>| row[0] == name)
            .collect();
        assert!(
            !rows.is_empty(),
            "add rows for `{name}` to tests/reference/effects.csv, as its head says"
        );
        let own: Vec<f64> = rows[0][1].split(' ').map(number).collect();
        let motion = self.motion(effect, &own);
        for row in rows {
            let sample = (number(row[2]) / INTERVAL_S).round() as usize;
            for ((signal, size), expected) in motion.iter().zip(SIZES).zip(&row[3..]) {
                let (found, expected) = (signal[sample], number(expected));
                let error = (found - expected).abs() / size;
                assert!(
                    error < tolerance,
                    "{name} at {} s: {found} against {expected}, error {error:.1e} of {size}",
                    row[2]
                );
            }
        }
    }
}
