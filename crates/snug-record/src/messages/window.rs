//! `/tightening/window`: what a tightening's samples alone do not say, so that it can be evaluated anew.

use crate::encoding::schema::{
    Field, Message, count, flag, group, list, number, pure_number, text,
};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize};
use snug_campaign::{Conditions, Correction, NoiseFloor, Rig, TimeBase};

/// Where a recorded tightening comes from and what its samples alone do not say: the message on `/tightening/window`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Window {
    /// Running number within the recording, from 1; the samples carry it.
    pub tightening: u64,
    /// File name without its folder.
    pub file: String,
    /// 1-based number within the file.
    pub number: u32,
    /// When its segment began, on the clock of its file's events \[s\]: the recording's own time axis leaves the pauses out.
    #[serde(default)]
    pub started_at_s: Option<f64>,
    /// Its conditions.
    pub conditions: Conditions,
    /// The rig's constants for it.
    pub rig: Rig,
    /// Largest torque of the whole segment \[Nm\].
    #[serde(default = "not_a_number")]
    pub peak_torque_nm: f64,
    /// Peak torque rounded to 5 Nm \[Nm\].
    #[serde(default = "not_a_number")]
    pub target_torque_nm: f64,
    /// Sampling grid of the window, before thinning, in the segment's time.
    pub time_base: TimeBase,
    /// Samples of the window, before thinning.
    pub samples: usize,
    /// Every how many-th sample was written: 1 for all.
    pub stored_every: usize,
    /// Sample of the window, before thinning, at which the pulse begins.
    pub onset: Option<usize>,
    /// Names of the measured channels that are there; the others are NaN in the samples.
    pub channels: Vec<String>,
    /// Noise of the fitted output, which only the quiet part before the window shows.
    #[serde(default, deserialize_with = "lenient")]
    pub noise: Option<NoiseFloor>,
    /// What was measured in the quiet part and taken out; the samples are corrected.
    #[serde(default, deserialize_with = "lenient")]
    pub corrections: Vec<Correction>,
}

/// JSON has no NaN: what was not finite is missing in the message.
fn not_a_number() -> f64 {
    f64::NAN
}

/// A part with a number missing (it was not finite) counts as absent; the samples are worth more than it.
fn lenient<'de, D: Deserializer<'de>, T: DeserializeOwned + Default>(
    deserializer: D,
) -> Result<T, D::Error> {
    let value = serde_json::Value::deserialize(deserializer)?;
    Ok(serde_json::from_value(value).unwrap_or_default())
}

impl Window {
    /// Samples of the window that were written.
    pub fn stored_samples(&self) -> usize {
        self.samples.div_ceil(self.stored_every.max(1))
    }

    /// The grid of the written samples, in the segment's time.
    pub fn stored_time_base(&self) -> TimeBase {
        TimeBase {
            start_s: self.time_base.start_s,
            interval_s: self.time_base.interval_s * self.stored_every as f64,
        }
    }
}

pub(crate) const CONDITIONS: &[Field] = &[
    text("participant", "Who held the tool"),
    text("strategy", "Tightening strategy"),
    text("joint", "Joint stiffness"),
    number("pace_per_min", "1/min", "Tightenings per minute"),
];

const RIG: &[Field] = &[
    number("lever_arm_m", "m", "Joint axis to grip l"),
    number(
        "known_inertia_kg_m2",
        "kg m^2",
        "Known inertia about the joint I_n",
    ),
];

pub(crate) const TIME_BASE: &[Field] = &[
    number("start_s", "s", "Time of sample 0"),
    number("interval_s", "s", "Time between samples"),
];

const NOISE: &[Field] = &[
    text("source", "Where the noise was measured"),
    text("quantity", "Quantity it is the noise of"),
    number("standard_deviation", "the quantity's", "Standard deviation"),
    list(pure_number(
        "autoregression",
        "Coefficients a_1 to a_p of the noise process",
    )),
    number(
        "innovation_sd",
        "the quantity's",
        "Standard deviation of the white innovations",
    ),
    count("samples", "Samples it was estimated from"),
];

const CORRECTION: &[Field] = &[
    text("effect", "Effect of the catalogue"),
    number("value", "see unit", "Size that was subtracted"),
    number("standard_error", "see unit", "Its standard error"),
    text("unit", "Unit of the size"),
    flag("significant", "Differs from zero beyond chance"),
    text(
        "constant_of",
        "Measured quantity of which it is a constant error",
    ),
];

/// The message's table.
pub(crate) const WINDOW: Message = Message {
    name: "snug.Window",
    about: "Where the samples of a tightening come from",
    fields: &[
        count("tightening", "Running number within the recording"),
        text("file", "Measurement file"),
        count("number", "Number within the file"),
        number(
            "started_at_s",
            "s",
            "When the segment began, on the clock of its file's events",
        ),
        group("conditions", CONDITIONS, "Conditions"),
        group("rig", RIG, "Known constants of the rig"),
        number("peak_torque_nm", "N m", "Largest torque"),
        number("target_torque_nm", "N m", "Largest torque rounded to 5 N m"),
        group(
            "time_base",
            TIME_BASE,
            "Sampling grid in the segment's time",
        ),
        count("samples", "Samples of the window"),
        count("stored_every", "Every how many-th sample was written"),
        count("onset", "Sample at which the pulse begins"),
        list(text("channels", "Measured channels that are there")),
        group("noise", NOISE, "Noise of the fitted output"),
        list(group("corrections", CORRECTION, "Sensor errors taken out")),
    ],
};
