//! From plan to campaign: draws people and pulses, integrates each tightening, measures it, and notes the truth.

use crate::error::SyntheticError;
use crate::files::campaign::SyntheticCampaign;
use crate::files::file::SyntheticFile;
use crate::files::truth::{TighteningTruth, Truth};
use crate::motion::plant::Plant;
use crate::motion::pulse::Pulse;
use crate::motion::trajectory::Trajectory;
use crate::plan::CampaignPlan;
use crate::plan::effects::{HiddenEffect, Law};
use crate::plan::fault::Fault;
use crate::plan::file::{FilePlan, Strategy};
use crate::plan::population::HandArm;
use crate::random::Stream;
use crate::random::noise::NoiseKind;
use crate::sensing::{Channels, sense};
use std::collections::BTreeMap;
use std::ops::Range;

/// Samples of rest before the window that are integrated as well, so that nothing starts by surprise.
const REST_SAMPLES: usize = 200;

/// Simulates a campaign: the same plan and seed give the same bits.
///
/// Every tightening draws from streams of its own, so that a plan with one file more, another effect or no noise
/// keeps everything else as it was.
///
/// # Errors
/// A plan that cannot be simulated, see [`SyntheticError`].
pub fn simulate(plan: &CampaignPlan, seed: u64) -> Result<SyntheticCampaign, SyntheticError> {
    plan.check()?;
    let mut files = Vec::with_capacity(plan.files.len());
    let mut tightenings = Vec::new();
    for (number, file_plan) in plan.files.iter().enumerate() {
        let all = 0..file_plan.tightenings;
        let (file, truths) = Bench { plan, seed }.file(number, file_plan, all)?;
        tightenings.extend(truths);
        files.push(file);
    }
    let hides = !plan.effects.is_empty();
    let sensors = &plan.sensors;
    let truth = Truth {
        effects: if hides {
            plan.effects.iter().map(|e| e.name().into()).collect()
        } else {
            vec!["none".into()]
        },
        strength: plan.strength,
        seed,
        noise: match sensors.noise {
            NoiseKind::White => "white".into(),
            NoiseKind::Coloured => "coloured".into(),
        },
        nuisance: sensors.bias_sd_rad_per_s2 > 0.0 || sensors.vibration_rad_per_s2 > 0.0,
        tightenings,
    };
    Ok(SyntheticCampaign { files, truth })
}

/// Some tightenings of one file of a plan, with the bits that [`simulate`] gives them: a long file in parts, each without the others in
/// memory. They are counted from 0, as files are.
///
/// # Errors
/// As [`simulate`].
///
/// # Panics
/// Where the plan has no file of this number.
pub fn simulate_part(
    plan: &CampaignPlan,
    file: usize,
    tightenings: Range<usize>,
    seed: u64,
) -> Result<SyntheticFile, SyntheticError> {
    plan.check()?;
    let (part, _) = Bench { plan, seed }.file(file, &plan.files[file], tightenings)?;
    Ok(part)
}

/// Where tightenings are made: the plan and the seed.
struct Bench<'a> {
    plan: &'a CampaignPlan,
    seed: u64,
}

impl Bench<'_> {
    fn file(
        &self,
        number: usize,
        file_plan: &FilePlan,
        tightenings: Range<usize>,
    ) -> Result<(SyntheticFile, Vec<TighteningTruth>), SyntheticError> {
        let mut file = SyntheticFile::empty(self.plan, file_plan, number);
        let mut truths = Vec::with_capacity(tightenings.len());
        for index in tightenings {
            let (channels, truth) = self.tightening(number, file_plan, index)?;
            file.append(channels, self.plan);
            truths.push(truth);
        }
        Ok((file, truths))
    }

    fn tightening(
        &self,
        number: usize,
        file: &FilePlan,
        index: usize,
    ) -> Result<(Channels, TighteningTruth), SyntheticError> {
        let plan = self.plan;
        let fault = self.fault(number, index);
        let mut rng = Stream::Tightening.rng(self.seed, number, index);
        let around = self.person(file)?;
        let known_inertia = file.known_inertia_kg_m2();
        let arm = plan
            .population
            .tightening(around, plan.lever_arm_m, known_inertia, &mut rng)?;
        let pulse = Pulse::drawn(file, &mut rng);
        let (laws, used) = self.laws(number, file, index);
        let plant = Plant {
            lever_arm_m: plan.lever_arm_m * (1.0 + lever_arm_error(&laws)),
            known_inertia_kg_m2: known_inertia,
            hand_arm: tired(arm, &laws, index),
            pulses: fault.map_or_else(|| vec![pulse], |fault| fault.pulses(pulse)),
            laws: if fault == Some(Fault::NoPulse) {
                Vec::new()
            } else {
                laws
            },
        };
        let (trajectory, window) = self.trajectory(&plant);
        let mut channels = sense(plan, &plant, &trajectory, window, self.seed, number, index);
        if let Some(fault) = fault {
            channels.spoil(fault, window, plan);
        }
        if file.strategy == Strategy::TurboTight {
            channels.grip_force_n = None;
        }
        let truth = TighteningTruth {
            file: file.label(),
            index,
            m: plant.hand_arm.mass_kg,
            c: plant.hand_arm.damping_kg_per_s,
            k: plant.hand_arm.stiffness_n_per_m,
            target: pulse.peak_nm,
            used,
            bias: channels.bias_rad_per_s2,
            peak_rad: trajectory.peak_rad(),
            fault: fault.map(|fault| fault.name().into()),
        };
        Ok((channels, truth))
    }

    fn fault(&self, file: usize, tightening: usize) -> Option<Fault> {
        let here = |planned: &&crate::PlannedFault| {
            planned.file == file && planned.tightening == tightening
        };
        self.plan.faults.iter().find(here).map(|found| found.fault)
    }

    /// The participant's own hand–arm under this file's conditions.
    fn person(&self, file: &FilePlan) -> Result<HandArm, SyntheticError> {
        let population = &self.plan.population;
        // Judged with the smaller inertia, which damps most: the person then suits both strategies.
        let person = population.person(file.participant, self.plan.lever_arm_m, 0.15, self.seed)?;
        Ok(population.under(
            person,
            file.strategy == Strategy::TurboTight,
            file.joint == crate::Joint::Hard,
            file.pace_per_min >= 8,
        ))
    }

    fn laws(
        &self,
        number: usize,
        file: &FilePlan,
        index: usize,
    ) -> (Vec<Law>, BTreeMap<String, Vec<f64>>) {
        let mut rng = Stream::Effect.rng(self.seed, number, index);
        let factor = self.plan.whose.factor(file, number, index, self.seed);
        let mut laws = Vec::new();
        let mut used = BTreeMap::new();
        for &effect in &self.plan.effects {
            if let Some(law) = effect.law(factor * self.plan.strength, &mut rng) {
                used.insert(effect.name().to_owned(), law.numbers.clone());
                laws.push(law);
            }
        }
        if used.is_empty() {
            used.insert("none".to_owned(), Vec::new());
        }
        (laws, used)
    }

    /// The true motion, and the index of the window's first sample in the whole segment.
    fn trajectory(&self, plant: &Plant) -> (Trajectory, usize) {
        let interval_s = 1.0 / self.plan.sample_rate_hz;
        let window = (self.plan.quiet_s * self.plan.sample_rate_hz).round() as usize;
        let rest = REST_SAMPLES.min(window);
        let samples = self.plan.segment_samples() - window + rest;
        let first_s = -(rest as f64) * interval_s;
        (Trajectory::of(plant, first_s, interval_s, samples), window)
    }
}

fn lever_arm_error(laws: &[Law]) -> f64 {
    let error = laws
        .iter()
        .find(|law| law.effect == HiddenEffect::LeverArmError);
    error.map_or(0.0, |law| law.numbers[0])
}

/// `arm` after `index` tightenings; each of m, c, k keeps at least a tenth.
fn tired(arm: HandArm, laws: &[Law], index: usize) -> HandArm {
    laws.iter().fold(arm, |arm, law| match law.parts() {
        (HiddenEffect::Fatigue, &[stiffness, damping, mass]) => arm
            .scaled([mass, damping, stiffness].map(|slope| (1.0 + slope * index as f64).max(0.1))),
        _ => arm,
    })
}
