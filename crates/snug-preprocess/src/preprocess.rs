//! The crate's way in: divides a recording, prepares every segment by the preset, and collects what was found.

use crate::error::PreprocessError;
use crate::prepared::Preprocessed;
use crate::presets::{snug, thesis, whole};
use crate::pulse::division;
use crate::segment::context::Context;
use crate::segment::remarks::Remarks;
use crate::settings::{PreprocessSettings, Preset, Window};
use snug_campaign::{Finding, Quantity, Recording, Segment, Severity, TighteningId};

/// Shortest sampling interval \[s\]: with a shorter one sample counts have no meaning. Chosen.
const SHORTEST_INTERVAL_S: f64 = 1e-9;
/// Longest sampling interval \[s\], eleven days: with a longer one neither. Chosen.
const LONGEST_INTERVAL_S: f64 = 1e6;

/// Turns one recording into tightenings.
///
/// `fitted_output` is the quantity that will be fitted: it, or a derivative of it, must be measured, and the noise floor
/// is that of the measured one.
///
/// # Errors
/// A setting that is not allowed. Faults of the data are findings of the result.
pub fn preprocess(
    recording: &Recording,
    settings: &PreprocessSettings,
    fitted_output: Quantity,
) -> Result<Preprocessed, PreprocessError> {
    settings.check()?;
    let mut result = Preprocessed::default();
    if recording.segments.is_empty() {
        let message = "the recording has no segments; nothing can be cut".to_owned();
        let finding = file_finding(recording, Severity::LeftOut, "no_segments", message);
        result.findings.push(finding);
    }
    let context = Context {
        recording,
        settings,
        fitted_output,
        rig: settings.rig.rig(recording),
        interval_s: recording.time_base.interval_s,
    };
    let division = match (settings.window, settings.preset) {
        (Window::Pulse { start_s, .. }, Preset::Snug) => division::segments(&context, start_s),
        _ => recording.segments.clone(),
    };
    result.findings.extend(divided(recording, &division));
    result.findings.extend(force_left_out(&context));
    for segment in &division {
        let mut remarks = Remarks::new(TighteningId {
            file: recording.file.clone(),
            number: segment.number,
        });
        let prepared = refuse_bad_interval(&context, &remarks).and_then(|()| {
            match (settings.window, settings.preset) {
                (Window::Whole, _) => whole::prepare(&context, segment, &mut remarks),
                (Window::Pulse { start_s, length_s }, Preset::Snug) => {
                    snug::prepare(&context, (start_s, length_s), segment, &mut remarks)
                }
                (Window::Pulse { start_s, length_s }, Preset::Thesis) => {
                    thesis::prepare(&context, (start_s, length_s), segment, &mut remarks)
                }
            }
        });
        result.findings.extend(remarks.into_findings());
        match prepared {
            Ok(mut prepared) => {
                if let Some(stretch) = settings.stretch {
                    stretch.end(&mut prepared);
                }
                result.tightenings.push(prepared);
            }
            Err(finding) => result.findings.push(finding),
        }
    }
    result.segments = division;
    result.findings.extend(goes_up(recording, &result));
    tracing::debug!(
        file = %recording.file,
        preset = settings.preset.name(),
        segments = recording.segments.len(),
        tightenings = result.tightenings.len(),
        findings = result.findings.len(),
        "preprocessed"
    );
    Ok(result)
}

fn refuse_bad_interval(context: &Context<'_>, remarks: &Remarks) -> Result<(), Finding> {
    let interval_s = context.interval_s;
    if (SHORTEST_INTERVAL_S..=LONGEST_INTERVAL_S).contains(&interval_s) {
        return Ok(());
    }
    let message = format!(
        "the sampling interval is {interval_s} s, it must lie between 1e-9 and 1e6 s; the tightening is left out"
    );
    Err(remarks.left_out("bad_sample_interval", None, message))
}

/// Says that a recording without events was divided.
fn divided(recording: &Recording, division: &[Segment]) -> Option<Finding> {
    (division.len() > recording.segments.len()).then(|| {
        let message = format!(
            "the file has no events; its {} torque pulses with a quiet part of their own before them are taken as one \
             tightening each",
            division.len()
        );
        file_finding(recording, Severity::Note, "divided_by_pulses", message)
    })
}

/// The original takes the grip force of files that call it `F_op_J` only.
fn force_left_out(context: &Context<'_>) -> Option<Finding> {
    let recording = context.recording;
    let name = recording.grip_force_channel.as_deref()?;
    (thesis::leaves_force_out(context) && recording.grip_force_n.is_some()).then(|| Finding {
        channel: Some(name.to_owned()),
        ..file_finding(
            recording,
            Severity::Note,
            "grip_force_not_taken",
            format!(
                "the measured grip force {name} is not reported: as in the original program, it chooses the tool's \
                 inertia, but only a channel called F_op_J counts as measured force"
            ),
        )
    })
}

/// The original's overwritten code 1, once per file: how many tightenings it would have rejected.
fn goes_up(recording: &Recording, result: &Preprocessed) -> Option<Finding> {
    let checks = result
        .tightenings
        .iter()
        .filter_map(|prepared| prepared.thesis_checks);
    let count = checks.filter(|checks| checks.goes_up).count();
    (count > 0).then(|| {
        let message = format!(
            "the displacement of {count} of {} tightenings does not come back within the window; as in the original \
             program, this rejects nothing",
            result.tightenings.len()
        );
        file_finding(recording, Severity::Note, "goes_up", message)
    })
}

fn file_finding(recording: &Recording, severity: Severity, code: &str, message: String) -> Finding {
    Finding {
        severity,
        code: code.to_owned(),
        file: recording.file.clone(),
        tightening: None,
        channel: None,
        message,
    }
}

#[cfg(test)]
#[path = "preprocess_tests.rs"]
mod tests;
