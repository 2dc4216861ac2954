//! Faults of the data that preparation must find: what each does to pulses, channels and the length of a segment.

use crate::error::SyntheticError;
use crate::plan::file::FilePlan;
use serde::{Deserialize, Serialize};

/// Share of the peak at which a saturated torque channel stops.
const SATURATION_RATIO: f64 = 0.7;

/// Something wrong with one tightening's data, for findings to say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Fault {
    /// The motor never started: no torque, no motion, only noise.
    NoPulse,
    /// The recording ends 60 ms into the window, before the events say so. Only a file's last tightening can be so.
    Truncated,
    /// A second, smaller pulse follows 110 ms after the first.
    DoubleHit,
    /// The torque channel stops at 70 % of the peak.
    SaturatedTorque,
    /// 5 ms of acceleration are missing (NaN) 50 ms into the window.
    Gap,
    /// The acceleration before the window was not logged, but filled up with zeros.
    SilentRest,
}

impl Fault {
    /// Name in snake case, as in the truth file.
    pub fn name(self) -> &'static str {
        match self {
            Self::NoPulse => "no_pulse",
            Self::Truncated => "truncated",
            Self::DoubleHit => "double_hit",
            Self::SaturatedTorque => "saturated_torque",
            Self::Gap => "gap",
            Self::SilentRest => "silent_rest",
        }
    }

    /// What the fault does to the channels; `window` is the index of the window's first sample.
    pub(crate) fn spoil(
        self,
        window: usize,
        sample_rate_hz: f64,
        torque_nm: &mut [f64],
        acceleration_rad_per_s2: &mut [f64],
    ) {
        let at = |time_s: f64| window + (time_s * sample_rate_hz).round() as usize;
        match self {
            Self::SaturatedTorque => {
                let peak = torque_nm.iter().copied().fold(0.0, f64::max);
                for torque in torque_nm {
                    *torque = torque.min(SATURATION_RATIO * peak);
                }
            }
            Self::Gap => {
                let length = acceleration_rad_per_s2.len();
                acceleration_rad_per_s2[at(0.05).min(length)..at(0.055).min(length)].fill(f64::NAN);
            }
            Self::SilentRest => acceleration_rad_per_s2[..window].fill(0.0),
            Self::NoPulse | Self::Truncated | Self::DoubleHit => {}
        }
    }

    /// How long of a segment is kept \[s\], if not all.
    pub(crate) fn kept_s(self, quiet_s: f64) -> Option<f64> {
        (self == Self::Truncated).then_some(quiet_s + 0.06)
    }
}

/// A fault and where it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedFault {
    /// 0-based file.
    pub file: usize,
    /// 0-based tightening.
    pub tightening: usize,
    /// What is wrong.
    pub fault: Fault,
}

impl PlannedFault {
    pub(crate) fn check(&self, files: &[FilePlan]) -> Result<(), SyntheticError> {
        let Self {
            file, tightening, ..
        } = *self;
        let count = files.get(file).map_or(0, |file| file.tightenings);
        if tightening >= count {
            return Err(SyntheticError::FaultOutsidePlan { file, tightening });
        }
        if self.fault == Fault::Truncated && tightening + 1 != count {
            return Err(SyntheticError::TruncatedInside { file, tightening });
        }
        Ok(())
    }
}
