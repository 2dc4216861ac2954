//! Preset `snug`: what the quiet part tells about the sensors is taken out before the fit.
//!
//! 1. Missing samples are bridged, spikes repaired.
//! 2. The torque pulse and its onset are found; the window is moved if the pulse lies outside.
//! 3. Bias of every channel from the quiet part, with its standard error under the coloured noise; subtracted always,
//!    reported as significant only beyond chance. The torque only if it is at rest there.
//! 4. Noise floor from the quiet part.
//! 5. Rest at the window's start: ω = θ = 0 there, integrated by trapezoids.
//! 6. Faults in the window that keep the tightening out of the statistics.

use crate::faults;
use crate::faults::Window;
use crate::prepared::Prepared;
use crate::pulse::locate::{Located, locate, place};
use crate::quality::free_flight::FreeFlight;
use crate::quality::non_finite::Missing;
use crate::quality::spikes;
use crate::quiet;
use crate::quiet::measurement::{QuietMeasurement, measure};
use crate::segment::channel::Channel;
use crate::segment::context::Context;
use crate::segment::integration::complete;
use crate::segment::peak_torque::peak_torque_nm;
use crate::segment::remarks::Remarks;
use crate::segment::signals::Signals;
use snug_campaign::{Finding, Quantity, Segment};
use std::ops::Range;

/// Prepares one segment; `start_s` and `length_s` are the window's.
pub(crate) fn prepare(
    context: &Context<'_>,
    (start_s, length_s): (f64, f64),
    segment: &Segment,
    remarks: &mut Remarks,
) -> Result<Prepared, Finding> {
    let mut signals = Signals::cut(context.recording, segment, remarks)?;
    let source = signals.source_of(context.fitted_output, remarks)?;
    let missing = context.bridge_missing(&mut signals, remarks);
    let all = 0..signals.len();
    if missing
        .iter()
        .any(|(_, missing)| missing.gaps.first() == Some(&all))
    {
        context.refuse_gaps(&missing, &all, &mut signals, remarks)?;
    }
    context.refuse_constant(source, &signals, remarks)?;
    let spikes = repair_spikes(context, &mut signals, remarks);
    let configured = crate::segment::window::snug(start_s, length_s, context.interval_s);
    let located = locate(context, &signals, &configured, remarks)?;
    let range = place(context, &signals, &located, &configured, remarks)?;
    context.refuse_gaps(&missing, &range, &mut signals, remarks)?;
    let quiet = quiet_part(context, &missing, &range, &located, remarks);
    let measured = match &quiet {
        Some(quiet) => measure(context, &mut signals, quiet, source, remarks),
        None => QuietMeasurement::default(),
    };
    let bridged: usize = missing
        .iter()
        .map(|(_, missing)| missing.bridged_in(&range))
        .sum();
    let mended = spikes.iter().filter(|spike| range.contains(&spike.start));
    let window = Window {
        range: &range,
        located: &located,
        repaired: bridged + mended.map(Range::len).sum::<usize>(),
        noise: measured.source_noise.as_ref(),
    };
    faults::report(context, &signals, &window, remarks);
    let peak = peak_torque_nm(&signals.torque_nm);
    signals.crop(&range);
    complete(&mut signals.motion, context.interval_s);
    let mut tightening = context.tightening(remarks, signals, range.start, peak);
    tightening.onset = Some(located.onset.saturating_sub(range.start));
    tightening.noise = (measured.source_noise).map(|noise| noise.floor(source));
    tightening.corrections = measured.corrections;
    Ok(Prepared {
        tightening,
        thesis_checks: None,
        zero_sample: None,
        data_quality_rejects: remarks.rejects(),
    })
}

/// Mends spikes in every channel, reports and returns them. What the tool's free flight through a gap explains stays.
fn repair_spikes(
    context: &Context<'_>,
    signals: &mut Signals,
    remarks: &mut Remarks,
) -> Vec<Range<usize>> {
    let flight = FreeFlight::new(&signals.torque_nm, context.rig);
    let mut flown: Vec<Range<usize>> = Vec::new();
    let mut mended = Vec::new();
    for (channel, samples) in signals.channels_mut() {
        let spikes = spikes::repair(
            samples,
            context.settings.quality.spike_sd,
            |index, level, value, tolerance| match channel {
                Channel::Motion(Quantity::Acceleration) => {
                    flight.explains(index, level, value, tolerance)
                }
                // The hand's force drops while the tool flies.
                Channel::GripForce => flown.iter().any(|flown| flown.contains(&index)),
                _ => false,
            },
        );
        let told = |some: &[Range<usize>]| spikes::told(some, channel, context.interval_s);
        if let Some(spikes) = told(&spikes.mended) {
            let message = format!("spikes: {spikes}; bridged by straight lines");
            remarks.repaired("spikes", Some(channel), message);
        }
        if let Some(drops) = told(&spikes.explained) {
            let message = format!(
                "drops of the hand's force: {drops}; left as they are, for so the tool moves through a small gap in the grip"
            );
            remarks.note("free_flight", Some(channel), message);
        }
        flown.extend(spikes.explained);
        mended.extend(spikes.mended);
    }
    mended
}

/// The quiet part, or a note that it is too short to be measured.
fn quiet_part(
    context: &Context<'_>,
    missing: &[(Channel, Missing)],
    window: &Range<usize>,
    located: &Located,
    remarks: &mut Remarks,
) -> Option<Range<usize>> {
    let settings = &context.settings.quiet;
    let after_gap = missing
        .iter()
        .flat_map(|(_, missing)| &missing.gaps)
        .map(|gap| gap.end)
        .filter(|&end| end <= window.start)
        .max()
        .unwrap_or(0);
    let part = quiet::part(
        after_gap,
        window.start,
        located.onset,
        context.samples(settings.guard_s),
        context.samples(settings.minimum_s),
    );
    if part.is_none() {
        let message = format!(
            "less than {} s of quiet before the onset at {:.4} s: bias and noise are not measured, nothing is corrected",
            settings.minimum_s,
            located.onset as f64 * context.interval_s
        );
        remarks.note("short_quiet_part", None, message);
    }
    part
}
