//! A segment cut out of its recording: channels of one length, for the steps to change.

use crate::segment::channel::Channel;
use crate::segment::remarks::Remarks;
use snug_campaign::{Finding, Motion, Quantity, Recording, Segment};
use std::ops::Range;

/// Highest derivative first.
pub(crate) const QUANTITIES: [Quantity; 3] = [
    Quantity::Acceleration,
    Quantity::Velocity,
    Quantity::Displacement,
];

/// The signals of one segment, copied out of the recording; all of one length.
#[derive(Debug, Clone)]
pub(crate) struct Signals {
    pub(crate) torque_nm: Vec<f64>,
    pub(crate) motion: Motion,
    pub(crate) grip_force_n: Option<Vec<f64>>,
    /// Samples that the events call for and the file does not hold.
    pub(crate) missing: usize,
}

impl Signals {
    /// Copies a segment; cut short where a channel ends early.
    ///
    /// # Errors
    /// The finding that leaves the segment out: a missing channel, or no samples.
    pub(crate) fn cut(
        recording: &Recording,
        segment: &Segment,
        remarks: &mut Remarks,
    ) -> Result<Self, Finding> {
        if recording.torque_nm.is_empty() {
            let message = "the recording has no torque samples; the tightening is left out".into();
            return Err(remarks.left_out("missing_channel", Some(Channel::Torque), message));
        }
        let lengths = QUANTITIES
            .iter()
            .filter_map(|&quantity| recording.motion.get(quantity))
            .map(<[f64]>::len)
            .filter(|&length| length > 0);
        let Some(shortest_motion) = lengths.min() else {
            let message = "the recording has no samples of angle, velocity or acceleration; \
                           the tightening is left out";
            return Err(remarks.left_out("missing_channel", None, message.into()));
        };
        let available = shortest_motion.min(recording.torque_nm.len());
        let range = segment.start..segment.end.min(available);
        if range.is_empty() {
            let message = format!(
                "samples {} to {} are called for, the file holds {available}; the tightening is left out",
                segment.start, segment.end
            );
            return Err(remarks.left_out("truncated_segment", None, message));
        }
        let mut motion = Motion::default();
        for quantity in QUANTITIES {
            if let Some(samples) = recording
                .motion
                .get(quantity)
                .and_then(|s| s.get(range.clone()))
            {
                motion.set(quantity, samples.to_vec());
            }
        }
        Ok(Self {
            torque_nm: recording.torque_nm[range.clone()].to_vec(),
            motion,
            grip_force_n: grip_force(recording, range.clone(), remarks),
            missing: segment.end - range.end,
        })
    }

    /// Samples per channel.
    pub(crate) fn len(&self) -> usize {
        self.torque_nm.len()
    }

    /// The quantity that the fitted output is measured by: itself, or the nearest higher derivative.
    ///
    /// # Errors
    /// The finding that leaves the segment out when it would have to be differentiated.
    pub(crate) fn source_of(
        &self,
        fitted: Quantity,
        remarks: &Remarks,
    ) -> Result<Quantity, Finding> {
        QUANTITIES
            .into_iter()
            .rev()
            .filter(|&quantity| quantity >= fitted)
            .find(|&quantity| self.motion.get(quantity).is_some())
            .ok_or_else(|| {
                let channel = Channel::Motion(fitted);
                let message = format!(
                    "the fitted output is {0}, but neither {0} nor a derivative of it is measured, and Snug does not \
                     differentiate; the tightening is left out",
                    channel.name()
                );
                remarks.left_out("missing_channel", Some(channel), message)
            })
    }

    /// Every channel with its samples.
    pub(crate) fn channels(&self) -> impl Iterator<Item = (Channel, &[f64])> {
        let motion = QUANTITIES
            .into_iter()
            .filter_map(|quantity| Some((Channel::Motion(quantity), self.motion.get(quantity)?)));
        let force = self
            .grip_force_n
            .as_deref()
            .map(|samples| (Channel::GripForce, samples));
        std::iter::once((Channel::Torque, self.torque_nm.as_slice()))
            .chain(motion)
            .chain(force)
    }

    /// Every channel with its samples, to be changed.
    pub(crate) fn channels_mut(&mut self) -> impl Iterator<Item = (Channel, &mut Vec<f64>)> {
        let motion = [
            (
                Quantity::Acceleration,
                &mut self.motion.acceleration_rad_per_s2,
            ),
            (Quantity::Velocity, &mut self.motion.velocity_rad_per_s),
            (Quantity::Displacement, &mut self.motion.displacement_rad),
        ];
        let motion = motion
            .into_iter()
            .filter_map(|(quantity, samples)| Some((Channel::Motion(quantity), samples.as_mut()?)));
        let force = self
            .grip_force_n
            .as_mut()
            .map(|samples| (Channel::GripForce, samples));
        std::iter::once((Channel::Torque, &mut self.torque_nm))
            .chain(motion)
            .chain(force)
    }

    /// Keeps the samples of `window`, which must lie inside, and the memory of no others.
    pub(crate) fn crop(&mut self, window: &Range<usize>) {
        for (_, samples) in self.channels_mut() {
            *samples = samples[window.clone()].to_vec();
        }
    }
}

/// The grip force is only reported, so a short one costs the channel, not the tightening.
fn grip_force(
    recording: &Recording,
    range: Range<usize>,
    remarks: &mut Remarks,
) -> Option<Vec<f64>> {
    let samples = recording.grip_force_n.as_ref()?;
    let cut = samples.get(range.clone()).map(<[f64]>::to_vec);
    if cut.is_none() {
        let message = format!(
            "the grip force has {} samples, the tightening ends at {}; it is used without grip force",
            samples.len(),
            range.end
        );
        remarks.note("short_channel", Some(Channel::GripForce), message);
    }
    cut
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::tests::synthetic::{SEGMENT, recording};
    use snug_campaign::TighteningId;

    fn remarks() -> Remarks {
        Remarks::new(TighteningId {
            file: "a.mat".into(),
            number: 1,
        })
    }

    #[test]
    fn cuts_every_channel_alike() {
        let recording = recording(&[1, 2], 0.0);
        let mut signals = Signals::cut(&recording, &recording.segments[1], &mut remarks()).unwrap();
        assert_eq!(signals.torque_nm, recording.torque_nm[SEGMENT..]);
        signals.crop(&(100..103));
        for (channel, samples) in signals.channels() {
            assert_eq!(samples.len(), 3, "{channel:?}");
        }
        assert_eq!(
            signals.torque_nm,
            recording.torque_nm[SEGMENT + 100..SEGMENT + 103]
        );
    }

    #[test]
    fn does_not_differentiate() {
        let mut recording = recording(&[1], 0.0);
        recording.motion.velocity_rad_per_s = recording.motion.acceleration_rad_per_s2.take();
        let signals = Signals::cut(&recording, &recording.segments[0], &mut remarks()).unwrap();
        let source = |fitted| signals.source_of(fitted, &remarks());
        assert_eq!(source(Quantity::Displacement), Ok(Quantity::Velocity));
        assert_eq!(source(Quantity::Velocity), Ok(Quantity::Velocity));
        assert_eq!(
            source(Quantity::Acceleration).unwrap_err().code,
            "missing_channel"
        );
    }

    #[test]
    fn short_channels_are_named() {
        let mut recording = recording(&[1, 2], 0.0);
        recording.torque_nm.truncate(SEGMENT + 10);
        recording.grip_force_n.as_mut().unwrap().truncate(5);
        let mut remarks = remarks();
        let signals = Signals::cut(&recording, &recording.segments[1], &mut remarks).unwrap();
        assert_eq!((signals.len(), signals.missing), (10, SEGMENT - 10));
        assert_eq!(remarks.into_findings()[0].code, "short_channel");
    }
}
