//! Preset `thesis`: the original program, step by step.
//!
//! 1. ω and θ by cumulative trapezoids from the *segment's* start; whatever bias and noise the quiet part holds becomes
//!    drift, and ω is not zeroed.
//! 2. Window: 2999 samples at 10 kHz, one fewer than 0.3 s.
//! 3. Offset: the displacement at its first local minimum, else at 27.4 ms, is taken off the displacement alone.
//! 4. Codes 1 and 2 on the displacement (see [`crate::ThesisChecks`]).
//! 5. Target torque from the whole segment.
//! 6. The grip force is taken where it is called `F_op_J`; under another name it only chooses the tool's inertia.
//!
//! The noise of the quiet part is measured as well, for the intervals alone: nothing is corrected or weighted with it.
//!
//! Deviations, both reported: short runs of not-finite samples are bridged, and a segment too short for the window is
//! left out (the original fails later, in a plot). No data-quality verdict: the original has none.

use crate::noise::autoregression::Autoregression;
use crate::prepared::Prepared;
use crate::segment::channel::Channel;
use crate::segment::context::Context;
use crate::segment::integration::cumulative_trapezoid;
use crate::segment::peak_torque::peak_torque_nm;
use crate::segment::remarks::Remarks;
use crate::segment::signals::Signals;
use crate::segment::window;
use crate::settings::Preset;
use crate::thesis::checks::ThesisChecks;
use crate::thesis::offset::zero_index;
use snug_campaign::{Finding, NoiseFloor, Quantity, Segment};

/// Prepares one segment as the original did; `start_s` and `length_s` are the window's.
pub(crate) fn prepare(
    context: &Context<'_>,
    (start_s, length_s): (f64, f64),
    segment: &Segment,
    remarks: &mut Remarks,
) -> Result<Prepared, Finding> {
    let mut signals = Signals::cut(context.recording, segment, remarks)?;
    signals.source_of(Quantity::Acceleration, remarks)?;
    if leaves_force_out(context) {
        signals.grip_force_n = None;
    }
    let window = window::thesis(start_s, length_s, context.interval_s);
    let missing = context.bridge_missing(&mut signals, remarks);
    context.refuse_truncation(&window, &signals, remarks)?;
    context.refuse_gaps(&missing, &(0..window.end), &mut signals, remarks)?;
    let Some(acceleration) = signals.motion.acceleration_rad_per_s2.as_deref() else {
        let message = "the original needs the acceleration; the tightening is left out".into();
        let channel = Some(Channel::Motion(Quantity::Acceleration));
        return Err(remarks.left_out("missing_channel", channel, message));
    };
    let noise = noise_before(context, acceleration, window.start);
    let velocity = cumulative_trapezoid(acceleration, context.interval_s);
    let displacement = cumulative_trapezoid(&velocity, context.interval_s);
    signals.motion.velocity_rad_per_s = Some(velocity);
    signals.motion.displacement_rad = Some(displacement);
    let peak = peak_torque_nm(&signals.torque_nm);
    signals.crop(&window);
    let displacement = signals
        .motion
        .displacement_rad
        .as_deref_mut()
        .unwrap_or_default();
    let zero_sample = zero_index(displacement, context.interval_s);
    if let Some(index) = zero_sample {
        let offset = displacement[index];
        displacement.iter_mut().for_each(|value| *value -= offset);
    }
    let checks = ThesisChecks::of(displacement);
    let mut tightening = context.tightening(remarks, signals, window.start, peak);
    tightening.noise = noise;
    Ok(Prepared {
        tightening,
        thesis_checks: Some(checks),
        zero_sample,
        data_quality_rejects: false,
    })
}

/// Whether the grip force stands under a name that the original reads for its presence alone (`Data1_…`).
pub(crate) fn leaves_force_out(context: &Context<'_>) -> bool {
    let name = context.recording.grip_force_channel.as_deref();
    context.settings.preset == Preset::Thesis && name.is_some_and(|name| name != FORCE)
}

/// The one name under which the original takes the grip force.
const FORCE: &str = "F_op_J";

/// Noise floor of the acceleration before the window; `None` when there is too little of it.
fn noise_before(
    context: &Context<'_>,
    acceleration: &[f64],
    window_start: usize,
) -> Option<NoiseFloor> {
    let settings = &context.settings.quiet;
    let end = window_start.checked_sub(context.samples(settings.guard_s))?;
    let quiet = acceleration.get(..end)?;
    if quiet.len() < context.samples(settings.minimum_s) {
        return None;
    }
    let noise = Autoregression::fit(quiet, settings.maximum_order)?;
    (noise.standard_deviation > 0.0).then(|| noise.floor(Quantity::Acceleration))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use crate::settings::Preset;
    use crate::tests::synthetic::{prepared, recording};
    use snug_campaign::Severity;

    #[test]
    fn the_original_takes_the_grip_force_under_one_name_only() {
        let mut recording = recording(&[11], 0.0);
        let plain = prepared(&recording, Preset::Thesis);
        assert!(plain.tightenings[0].tightening.grip_force_n.is_some());
        recording.grip_force_channel = Some("Data1_F_op_J_FIR_Filter_OFFSET".into());
        let other = prepared(&recording, Preset::Thesis);
        let tightening = &other.tightenings[0].tightening;
        assert_eq!(tightening.grip_force_n, None);
        assert_eq!(tightening.rig.known_inertia_kg_m2, 0.275);
        assert_eq!(other.findings[0].code, "grip_force_not_taken");
        assert_eq!(other.findings.len(), 1);
        assert_eq!(other.findings[0].severity, Severity::Note);
        let snug = &prepared(&recording, Preset::Snug).tightenings[0].tightening;
        assert!(snug.grip_force_n.is_some());
    }
}
