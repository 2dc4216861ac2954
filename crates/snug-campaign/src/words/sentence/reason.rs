//! Why a verdict is what it is: each reason as data, and the sentence it is said with.

use crate::effect::corrected::CorrectedEffect;
use crate::effect::size::EffectParameter;
use crate::words::chance::by_chance;
use crate::words::effect_name::Named;
use crate::words::effect_name::effect_name;
use crate::words::grammar::{capitalised, counted, joined};
use crate::words::number::{short, significant, whole_percent};
use crate::words::sentence::changes::Changes;
use crate::words::sentence::headline::Left;
use crate::words::sentence::restarted::{BESIDE_LINES, WhyRestarted};
use crate::words::sentence::said::written_as_said;
use crate::words::sentence::suspicion::Suspicion;
use crate::words::size::{amount, sizes};
use std::fmt::{self, Display, Formatter};

/// What counts as one independent piece of evidence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cluster {
    /// A whole tightening.
    Tightening,
    /// A stretch of one of few long records.
    Stretch,
}

impl Cluster {
    /// What people call them.
    pub fn plural(self) -> &'static str {
        match self {
            Self::Tightening => "tightenings",
            Self::Stretch => "stretches of the record",
        }
    }
}

/// What would decide an open verdict.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MoreData {
    /// About so many tightenings.
    Tightenings(f64),
    /// A record so many times as long.
    Longer(f64),
}

/// Tightenings beyond which nobody would make so many more to decide a verdict. Chosen.
const MOST_TIGHTENINGS: f64 = 500.0;
/// Times as long as a record is \[–\] beyond which nobody would take a longer one. Chosen.
const MOST_TIMES: f64 = 50.0;

/// One reason for a verdict.
#[derive(Debug, Clone, PartialEq)]
pub enum Reason {
    /// The noise is not known.
    NoiseUnknown {
        /// What the model leaves.
        left: Left,
        /// Whether straight lines from restart to restart hardly count in it.
        beside_lines: bool,
    },
    /// What the model leaves, over the noise.
    Error {
        /// Tightenings compared.
        tightenings: usize,
        /// Root mean square of the residual over the noise.
        error: f64,
        /// Whether only noise is left.
        is_at_floor: bool,
        /// Whether what is left beyond it hardly repeats from tightening to tightening.
        hardly_repeats: bool,
    },
    /// What an effect removes where its size was not fitted.
    Removes {
        /// The effect.
        effect: Named,
        /// Share of the misfit.
        heldout_gain: f64,
        /// Family-wise p.
        p_family: f64,
        /// What was held out.
        cluster: Cluster,
        /// Whether the misfit is counted beyond a known noise.
        is_beyond_noise: bool,
    },
    /// Whose effect it is, where groups of tightenings differ in its size.
    Whose {
        /// The effect.
        effect: Named,
        /// The parameter that differs.
        parameter: Box<EffectParameter>,
    },
    /// What to check where no model fits.
    Check(Suspicion),
    /// How large the missing effect is.
    Size(Vec<EffectParameter>),
    /// What these data cannot tell from the missing effect.
    CannotTell(Vec<Named>),
    /// Mass, damping or stiffness drift.
    Drifts {
        /// Name of the trend.
        trend: String,
        /// Changes per tightening.
        parameters: Vec<EffectParameter>,
    },
    /// The rig changes while it is measured.
    Changes(Changes),
    /// Preparation took something out.
    TakenOut {
        /// What.
        corrected: CorrectedEffect,
        /// What to check at the bench, where it is the rule and not the exception.
        check: Option<&'static str>,
    },
    /// Effects that this rig cannot be simulated with.
    NotSimulated(Vec<Named>),
    /// Laws that are in no catalogue were not tried beside the last model, which leaves too little for one to be told.
    LawsLeftOut {
        /// Share of the squared error with which it began \[–\].
        left: f64,
        /// The same from which a law is told \[–\].
        least: f64,
    },
    /// What would decide.
    WouldDecide {
        /// The best candidate.
        effect: Named,
        /// Its family-wise p.
        p_family: f64,
        /// How much more data.
        more: MoreData,
    },
    /// The model is restarted from the measured motion.
    Restarted {
        /// Why it is.
        why: WhyRestarted,
        /// Time between restarts \[s\].
        every_s: f64,
    },
    /// Recordings begin in motion or elsewhere, so that the motion of each at its first sample is fitted with it.
    BeginsMoving,
    /// The input is taken as held from sample to sample, since less is missing then.
    Held {
        /// Effects that are not needed then.
        spared: Vec<String>,
        /// Whether the delay that is found without it is about half a sampling interval.
        is_half_an_interval: bool,
    },
    /// Whether the input is held was still being tried when the search was ended.
    HeldUndecided,
    /// What was found looks like a held input, which so many samples keep from being tried.
    HeldNotTried,
    /// Tightenings that could not be judged by the common measure.
    LeftOut {
        /// How many.
        left_out: usize,
        /// Of how many.
        all: usize,
        /// The quantity compared.
        quantity: &'static str,
        /// Whether in multiples of its noise.
        has_noise: bool,
    },
    /// Tightenings with too few samples to be compared.
    Short {
        /// How many.
        left_out: usize,
        /// Samples that it takes.
        samples: usize,
    },
    /// Tightenings that are there more than once.
    Copies {
        /// How many.
        left_out: usize,
        /// The first of them.
        first: String,
        /// What that is a copy of.
        of: String,
    },
    /// Effects were learnt from some tightenings only.
    LearntFrom {
        /// Tightenings used.
        taken: usize,
        /// Files read.
        read: usize,
        /// All files.
        files: usize,
    },
    /// Files that could not be read.
    Unread {
        /// Why the first could not.
        first: String,
        /// How many more.
        more: usize,
    },
}

/// Said where a search with a held input was ended.
const HELD_NOT_TRIED: &str = "The delay that was found is about half a sampling interval, which is what an input looks like that is held from sample to sample, as a controller's is. Of so many samples that was not tried: state `model: (intersample: ZeroOrder)` in the study where it is held, `Linear` where it runs straight.";
const HELD_UNDECIDED: &str = "It was ended while the same was tried with an input that is held from sample to sample: part of what was found may be half a sampling interval (`model.intersample` in the study says which input it is).";

written_as_said!(Reason);

impl Display for Reason {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoiseUnknown { left, beside_lines } => {
                write!(f, "The noise of this signal is not known, so the error ({left}) is judged by whether candidates predict stretches that took no part in fitting them.")?;
                f.write_str(if *beside_lines { BESIDE_LINES } else { "" })
            }
            Self::Error {
                tightenings,
                error,
                is_at_floor,
                hardly_repeats,
            } => error_over_noise(f, *tightenings, *error, *is_at_floor, *hardly_repeats),
            Self::Check(suspicion) => suspicion.fmt(f),
            Self::Removes {
                effect,
                heldout_gain,
                p_family,
                cluster,
                is_beyond_noise,
            } => {
                let of = match is_beyond_noise {
                    true => "what was beyond the noise",
                    false => "the squared error",
                };
                write!(
                    f,
                    "{} removes {} of {of} in {} that took no part in finding its size; {}.",
                    capitalised(&effect.spoken()),
                    whole_percent(heldout_gain.clamp(0.0, 1.0)),
                    cluster.plural(),
                    by_chance(*p_family)
                )
            }
            Self::Whose { effect, parameter } => whose(f, effect, parameter),
            Self::Size(parameters) => write!(f, "Its size: {}.", sizes(parameters)),
            Self::CannotTell(twins) => cannot_tell(f, twins),
            Self::Drifts { trend, parameters } => drifts(f, trend, parameters),
            Self::Changes(changes) => changes.fmt(f),
            Self::TakenOut { corrected, check } => taken_out(f, corrected, *check),
            Self::NotSimulated(effects) => write!(
                f,
                "Not tried, because this rig cannot be simulated with any size that was begun with: {}.",
                joined(&spoken(effects))
            ),
            Self::LawsLeftOut { left, least } => laws_left_out(f, *left, *least),
            Self::WouldDecide {
                effect,
                p_family,
                more,
            } => would_decide(f, effect, *p_family, *more),
            Self::Restarted { why, every_s } => why.restarted_every(f, *every_s),
            Self::BeginsMoving => f.write_str("Recordings begin in motion, or where their sensor does not read 0: how each begins is fitted with mass, damping and stiffness (`initial_motion` in `model.effects`)."),
            Self::Held {
                spared,
                is_half_an_interval,
            } => held(f, spared, *is_half_an_interval),
            Self::HeldUndecided => f.write_str(HELD_UNDECIDED),
            Self::HeldNotTried => f.write_str(HELD_NOT_TRIED),
            Self::LeftOut {
                left_out,
                all,
                quantity,
                has_noise,
            } => tightenings_left_out(f, *left_out, *all, quantity, *has_noise),
            Self::Short { left_out, samples } => too_short(f, *left_out, *samples),
            Self::Copies { left_out, first, of } => copies(f, *left_out, first, of),
            Self::LearntFrom { taken, read, files } => learnt_from(f, *taken, *read, *files),
            Self::Unread { first, more } => unread(f, first, *more),
        }
    }
}

fn cannot_tell(f: &mut Formatter<'_>, twins: &[Named]) -> fmt::Result {
    let twins = joined(&spoken(twins));
    write!(
        f,
        "These data cannot tell it from {twins}; they are named together."
    )
}

fn spoken(effects: &[Named]) -> Vec<String> {
    effects.iter().map(Named::spoken).collect()
}

fn error_over_noise(
    f: &mut Formatter<'_>,
    tightenings: usize,
    error: f64,
    is_at_floor: bool,
    hardly_repeats: bool,
) -> fmt::Result {
    let decimals = if is_at_floor { 3 } else { 2 };
    write!(
        f,
        "Over {tightenings} tightenings the model's error is {error:.decimals$} times the sensor noise measured in the quiet part before each pulse; "
    )?;
    f.write_str(match is_at_floor {
        true => "1 means that only noise is left.",
        false => "with a complete model it would be 1.",
    })?;
    match hardly_repeats && !is_at_floor {
        true => f.write_str(
            " What is left beyond the noise hardly repeats from tightening to tightening, as an effect that all share would: look at the tightenings that fit worst.",
        ),
        false => Ok(()),
    }
}

fn drifts(f: &mut Formatter<'_>, trend: &str, parameters: &[EffectParameter]) -> fmt::Result {
    write!(
        f,
        "Beside the misfit, mass, damping or stiffness drift with the tightening's number ({}): {}.",
        effect_name(trend),
        sizes(parameters)
    )
}

fn whose(f: &mut Formatter<'_>, effect: &Named, parameter: &EffectParameter) -> fmt::Result {
    let Some(sizes) = &parameter.by_group else {
        return Ok(());
    };
    write!(
        f,
        "{} is not the same for all {}: {} {}.",
        capitalised(&effect.spoken()),
        sizes.factor.plural(),
        parameter.size().name,
        sizes.sentence(&parameter.unit)
    )
}

fn laws_left_out(f: &mut Formatter<'_>, left: f64, least: f64) -> fmt::Result {
    let (left, least) = (significant(100.0 * left, 2), short(100.0 * least));
    write!(
        f,
        "Simple forces that are in no catalogue were not tried beside this model: it leaves {left}\u{a0}% of the squared error with which this began, and one is told from {least}\u{a0}% on."
    )
}

fn would_decide(
    f: &mut Formatter<'_>,
    effect: &Named,
    p_family: f64,
    more: MoreData,
) -> fmt::Result {
    let (effect, chance) = (effect.spoken(), by_chance(p_family));
    write!(f, "The best candidate is {effect} ({chance}). ")?;
    match more {
        MoreData::Tightenings(count) if count > MOST_TIGHTENINGS => f.write_str(
            "These data cannot decide it, nor would any number of tightenings like these that could be made: look at what differs between them, or change what is measured.",
        ),
        MoreData::Longer(times) if times > MOST_TIMES => f.write_str(
            "These data cannot decide it, nor would a longer record like this: change what drives the rig, or what is measured.",
        ),
        MoreData::Tightenings(count) => {
            write!(f, "About {count} tightenings like these would decide.")
        }
        MoreData::Longer(times) => write!(
            f,
            "A record about {times:.0} times as long, or several of them, would decide."
        ),
    }
}

fn tightenings_left_out(
    f: &mut Formatter<'_>,
    left_out: usize,
    all: usize,
    quantity: &str,
    has_noise: bool,
) -> fmt::Result {
    let measure = match has_noise {
        true => "in multiples of its measured noise",
        false => "without a measured noise",
    };
    let these = if left_out == 1 { "this one" } else { "these" };
    write!(
        f,
        "{left_out} of {all} tightenings took no part in the diagnosis: all must be judged by one measure, here {quantity} {measure}, and that could not be had of {these}. findings.json says why."
    )
}

fn too_short(f: &mut Formatter<'_>, left_out: usize, samples: usize) -> fmt::Result {
    let them = counted(left_out, "tightening");
    write!(
        f,
        "{them} took no part in the diagnosis: fewer than {samples} samples are scored, too few to compare a model with."
    )
}

fn copies(f: &mut Formatter<'_>, left_out: usize, first: &str, of: &str) -> fmt::Result {
    let them = counted(left_out, "tightening");
    let hold = match left_out {
        1 => "it holds",
        _ => "they hold",
    };
    write!(
        f,
        "{them} took no part in the diagnosis: {hold} the same samples as another to the last bit ({first} those of {of}), and a copy is no new evidence."
    )
}

fn held(f: &mut Formatter<'_>, spared: &[String], is_half_an_interval: bool) -> fmt::Result {
    let names: Vec<String> = spared.iter().map(|name| effect_name(name)).collect();
    f.write_str("The input is taken as held from sample to sample, as a controller's is (`model.intersample: ZeroOrder`): ")?;
    match (is_half_an_interval, names.is_empty()) {
        (true, _) => f.write_str(
            "the delay that is found without it is about half a sampling interval, which is what a held input looks like.",
        ),
        (false, true) => f.write_str("what is found then leaves less."),
        (false, false) => write!(
            f,
            "a model of fewer effects then leaves as little, without {}.",
            names.join(" and ")
        ),
    }?;
    f.write_str(" State `Linear` where it is not.")
}

fn learnt_from(f: &mut Formatter<'_>, taken: usize, read: usize, files: usize) -> fmt::Result {
    let from = match read < files {
        true => format!("{read} of the {files} files"),
        false => format!("each of the {files} files"),
    };
    write!(
        f,
        "There are many tightenings: what is missing, and how large it is, was learnt from {taken}, taken evenly from {from}; every tightening was then evaluated with what was learnt. `diagnosis: (most_tightenings: …)` in the study says how many may be used."
    )
}

fn unread(f: &mut Formatter<'_>, first: &str, more: usize) -> fmt::Result {
    write!(
        f,
        "Not every file could be read, so this diagnosis is in part without it: {first}"
    )?;
    match more {
        0 => write!(f, "."),
        some => write!(f, " (and {some} more)."),
    }
}

fn taken_out(f: &mut Formatter<'_>, one: &CorrectedEffect, check: Option<&str>) -> fmt::Result {
    write!(
        f,
        "Before the fit, {} was measured in the quiet part and taken out: about {} in {} of the tightenings.",
        effect_name(&one.effect),
        amount(one.size, &one.unit),
        whole_percent(one.share)
    )?;
    match check {
        Some(check) => write!(f, " Check at the bench: {check}"),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_candidate_in_no_catalogue_is_named_by_what_it_is() {
        let undecided = Reason::WouldDecide {
            effect: Named::alone("x5_law".into(), Some("p*x^5".into())),
            p_family: 0.2,
            more: MoreData::Longer(3.0),
        };
        let said = undecided.to_string();
        assert!(said.contains("is a force p*x^5 ("), "{said}");
    }
}
