//! Effects as a diagnosis knows them: in the model, ranked, taken out, or too small to be seen; and how large they are.

pub(crate) mod added;
pub(crate) mod corrected;
pub(crate) mod detectability;
pub(crate) mod ranked;
pub(crate) mod size;
pub(crate) mod size_comparison;
pub(crate) mod unlisted;
