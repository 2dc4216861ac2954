//! What to check where no model fits, each as data, and the sentence it is said with.

use super::explained::at_most_all;
use std::fmt::{self, Display, Formatter};

/// Something that may be why no model fits; shares are those of the output's power that mass, damping and stiffness alone would
/// explain then \[–\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Suspicion {
    /// The fit ended in a poor minimum: where the spectra put m, c, k, they do better.
    PoorMinimum(f64),
    /// The input's sign is the other one.
    Sign(f64),
    /// Input and output are swapped.
    Swapped(f64),
    /// The output is another derivative of the angle.
    Derivative {
        /// What it is declared to be.
        declared: &'static str,
        /// What it would be.
        other: &'static str,
        /// Share explained then.
        share: f64,
    },
    /// None of these helps.
    NoOscillator,
}

impl Display for Suspicion {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::PoorMinimum(share) => write!(
                f,
                "Check the starting values: where the spectra put them, mass, damping and stiffness alone explain {}, so the fit ended in a poor minimum. Leave m, c and k out of the study's `model.parameters`, or start them elsewhere.",
                at_most_all(*share)
            ),
            Self::Sign(share) => write!(
                f,
                "Check the sign: with that of the input changed, mass, damping and stiffness alone would explain {}.",
                at_most_all(*share)
            ),
            Self::Swapped(share) => write!(
                f,
                "Check which column is which: with input and output swapped, mass, damping and stiffness alone would explain {}.",
                at_most_all(*share)
            ),
            Self::Derivative {
                declared,
                other,
                share,
            } => write!(
                f,
                "Check the kind of the output: were what is declared as {declared} the {other}, mass, damping and stiffness alone would explain {}.",
                at_most_all(*share)
            ),
            Self::NoOscillator => f.write_str(
                "Another sign, swapped channels or another derivative of the angle would not help. The rig may be no mass on a spring and damper, several modes may move at once, or something else than the logged input drives it. Units and sampling rate are not to blame: the fit is the same in any.",
            ),
        }
    }
}
