//! What all segments of a recording share, and what every preset refuses.

use crate::quality::non_finite::{Missing, bridge};
use crate::segment::channel::Channel;
use crate::segment::remarks::Remarks;
use crate::segment::signals::Signals;
use crate::segment::window::samples;
use crate::settings::PreprocessSettings;
use snug_campaign::{Finding, Quantity, Recording, Rig, Tightening, TimeBase, target_torque_nm};
use std::ops::Range;

/// What all segments of a recording share.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Context<'a> {
    pub(crate) recording: &'a Recording,
    pub(crate) settings: &'a PreprocessSettings,
    pub(crate) fitted_output: Quantity,
    pub(crate) rig: Rig,
    pub(crate) interval_s: f64,
}

impl Context<'_> {
    /// Number of samples in `duration_s`.
    pub(crate) fn samples(&self, duration_s: f64) -> usize {
        samples(duration_s, self.interval_s)
    }

    /// A tightening from signals that are already cropped to the window starting at sample `start`.
    pub(crate) fn tightening(
        &self,
        remarks: &Remarks,
        signals: Signals,
        start: usize,
        peak_torque_nm: f64,
    ) -> Tightening {
        Tightening {
            id: remarks.id().clone(),
            conditions: self.recording.conditions.clone(),
            rig: self.rig,
            time_base: TimeBase {
                start_s: start as f64 * self.interval_s,
                interval_s: self.interval_s,
            },
            torque_nm: signals.torque_nm,
            motion: signals.motion,
            grip_force_n: signals.grip_force_n,
            peak_torque_nm,
            target_torque_nm: target_torque_nm(peak_torque_nm),
            onset: None,
            noise: None,
            corrections: Vec::new(),
        }
    }

    /// Bridges short runs of missing samples in every channel and reports them.
    pub(crate) fn bridge_missing(
        &self,
        signals: &mut Signals,
        remarks: &mut Remarks,
    ) -> Vec<(Channel, Missing)> {
        let longest = self.samples(self.settings.quality.repair_gap_s);
        let mut found = Vec::new();
        for (channel, samples) in signals.channels_mut() {
            let missing = bridge(samples, longest);
            let bridged: usize = missing.bridged.iter().map(Range::len).sum();
            if bridged > 0 {
                let message = format!(
                    "{bridged} samples of {} are not finite, in {} runs of at most {longest}; bridged by straight lines",
                    channel.name(),
                    missing.bridged.len()
                );
                remarks.repaired("missing_samples", Some(channel), message);
            }
            found.push((channel, missing));
        }
        found
    }

    /// Refuses gaps inside `needed`; a gap in the grip force costs that channel only.
    pub(crate) fn refuse_gaps(
        &self,
        missing: &[(Channel, Missing)],
        needed: &Range<usize>,
        signals: &mut Signals,
        remarks: &mut Remarks,
    ) -> Result<(), Finding> {
        for (channel, missing) in missing {
            let Some(gap) = missing.gap_in(needed) else {
                continue;
            };
            let what = format!(
                "{:.3} ms of {} without finite samples at {:.4} s, at most {:.3} ms can be bridged",
                1e3 * gap.len() as f64 * self.interval_s,
                channel.name(),
                gap.start as f64 * self.interval_s,
                1e3 * self.settings.quality.repair_gap_s
            );
            if *channel == Channel::GripForce {
                signals.grip_force_n = None;
                let message = format!("{what}; the tightening is used without grip force");
                remarks.note("gap", Some(*channel), message);
            } else {
                let message = format!("{what}; the tightening is left out");
                return Err(remarks.left_out("gap", Some(*channel), message));
            }
        }
        Ok(())
    }

    /// Refuses a window that the segment is too short for; notes one that is cut short behind the window.
    pub(crate) fn refuse_truncation(
        &self,
        window: &Range<usize>,
        signals: &Signals,
        remarks: &mut Remarks,
    ) -> Result<(), Finding> {
        let seconds = |count: usize| count as f64 * self.interval_s;
        if window.is_empty() || window.end > signals.len() {
            let message = format!(
                "the window ends {:.4} s after the segment's start, but only {:.4} s are there ({} samples missing \
                 from the file); the tightening is left out",
                seconds(window.end),
                seconds(signals.len()),
                signals.missing
            );
            return Err(remarks.left_out("truncated_segment", None, message));
        }
        if signals.missing > 0 {
            let message = format!(
                "the file ends {} samples before the segment does; the window is complete and used",
                signals.missing
            );
            remarks.note("truncated_segment", None, message);
        }
        Ok(())
    }

    /// Refuses an output that never changes.
    pub(crate) fn refuse_constant(
        &self,
        source: Quantity,
        signals: &Signals,
        remarks: &Remarks,
    ) -> Result<(), Finding> {
        let samples = signals.motion.get(source).unwrap_or_default();
        let first = samples.first().copied().unwrap_or(0.0);
        if samples.iter().any(|&sample| sample != first) {
            return Ok(());
        }
        let channel = Channel::Motion(source);
        let message = format!(
            "{} is {first} {} throughout: a dead channel; the tightening is left out",
            channel.name(),
            channel.unit()
        );
        Err(remarks.left_out("constant_channel", Some(channel), message))
    }
}
