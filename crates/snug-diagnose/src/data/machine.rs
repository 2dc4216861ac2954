//! Whether a rig is one that nobody holds.

use snug_identify::FitTask;
use snug_model::Scale;

/// Whether nobody holds the rig.
pub(crate) fn is_machine(case: &FitTask<'_>) -> bool {
    matches!(case.model.scale(), Scale::Rig { .. })
}
