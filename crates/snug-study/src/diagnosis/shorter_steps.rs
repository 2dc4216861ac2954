//! Studies that are simulated in shorter steps from sample to sample as long as what they find asks for them.

use crate::error::StudyError;
use crate::progress::ProgressEvent;
use crate::study::Study;
use snug_diagnose::DiagnoseError;

/// What is found with a study, simulated in shorter steps as long as it asks for them, and the study with those.
pub(super) fn in_short_enough_steps<T>(
    mut study: Study,
    progress: &(dyn Fn(ProgressEvent<'_>) + Sync),
    find: impl Fn(&Study) -> Result<T, StudyError>,
) -> Result<(Study, T), StudyError> {
    loop {
        match find(&study) {
            Err(StudyError::Diagnose(DiagnoseError::Unresolved { steps })) => {
                let what = format!("simulating in {steps} steps from sample to sample");
                progress(ProgressEvent::Stage { what: &what });
                study.model.steps_per_sample = Some(steps);
            }
            found => return found.map(|found| (study, found)),
        }
    }
}
