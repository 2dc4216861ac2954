//! The embedded campaigns: small, complete, and the same bits wherever they are made again.

use crate::error::SyntheticError;
use crate::files::campaign::SyntheticCampaign;
use crate::files::layout::MatStyle;
use crate::plan::CampaignPlan;
use crate::plan::effects::HiddenEffect;
use crate::plan::fault::{Fault, PlannedFault};
use crate::plan::file::Strategy;
use crate::plan::file::{ChannelNames, FilePlan, Joint};
use crate::plan::population::Population;
use crate::plan::sensors::Sensors;
use crate::random::noise::NoiseKind;
use crate::simulate::simulate;
use std::path::{Path, PathBuf};

/// Seed of the embedded campaign.
pub const SEED: u64 = 2020;

/// Name of its folder within the fixtures.
pub const CAMPAIGN: &str = "campaign";

/// Seed of the mystery.
pub const MYSTERY_SEED: u64 = 2027;

/// Name of the mystery's folder within the fixtures.
pub const MYSTERY: &str = "mystery";

/// The embedded campaign's plan: six participants with two files each, four tightenings per file, every combination
/// of strategy, joint and pace.
///
/// It hides no effect. Hard joints stiffen the hand–arm by 15 % and Turbo Tight lightens it by 15 %, pace changes
/// nothing, so that the statistics have something to find and something not to find. Noise is coloured; a small bias
/// and the motor's vibration disturb mildly. Two tightenings are faulty: the second of `TP2_TT_Soft_5_08.mat` has no pulse, and the
/// last of `TP6_TT_Soft_5_12.mat` is cut off.
pub fn plan() -> CampaignPlan {
    use Joint::{Hard, Soft};
    use Strategy::{QuickStep, TurboTight};
    let conditions = [
        (1, QuickStep, Soft, 5),
        (2, QuickStep, Hard, 8),
        (3, QuickStep, Soft, 8),
        (4, QuickStep, Hard, 5),
        (5, QuickStep, Soft, 5),
        (6, QuickStep, Hard, 8),
        (1, TurboTight, Hard, 8),
        (2, TurboTight, Soft, 5),
        (3, TurboTight, Hard, 5),
        (4, TurboTight, Soft, 8),
        (5, TurboTight, Hard, 8),
        (6, TurboTight, Soft, 5),
    ];
    let file = |(index, (participant, strategy, joint, pace_per_min))| FilePlan {
        participant,
        strategy,
        joint,
        pace_per_min,
        tightenings: 4,
        channel_names: ChannelNames::in_turn(index),
    };
    CampaignPlan {
        files: conditions.into_iter().enumerate().map(file).collect(),
        population: Population {
            turbo_tight_ratio: [0.85, 1.0, 1.0],
            hard_joint_ratio: [1.0, 1.0, 1.15],
            ..Population::default()
        },
        sensors: Sensors {
            noise: NoiseKind::Coloured,
            bias_sd_rad_per_s2: 0.03,
            vibration_rad_per_s2: 0.1,
            quantised: true,
            ..Sensors::default()
        },
        faults: vec![
            PlannedFault {
                file: 7,
                tightening: 1,
                fault: Fault::NoPulse,
            },
            PlannedFault {
                file: 11,
                tightening: 3,
                fault: Fault::Truncated,
            },
        ],
        segment_s: 1.9,
        ..CampaignPlan::of_size(0, 0)
    }
}

/// The embedded campaign itself.
///
/// # Errors
/// None: the plan is sound, which a test checks.
pub fn campaign() -> Result<SyntheticCampaign, SyntheticError> {
    simulate(&plan(), SEED)
}

/// The mystery's plan: six participants with one file each, four tightenings per file, one physical effect hidden in all.
///
/// A better accelerometer than the embedded campaign's (0.3 rad/s²) makes the effect leave one and a half times the
/// noise. Noise is coloured, a small bias disturbs mildly, every participant has another hand–arm.
pub fn mystery_plan() -> CampaignPlan {
    let plan = CampaignPlan {
        sensors: Sensors {
            noise: NoiseKind::Coloured,
            acceleration_noise_rad_per_s2: 0.3,
            bias_sd_rad_per_s2: 0.03,
            quantised: true,
            ..Sensors::default()
        },
        segment_s: 1.9,
        ..CampaignPlan::of_size(6, 4)
    };
    plan.hiding(HiddenEffect::StretchReflex, 0.8)
}

/// The mystery itself.
///
/// # Errors
/// None: the plan is sound, which a test checks.
pub fn mystery() -> Result<SyntheticCampaign, SyntheticError> {
    simulate(&mystery_plan(), MYSTERY_SEED)
}

/// Writes both embedded campaigns into `fixtures`, each as a folder with its `.truth.json` beside it.
///
/// # Errors
/// [`SyntheticError::Write`] with the path that could not be written.
pub fn write(fixtures: &Path) -> Result<Vec<PathBuf>, SyntheticError> {
    let mut written = campaign()?.write(&fixtures.join(CAMPAIGN), MatStyle::default())?;
    written.extend(mystery()?.write(&fixtures.join(MYSTERY), MatStyle::default())?);
    Ok(written)
}
