//! What can be asked of a study.

/// A verb of the diagnosis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verb {
    /// Model against measurement, and where it fails.
    Compare,
    /// The same, and which effect is missing; the study stays as it is.
    Diagnose,
    /// These effects are added to the study's model.
    Add(Vec<String>),
    /// Effects are added as long as the data justify it, or until it is interrupted.
    Improve,
}

impl Verb {
    /// The effects it names.
    pub fn effects(&self) -> &[String] {
        match self {
            Self::Add(effects) => effects,
            _ => &[],
        }
    }
}
