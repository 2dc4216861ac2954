//! One tightening on its way: ready for identification, its result and fit measures, and why it was rejected.

use crate::identification::estimate::Estimate;
use crate::measurement::conditions::Conditions;
use crate::measurement::noise::NoiseFloor;
use crate::measurement::recording::Motion;
use crate::measurement::rig::{Quantity, Rig};
use crate::measurement::time_base::TimeBase;
use crate::tightening::validation::Validation;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Which tightening: the file and the 1-based number within it.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TighteningId {
    /// File name without its folder.
    pub file: String,
    /// 1-based number within the file.
    pub number: u32,
}

impl fmt::Display for TighteningId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} #{}", self.file, self.number)
    }
}

/// A sensor error that was measured in the quiet part and taken out before the fit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Correction {
    /// The effect of the catalogue it corresponds to, for example `acceleration_bias`.
    pub effect: String,
    /// The measured quantity whose constant error it is; `None` where it is that of another signal, as the torque.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub constant_of: Option<Quantity>,
    /// Size that was subtracted.
    pub value: f64,
    /// Its standard error under the measured (coloured) noise.
    pub standard_error: f64,
    /// Unit of the size.
    pub unit: String,
    /// Whether it differs from zero beyond chance.
    pub significant: bool,
}

/// One tightening, cut out, zeroed and ready for identification. All signals have the same length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tightening {
    /// Which one.
    pub id: TighteningId,
    /// Its conditions.
    pub conditions: Conditions,
    /// The rig's constants for it.
    pub rig: Rig,
    /// The window's sampling grid, in the segment's time (0 = the segment's start).
    pub time_base: TimeBase,
    /// Input: joint torque \[Nm\].
    pub torque_nm: Vec<f64>,
    /// Measured motion, corrected; includes what was integrated from it.
    pub motion: Motion,
    /// Measured grip force \[N\].
    pub grip_force_n: Option<Vec<f64>>,
    /// Largest torque of the whole segment \[Nm\].
    pub peak_torque_nm: f64,
    /// Peak torque rounded to 5 Nm \[Nm\].
    pub target_torque_nm: f64,
    /// Index into the window at which the pulse begins.
    pub onset: Option<usize>,
    /// Measurement noise of the fitted output.
    pub noise: Option<NoiseFloor>,
    /// What was measured in the quiet part and taken out.
    pub corrections: Vec<Correction>,
}

impl Tightening {
    /// The constant error of a measured quantity that was taken out before the fit, and is uncertain.
    pub fn correction_of(&self, quantity: Quantity) -> Option<&Correction> {
        (self.corrections.iter()).find(|correction| correction.constant_of == Some(quantity))
    }

    /// A tightening from arrays: torque \[Nm\], sampled every `interval_s` from 0 s on, on a rig; what is not said is unknown,
    /// not invented. Peak and target torque are those of the torque given.
    pub fn from_torque(rig: Rig, interval_s: f64, torque_nm: Vec<f64>) -> Self {
        let peak_torque_nm = torque_nm.iter().copied().fold(0.0, f64::max);
        Self {
            id: TighteningId {
                file: String::new(),
                number: 1,
            },
            conditions: Conditions::default(),
            rig,
            time_base: TimeBase {
                start_s: 0.0,
                interval_s,
            },
            torque_nm,
            motion: Motion::default(),
            grip_force_n: None,
            peak_torque_nm,
            target_torque_nm: 5.0 * (peak_torque_nm / 5.0).round(),
            onset: None,
            noise: None,
            corrections: Vec::new(),
        }
    }

    /// The same with one measured quantity, one value per sample of the torque.
    pub fn with(mut self, quantity: Quantity, samples: Vec<f64>) -> Self {
        self.motion.set(quantity, samples);
        self
    }

    /// The same with the noise of what was measured.
    pub fn with_noise(mut self, noise: NoiseFloor) -> Self {
        self.noise = Some(noise);
        self
    }
}

/// Why a tightening was rejected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rejection {
    /// Thesis code 1: the displacement goes up and does not come back.
    GoesUp,
    /// Thesis code 2: the displacement goes down.
    GoesDown,
    /// Thesis code 3: not lightly damped.
    NotLightlyDamped,
    /// Fit below the study's limit (90 %).
    PoorFit,
    /// Estimated mass not positive.
    MassNotPositive,
    /// The optimum lies on a constraint: the parameters are not the data's free choice.
    AtConstraint,
    /// The identification did not reach an optimum, or the data do not determine the parameters.
    NotIdentified,
    /// Kept for validation: simulated with the parameters of the others, not fitted.
    Validation,
    /// The data themselves are faulty (saturation, gaps, no pulse, truncated, …): see the findings.
    DataQuality,
}

impl Rejection {
    /// Stable snake-case name, as in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::GoesUp => "goes_up",
            Self::GoesDown => "goes_down",
            Self::NotLightlyDamped => "not_lightly_damped",
            Self::PoorFit => "poor_fit",
            Self::MassNotPositive => "mass_not_positive",
            Self::AtConstraint => "at_constraint",
            Self::NotIdentified => "not_identified",
            Self::Validation => "validation",
            Self::DataQuality => "data_quality",
        }
    }
}

/// Whether a tightening takes part in the statistics.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Selection {
    /// Empty when selected.
    pub rejections: Vec<Rejection>,
}

impl Selection {
    /// True when nothing speaks against the tightening.
    pub fn selected(&self) -> bool {
        self.rejections.is_empty()
    }
}

/// Everything that is reported about how model and measurement agree. `None` where it does not apply.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FitMeasures {
    /// 100 (1 − ‖y − ŷ‖ / ‖y − ȳ‖) of the displacement.
    pub fit_percent: Option<f64>,
    /// The same of the fitted output.
    pub fit_percent_fitted_output: Option<f64>,
    /// Root mean square of the whitened residual: 1 = nothing left but noise.
    pub error_over_noise: Option<f64>,
    /// Root-mean-square residual of the displacement \[rad\].
    pub rms_displacement_rad: Option<f64>,
    /// 100 (1 − mean|e| / mean|y|) of the explicit Euler displacement.
    pub euler_accuracy_percent: Option<f64>,
    /// √(k/m) / 2π of the hand–arm \[Hz\].
    pub natural_frequency_hz: Option<f64>,
    /// Lower end of its 95 % interval \[Hz\].
    pub natural_frequency_low_hz: Option<f64>,
    /// Upper end of its 95 % interval \[Hz\].
    pub natural_frequency_high_hz: Option<f64>,
    /// Damped frequency of tool and hand–arm together \[Hz\]; `None` when overdamped.
    pub damped_frequency_hz: Option<f64>,
    /// Lower end of its 95 % interval \[Hz\].
    pub damped_frequency_low_hz: Option<f64>,
    /// Upper end of its 95 % interval \[Hz\].
    pub damped_frequency_high_hz: Option<f64>,
    /// ζ of tool and hand–arm together: c l² / (2 √(k l² (I_n + m l²))).
    pub damping_ratio: Option<f64>,
    /// Lower end of its 95 % interval.
    pub damping_ratio_low: Option<f64>,
    /// Upper end of its 95 % interval.
    pub damping_ratio_high: Option<f64>,
    /// ζ as the thesis checks it, with the tool's mass: c / (2 √(k (m + m_n))).
    pub thesis_damping_ratio: Option<f64>,
    /// max |F1| \[N\].
    pub peak_force_f1_n: Option<f64>,
    /// max |F2| \[N\].
    pub peak_force_f2_n: Option<f64>,
    /// max |F3| \[N\].
    pub peak_force_f3_n: Option<f64>,
    /// max |F_op_J| \[N\].
    pub peak_grip_force_n: Option<f64>,
}

/// Measured and simulated signals of one tightening, all on `time_base`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Traces {
    /// Sampling grid in the segment's time.
    pub time_base: TimeBase,
    /// Torque \[Nm\].
    pub torque_nm: Vec<f64>,
    /// Measured motion.
    pub measured: Motion,
    /// Simulated motion.
    pub simulated: Motion,
    /// Motion simulated with the model that a diagnosis began with; empty where the model is that one still.
    #[serde(default)]
    pub before: Motion,
    /// Displacement by the explicit Euler method \[rad\].
    pub euler_displacement_rad: Vec<f64>,
    /// F1 = l (c ω + k θ) with simulated ω, θ \[N\].
    pub force_f1_n: Vec<f64>,
    /// F2 = (T − I_n α_measured) / l \[N\]; empty without an acceleration channel.
    pub force_f2_n: Vec<f64>,
    /// F3 = (T − I_n α_simulated) / l \[N\].
    pub force_f3_n: Vec<f64>,
    /// Measured grip force \[N\].
    pub grip_force_n: Option<Vec<f64>>,
}

/// What was found out about one tightening.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TighteningResult {
    /// Which one.
    pub id: TighteningId,
    /// When its segment began, on the clock of its file's events \[s\]; `None` where the file has none.
    #[serde(default)]
    pub started_at_s: Option<f64>,
    /// Its conditions.
    pub conditions: Conditions,
    /// The rig's constants for it.
    pub rig: Rig,
    /// Largest torque of the whole segment \[Nm\].
    pub peak_torque_nm: f64,
    /// Peak torque rounded to 5 Nm \[Nm\].
    pub target_torque_nm: f64,
    /// The identification; `None` when the data did not allow one.
    pub estimate: Option<Estimate>,
    /// Agreement of model and measurement.
    pub measures: FitMeasures,
    /// Whether it is selected.
    pub selection: Selection,
    /// What was taken out before the fit.
    pub corrections: Vec<Correction>,
    /// Noise of the fitted output.
    pub noise: Option<NoiseFloor>,
    /// How well it is predicted, if it was kept for validation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub validation: Option<Validation>,
}
