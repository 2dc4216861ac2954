//! The verdict in one sentence.

use crate::measurement::quantity::Quantity;
use crate::measurement::signal_units::SignalUnits;
use crate::words::changes::Changes;
use crate::words::effect_name::Named;
use crate::words::grammar::{counted, joined};
use crate::words::number::significant;
use crate::words::sentence::explained::Explained;
use crate::words::sentence::explained::at_most_all;
use crate::words::sentence::said::written_as_said;
use crate::words::sentence::suspicion::{OtherUnits, RestartedTooSeldom, TurnedRound};
use crate::words::size::amount;
use std::fmt::{self, Display, Formatter};

/// What a fitted model leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Left {
    /// Root mean square of the residual, over the noise (no unit) where that is known, else in `unit`.
    pub error: f64,
    /// The unit of the output as it is shown; `None` where the error is over the noise.
    pub unit: Option<String>,
}

impl Left {
    /// An `error` over the noise.
    pub fn over_noise(error: f64) -> Self {
        Self { error, unit: None }
    }

    /// An error of the `output`, in SI units about the joint, as `units` show it.
    pub fn of_output(error: f64, output: Quantity, units: &SignalUnits) -> Self {
        Self {
            error: error * units.output_per_rad,
            unit: Some(units.motion(output)),
        }
    }
}

impl Display for Left {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.unit {
            None => write!(f, "{:.3} times the measurement noise", self.error),
            Some(unit) => write!(f, "{} rms", amount(self.error, unit)),
        }
    }
}

/// How the error fell: `from 1.541 to 1.007 times the measurement noise`.
#[derive(Debug, Clone, PartialEq)]
pub struct Fall {
    /// What the first model left.
    pub before: Left,
    /// What the last leaves.
    pub after: Left,
}

impl Display for Fall {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.before.unit {
            None => write!(f, "from {:.3} to {}", self.before.error, self.after),
            Some(_) => write!(
                f,
                "from {} to {}",
                significant(self.before.error, 3),
                self.after
            ),
        }
    }
}

/// The verdict, with what it rests on.
#[derive(Debug, Clone, PartialEq)]
pub enum Headline {
    /// Whoever watches ended the search; what had been added by then.
    Stopped {
        /// The effects.
        added: Vec<Named>,
        /// How the error fell with them.
        fall: Fall,
    },
    /// An effect is missing, or a law that is in no catalogue.
    Lacks {
        /// It, and what these data cannot tell from it.
        effect: Named,
        /// How the error falls with it.
        fall: Fall,
    },
    /// An effect that the model has is not the same for all.
    Differs {
        /// The effect.
        effect: Named,
        /// What groups differ in it, as `participants`.
        groups: &'static str,
        /// How the error falls with a size for each.
        fall: Fall,
    },
    /// More than noise is left, and nothing that was tried explains it.
    MoreThanNoise {
        /// What was added all the same.
        added: Vec<Named>,
        /// How the error fell.
        fall: Fall,
        /// How much of the output is explained, where the noise is not known.
        explained: Option<Explained>,
        /// What changes along the recordings.
        changes: Option<Changes>,
    },
    /// Nothing but noise is left, and so much of it that not one recording can be used.
    TooNoisy {
        /// What was added.
        added: Vec<Named>,
        /// How the error fell.
        fall: Fall,
        /// How much of the output is explained.
        explained: Explained,
    },
    /// Terms that are in no catalogue were added.
    Unlisted {
        /// What was added.
        added: Vec<Named>,
        /// What was added and is small beside it.
        further: Vec<Named>,
        /// Whether hardly more than noise is left.
        describes: bool,
        /// How the error fell.
        fall: Fall,
    },
    /// Repeatable misfit that no effect of the catalogue explains.
    Unexplained(Left),
    /// Nothing more is justified.
    Adequate {
        /// What was added.
        added: Vec<Named>,
        /// What was added and is small beside it.
        further: Vec<Named>,
        /// How the error fell.
        fall: Fall,
        /// How much is explained, where no noise says what is enough.
        explained: Option<Explained>,
    },
    /// There is no model that a question about effects could be about.
    NoModel(NoModel),
    /// The rig changes while it is measured, by so much that nothing else was looked for.
    Changes {
        /// What changes.
        changes: Changes,
        /// What the model leaves whose numbers stay.
        left: Left,
    },
    /// Compared only; nothing was looked for.
    Compared(Left),
    /// Too little to say.
    TooLittle {
        /// How many tightenings there are; `None` where stretches of few long records are compared.
        tightenings: Option<usize>,
        /// What was added all the same.
        added: Vec<Named>,
        /// How the error fell with it.
        fall: Fall,
    },
}

written_as_said!(Headline);

fn named(effects: &[Named]) -> String {
    joined(&effects.iter().map(Named::with_twins).collect::<Vec<_>>())
}

fn describe(well: bool, laws: usize) -> &'static str {
    match (well, laws) {
        (true, 1) => "describes",
        (true, _) => "describe",
        (false, 1) => "comes nearest to",
        (false, _) => "together come nearest to",
    }
}

impl Display for Headline {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stopped { added, fall } => stopped(f, added, fall),
            Self::Lacks { effect, fall } => lacks(f, effect, fall),
            Self::Differs {
                effect,
                groups,
                fall,
            } => write!(
                f,
                "What the model lacks is that {} is not the same for all {groups}: with a size for each the error falls {fall}.",
                effect.spoken()
            ),
            Self::MoreThanNoise {
                added,
                fall,
                explained,
                changes,
            } => more_than_noise(f, added, fall, *explained, changes.as_ref()),
            Self::TooNoisy {
                added,
                fall,
                explained,
            } => too_noisy(f, added, fall, *explained),
            Self::Unlisted {
                added,
                further,
                describes,
                fall,
            } => {
                write!(
                    f,
                    "Something that is not in the catalogue acts here; {} {} it, and the error falls {fall}.",
                    named(added),
                    describe(*describes, added.len())
                )?;
                aside(f, further)
            }
            Self::Unexplained(left) => write!(
                f,
                "Misfit that repeats from tightening to tightening remains ({left}), and no effect of the catalogue explains it."
            ),
            Self::NoModel(why) => why.fmt(f),
            Self::Adequate {
                added,
                further,
                fall,
                explained,
            } => {
                adequate(f, added, fall, *explained)?;
                aside(f, further)
            }
            Self::Changes { changes, left } => write!(
                f,
                "The rig changes while it is measured: {}. No model whose numbers stay follows that; this one leaves {left}.",
                changes.clause()
            ),
            Self::Compared(left) => {
                write!(
                    f,
                    "The model leaves {left}; `diagnose` says what could be missing."
                )
            }
            Self::TooLittle {
                tightenings,
                added,
                fall,
            } => too_little(f, *tightenings, added, fall),
        }
    }
}

/// Why there is no model that a question about effects could be about.
#[derive(Debug, Clone, PartialEq)]
pub enum NoModel {
    /// Some recordings are in other units than others.
    OtherUnits(OtherUnits),
    /// The input has the other sign, or is the output: with it mended, mass, damping and stiffness alone explain this share \[–\].
    OtherChannel {
        /// Whether input and output are swapped; else it is the sign.
        are_swapped: bool,
        /// What would be explained then.
        share: f64,
    },
    /// Recordings whose input has the other sign than that of the others.
    TurnedRound(TurnedRound),
    /// The rig pushes itself away from where it would rest.
    PushesAway,
    /// The model is restarted after it has fallen away.
    RestartedTooSeldom(RestartedTooSeldom),
    /// No model was found that deserves the question.
    NotFitted(Explained),
    /// Most effects could not be tried beside a model that explains so much.
    HardlyTried {
        /// How many were.
        tried: usize,
        /// Of how many.
        of: usize,
    },
}

impl Display for NoModel {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::OtherUnits(units) => write!(
                f,
                "Recordings seem to be in different units: {units}. What is missing cannot be asked before that is mended."
            ),
            Self::OtherChannel { are_swapped, share } => write!(
                f,
                "{}: then, mass, damping and stiffness alone would explain {}. What is missing cannot be asked before that is mended.",
                match are_swapped {
                    true => "Input and output seem to be swapped",
                    false => "The input seems to have the other sign",
                },
                at_most_all(*share)
            ),
            Self::TurnedRound(turned) => write!(
                f,
                "The recordings do not agree which way is which: {turned}. What is missing cannot be asked before that is mended."
            ),
            Self::PushesAway => f.write_str(
                "The rig pushes itself away from where it would rest, and no stiffness of 0 or more follows it. What is missing cannot be asked before the study lets it be below.",
            ),
            Self::RestartedTooSeldom(seldom) => write!(
                f,
                "The model is restarted too seldom: {}. What is missing cannot be asked before it is restarted sooner.",
                seldom.so_that()
            ),
            Self::NotFitted(explained) => write!(
                f,
                "No model was found that deserves the question what is missing: the best explains {explained}."
            ),
            Self::HardlyTried { tried, of } => write!(
                f,
                "What is missing is not known: only {tried} of {of} candidates could be tried on this rig as it is sampled."
            ),
        }
    }
}

fn lacks(f: &mut Formatter<'_>, effect: &Named, fall: &Fall) -> fmt::Result {
    let what = match effect.is_unlisted() {
        true => "A law that is not in the catalogue is missing, best described as",
        false => "The model lacks",
    };
    write!(
        f,
        "{what} {}: with it the error falls {fall}.",
        effect.with_twins()
    )
}

fn stopped(f: &mut Formatter<'_>, added: &[Named], fall: &Fall) -> fmt::Result {
    match added {
        [] => write!(
            f,
            "Stopped before an effect was added: the model leaves {}, and what it lacks is not decided.",
            fall.after
        ),
        added => write!(
            f,
            "Stopped after {}: with {} the error fell {fall}; nothing more was tried.",
            counted(added.len(), "effect"),
            named(added)
        ),
    }
}

fn too_little(
    f: &mut Formatter<'_>,
    tightenings: Option<usize>,
    added: &[Named],
    fall: &Fall,
) -> fmt::Result {
    let of_these = match tightenings {
        Some(some) => format!("these {some} tightenings are too few to say"),
        None => "these data cannot decide".to_owned(),
    };
    match added {
        [] => write!(
            f,
            "What is missing, {of_these}: the model leaves {}, and the best candidate could still be chance.",
            fall.after
        ),
        added => write!(
            f,
            "With {} the error fell {fall}; whether more is missing, {of_these}: the best of the other candidates could still be chance.",
            named(added)
        ),
    }
}

fn more_than_noise(
    f: &mut Formatter<'_>,
    added: &[Named],
    fall: &Fall,
    explained: Option<Explained>,
    changes: Option<&Changes>,
) -> fmt::Result {
    match added {
        [] => write!(f, "The model leaves {}", fall.after),
        added => write!(f, "With {} the error fell {fall}", named(added)),
    }?;
    match changes {
        None => f.write_str(", which is more than noise, and nothing that was tried explains the rest: the verdict is open."),
        Some(changes) => write!(
            f,
            ", which is more than noise: the rig changes while it is measured, {}. No model whose numbers stay follows that.",
            changes.clause()
        ),
    }?;
    explained.map_or(Ok(()), |all| {
        write!(f, " The model explains {all}. {}", all.left())
    })
}

fn too_noisy(
    f: &mut Formatter<'_>,
    added: &[Named],
    fall: &Fall,
    explained: Explained,
) -> fmt::Result {
    explains(f, added, fall, explained)?;
    write!(
        f,
        ", which is as white as noise, and so much that not one recording fits well enough to be used: measure with less noise, or let the study's `selection` take more of it. {}",
        explained.left()
    )
}

fn explains(
    f: &mut Formatter<'_>,
    added: &[Named],
    fall: &Fall,
    explained: Explained,
) -> fmt::Result {
    match added {
        [] => write!(
            f,
            "The model explains {explained}: it leaves {}",
            fall.after
        ),
        added => write!(
            f,
            "With {} the model explains {explained}: the error fell {fall}",
            named(added)
        ),
    }
}

/// What is small beside what the verdict is about.
fn aside(f: &mut Formatter<'_>, further: &[Named]) -> fmt::Result {
    match further {
        [] => Ok(()),
        some => write!(f, " Further, small: {}.", named(some)),
    }
}

fn adequate(
    f: &mut Formatter<'_>,
    added: &[Named],
    fall: &Fall,
    explained: Option<Explained>,
) -> fmt::Result {
    match (added, explained) {
        (added, Some(all)) => explains(f, added, fall, all),
        ([], None) => write!(f, "The model is adequate: it leaves {}", fall.after),
        (added, None) => write!(
            f,
            "With {} the model is complete: the error fell {fall}",
            named(added)
        ),
    }?;
    write!(f, ", and nothing more is justified.")?;
    explained.map_or(Ok(()), |all| write!(f, " {}", all.left()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.5 rad at the end of a lever of 0.33 m are 0.165 m.
    #[test]
    fn an_error_is_told_in_the_unit_of_the_output() {
        let slide = SignalUnits {
            output: "m".into(),
            output_per_rad: 0.33,
            ..SignalUnits::default()
        };
        let left = Left::of_output(0.5, Quantity::Velocity, &slide);
        assert_eq!(left.to_string(), "0.165\u{a0}m/s rms");
        let counts = SignalUnits {
            output: "1".into(),
            ..SignalUnits::default()
        };
        let left = |error| Left::of_output(error, Quantity::Displacement, &counts);
        assert_eq!(left(0.5).to_string(), "0.500 rms");
        let fall = Fall {
            before: left(2.0),
            after: left(0.5),
        };
        assert_eq!(fall.to_string(), "from 2.00 to 0.500 rms");
        let fall = Fall {
            before: Left::over_noise(6.4),
            after: Left::over_noise(1.0),
        };
        assert_eq!(
            fall.to_string(),
            "from 6.400 to 1.000 times the measurement noise"
        );
    }
}
