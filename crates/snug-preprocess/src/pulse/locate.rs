//! Where the pulse lies in a segment, and where the window is put for it; refuses segments without a usable pulse.

use crate::pulse::onset::{Baseline, Pulse, onset, pulses};
use crate::quality::polarity;
use crate::segment::channel::Channel;
use crate::segment::context::Context;
use crate::segment::remarks::Remarks;
use crate::segment::signals::Signals;
use snug_campaign::Finding;
use std::ops::Range;

/// Where the pulse is.
#[derive(Debug, Clone)]
pub(crate) struct Located {
    /// First sample of the pulse.
    pub(crate) onset: usize,
    /// The pulse that the tightening is about.
    pub(crate) pulse: Pulse,
    /// Every pulse of the segment, that one included.
    pub(crate) pulses: Vec<Pulse>,
}

/// Finds the torque pulse.
///
/// # Errors
/// The finding that leaves the tightening out: no pulse, exchanged channels, inverted torque.
pub(crate) fn locate(
    context: &Context<'_>,
    signals: &Signals,
    configured: &Range<usize>,
    remarks: &Remarks,
) -> Result<Located, Finding> {
    let settings = &context.settings.onset;
    let rest = configured
        .start
        .saturating_sub(context.samples(context.settings.quiet.guard_s));
    let baseline = Baseline::of(&signals.torque_nm, rest);
    refuse_no_pulse(context, signals, baseline, remarks)?;
    refuse_wrong_polarity(signals, rest, remarks)?;
    let pulses = pulses(&signals.torque_nm, baseline, settings);
    let in_window = pulses.iter().find(|pulse| configured.contains(&pulse.peak));
    let highest = pulses
        .iter()
        .max_by(|a, b| signals.torque_nm[a.peak].total_cmp(&signals.torque_nm[b.peak]));
    let Some(pulse) = in_window.or(highest).cloned() else {
        return Err(no_pulse(0.0, context, remarks));
    };
    let hold = context.samples(settings.hold_s);
    let onset = onset(&signals.torque_nm, baseline, &pulse, settings, hold);
    Ok(Located {
        onset,
        pulse,
        pulses,
    })
}

fn refuse_no_pulse(
    context: &Context<'_>,
    signals: &Signals,
    baseline: Baseline,
    remarks: &Remarks,
) -> Result<(), Finding> {
    let height = signals
        .torque_nm
        .iter()
        .map(|torque| (torque - baseline.level_nm).abs())
        .fold(0.0, f64::max);
    let least = (context.settings.onset.threshold_sd * baseline.sd_nm)
        .max(context.settings.quality.minimum_pulse_nm);
    // Not `height < least`: a height of 0 is no pulse even where no minimum is set.
    if height > 0.0 && height >= least {
        Ok(())
    } else {
        Err(no_pulse(height, context, remarks))
    }
}

fn no_pulse(height_nm: f64, context: &Context<'_>, remarks: &Remarks) -> Finding {
    let message = format!(
        "the torque leaves its level at rest by {height_nm:.3} Nm at most, a pulse has at least {} Nm and stands out of \
         the noise; the tightening is left out",
        context.settings.quality.minimum_pulse_nm
    );
    remarks.left_out("no_pulse", Some(Channel::Torque), message)
}

/// Refuses exchanged channels and a torque of the wrong sign, judged from `rest` on.
fn refuse_wrong_polarity(signals: &Signals, rest: usize, remarks: &Remarks) -> Result<(), Finding> {
    let less_rest = |samples: &[f64]| -> Vec<f64> {
        let level = Baseline::of(samples, rest).level_nm;
        samples
            .iter()
            .skip(rest)
            .map(|sample| sample - level)
            .collect()
    };
    let torque = less_rest(&signals.torque_nm);
    if let Some(acceleration) = &signals.motion.acceleration_rad_per_s2
        && let Some((torque, acceleration)) = polarity::swapped(&torque, &less_rest(acceleration))
    {
        let message = format!(
            "torque and acceleration look exchanged: the torque swings both ways ({:.0} % one-sided), the acceleration \
             has one sign ({:.0} %); the tightening is left out",
            100.0 * torque,
            100.0 * acceleration
        );
        return Err(remarks.left_out("swapped_channels", Some(Channel::Torque), message));
    }
    if polarity::inverted_torque(&torque) {
        let lowest = torque.iter().copied().fold(0.0, f64::min);
        let message =
            format!("the torque pulse is negative ({lowest:.2} Nm); the tightening is left out");
        return Err(remarks.left_out("inverted_torque", Some(Channel::Torque), message));
    }
    Ok(())
}

/// Puts the window: as configured, or `lead_s` before the onset when the onset lies before the window or in its second
/// half, the peak lies behind it, or the pulse's end is cut off and would not be.
///
/// # Errors
/// The finding that leaves the tightening out because the segment ends inside the window.
pub(crate) fn place(
    context: &Context<'_>,
    signals: &Signals,
    located: &Located,
    configured: &Range<usize>,
    remarks: &mut Remarks,
) -> Result<Range<usize>, Finding> {
    let lead = context.samples(context.settings.onset.lead_s);
    let before_onset = located.onset.saturating_sub(lead);
    let moved = before_onset..before_onset + configured.len();
    let pulse = &located.pulse;
    // Where a rise began is known to the time that the torque must rest before it.
    let hold = context.samples(context.settings.onset.hold_s);
    let too_early = located.onset + hold < configured.start;
    let cut_off = pulse.range.end > configured.end && pulse.range.end <= moved.end;
    let late = located.onset > configured.start + configured.len() / 2;
    let too_late =
        moved.start > configured.start && (late || cut_off || pulse.peak >= configured.end);
    let window = if too_early || too_late {
        moved
    } else {
        configured.clone()
    };
    context.refuse_truncation(&window, signals, remarks)?;
    let milliseconds =
        |from: usize, to: usize| 1e3 * (to as f64 - from as f64) * context.interval_s;
    if window != *configured {
        let message = format!(
            "the pulse begins {:.1} ms and peaks {:.1} ms after the configured window's start; the window is moved by \
             {:+.1} ms",
            milliseconds(configured.start, located.onset),
            milliseconds(configured.start, pulse.peak),
            milliseconds(configured.start, window.start)
        );
        remarks.note("window_moved", Some(Channel::Torque), message);
    }
    if pulse.range.end > window.end {
        let message = format!(
            "the pulse ends {:.1} ms behind the window",
            milliseconds(window.end, pulse.range.end)
        );
        remarks.note("pulse_exceeds_window", Some(Channel::Torque), message);
    }
    Ok(window)
}
