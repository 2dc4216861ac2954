use crate::presets::{Context, snug, thesis, whole};
use crate::remarks::Remarks;
use crate::{PreprocessError, PreprocessSettings, Preprocessed, Preset, Window};
use snug_campaign::{Finding, Quantity, Recording, Severity, TighteningId};

/// Sampling intervals between a nanosecond and eleven days; beyond them sample counts have no meaning.
const SHORTEST_INTERVAL_S: f64 = 1e-9;
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
    for segment in &recording.segments {
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
            Ok(prepared) => result.tightenings.push(prepared),
            Err(finding) => result.findings.push(finding),
        }
    }
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
