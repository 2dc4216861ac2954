//! One simulated measurement file: segments back to back, under a clock of events that counts the pauses between them.

use crate::plan::CampaignPlan;
use crate::plan::file::FilePlan;
use crate::sensing::Channels;
use snug_campaign::{Conditions, Motion, Recording, Segment, TimeBase};

/// Start of the first segment in the events' clock \[s\].
const FIRST_EVENT_S: f64 = 12.5;

/// One measurement file, as its sensors had it. Every sample fits single precision exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticFile {
    /// File name, for example `TP3_QS_Soft_8_01.mat`.
    pub name: String,
    /// Its conditions and how its channels are called.
    pub plan: FilePlan,
    /// Sampling rate \[Hz\].
    pub sample_rate_hz: f64,
    /// Joint torque \[Nm\].
    pub torque_nm: Vec<f64>,
    /// Angular acceleration \[rad/s²\].
    pub acceleration_rad_per_s2: Vec<f64>,
    /// Grip force \[N\]; Quick Step only.
    pub grip_force_n: Option<Vec<f64>>,
    /// Start, torque and stop of each tightening in the events' own clock \[s\].
    pub events_s: Vec<[f64; 3]>,
}

impl SyntheticFile {
    pub(crate) fn empty(campaign: &CampaignPlan, plan: &FilePlan, number: usize) -> Self {
        Self {
            name: format!("{}_{:02}.mat", plan.label(), number + 1),
            plan: plan.clone(),
            sample_rate_hz: campaign.sample_rate_hz,
            torque_nm: Vec::new(),
            acceleration_rad_per_s2: Vec::new(),
            grip_force_n: None,
            events_s: Vec::new(),
        }
    }

    /// Puts one more segment behind the others.
    pub(crate) fn append(&mut self, channels: Channels, campaign: &CampaignPlan) {
        let kept = channels.kept;
        self.torque_nm.extend(&channels.torque_nm[..kept]);
        self.acceleration_rad_per_s2
            .extend(&channels.acceleration_rad_per_s2[..kept]);
        if let Some(force) = channels.grip_force_n {
            self.grip_force_n
                .get_or_insert_default()
                .extend(&force[..kept]);
        }
        let pause_s = 60.0 / f64::from(self.plan.pace_per_min);
        let start_s = FIRST_EVENT_S + self.events_s.len() as f64 * pause_s;
        self.events_s.push([
            start_s,
            start_s + campaign.quiet_s,
            start_s + campaign.segment_s,
        ]);
    }

    /// The file as a reader of the thesis' layout would hand it on.
    pub fn recording(&self) -> Recording {
        let mut end = 0;
        let mut segments = Vec::with_capacity(self.events_s.len());
        for (number, times) in (1..).zip(&self.events_s) {
            let start = end;
            end += ((times[2] - times[0]) * self.sample_rate_hz).round() as usize;
            segments.push(Segment {
                number,
                start,
                end,
                event_times_s: Some(*times),
            });
        }
        Recording {
            file: self.name.clone(),
            label: self.plan.label(),
            conditions: Conditions {
                participant: Some(format!("TP{}", self.plan.participant)),
                strategy: Some(self.plan.strategy_name().into()),
                joint: Some(self.plan.joint_name().into()),
                pace_per_min: Some(f64::from(self.plan.pace_per_min)),
            },
            time_base: TimeBase {
                start_s: 0.0,
                interval_s: 1.0 / self.sample_rate_hz,
            },
            torque_nm: self.torque_nm.clone(),
            motion: Motion {
                acceleration_rad_per_s2: Some(self.acceleration_rad_per_s2.clone()),
                ..Motion::default()
            },
            grip_force_n: self.grip_force_n.clone(),
            has_force_channel: self.grip_force_n.is_some(),
            grip_force_channel: self
                .grip_force_n
                .is_some()
                .then(|| self.plan.channel_names.names()[2].to_owned()),
            segments,
        }
    }
}
