//! `/tightening/window`: what a tightening's samples alone do not say, so that it can be evaluated anew.

use crate::schema::{Field, Kind, Message, field};
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
    field("participant", Kind::Text, "", "Who held the tool"),
    field("strategy", Kind::Text, "", "Tightening strategy"),
    field("joint", Kind::Text, "", "Joint stiffness"),
    field(
        "pace_per_min",
        Kind::Double,
        "1/min",
        "Tightenings per minute",
    ),
];

const RIG: &[Field] = &[
    field("lever_arm_m", Kind::Double, "m", "Joint axis to grip l"),
    field(
        "known_inertia_kg_m2",
        Kind::Double,
        "kg m^2",
        "Known inertia about the joint I_n",
    ),
];

pub(crate) const TIME_BASE: &[Field] = &[
    field("start_s", Kind::Double, "s", "Time of sample 0"),
    field("interval_s", Kind::Double, "s", "Time between samples"),
];

const NOISE: &[Field] = &[
    field("source", Kind::Text, "", "Where the noise was measured"),
    field("quantity", Kind::Text, "", "Quantity it is the noise of"),
    field(
        "standard_deviation",
        Kind::Double,
        "the quantity's",
        "Standard deviation",
    ),
    field(
        "autoregression",
        Kind::List(&Kind::Double),
        "",
        "Coefficients a_1 to a_p of the noise process",
    ),
    field(
        "innovation_sd",
        Kind::Double,
        "the quantity's",
        "Standard deviation of the white innovations",
    ),
    field("samples", Kind::Count, "", "Samples it was estimated from"),
];

const CORRECTION: &[Field] = &[
    field("effect", Kind::Text, "", "Effect of the catalogue"),
    field(
        "value",
        Kind::Double,
        "see unit",
        "Size that was subtracted",
    ),
    field(
        "standard_error",
        Kind::Double,
        "see unit",
        "Its standard error",
    ),
    field("unit", Kind::Text, "", "Unit of the size"),
    field(
        "significant",
        Kind::Flag,
        "",
        "Differs from zero beyond chance",
    ),
    field(
        "constant_of",
        Kind::Text,
        "",
        "Measured quantity of which it is a constant error",
    ),
];

/// The message's table.
pub(crate) const WINDOW: Message = Message {
    name: "snug.Window",
    about: "Where the samples of a tightening come from",
    fields: &[
        field(
            "tightening",
            Kind::Count,
            "",
            "Running number within the recording",
        ),
        field("file", Kind::Text, "", "Measurement file"),
        field("number", Kind::Count, "", "Number within the file"),
        field("conditions", Kind::Object(CONDITIONS), "", "Conditions"),
        field("rig", Kind::Object(RIG), "", "Known constants of the rig"),
        field("peak_torque_nm", Kind::Double, "N m", "Largest torque"),
        field(
            "target_torque_nm",
            Kind::Double,
            "N m",
            "Largest torque rounded to 5 N m",
        ),
        field(
            "time_base",
            Kind::Object(TIME_BASE),
            "",
            "Sampling grid in the segment's time",
        ),
        field("samples", Kind::Count, "", "Samples of the window"),
        field(
            "stored_every",
            Kind::Count,
            "",
            "Every how many-th sample was written",
        ),
        field("onset", Kind::Count, "", "Sample at which the pulse begins"),
        field(
            "channels",
            Kind::List(&Kind::Text),
            "",
            "Measured channels that are there",
        ),
        field(
            "noise",
            Kind::Object(NOISE),
            "",
            "Noise of the fitted output",
        ),
        field(
            "corrections",
            Kind::List(&Kind::Object(CORRECTION)),
            "",
            "Sensor errors taken out",
        ),
    ],
};
