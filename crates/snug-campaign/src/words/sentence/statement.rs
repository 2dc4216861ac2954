//! What a table of a diagnosis says of one of its rows, in a sentence.

use crate::effect::detectability::InSomeGroups;
use crate::effect::size::EffectParameter;
use crate::words::effect_name::effect_name;
use crate::words::number::{percent, significant, whole_percent};
use crate::words::sentence::reason::Cluster;
use crate::words::size::{amount, sizes};

/// What the sentences of every explanation of a catalogue effect are.
pub fn described(summary: &str, shows_as: &str, check: &str) -> Vec<String> {
    vec![
        summary.to_owned(),
        format!("How it shows: {shows_as}."),
        format!("Check at the bench: {check}"),
    ]
}

/// What a term in no catalogue is.
pub fn described_unlisted(expression: &str, says: &str) -> Vec<String> {
    vec![
        format!(
            "A term in no catalogue: {says}. The hand's force gains {expression} ({}).",
            symbols(expression)
        ),
        "It describes the missing force; what causes it is for the bench to find out.".to_owned(),
    ]
}

/// The simplest term for what no effect of the catalogue explains.
pub fn unlisted(
    expression: &str,
    parameters: &[EffectParameter],
    heldout_gain: f64,
    cluster: Cluster,
) -> String {
    format!(
        "The simplest term that describes it is a force {expression} with {} ({}); it removes {} of the misfit in {} that took no part in finding its size. It describes; what causes it is for the bench to find out.",
        sizes(parameters),
        symbols(expression),
        whole_percent(heldout_gain.clamp(0.0, 1.0)),
        cluster.plural()
    )
}

/// What became of an attempt to do without a term.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// It stays.
    Stays,
    /// It went: the model predicts as well without it.
    PredictsAsWell,
    /// It went: the interval of its size holds nothing.
    MayBeNothing,
    /// It went: it took little, and what is left stays a motion.
    StandsIn,
}

/// The same in words; `growth` of the squared error without the term, as a share of it.
pub fn removal(name: &str, fate: Fate, growth: f64) -> String {
    let would = || format!("Without {name} the squared error would {}", grow(growth));
    match fate {
        Fate::Stays => format!("{}: it stays.", would()),
        Fate::PredictsAsWell => {
            format!("Without {name} the model predicts as well: it was taken out again.")
        }
        Fate::MayBeNothing => {
            format!(
                "There may be nothing of {name}, says the interval of its size: it was taken out again."
            )
        }
        Fate::StandsIn => format!(
            "{}, and what is left stays a motion with it, too: it may stand in for something else, and was taken out again.",
            would()
        ),
    }
}

/// What an error would do that grows by `share` of itself: `grow by 3.1 %`, `be 12 times as large`.
pub fn grow(share: f64) -> String {
    match share < 1.0 {
        true => format!("grow by {}", percent(share)),
        false => format!("be {} times as large", significant(1.0 + share, 2)),
    }
}

/// How large an effect could be without having been seen.
pub fn detectability(
    effect: &str,
    smallest: Option<f64>,
    unit: &str,
    in_some: Option<&InSomeGroups>,
) -> String {
    let name = effect_name(effect);
    let all = match smallest {
        Some(size) => format!("{name}: absent or smaller than {}.", amount(size, unit)),
        None => {
            format!("{name}: these data could not show it, even at its largest plausible size.")
        }
    };
    match in_some.filter(|_| smallest.is_some()) {
        Some(some) => format!("{all} {}", in_some_groups(some, unit)),
        None => all,
    }
}

/// What would be found where only some groups have it.
pub fn in_some_groups(some: &InSomeGroups, unit: &str) -> String {
    let of = format!("{} {}", some.groups, some.factor.plural());
    match (some.in_one, some.fewest) {
        (Some(size), _) => format!(
            "If one of {of} has it, found from {} on.",
            amount(size, unit)
        ),
        (None, Some(fewest)) => {
            format!("At its largest plausible size found where {fewest} of {of} have it.")
        }
        (None, None) => format!("Found only where all {of} have it."),
    }
}

/// The experiment that tells two effects apart; `None` tightenings where none of the tried conditions does.
pub fn experiment(between: &[String; 2], conditions: &str, tightenings: Option<usize>) -> String {
    let [first, second] = between;
    match tightenings {
        Some(1) => {
            format!("To tell {first} from {second}: one more tightening {conditions} is enough.")
        }
        Some(number) => {
            format!(
                "To tell {first} from {second}: make about {number} more tightenings {conditions}."
            )
        }
        None => format!(
            "No change of torque or joint that was tried tells {first} from {second}: the two need a look at the bench."
        ),
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_twice_is_told_as_a_factor() {
        assert_eq!(grow(0.0312), "grow by 3.1 %");
        assert_eq!(grow(961.58), "be 963 times as large");
    }
}
