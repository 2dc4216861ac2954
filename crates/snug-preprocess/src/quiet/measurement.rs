//! Measures noise and offset of every channel in the quiet part and takes the offsets out of the segment.

use crate::noise::autoregression::Autoregression;
use crate::quiet::bias::Offset;
use crate::quiet::{Unsteadiness, unsteadiness};
use crate::segment::channel::Channel;
use crate::segment::context::Context;
use crate::segment::remarks::Remarks;
use crate::segment::signals::Signals;
use snug_campaign::{Correction, Quantity};
use std::ops::Range;

/// What the quiet part told.
#[derive(Debug, Clone, Default)]
pub(crate) struct QuietMeasurement {
    /// What was subtracted.
    pub(crate) corrections: Vec<Correction>,
    /// Noise of the channel that the fitted output comes from.
    pub(crate) source_noise: Option<Autoregression>,
}

/// Noise below this share of the channel's largest value is rounding of a simulation, not a sensor's.
const SILENCE_RATIO: f64 = 1e-9;

/// Measures every channel in the quiet part and takes its offset out of the whole segment.
///
/// A torque that is not at rest keeps its offset: then the mean is no zero error.
pub(crate) fn measure(
    context: &Context<'_>,
    signals: &mut Signals,
    quiet: &Range<usize>,
    source: Quantity,
    remarks: &mut Remarks,
) -> QuietMeasurement {
    let settings = &context.settings.quiet;
    let mut measured = QuietMeasurement::default();
    for (channel, samples) in signals.channels_mut() {
        let part = &samples[quiet.clone()];
        let noise = Autoregression::fit(part, settings.maximum_order)
            .filter(|noise| noise.standard_deviation > SILENCE_RATIO * reach(samples));
        let restless = unsteadiness(part, settings);
        let offset = Offset::measure(part, noise.as_ref(), settings.significance);
        if let Some(restless) = &restless {
            note_unsteadiness(channel, restless, remarks);
        }
        if restless.is_none() || channel != Channel::Torque {
            offset.subtract_from(samples);
            measured.corrections.extend(offset.correction(channel));
            if channel == Channel::GripForce && offset.significant {
                let message = format!(
                    "the grip force at rest is {:.3} ± {:.3} N; it is taken as zero",
                    offset.value, offset.standard_error
                );
                remarks.repaired("grip_force_offset", Some(channel), message);
            }
        }
        if channel == Channel::Motion(source) {
            if noise.is_none() {
                let message = format!(
                    "{} does not change in the quiet part: its noise is not measured",
                    channel.name()
                );
                remarks.note("silent_quiet_part", Some(channel), message);
            }
            measured.source_noise = noise;
        }
    }
    measured
}

/// Largest absolute value.
fn reach(samples: &[f64]) -> f64 {
    samples
        .iter()
        .fold(0.0, |reach, sample| reach.max(sample.abs()))
}

fn note_unsteadiness(channel: Channel, restless: &Unsteadiness, remarks: &mut Remarks) {
    let list = |values: &[f64]| -> String {
        let values: Vec<String> = values.iter().map(|value| format!("{value:.4}")).collect();
        values.join(", ")
    };
    let consequence = if channel == Channel::Torque {
        "no torque offset is taken out"
    } else {
        "the mean is taken out all the same"
    };
    let message = format!(
        "{} is not at rest before the pulse: quarter means {} (largest deviation {:.1} standard errors), standard \
         deviations {} {}; {consequence}",
        channel.name(),
        list(&restless.means),
        restless.largest_z,
        list(&restless.deviations),
        channel.unit()
    );
    remarks.note("quiet_part_unsteady", Some(channel), message);
}
