//! The words in which verdicts are told: for someone who knows nutrunners, not statistics.

use crate::data::clusters::Units;
use crate::library::{declaration, in_words, is_unlisted};
use crate::pooled::fitted::Fitted;
use crate::ranking::rank::Candidate;
use crate::selection::path::{Addition, Attempt, Stop};
use crate::settings::DiagnoseSettings;
use snug_campaign::{CorrectedEffect, EffectParameter, RankedEffect, Verdict};
use snug_model::{CustomEffectSettings, Description, Effect, Law, TRENDS};

/// What the words are about.
pub(crate) struct Situation<'a> {
    pub verb: &'static str,
    pub verdict: Verdict,
    pub tightenings: usize,
    /// What is held out in turn: whole tightenings, or stretches of few long records.
    pub units: Units,
    pub before: &'a Fitted,
    pub after: &'a Fitted,
    pub additions: &'a [Addition],
    /// The candidate that is supported and not in the model.
    pub chosen: Option<&'a Candidate>,
    /// What these data cannot tell from it.
    pub twins: Vec<Effect>,
    pub ranking: &'a [RankedEffect],
    pub stopped: Option<Stop>,
    /// Candidates that cannot be simulated on this rig.
    pub impossible: &'a [Effect],
    /// What preparation took out.
    pub corrected: &'a [CorrectedEffect],
    pub settings: &'a DiagnoseSettings,
}

impl Situation<'_> {
    /// Two effects that are to be told apart by an experiment, if there are: the one that is missing or was added last, and
    /// its twin.
    pub fn twin_pair(&self) -> Option<(&Fitted, Effect)> {
        if let Some(chosen) = self.chosen {
            return Some((&chosen.fitted, *self.twins.first()?));
        }
        let added = self.additions.last()?;
        let twin = *added.twins.first()?;
        (self.after.effects.last() == Some(&added.effect)).then_some((self.after, twin))
    }
}

/// A value with three significant digits and its unit.
pub(crate) fn amount(value: f64, unit: &str) -> String {
    let number = number(value);
    match unit {
        "" | "1" | "-" => number,
        unit => format!("{number} {unit}"),
    }
}

fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let decimals = 2 - value.abs().log10().floor() as i32;
    match decimals {
        ..=-3 => format!("{value:.2e}"),
        -2..=0 => format!("{value:.0}"),
        1..=5 => format!("{value:.*}", decimals as usize),
        _ => format!("{value:.2e}"),
    }
}

/// `friction force 1.18 N (1.14 to 1.23)`.
fn size(parameter: &EffectParameter) -> String {
    let value = format!(
        "{} {}",
        parameter.meaning,
        amount(parameter.value, &parameter.unit)
    );
    let range = match (parameter.low, parameter.high) {
        (Some(low), Some(high)) => format!(" ({} to {})", number(low), number(high)),
        _ => " (no interval)".to_owned(),
    };
    let beyond = match parameter.is_plausible() {
        true => String::new(),
        false => format!(
            ", beyond the plausible {} to {}",
            number(parameter.minimum),
            amount(parameter.maximum, &parameter.unit)
        ),
    };
    let own = match parameter.spread {
        Some(spread) => format!(
            ", different in every tightening by {}",
            amount(spread, &parameter.unit)
        ),
        None => String::new(),
    };
    value + &range + &beyond + &own
}

/// What each parameter of an effect is, with its range, one after the other.
pub(crate) fn sizes(parameters: &[EffectParameter]) -> String {
    parameters.iter().map(size).collect::<Vec<_>>().join(", ")
}

/// An effect's name, `co contraction`, or the force that a term in no catalogue is.
pub(crate) fn spoken(effect: Effect) -> String {
    match declaration(effect.name()) {
        Some(declared) => format!("a force {}", declared.expression),
        None => effect.name().replace('_', " "),
    }
}

/// An effect of `fitted` that these data cannot tell from others is named with them; a term that stands alone is put into
/// words.
fn with_twins(effect: Effect, twins: &[Effect], fitted: &Fitted) -> String {
    let names = std::iter::once(&effect).chain(twins);
    let names: Vec<String> = names.map(|&effect| spoken(effect)).collect();
    match (twins, in_words(effect, fitted.size(effect))) {
        ([], None) => names.concat(),
        ([], Some(words)) => format!("{} ({words})", names.concat()),
        _ => format!("{} (these data cannot tell which)", names.join(" or ")),
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}

/// `from 1.541 to 1.007 times the measurement noise`.
fn fall(before: &Fitted, after: &Fitted) -> String {
    match before.is_weighted && after.is_weighted {
        true => format!("from {:.3} to {}", before.error(), error(after)),
        false => format!("from {} to {}", number(before.error()), error(after)),
    }
}

fn error(fitted: &Fitted) -> String {
    match fitted.is_weighted {
        true => format!("{:.3} times the measurement noise", fitted.error()),
        false => format!("{} rms", number(fitted.error())),
    }
}

/// `1 effect`, `2 effects`.
fn counted(effects: usize) -> String {
    match effects {
        1 => "1 effect".to_owned(),
        some => format!("{some} effects"),
    }
}

fn joined(effects: &[String]) -> String {
    match effects {
        [] => String::new(),
        [one] => one.clone(),
        [some @ .., last] => format!("{} and {last}", some.join(", ")),
    }
}

/// The verdict in one sentence.
pub(crate) fn headline(situation: &Situation<'_>) -> String {
    let after = error(situation.after);
    let fell = fall(situation.before, situation.after);
    let added: Vec<String> = (situation.additions.iter())
        .map(|one| with_twins(one.effect, &one.twins, situation.after))
        .collect();
    if situation.stopped == Some(Stop::Interrupted) {
        return match added.as_slice() {
            [] => format!(
                "Stopped by you before an effect was added: the model leaves {after}, and what it lacks is not decided."
            ),
            some => format!(
                "Stopped by you after {}: with {} the error fell {fell}; nothing more was tried.",
                counted(some.len()),
                joined(some)
            ),
        };
    }
    match (situation.verdict, situation.chosen) {
        (Verdict::MissingEffect | Verdict::UnlistedEffect, Some(chosen)) => {
            let name = with_twins(chosen.effect, &situation.twins, &chosen.fitted);
            let falls = fall(situation.after, &chosen.fitted);
            let what = match is_unlisted(chosen.effect) {
                true => format!(
                    "A law that is not in the catalogue is missing, best described as {name}"
                ),
                false => format!("The model lacks {name}"),
            };
            format!("{what}: with it the error falls {falls}.")
        }
        (Verdict::UnlistedEffect, None) if !added.is_empty() => {
            let describes = match (situation.after.is_beyond_noise(), added.len()) {
                (false, 1) => "describes",
                (false, _) => "describe",
                (true, 1) => "comes nearest to",
                (true, _) => "together come nearest to",
            };
            format!(
                "Something that is not in the catalogue acts here; {} {describes} it, and the error falls {fell}.",
                joined(&added)
            )
        }
        (Verdict::UnlistedEffect, None) => format!(
            "Misfit that repeats from tightening to tightening remains ({after}), and no effect of the catalogue explains it."
        ),
        (Verdict::Adequate, _) if !added.is_empty() => format!(
            "With {} the model is complete: the error fell {fell}, and nothing more is justified.",
            joined(&added)
        ),
        (Verdict::Adequate, _) => {
            format!("The model is adequate: it leaves {after}, and nothing more is justified.")
        }
        (Verdict::Undecided, _) if situation.verb == "compare" => {
            format!("The model leaves {after}; `diagnose` says what could be missing.")
        }
        (Verdict::Undecided | Verdict::MissingEffect, _) => format!(
            "{} to say: the model leaves {after}, and the best candidate could still be chance.",
            match situation.units.are_whole() {
                true => format!("These {} tightenings are too few", situation.tightenings),
                false => "This measurement is too short".to_owned(),
            }
        ),
    }
}

/// Why, in plain words.
pub(crate) fn reasons(situation: &Situation<'_>) -> Vec<String> {
    let mut reasons = vec![what_is_left(situation)];
    reasons.extend(situation.additions.iter().map(|one| {
        let name = spoken(one.effect);
        evidence(&name, one.heldout_gain, one.p_family, situation)
    }));
    reasons.extend(what_speaks_for_the_chosen(situation));
    reasons.extend(trends(situation));
    reasons.extend(situation.corrected.iter().map(correction));
    if !situation.impossible.is_empty() {
        let names = situation.impossible.iter().map(|&effect| spoken(effect));
        reasons.push(format!(
            "Not tried, because this rig cannot be simulated with sizes meant for a hand on a tool: {}.",
            joined(&names.collect::<Vec<_>>())
        ));
    }
    reasons.extend(what_would_decide(situation));
    reasons
}

fn what_is_left(situation: &Situation<'_>) -> String {
    let (tightenings, error) = (situation.tightenings, situation.after.error());
    if !situation.after.is_weighted {
        return format!(
            "The noise of this signal is not known, so the error ({}) is judged by whether candidates predict stretches that took no part in fitting them.",
            self::error(situation.after)
        );
    }
    if situation.after.is_at_floor() {
        return format!(
            "Over {tightenings} tightenings the model's error is {error:.3} times the sensor noise measured in the quiet part before each pulse; 1 means that only noise is left."
        );
    }
    let more = match situation.verdict {
        Verdict::Adequate => {
            " What is left beyond the noise hardly repeats from tightening to tightening, as an effect that all share would: look at the tightenings that fit worst."
        }
        _ => "",
    };
    format!(
        "Over {tightenings} tightenings the model's error is {error:.2} times the sensor noise measured in the quiet part before each pulse; with a complete model it would be 1.{more}"
    )
}

fn what_speaks_for_the_chosen(situation: &Situation<'_>) -> Vec<String> {
    let (Some(chosen), Some(first)) = (situation.chosen, situation.ranking.first()) else {
        return Vec::new();
    };
    let name = spoken(chosen.effect);
    let mut reasons = vec![
        evidence(&name, first.heldout_gain, first.p_family, situation),
        format!("Its size: {}.", sizes(&first.parameters)),
    ];
    let twins: Vec<String> = situation.twins.iter().map(|&twin| spoken(twin)).collect();
    if !twins.is_empty() {
        reasons.push(format!(
            "These data cannot tell it from {}; they are named together.",
            joined(&twins)
        ));
    }
    reasons
}

fn trends(situation: &Situation<'_>) -> impl Iterator<Item = String> {
    let supported = |name: &str| {
        let mut ranking = situation.ranking.iter();
        ranking.find(|one| one.effect == name && one.p_family <= situation.settings.level)
    };
    TRENDS.iter().filter_map(move |trend| {
        Some(format!(
            "Beside the misfit, mass, damping or stiffness drift with the tightening's number ({}): {}.",
            trend.name,
            sizes(&supported(trend.name)?.parameters)
        ))
    })
}

fn what_would_decide(situation: &Situation<'_>) -> Option<String> {
    let is_interrupted = situation.stopped == Some(Stop::Interrupted);
    if situation.verdict != Verdict::Undecided || situation.verb == "compare" || is_interrupted {
        return None;
    }
    let first = situation.ranking.first()?;
    let times = (4.0 / first.score.max(0.5)).powi(2);
    let decided_by = match situation.units.are_whole() {
        true => format!(
            "About {} tightenings like these would decide.",
            (times * situation.tightenings as f64 / 4.0).ceil() * 4.0
        ),
        false => format!(
            "A record about {:.0} times as long, or several of them, would decide.",
            times.ceil().max(2.0)
        ),
    };
    Some(format!(
        "The best candidate is {} (chance alone does as well in at most {} of 100 campaigns). {decided_by}",
        first.effect.replace('_', " "),
        (first.p_family * 100.0).ceil(),
    ))
}

/// What preparation took out; where that is the rule and not the exception, with what to check.
fn correction(one: &CorrectedEffect) -> String {
    let taken_out = format!(
        "Before the fit, {} was measured in the quiet part and taken out: about {} in {:.0} % of the tightenings.",
        one.effect.replace('_', " "),
        amount(one.size, &one.unit),
        one.share * 100.0
    );
    match Effect::named(&one.effect).filter(|_| one.share > 0.5) {
        Some(effect) => format!(
            "{taken_out} Check at the bench: {}",
            effect.description().check
        ),
        None => taken_out,
    }
}

fn evidence(name: &str, gain: f64, p: f64, situation: &Situation<'_>) -> String {
    let chance = match p {
        p if p <= 0.001 => "less than once in 1000 measurements like this".to_owned(),
        p => format!("in about {:.1} of 100 measurements like this", 100.0 * p),
    };
    let gain = (gain * 100.0).clamp(0.0, 100.0);
    let held_out = situation.units.named();
    let of = match situation.after.is_weighted {
        true => "what was beyond the noise",
        false => "the squared error",
    };
    format!(
        "{} removes {gain:.0} % of {of} in {held_out} that took no part in finding its size; chance alone would do that {chance}.",
        capitalised(name)
    )
}

/// Why the climb stopped.
pub(crate) fn stopped(situation: &Situation<'_>) -> Option<String> {
    Some(match situation.stopped? {
        Stop::NothingSupported { best_p } => format!(
            "No further effect is supported: chance alone does as well as the best of the rest in {:.0} of 100 campaigns like this, and an effect is believed below {:.0} of 100 only.",
            (best_p * 100.0).ceil(),
            situation.settings.level * 100.0
        ),
        Stop::TooSmall { effect, share } => format!(
            "The best of the rest, {}, would lower the squared error by {:.2} %, less than the {:.1} % that matter here: {}. If it shows at the bench all the same, add it: while it is left out, the sizes found here lean to make up for it.",
            spoken(effect),
            share * 100.0,
            situation.after.smallest_gain(situation.settings) * 100.0,
            match situation.after.is_at_floor() {
                true => "that much is within reach of noise in the torque signal and of the timing between samples",
                false => "that much may be a piece of what else is missing",
            }
        ),
        Stop::Full => "The model carries as many effects as can be told apart; look at the data before adding more.".to_owned(),
        Stop::Interrupted => match situation.additions.len() {
            0 => "You ended it before an effect was added.".to_owned(),
            some => format!(
                "You ended it after {}; nothing more was tried, nor whether each of them is needed beside the others.",
                counted(some)
            ),
        },
    })
}

/// What an effect of `fitted` is, how it shows, what to check at the bench.
pub(crate) fn explanation(effect: Effect, fitted: &Fitted) -> Vec<String> {
    match declaration(effect.name()).zip(in_words(effect, fitted.size(effect))) {
        Some((declared, words)) => vec![
            format!(
                "A term in no catalogue: {words}. The hand's force gains {} ({}).",
                declared.expression,
                symbols(&declared.expression)
            ),
            "It describes the missing force; what causes it is for the bench to find out."
                .to_owned(),
        ],
        None => described(effect.description()),
    }
}

/// What the catalogue says about an effect or a trend.
pub(crate) fn described(description: &Description) -> Vec<String> {
    let Description {
        summary,
        shows_as,
        check,
        ..
    } = description;
    vec![
        (*summary).to_owned(),
        format!("How it shows: {shows_as}."),
        format!("Check at the bench: {check}"),
    ]
}

/// What the letters of an expression stand for.
fn symbols(expression: &str) -> String {
    let letters: Vec<&str> = expression
        .split(|sign: char| !sign.is_ascii_alphanumeric())
        .collect();
    let meanings = [
        ("x", "x: displacement of the grip"),
        ("v", "v: its velocity"),
        ("theta", "theta: the tool's angle"),
        ("T", "T: joint torque"),
        ("t", "t: time since the pulse began"),
        ("p", "p: its size"),
        ("x0", "x0: a displacement"),
        ("v0", "v0: a speed"),
        ("t0", "t0: a time"),
    ];
    let used = meanings
        .iter()
        .filter(|(letter, _)| letters.contains(letter));
    used.map(|(_, meaning)| *meaning)
        .collect::<Vec<_>>()
        .join(", ")
}

/// What became of an attempt to do without a term.
pub(crate) fn removal(attempt: &Attempt) -> String {
    let name = spoken(attempt.effect);
    match attempt.removed {
        true => format!("Without {name} the model predicts as well: it was taken out again."),
        false => format!(
            "Without {name} the squared error grows by {:.1} %: it stays.",
            attempt.growth * 100.0
        ),
    }
}

/// The unlisted term in words.
pub(crate) fn unlisted(
    declared: &CustomEffectSettings,
    gain: f64,
    parameters: &[EffectParameter],
    units: Units,
) -> String {
    let held_out = units.named();
    format!(
        "The simplest term that describes it is a force {} with {} ({}); it removes {:.0} % of the misfit in {held_out} that took no part in finding its size. It describes; what causes it is for the bench to find out.",
        declared.expression,
        sizes(parameters),
        symbols(&declared.expression),
        (gain * 100.0).clamp(0.0, 100.0)
    )
}

/// RON for the study's `model.custom` list: the term, starting from what was found.
pub(crate) fn paste(declared: &CustomEffectSettings, found: &[EffectParameter]) -> String {
    let pairs = declared.parameters.iter().zip(found);
    let parameters: Vec<String> = pairs
        .map(|(one, found)| {
            let mut text = format!(
                "(name: \"{}\", unit: \"{}\", start: {:.4e}",
                one.name, found.unit, found.value
            );
            for (name, bound) in [("minimum", one.minimum), ("maximum", one.maximum)] {
                if bound.is_finite() {
                    text += &format!(", {name}: {bound}");
                }
            }
            text + ")"
        })
        .collect();
    format!(
        "(name: \"{}\", place: Force, expression: \"{}\", parameters: [{}])",
        declared.name,
        declared.expression,
        parameters.join(", ")
    )
}
