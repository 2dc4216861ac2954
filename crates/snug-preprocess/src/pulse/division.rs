//! A recording without events, divided at its torque pulses.

use crate::pulse::onset::{Baseline, onset, pulses};
use crate::segment::context::Context;
use snug_campaign::{Recording, Segment};

/// The tightenings' places: the recording's own segments, or, where it is one segment without events, one for every pulse
/// that has at least `start_s` (the window's start) of quiet before it.
///
/// A segment ends where the next begins, so that no sample is lost. A pulse with less quiet before it stays in the segment
/// of the pulse it follows.
pub(crate) fn segments(context: &Context<'_>, start_s: f64) -> Vec<Segment> {
    let recording = context.recording;
    let starts = match recording.segments.as_slice() {
        [one] if is_undivided(one, recording) => starts(context, start_s, one),
        own => return own.to_vec(),
    };
    let end = recording.segments[0].end;
    let ends = starts.iter().skip(1).copied().chain([end]);
    (1..)
        .zip(starts.iter().zip(ends))
        .map(|(number, (&start, end))| Segment {
            number,
            start,
            end,
            event_times_s: None,
        })
        .collect()
}

/// One segment over everything that no event and no range of a study asked for.
fn is_undivided(segment: &Segment, recording: &Recording) -> bool {
    segment.event_times_s.is_none()
        && segment.start == 0
        && segment.end >= recording.torque_nm.len()
}

/// First sample of every tightening; the first one begins with the recording.
fn starts(context: &Context<'_>, start_s: f64, whole: &Segment) -> Vec<usize> {
    let settings = &context.settings.onset;
    let torque_nm = without_gaps(&context.recording.torque_nm);
    let baseline = Baseline::of(&torque_nm, torque_nm.len());
    let quiet = context.samples(start_s);
    let before = quiet + context.samples(settings.lead_s);
    let hold = context.samples(settings.hold_s);
    let height_nm = torque_nm.iter().copied().fold(0.0, f64::max) - baseline.level_nm;
    let mut starts = vec![whole.start];
    if height_nm < context.settings.quality.minimum_pulse_nm {
        return starts;
    }
    let pulses = pulses(&torque_nm, baseline, settings);
    for pair in pulses.windows(2) {
        let begins = onset(&torque_nm, baseline, &pair[1], settings, hold);
        let rested = pair[0].range.end;
        if begins >= rested + quiet {
            starts.push(begins.saturating_sub(before).max(rested));
        }
    }
    starts
}

/// The torque with its last finite value in place of what is not finite: a gap makes no pulse.
fn without_gaps(torque_nm: &[f64]) -> Vec<f64> {
    let mut last = 0.0;
    torque_nm
        .iter()
        .map(|&torque| {
            if torque.is_finite() {
                last = torque;
            }
            last
        })
        .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use crate::prepared::Preprocessed;
    use crate::settings::Preset;
    use crate::tests::synthetic::{ONSET, PEAK, SEGMENT, prepared, recording};
    use snug_campaign::Recording;

    fn codes(result: &Preprocessed) -> Vec<&str> {
        result.findings.iter().map(|f| f.code.as_str()).collect()
    }

    /// A file without events: everything is one segment.
    fn without_events(seeds: &[u64]) -> Recording {
        let mut recording = recording(seeds, 0.0);
        recording.segments.truncate(1);
        recording.segments[0].end = recording.torque_nm.len();
        recording
    }

    #[test]
    fn pulses_of_a_file_without_events_are_tightenings() {
        let recording = without_events(&[11, 12, 13]);
        let result = prepared(&recording, Preset::Snug);
        assert_eq!(codes(&result), ["divided_by_pulses"]);
        assert_eq!(result.tightenings.len(), 3);
        assert_eq!(result.segments[2].end, recording.torque_nm.len());
        for (index, prepared) in result.tightenings.iter().enumerate() {
            let tightening = &prepared.tightening;
            assert_eq!(tightening.id.number as usize, index + 1);
            assert_eq!(prepared.rejections(), vec![]);
            // The pulse is where it was made, counted from the file's start, and its quiet part was measured.
            let first = result.segments[index].start as f64 * 1e-4 + tightening.time_base.start_s;
            let begins = (first * 1e4).round() as usize + tightening.onset.unwrap();
            assert!(begins.abs_diff(index * SEGMENT + ONSET) < 10, "{begins}");
            assert!(tightening.noise.as_ref().unwrap().samples > 14_000);
        }
        assert_eq!(prepared(&recording, Preset::Thesis).tightenings.len(), 1);
    }

    #[test]
    fn a_pulse_without_quiet_of_its_own_stays_a_finding() {
        let mut recording = without_events(&[11, 12]);
        // A third pulse 1 s after the second one's end.
        let second_end = SEGMENT + PEAK + 120;
        recording.torque_nm.extend(vec![0.0; 10_000]);
        let motion = &mut recording.motion;
        let acceleration = motion.acceleration_rad_per_s2.as_mut().unwrap();
        acceleration.extend(vec![0.0; 10_000]);
        recording.grip_force_n = None;
        recording.segments[0].end = recording.torque_nm.len();
        recording.torque_nm[second_end + 10_000..second_end + 10_400]
            .iter_mut()
            .for_each(|torque| *torque += 20.0);
        let result = prepared(&recording, Preset::Snug);
        assert_eq!(result.tightenings.len(), 2);
        assert_eq!(codes(&result), ["divided_by_pulses", "second_pulse"]);
        assert_eq!(result.findings[1].tightening, Some(2));
    }

    #[test]
    fn segments_that_events_name_are_not_divided() {
        let mut recording = without_events(&[11, 12]);
        recording.segments[0].event_times_s = Some([0.0, 1.48, 4.0]);
        let result = prepared(&recording, Preset::Snug);
        assert_eq!(result.tightenings.len(), 1);
        assert!(codes(&result).contains(&"second_pulse"));
    }
}
