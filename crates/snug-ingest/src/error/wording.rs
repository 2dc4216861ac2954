//! Lists and numbers as messages show them.

use crate::unit::Unit;
use snug_campaign::did_you_mean;
use snug_campaign::excerpt;

pub(super) fn megabytes(bytes: &u64) -> u64 {
    bytes.div_ceil(1_000_000)
}

pub(super) fn units(units: &[Unit]) -> String {
    let names: Vec<String> = units.iter().map(|unit| format!("{unit:?}")).collect();
    names.join(", ")
}

/// The first names of a list, and how many more there are.
pub(super) fn listed(names: &[String]) -> String {
    const SHOWN: usize = 12;
    match names.len() {
        0 => "nothing".to_owned(),
        1..=SHOWN => excerpts(names),
        count => format!("{} and {} more", excerpts(&names[..SHOWN]), count - SHOWN),
    }
}

/// Which of a file's names was meant; in a file with thousands, or of names that nobody types, nothing is said of them.
pub(super) fn meant(accepted: &[String], present: &[String]) -> String {
    const LOOKED_AT: usize = 1000;
    const LONGEST: usize = 100;
    let typed: Vec<&String> = present
        .iter()
        .take(LOOKED_AT)
        .filter(|name| name.len() <= LONGEST)
        .collect();
    let meant: String = accepted
        .iter()
        .map(|name| did_you_mean(name, &typed))
        .collect();
    excerpt(&meant)
}

fn excerpts(names: &[String]) -> String {
    let shown: Vec<String> = names.iter().map(|name| excerpt(name)).collect();
    shown.join(", ")
}
