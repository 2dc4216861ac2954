//! Window `Whole`: a segment as it was measured but for a sensor's glitches, for rigs without a quiet part.

use crate::noise::spread::extremes;
use crate::prepared::Prepared;
use crate::quality::wrapped::{Wrapped, unwrap};
use crate::quality::{catching_up, saturation, spikes, stuck, zero_jump};
use crate::segment::channel::Channel;
use crate::segment::context::Context;
use crate::segment::integration::complete;
use crate::segment::peak_torque::peak_torque_nm;
use crate::segment::remarks::Remarks;
use crate::segment::signals::Signals;
use snug_campaign::{Finding, Quantity, Segment};
use std::cell::LazyCell;
use std::ops::Range;

/// Samples to either side of a jump of the input within which the motion may jump, too. Chosen: a pendulum that is kicked turns about within
/// three samples of 300 Hz.
const KICKED: usize = 4;

/// Times that a jump of the input is larger than any other, so that a motion that jumps there only may jump with it \[–\]. Chosen.
const AS_FAR: f64 = 2.0;

/// Share of a recording's samples that may be mended \[–\]: more are no faults of a sensor that come now and then. Chosen.
const MOST_MENDED: f64 = 0.02;

/// Share of a recording's samples that may stand at the limit of a sensor \[–\]. Chosen: of a rig whose acceleration is cut off at 0.55 of its
/// peak a search took five effects, none of which was there.
const MOST_AT_LIMIT: f64 = 0.01;

/// Share of a recording's samples in which its reading may be stuck \[–\]. Chosen: of a rig whose displacement stood still for an eighth of one
/// recording a spring that gives way was told, which was not there.
const MOST_STUCK: f64 = 0.01;

/// What a rig's inertia keeps from jumping there and back.
const OF_MOTION: [Quantity; 2] = [Quantity::Displacement, Quantity::Velocity];

/// Takes every sample; nothing is zeroed, and the noise floor is left to the fit's residual.
pub(crate) fn prepare(
    context: &Context<'_>,
    segment: &Segment,
    remarks: &mut Remarks,
) -> Result<Prepared, Finding> {
    let mut signals = Signals::cut(context.recording, segment, remarks)?;
    let source = signals.source_of(context.fitted_output, remarks)?;
    let all = 0..signals.len();
    let missing = context.bridge_missing(&mut signals, remarks);
    context.refuse_gaps(&missing, &all, &mut signals, remarks)?;
    context.refuse_truncation(&all, &signals, remarks)?;
    context.refuse_constant(source, &signals, remarks)?;
    let first = signals.torque_nm[0];
    if signals.torque_nm.iter().all(|&torque| torque == first) {
        let message =
            format!("the input is {first} Nm throughout; only initial motion can excite the rig");
        remarks.note("constant_channel", Some(Channel::Torque), message);
    }
    let spike_sd = context.settings.quality.spike_sd;
    let angle_rad = signals.motion.displacement_rad.as_mut();
    let wrapped = angle_rad.and_then(|angle_rad| unwrap(angle_rad, spike_sd));
    let kicks = Kicks::of(&signals.torque_nm, spike_sd);
    mend_spikes(context, &kicks, &mut signals, remarks);
    match wrapped {
        Some(wrapped) => tell_wrapped(wrapped, remarks),
        None => tell_jumps(context, &kicks, source, &signals, remarks),
    }
    tell_dropouts(context, &kicks, source, &signals, remarks);
    tell_saturation(context, source, &signals, remarks);
    complete(&mut signals.motion, context.interval_s);
    let peak = peak_torque_nm(&signals.torque_nm);
    Ok(Prepared {
        tightening: context.tightening(remarks, signals, 0, peak),
        thesis_checks: None,
        zero_sample: None,
        data_quality_rejects: remarks.rejects(),
    })
}

/// To which samples the input jumps, in their order, and how far.
struct Kicks(Vec<(usize, f64)>);

impl Kicks {
    fn of(torque_nm: &[f64], spike_sd: f64) -> Self {
        let size = |to: usize| (torque_nm[to] - torque_nm[to - 1]).abs();
        let jumps = spikes::jumps(torque_nm, spike_sd).into_iter();
        Self(jumps.map(|to| (to, size(to))).collect())
    }

    /// Whether the motion may jump there, too.
    fn explain(&self, index: usize) -> bool {
        let next = self.0.partition_point(|(kick, _)| kick + KICKED < index);
        (self.0.get(next)).is_some_and(|(kick, _)| *kick <= index + KICKED)
    }

    /// The same of a motion that jumps nowhere else: the input jumps nowhere else as far as there.
    fn explain_alone(&self, index: usize) -> bool {
        let is_here = |kick: usize| kick.abs_diff(index) <= KICKED;
        let largest = |here: bool| {
            let those = self.0.iter().filter(|(kick, _)| is_here(*kick) == here);
            those.map(|(_, size)| *size).fold(0.0, f64::max)
        };
        largest(true) > AS_FAR * largest(false)
    }
}

/// Mends where a displacement or velocity leaves its course and comes back as no rig does that is not kicked, as long as that is seldom.
/// Nothing of an acceleration: a blow makes a spike of it.
fn mend_spikes(context: &Context<'_>, kicks: &Kicks, signals: &mut Signals, remarks: &mut Remarks) {
    let quality = &context.settings.quality;
    for quantity in OF_MOTION {
        let Some(samples) = signals.motion.get(quantity) else {
            continue;
        };
        let channel = Channel::Motion(quantity);
        let mut mended = samples.to_vec();
        let explains = |index: usize, _, _, _| kicks.explain(index);
        let spikes = spikes::repair(&mut mended, quality.spike_sd, explains).mended;
        let Some(those) = spikes::told(&spikes, channel, context.interval_s) else {
            continue;
        };
        let lost: usize = spikes.iter().map(Range::len).sum();
        if lost as f64 <= MOST_MENDED * samples.len() as f64 {
            signals.motion.set(quantity, mended);
            let message = format!("spikes: {those}; bridged by straight lines");
            remarks.repaired("spikes", Some(channel), message);
        } else {
            let message = format!(
                "spikes: {those}; too many for a sensor's faults, so that they are taken as they are"
            );
            remarks.note("spikes", Some(channel), message);
        }
    }
}

/// Says where a displacement or velocity stands still and then catches up. Nothing is mended: what it did meanwhile nobody knows. Where it is
/// what is fitted, and that takes long, the recording is kept from being judged.
fn tell_dropouts(
    context: &Context<'_>,
    kicks: &Kicks,
    source: Quantity,
    signals: &Signals,
    remarks: &mut Remarks,
) {
    let quality = &context.settings.quality;
    for quantity in OF_MOTION {
        let Some(samples) = signals.motion.get(quantity) else {
            continue;
        };
        let channel = Channel::Motion(quantity);
        let shortest = context.samples(quality.stuck_s);
        let held = catching_up::find(samples, shortest, quality.spike_sd);
        let Some(repeats) = stuck::told(&held, channel, context.interval_s) else {
            continue;
        };
        let what = format!("{repeats} and then jumps, as where a logger drops out");
        // A motor that rests has a speed, 0, and sets out at once where it is driven.
        let may_rest = |held: &Range<usize>| {
            quantity == Quantity::Velocity && samples[held.start] == 0.0 || kicks.explain(held.end)
        };
        let stuck = held.iter().filter(|held| !may_rest(held));
        let lost = stuck.map(Range::len).sum::<usize>() as f64 / samples.len() as f64;
        if quantity == source && lost > MOST_STUCK {
            let advice = "leave that out of its file, or cut the file in two there";
            keep_out("dropout", channel, &what, advice, remarks);
        } else {
            let message = format!("{what}; it is taken as it is, and no model follows it there");
            remarks.note("dropout", Some(channel), message);
        }
    }
}

/// Says where an acceleration ends at the limit of its sensor; where it is what is fitted, and does so often, that keeps the recording from
/// being judged. A displacement or velocity may rest at its largest value: at a stop, or as fast as a motor turns.
fn tell_saturation(
    context: &Context<'_>,
    source: Quantity,
    signals: &Signals,
    remarks: &mut Remarks,
) {
    let Some(samples) = &signals.motion.acceleration_rad_per_s2 else {
        return;
    };
    let Some(limit) = saturation::find(samples, context.settings.quality.saturated_samples) else {
        return;
    };
    let channel = Channel::Motion(Quantity::Acceleration);
    let what = format!(
        "{} stays at its largest or smallest value for {} of {} samples, {} in a row, as a sensor does at the end of its range",
        channel.name(),
        limit.samples,
        samples.len(),
        limit.longest_run
    );
    let share = limit.samples as f64 / samples.len() as f64;
    if source == Quantity::Acceleration && share > MOST_AT_LIMIT {
        let advice = "measure in a wider range, or drive the rig less";
        keep_out("saturation", channel, &what, advice, remarks);
    } else {
        let message = format!("{what}; it is taken as it is");
        remarks.note("saturation", Some(channel), message);
    }
}

/// Says where a displacement jumps and stays; where it is what is fitted, that keeps the recording from being judged.
fn tell_jumps(
    context: &Context<'_>,
    kicks: &Kicks,
    source: Quantity,
    signals: &Signals,
    remarks: &mut Remarks,
) {
    let Some(samples) = &signals.motion.displacement_rad else {
        return;
    };
    let quality = &context.settings.quality;
    // Where it stood still and catches up, that is told. Few recordings jump: it is looked for where one does.
    let shortest = context.samples(quality.stuck_s);
    let held = LazyCell::new(|| catching_up::find(samples, shortest, quality.spike_sd));
    let catches_up = |index: usize| held.iter().any(|held| index.abs_diff(held.end) <= 1);
    let is_explained = |index: usize| kicks.explain_alone(index) || catches_up(index);
    let jumps = zero_jump::find(samples, quality.spike_sd, is_explained);
    if jumps.is_empty() {
        return;
    }
    let [lowest, highest] = extremes(samples);
    let told = jumps.iter().map(|&to| {
        let share = (samples[to] - samples[to - 1]).abs() / (highest - lowest);
        let at_s = to as f64 * context.interval_s;
        format!("at {at_s:.4} s by {:.1} % of its range", 100.0 * share)
    });
    let told: Vec<String> = told.collect();
    let channel = Channel::Motion(Quantity::Displacement);
    let what = format!(
        "{} jumps within one sample {} and stays there, which the input does not explain: a zero that was set anew, lost counts, or something that \
         slipped",
        channel.name(),
        told.join(" and ")
    );
    if source == Quantity::Displacement {
        keep_out(
            "zero_jump",
            channel,
            &what,
            "cut its file in two there",
            remarks,
        );
    } else {
        let message = format!("{what}; it is taken as it is");
        remarks.note("zero_jump", Some(channel), message);
    }
}

/// Keeps a recording from being judged for `what` no model follows.
fn keep_out(code: &str, channel: Channel, what: &str, advice: &str, remarks: &mut Remarks) {
    let message = format!(
        "{what}: no model follows it there, and the recording is kept out of what is compared and counted; {advice}"
    );
    remarks.reject(code, Some(channel), message);
}

/// Says that an angle begins anew again and again.
fn tell_wrapped(wrapped: Wrapped, remarks: &mut Remarks) {
    let Wrapped {
        times,
        period_rad,
        is_turn,
    } = wrapped;
    let channel = Some(Channel::Motion(Quantity::Displacement));
    match is_turn {
        true => {
            let message = format!(
                "the angle begins anew after every turn, {times} times; its turns are put together"
            );
            remarks.repaired("wrapped_angle", channel, message);
        }
        false => {
            let message = format!(
                "the angle jumps {times} times by about {period_rad:.4} rad and goes on from there, as a counter does that runs over; it is taken \
                 as it is"
            );
            remarks.note("wrapped_angle", channel, message);
        }
    }
}

#[cfg(test)]
mod tests;
