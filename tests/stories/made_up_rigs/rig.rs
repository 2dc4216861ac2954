//! A rig that was made up: its recordings, what they are declared as, and noise that is the same at every run.

use snug_campaign::{CampaignResult, Diagnosis};
use snug_study::{ProgressEvent, RunSettings, Study, Verb, diagnose};
use std::f64::consts::TAU;
use std::path::Path;
use std::sync::atomic::AtomicBool;

pub const TORQUE: &str = "signal: Torque, unit: NewtonMetre";
pub const FORCE: &str = "signal: Force, unit: Newton";

/// Recordings of one machine: input and output, row by row.
pub struct Rig {
    pub recordings: Vec<Vec<[f64; 2]>>,
    /// Input, and the output that is fitted: its signal and its unit.
    pub declared: [&'static str; 3],
    /// What else its study says of how it is identified.
    pub identified: &'static str,
}

impl Rig {
    /// A rig whose input and output are declared so, in a study as README teaches it.
    pub fn declared(declared: [&'static str; 3], recordings: Vec<Vec<[f64; 2]>>) -> Self {
        Self {
            recordings,
            declared,
            identified: "constraints: [Positive]",
        }
    }

    /// A drive whose angle is measured.
    pub fn that_turns(recordings: Vec<Vec<[f64; 2]>>) -> Self {
        Self::declared([TORQUE, "Displacement", "Radian"], recordings)
    }

    /// A slide whose place is measured.
    pub fn that_slides(recordings: Vec<Vec<[f64; 2]>>) -> Self {
        Self::declared([FORCE, "Displacement", "Metre"], recordings)
    }

    /// A drive whose speed is measured.
    pub fn that_turns_at_speeds(recordings: Vec<Vec<[f64; 2]>>) -> Self {
        Self::declared([TORQUE, "Velocity", "RadianPerSecond"], recordings)
    }

    /// A slide whose speed is measured.
    pub fn that_slides_at_speeds(recordings: Vec<Vec<[f64; 2]>>) -> Self {
        Self::declared([FORCE, "Velocity", "MetrePerSecond"], recordings)
    }

    /// The diagnosis of a study as README teaches it, sampled at 1 kHz.
    pub fn told(&self, verb: &Verb) -> Diagnosis {
        self.told_with("", verb)
    }

    /// The same of one that says this of its `model`.
    pub fn told_with(&self, model: &str, verb: &Verb) -> Diagnosis {
        let never = AtomicBool::new(false);
        self.told_until(model, verb, &|_| (), &never)
    }

    /// The same by somebody who is told how far it is, and may end it.
    pub fn told_until(
        &self,
        model: &str,
        verb: &Verb,
        progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
        interrupted: &AtomicBool,
    ) -> Diagnosis {
        let result = self.came_of(model, verb, progress, interrupted);
        result.diagnosis.unwrap()
    }

    /// All that comes of it.
    pub fn came_of(
        &self,
        model: &str,
        verb: &Verb,
        progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
        interrupted: &AtomicBool,
    ) -> CampaignResult {
        let (folder, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        for (number, recording) in self.recordings.iter().enumerate() {
            let rows = recording.iter().map(|[u, y]| format!("{u:e},{y:e}\n"));
            let table: String = std::iter::once("u,y\n".to_owned()).chain(rows).collect();
            std::fs::write(folder.path().join(format!("r{number}.csv")), table).unwrap();
        }
        let [input, signal, unit] = self.declared;
        let text = format!(
            r#"(
                source: (path: {path:?}, format: Csv(
                    channels: [
                        (column: Name("u"), {input}),
                        (column: Name("y"), signal: {signal}, unit: {unit}),
                    ],
                    sampling: Rate(hz: 1000.0),
                )),
                preprocess: (window: Whole, rig: (lever_arm_m: 1.0, known_inertia: Fixed(0.0))),
                model: ({model}),
                identify: (fitted_output: {signal}, {identified}),
            )"#,
            path = folder.path(),
            identified = self.identified,
        );
        let study = Study::parse(&text, Path::new("rig.ron")).unwrap();
        let settings = RunSettings::new(out.path());
        let outcome = diagnose(&study, verb, &settings, progress, interrupted).unwrap();
        outcome.result
    }
}

/// Samples every millisecond of what `rate` moves from rest, the input held from sample to sample.
pub fn moved<const N: usize>(
    inputs: &[f64],
    steps: u32,
    rate: impl Fn([f64; N], f64) -> [f64; N],
) -> impl Iterator<Item = [f64; N]> {
    let mut state = [0.0; N];
    inputs.iter().map(move |&u| {
        let sample = state;
        state = moved_from(state, u, steps, &rate);
        sample
    })
}

/// A millisecond later than `state` under this input.
pub fn moved_from<const N: usize>(
    mut state: [f64; N],
    u: f64,
    steps: u32,
    rate: impl Fn([f64; N], f64) -> [f64; N],
) -> [f64; N] {
    let h = 1e-3 / f64::from(steps);
    let further = |state: [f64; N], rates: [f64; N], h: f64| -> [f64; N] {
        std::array::from_fn(|index| state[index] + h * rates[index])
    };
    for _ in 0..steps {
        let middle = further(state, rate(state, u), 0.5 * h);
        state = further(state, rate(middle, u), h);
    }
    state
}

/// Of unit variance and all the same at every run: twelve even numbers, summed.
pub struct Noise(pub u64);

impl Noise {
    pub fn even(&mut self) -> f64 {
        self.0 = (self.0.wrapping_mul(6_364_136_223_846_793_005))
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 2.0_f64.powi(53)
    }

    pub fn draw(&mut self) -> f64 {
        (0..12).map(|_| self.even()).sum::<f64>() - 6.0
    }

    /// Levels between these two, each held for so many samples.
    pub fn levels(&mut self, between: [f64; 2], held: usize, samples: usize) -> Vec<f64> {
        let levels: Vec<f64> = (0..=samples / held)
            .map(|_| between[0] + (between[1] - between[0]) * self.even())
            .collect();
        (0..samples).map(|k| levels[k / held]).collect()
    }

    /// Twelve tones of one size between these frequencies \[Hz\].
    pub fn tones(&mut self, between_hz: [f64; 2], size: f64, samples: usize) -> Vec<f64> {
        let [low, high] = between_hz;
        let tones: Vec<[f64; 2]> = (0..12)
            .map(|tone| {
                let hz = low * (high / low).powf(f64::from(tone) / 11.0);
                [hz, TAU * self.even()]
            })
            .collect();
        let at = |k: usize| {
            let turns = tones
                .iter()
                .map(|[hz, phase]| (TAU * hz * 1e-3 * k as f64 + phase).sin());
            size * turns.sum::<f64>()
        };
        (0..samples).map(at).collect()
    }

    pub fn with(
        &mut self,
        inputs: &[f64],
        outputs: impl Iterator<Item = f64>,
        size: f64,
    ) -> Vec<[f64; 2]> {
        let pairs = inputs.iter().zip(outputs);
        pairs.map(|(&u, y)| [u, y + size * self.draw()]).collect()
    }
}
