use crate::bare_loop;
use snug_campaign::{
    Conditions, Intersample, Motion, NoiseFloor, NoiseSource, Quantity, Rig, Tightening,
    TighteningId, TimeBase,
};
use snug_model::{Input, Model, THESIS_START};

const SAMPLES: usize = 3000;
const INTERVAL_S: f64 = 1e-4;
const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
/// Noise of the displacement \[rad\] and of the acceleration \[rad/s²\].
const DISPLACEMENT_NOISE: f64 = 1e-4;
const ACCELERATION_NOISE: f64 = 0.5;

/// One synthetic tightening of 3000 samples at 10 kHz.
pub struct Problem {
    /// As identification takes it.
    pub tightening: Tightening,
}

impl Problem {
    /// The problem of that number: always the same one.
    pub fn number(number: usize) -> Self {
        let mut random = Random(0x9E37_79B9_7F4A_7C15 ^ (number as u64 + 1));
        let values = [
            1.0 + 2.6 * random.uniform(),
            50.0 + 60.0 * random.uniform(),
            1400.0 + 2000.0 * random.uniform(),
        ];
        let torque = pulse(&mut random);
        let model = Model::new(RIG, &[]).expect("the benchmark's own rig");
        let input = Input::new(&torque, INTERVAL_S, Intersample::Linear);
        let mut motion = model.simulate(&values, &input);
        for (quantity, noise) in [
            (Quantity::Displacement, DISPLACEMENT_NOISE),
            (Quantity::Acceleration, ACCELERATION_NOISE),
        ] {
            let noisy = motion
                .get(quantity)
                .expect("a simulation gives every quantity")
                .iter()
                .map(|value| value + noise * random.normal())
                .collect();
            motion.set(quantity, noisy);
        }
        Self {
            tightening: tightening(number, torque, motion),
        }
    }

    /// The yardstick's fit of the displacement.
    pub fn bare_fit(&self) -> [f64; 3] {
        bare_loop::fit(
            &self.tightening.torque_nm,
            self.tightening
                .motion
                .get(Quantity::Displacement)
                .expect("it was simulated"),
            INTERVAL_S,
            RIG.lever_arm_m,
            RIG.known_inertia_kg_m2,
            THESIS_START,
        )
    }
}

fn tightening(number: usize, torque_nm: Vec<f64>, motion: Motion) -> Tightening {
    Tightening {
        id: TighteningId {
            file: "benchmark".into(),
            number: number as u32,
        },
        conditions: Conditions::default(),
        rig: RIG,
        time_base: TimeBase {
            start_s: 0.0,
            interval_s: INTERVAL_S,
        },
        peak_torque_nm: torque_nm.iter().copied().fold(0.0, f64::max),
        target_torque_nm: 30.0,
        torque_nm,
        motion,
        grip_force_n: None,
        onset: None,
        noise: Some(NoiseFloor {
            source: NoiseSource::Declared,
            quantity: Quantity::Acceleration,
            standard_deviation: ACCELERATION_NOISE,
            autoregression: Vec::new(),
            innovation_sd: ACCELERATION_NOISE,
            samples: SAMPLES,
        }),
        corrections: Vec::new(),
    }
}

/// A ramp to the target and a cosine release.
fn pulse(random: &mut Random) -> Vec<f64> {
    let start = 0.005 + 0.02 * random.uniform();
    let ramp = 0.03 + 0.09 * random.uniform();
    let target = 15.0 + 25.0 * random.uniform();
    let release = 0.005 + 0.005 * random.uniform();
    (0..SAMPLES)
        .map(|index| {
            let time = index as f64 * INTERVAL_S - start;
            let down = ((time - ramp) / release).clamp(0.0, 1.0);
            let up = (time / ramp).clamp(0.0, 1.0).powf(1.3);
            target * up * 0.5 * (1.0 + (std::f64::consts::PI * down).cos())
        })
        .collect()
}

/// SplitMix64: enough randomness for a benchmark's data, the same on every machine.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform().max(f64::MIN_POSITIVE).ln()).sqrt();
        radius * (2.0 * std::f64::consts::PI * self.uniform()).cos()
    }
}
