//! A measurement file in SI units, nothing repaired: what ingest hands to preprocessing.

use crate::measurement::conditions::Conditions;
use crate::measurement::motion::Motion;
use crate::measurement::time_base::TimeBase;
use serde::{Deserialize, Serialize};

/// A stretch of a recording that holds one tightening.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Segment {
    /// 1-based number within the file.
    pub number: u32,
    /// First sample.
    pub start: usize,
    /// One past the last sample the events call for; may lie beyond the recording's end (then the segment is truncated).
    pub end: usize,
    /// The events' own clock: start, torque, stop \[s\]; `None` where the file has no events.
    pub event_times_s: Option<[f64; 3]>,
}

/// One measurement file, in SI units, as it was recorded: nothing repaired, NaN where the file holds NaN.
///
/// All channels have the same length unless a finding says otherwise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recording {
    /// File name without its folder, extension included.
    pub file: String,
    /// What the file calls itself (`File_name`), or the file's stem.
    pub label: String,
    /// Conditions read from the label.
    pub conditions: Conditions,
    /// Common sampling grid.
    pub time_base: TimeBase,
    /// Input: joint torque T \[Nm\].
    pub torque_nm: Vec<f64>,
    /// Measured motion of the tool.
    pub motion: Motion,
    /// Measured grip force F_op_J \[N\].
    pub grip_force_n: Option<Vec<f64>>,
    /// Whether a grip-force channel stands in the file under any known name (it selects the tool's inertia).
    pub has_force_channel: bool,
    /// Name of the grip-force channel in its source, where it is one of the names of the thesis' layout.
    #[serde(default)]
    pub grip_force_channel: Option<String>,
    /// The tightenings' places, in file order; one segment over everything where the file has no events.
    pub segments: Vec<Segment>,
}
