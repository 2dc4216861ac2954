//! Where a model fails.

use crate::identification::interval::Interval;
use crate::measurement::quantity::Quantity;
use crate::words::sentence::remark::Remark;
use serde::{Deserialize, Serialize};

/// Mean squared misfit in one part of the data (a stretch of time, a band of frequency, a condition).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// What part: `rise`, `0.02..0.04 s`, `QS`, …
    pub part: String,
    /// Lower edge where the part is a range, in the unit that the name of its [`Aspect`] ends with.
    pub from: Option<f64>,
    /// Upper edge, likewise in that unit.
    pub to: Option<f64>,
    /// Root-mean-square error there over the noise there (over the measurement's noise-free expectation, where the noise
    /// is not known: over the pooled rms).
    pub error_over_noise: f64,
    /// 95 % bootstrap interval over tightenings.
    pub interval: Option<Interval>,
    /// Share of the campaign's whole excess over the noise that lies there.
    pub share_of_excess: f64,
    /// Samples that fall there.
    pub samples: usize,
}

/// The misfit along one way of looking.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Aspect {
    /// `time_since_onset_s`, `phase`, `frequency_hz`, `amplitude_rad`, `participant`, `strategy`, `joint`,
    /// `pace_per_min`, `target_torque_nm`.
    pub aspect: String,
    /// Its parts in order.
    pub parts: Vec<Share>,
}

/// The missing force over one coordinate, with a bootstrap band over tightenings.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ForceCurve {
    /// Bin centres, in the coordinate's unit.
    pub at: Vec<f64>,
    /// Mean missing force \[N\].
    pub force_n: Vec<f64>,
    /// Lower edge of the 95 % band \[N\].
    pub low_n: Vec<f64>,
    /// Upper edge of the 95 % band \[N\].
    pub high_n: Vec<f64>,
}

/// The missing force over displacement and velocity.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ForceMap {
    /// Bin centres of the grip displacement x \[m\].
    pub x_m: Vec<f64>,
    /// Bin centres of the grip velocity v \[m/s\].
    pub v_m_per_s: Vec<f64>,
    /// Mean missing force \[N\], row-major (x, v); `None` where no sample fell.
    pub force_n: Vec<Option<f64>>,
    /// Half width of its 95 % bootstrap band \[N\].
    pub half_width_n: Vec<Option<f64>>,
}

/// How what a model leaves goes with itself and with the torque, later and earlier.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ResidualCorrelation {
    /// How much later \[s\], from one sample on.
    pub lag_s: Vec<f64>,
    /// Correlation of the residual with itself that much later, −1 to 1, no unit; 0 of white noise.
    pub own: Vec<f64>,
    /// How much later than the torque \[s\]; below 0 how much earlier.
    pub torque_lag_s: Vec<f64>,
    /// Correlation of the residual with the torque, −1 to 1, no unit; 0 where nothing of the torque is left unexplained.
    pub with_torque: Vec<f64>,
    /// Half width of the band that 95 % of white noise's correlations are in, no unit.
    pub half_width: f64,
}

/// How the motion answers the torque, frequency by frequency, as measured and as a model has it: both estimated in the same way from
/// the same windows, so that what a window cannot resolve is the same in both. A value for each frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FrequencyResponse {
    /// Which motion.
    pub quantity: Quantity,
    /// Frequencies \[Hz\], rising.
    pub frequency_hz: Vec<f64>,
    /// Of the motion as measured over the torque, in the motion's SI unit per Nm.
    pub measured: Vec<Response>,
    /// The same of the motion that the model makes under the measured torque.
    pub simulated: Vec<Response>,
    /// Lower and upper end of the measured gain's 95 % interval; `None` where one value alone was there.
    pub gain_interval: Vec<Option<Interval>>,
    /// γ², 0 to 1, no unit: 1 where the motion follows the torque in the same linear way in every tightening; `None` as above.
    pub coherence: Vec<Option<f64>>,
    /// Distance of two frequencies that the windows tell apart \[Hz\].
    pub resolution_hz: f64,
}

/// Gain and phase at one frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Response {
    /// In the motion's SI unit per Nm.
    pub gain: f64,
    /// \[rad\], from −π to π; below 0 where the motion is late.
    pub phase_rad: f64,
}

/// Where a model fails.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Location {
    /// The misfit over time, phase, frequency, amplitude and conditions.
    pub aspects: Vec<Aspect>,
    /// The force that would have to be added, over time since onset \[s\].
    pub force_over_time: ForceCurve,
    /// The same over displacement and velocity.
    pub force_map: ForceMap,
    /// Whether what is left is white, and whether it follows from the torque; `None` where nothing is left to correlate.
    pub correlation: Option<ResidualCorrelation>,
    /// How the motion answers the torque over frequency; `None` where no frequency is coherent.
    pub response: Option<FrequencyResponse>,
    /// Share of the squared misfit that the other tightenings' mean residual predicts, 0 to 1.
    pub repeatable_share: Option<f64>,
    /// What stands out.
    pub remarks: Vec<Remark>,
}
