//! The faults inside the window that keep a tightening out of the statistics, although it can be fitted.

use crate::noise::autoregression::Autoregression;
use crate::pulse::locate::Located;
use crate::quality::{polarity, saturation, stuck};
use crate::segment::channel::Channel;
use crate::segment::context::Context;
use crate::segment::remarks::Remarks;
use crate::segment::signals::Signals;
use snug_campaign::Quantity;
use std::ops::Range;

/// Standard deviations by which the tool must move against the torque before its sign is doubted.
const INVERTED_SD: f64 = 5.0;

/// The window as the fault checks see it.
#[derive(Debug)]
pub(crate) struct Window<'a> {
    pub(crate) range: &'a Range<usize>,
    pub(crate) located: &'a Located,
    /// Samples inside it that were bridged or mended.
    pub(crate) repaired: usize,
    /// Noise of the channel that the fitted output comes from.
    pub(crate) noise: Option<&'a Autoregression>,
}

/// Reports every fault that keeps a fittable tightening out of the statistics.
pub(crate) fn report(
    context: &Context<'_>,
    signals: &Signals,
    window: &Window<'_>,
    remarks: &mut Remarks,
) {
    frozen_or_limited(context, signals, window.range, remarks);
    double_hit(context, window, remarks);
    inverted_acceleration(context, signals, window, remarks);
    let share = window.repaired as f64 / window.range.len() as f64;
    if share > context.settings.quality.repaired_ratio {
        let message = format!(
            "{} samples of the window's {} were repaired, {:.1} % are allowed; the tightening is rejected",
            window.repaired,
            window.range.len(),
            100.0 * context.settings.quality.repaired_ratio
        );
        remarks.reject("repaired_too_much", None, message);
    }
}

/// Saturation and dropouts, channel by channel; the grip force does not enter the model and is only noted.
fn frozen_or_limited(
    context: &Context<'_>,
    signals: &Signals,
    range: &Range<usize>,
    remarks: &mut Remarks,
) {
    let quality = &context.settings.quality;
    for (channel, samples) in signals.channels() {
        let limit = saturation::find(&samples[range.clone()], quality.saturated_samples);
        if let Some(limit) = &limit {
            let levels: Vec<String> = (limit.levels.iter())
                .map(|level| format!("{level:.3}"))
                .collect();
            let what = format!(
                "{} stays at its {} {} {} for {} samples, {} in a row",
                channel.name(),
                if levels.len() == 1 { "limit" } else { "limits" },
                levels.join(" and "),
                channel.unit(),
                limit.samples,
                limit.longest_run
            );
            hold_against("saturation", channel, what, remarks);
        }
        // With the quiet part, so that a channel without noise is known for what it is.
        let shortest = context.samples(quality.stuck_s);
        let mut runs = stuck::find(
            &samples[..range.end],
            shortest,
            limit.as_ref().map_or(&[][..], |limit| &limit.levels),
        );
        runs.retain(|run| run.end > range.start);
        if let Some(what) = stuck::told(&runs, channel, context.interval_s) {
            hold_against("dropout", channel, what, remarks);
        }
    }
}

fn hold_against(code: &str, channel: Channel, what: String, remarks: &mut Remarks) {
    if channel == Channel::GripForce {
        let message = format!("{what}; it is not used in the fit");
        remarks.note(code, Some(channel), message);
    } else {
        let message = format!("{what}; the tightening is rejected");
        remarks.reject(code, Some(channel), message);
    }
}

fn double_hit(context: &Context<'_>, window: &Window<'_>, remarks: &mut Remarks) {
    let pulse = &window.located.pulse;
    for other in window.located.pulses.iter().filter(|other| *other != pulse) {
        let apart = 1e3 * (other.peak as f64 - pulse.peak as f64) * context.interval_s;
        if other.range.start < window.range.end {
            let message = format!(
                "a second pulse peaks {apart:+.1} ms from the first; the tightening is rejected"
            );
            remarks.reject("double_hit", Some(Channel::Torque), message);
        } else {
            let message = format!(
                "a second pulse peaks {apart:+.1} ms from the first, behind the window: it is not evaluated"
            );
            remarks.lost("second_pulse", Some(Channel::Torque), message);
        }
    }
}

/// The tool must first move the way the torque pushes, unless the release shows that it was only in motion before.
fn inverted_acceleration(
    context: &Context<'_>,
    signals: &Signals,
    window: &Window<'_>,
    remarks: &mut Remarks,
) {
    let (Some(acceleration), Some(noise)) = (&signals.motion.acceleration_rad_per_s2, window.noise)
    else {
        return;
    };
    let rise = window.located.onset..window.located.pulse.peak;
    if rise.is_empty() {
        return;
    }
    let interval_s = context.interval_s;
    let velocity = polarity::early_velocity(&signals.torque_nm, acceleration, &rise, interval_s);
    let sd = (noise.long_run_variance() * rise.len() as f64).sqrt() * interval_s;
    let fall = polarity::fall_at_release(
        &signals.torque_nm,
        acceleration,
        rise.end,
        window.range.end,
        interval_s,
    );
    if velocity < -INVERTED_SD * sd && fall.is_none_or(|fall| fall < 0.0) {
        let message = format!(
            "the tool first moves against the torque ({velocity:.3} rad/s at half the peak torque): one of the signs is \
             wrong; the tightening is rejected"
        );
        let channel = Channel::Motion(Quantity::Acceleration);
        remarks.reject("inverted_acceleration", Some(channel), message);
    }
}
