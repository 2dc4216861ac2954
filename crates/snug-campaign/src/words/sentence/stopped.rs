//! Why nothing more was added.

use crate::words::chance::by_chance;
use crate::words::effect_name::Named;
use crate::words::grammar::counted;
use crate::words::number::{fixed, short, significant};
use crate::words::sentence::said::written_as_said;
use std::fmt::{self, Display, Formatter};

/// Why the search for effects stopped.
#[derive(Debug, Clone, PartialEq)]
pub enum Stopped {
    /// No candidate reaches the level.
    NothingSupported {
        /// Smallest family-wise p of the rest.
        best_p: f64,
        /// Family-wise p below which an effect is believed.
        level: f64,
    },
    /// The best of the rest is beyond chance, but the interval of its size holds nothing.
    SizeMayBeNothing(Named),
    /// What the best of the rest takes away, another motion at the restarts or a load takes away, too.
    OfRestarts(Named),
    /// The best supported candidate lowers the error by too little to matter.
    TooSmall {
        /// The candidate.
        effect: Named,
        /// Share of the squared error that it removes.
        share: f64,
        /// Share that matters.
        smallest: f64,
        /// Whether only noise is left.
        is_at_floor: bool,
    },
    /// What the best of the rest takes away is a trifle beside what the study's own model left.
    Trifle {
        /// The candidate.
        effect: Named,
        /// Share of the first model's squared error that it removes.
        share: f64,
        /// Share that matters.
        smallest: f64,
    },
    /// What is left is rounding.
    Exact,
    /// The model cannot carry more.
    Full,
    /// Whoever watches ended it after so many effects.
    Interrupted(usize),
}

written_as_said!(Stopped);

impl Display for Stopped {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NothingSupported { best_p, level } => write!(
                f,
                "No further effect is supported: {} as the best of the rest, and an effect is believed below {} of 100 only.",
                by_chance(*best_p),
                short(100.0 * level)
            ),
            Self::SizeMayBeNothing(effect) => write!(
                f,
                "No further effect is supported: the best of the rest, {}, is more than chance, but these data do not tell its size from nothing.",
                effect.spoken()
            ),
            Self::OfRestarts(effect) => write!(
                f,
                "No further effect is supported: what the best of the rest, {}, takes away, another motion at each restart takes away as well, or a load that was not recorded. These data do not tell it from errors with which the measured motion is taken up, or from what else moves the rig.",
                effect.spoken()
            ),
            Self::TooSmall { effect, share, smallest, is_at_floor } => write!(
                f,
                "The best of the rest, {}, would lower the squared error by {}\u{a0}%, less than the {}\u{a0}% that matter here: {}. If it shows at the bench all the same, add it: while it is left out, the sizes found here lean to make up for it.",
                effect.spoken(),
                fixed(100.0 * share, 2),
                fixed(100.0 * smallest, 1),
                match is_at_floor {
                    true => "that much is within reach of noise in the torque signal and of the timing between samples",
                    false => "that much may be a piece of what else is missing",
                }
            ),
            Self::Trifle { effect, share, smallest } => write!(
                f,
                "Further, small: {} takes {}\u{a0}% of the squared error with which this began, less than the {}\u{a0}% from which {} told. To have it all the same, add it.",
                effect.spoken(),
                significant(100.0 * share, 2),
                short(100.0 * smallest),
                match effect.is_unlisted() {
                    true => "a law that is in no catalogue is",
                    false => "an effect is",
                }
            ),
            Self::Exact => f.write_str(
                "What is left is less than an instrument could see, as if these data were computed: it is rounding, and no effect is looked for in it.",
            ),
            Self::Full => f.write_str(
                "The model carries as many effects as can be told apart; look at the data before adding more.",
            ),
            Self::Interrupted(0) => f.write_str("It was ended before an effect was added."),
            Self::Interrupted(added) => write!(
                f,
                "It was ended after {}; nothing more was tried, nor whether each of them is needed beside the others.",
                counted(*added, "effect")
            ),
        }
    }
}
