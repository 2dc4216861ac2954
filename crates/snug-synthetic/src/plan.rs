//! The plan of a campaign: conditions of its files, people, sensors, hidden effects, faults; the seed decides the rest.

pub(crate) mod effects;
pub(crate) mod fault;
pub(crate) mod file;
pub(crate) mod population;
pub(crate) mod sensors;
pub(crate) mod whose;

use crate::error::SyntheticError;
use crate::plan::effects::HiddenEffect;
use crate::plan::fault::PlannedFault;
use crate::plan::file::{ChannelNames, FilePlan, Joint, Strategy};
use crate::plan::population::Population;
use crate::plan::sensors::Sensors;
use crate::plan::whose::Whose;
use crate::random::noise::NoiseKind;
use serde::{Deserialize, Serialize};

/// Everything that decides a campaign, except the seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CampaignPlan {
    /// The files; default the six of [`CampaignPlan::of_size`].
    pub files: Vec<FilePlan>,
    /// Hidden effects; default none.
    pub effects: Vec<HiddenEffect>,
    /// How strong they are, 0 to 1, without unit; default 0.3.
    pub strength: f64,
    /// Who has the hidden effects; default everyone alike.
    pub whose: Whose,
    /// Who holds the tool.
    pub population: Population,
    /// What the sensors add.
    pub sensors: Sensors,
    /// Tightenings that something is wrong with; default none.
    pub faults: Vec<PlannedFault>,
    /// Sampling rate \[Hz\]; default 10 000.
    pub sample_rate_hz: f64,
    /// Length of the quiet part before the window \[s\]; default 1.48.
    pub quiet_s: f64,
    /// Length of a segment \[s\]; default 2.
    pub segment_s: f64,
    /// l, joint axis to grip, as everybody believes it is \[m\]; default 0.330.
    pub lever_arm_m: f64,
}

impl Default for CampaignPlan {
    fn default() -> Self {
        Self::of_size(6, 4)
    }
}

impl CampaignPlan {
    /// A campaign of `files` files with `tightenings_per_file` each, hiding nothing, with white noise and no nuisance.
    ///
    /// Participants, strategies, joints, paces and channel names take turns so that every run of eight files holds
    /// every combination of the three conditions; from the ninth on, new participants come.
    pub fn of_size(files: usize, tightenings_per_file: usize) -> Self {
        const TURNS: [(Strategy, Joint, u32); 8] = [
            (Strategy::QuickStep, Joint::Soft, 5),
            (Strategy::QuickStep, Joint::Hard, 8),
            (Strategy::TurboTight, Joint::Hard, 5),
            (Strategy::QuickStep, Joint::Soft, 8),
            (Strategy::TurboTight, Joint::Soft, 5),
            (Strategy::TurboTight, Joint::Hard, 8),
            (Strategy::QuickStep, Joint::Hard, 5),
            (Strategy::TurboTight, Joint::Soft, 8),
        ];
        let file = |index: usize| {
            let (strategy, joint, pace_per_min) = TURNS[index % TURNS.len()];
            let participant = index / TURNS.len() * 6 + index % TURNS.len() % 6;
            FilePlan {
                participant: participant as u32 + 1,
                strategy,
                joint,
                pace_per_min,
                tightenings: tightenings_per_file,
                channel_names: ChannelNames::in_turn(index),
            }
        };
        Self {
            files: (0..files).map(file).collect(),
            effects: Vec::new(),
            strength: 0.3,
            whose: Whose::Everyone,
            population: Population::default(),
            sensors: Sensors::default(),
            faults: Vec::new(),
            sample_rate_hz: 10_000.0,
            quiet_s: 1.48,
            segment_s: 2.0,
            lever_arm_m: 0.330,
        }
    }

    /// The same campaign with `effect` hidden in it at `strength` (0 to 1), beside what it hides already.
    pub fn hiding(mut self, effect: HiddenEffect, strength: f64) -> Self {
        self.effects.push(effect);
        self.strength = strength;
        self
    }

    /// The same campaign with the effects that it hides of these only, or larger for some.
    pub fn of(mut self, whose: Whose) -> Self {
        self.whose = whose;
        self
    }

    /// The same campaign with acceleration noise of this kind.
    pub fn with_noise(mut self, noise: NoiseKind) -> Self {
        self.sensors.noise = noise;
        self
    }

    /// The same campaign with a nuisance bias of this standard deviation per tightening \[rad/s²\].
    pub fn with_bias(mut self, bias_sd_rad_per_s2: f64) -> Self {
        self.sensors.bias_sd_rad_per_s2 = bias_sd_rad_per_s2;
        self
    }

    /// Samples of one segment.
    pub(crate) fn segment_samples(&self) -> usize {
        (self.segment_s * self.sample_rate_hz).round() as usize
    }

    /// # Errors
    /// Names the first setting that cannot be simulated.
    pub(crate) fn check(&self) -> Result<(), SyntheticError> {
        let sensors = &self.sensors;
        let not_negative = [
            ("strength", self.strength),
            ("quiet_s", self.quiet_s),
            (
                "acceleration_noise_rad_per_s2",
                sensors.acceleration_noise_rad_per_s2,
            ),
            ("torque_noise_nm", sensors.torque_noise_nm),
            ("force_noise_n", sensors.force_noise_n),
            ("bias_sd_rad_per_s2", sensors.bias_sd_rad_per_s2),
            ("vibration_rad_per_s2", sensors.vibration_rad_per_s2),
        ];
        for (field, value) in not_negative {
            require(value >= 0.0 && value.is_finite(), field, value, "0 or more")?;
        }
        for (field, value) in [
            ("sample_rate_hz", self.sample_rate_hz),
            ("lever_arm_m", self.lever_arm_m),
        ] {
            require(value > 0.0 && value.is_finite(), field, value, "above 0")?;
        }
        let longest = "longer than quiet_s, at most 60";
        let fits = self.segment_s > self.quiet_s && self.segment_s <= 60.0;
        require(fits, "segment_s", self.segment_s, longest)?;
        for fault in &self.faults {
            fault.check(&self.files)?;
        }
        Ok(())
    }
}

fn require(
    holds: bool,
    field: &'static str,
    value: f64,
    allowed: &'static str,
) -> Result<(), SyntheticError> {
    if holds {
        Ok(())
    } else {
        Err(SyntheticError::OutOfRange {
            field,
            value,
            allowed,
        })
    }
}
