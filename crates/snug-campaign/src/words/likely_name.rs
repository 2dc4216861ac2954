//! The known name that a misspelt one probably means, for errors about settings and arguments.

use strsim::normalized_damerau_levenshtein;

/// Share of the letters that must be right for a name to count as meant \[–\]. Chosen: one slip in three letters.
const LIKE: f64 = 2.0 / 3.0;
/// Bytes beyond which nothing was meant: no name is as long, and likeness takes time and memory by the square. Chosen.
const LONGEST: usize = 200;
/// Letters that must be typed before a part of a name counts as meant. Chosen.
const PART: usize = 4;

/// What an error says behind a name that nothing has: ` (did you mean `cubic_stiffness`?)`, or nothing.
///
/// Meant is the known name that differs by the fewest letters (left out, added, replaced or swapped), at most every third;
/// where there is none, every known name with a part like the unknown one. Capitals count as small letters, hyphens and
/// spaces as underscores.
pub fn did_you_mean<N: AsRef<str>>(unknown: &str, known: &[N]) -> String {
    if unknown.len() > LONGEST {
        return String::new();
    }
    let typed = plain(unknown);
    let names = || known.iter().map(AsRef::as_ref);
    let likeness = |name: &str| normalized_damerau_levenshtein(&typed, &plain(name));
    let nearest = names()
        .filter(|name| likeness(name) >= LIKE)
        .max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    let is_part = |name: &&str| {
        let name = plain(name);
        let is_like = |part: &str| normalized_damerau_levenshtein(&typed, part) >= LIKE;
        typed.len() >= PART && (name.contains(&typed) || name.split('_').any(is_like))
    };
    let meant: Vec<String> = match nearest {
        Some(name) => vec![format!("`{name}`")],
        None => names()
            .filter(is_part)
            .map(|name| format!("`{name}`"))
            .collect(),
    };
    match meant.as_slice() {
        [] => String::new(),
        some => format!(" (did you mean {}?)", some.join(" or ")),
    }
}

fn plain(name: &str) -> String {
    name.to_lowercase().replace(['-', ' '], "_")
}

#[cfg(test)]
mod tests {
    use super::*;

    const EFFECTS: [&str; 4] = [
        "cubic_stiffness",
        "quadratic_stiffness",
        "coulomb_friction",
        "torque_lag",
    ];

    #[test]
    fn a_slip_of_the_finger_is_understood() {
        for (typed, meant) in [
            ("cubic_stifness", "cubic_stiffness"),
            ("cubci_stiffness", "cubic_stiffness"),
            ("Coulomb-Friction", "coulomb_friction"),
            ("coulomb friction", "coulomb_friction"),
            ("torque_lga", "torque_lag"),
        ] {
            let question = format!(" (did you mean `{meant}`?)");
            assert_eq!(did_you_mean(typed, &EFFECTS), question);
        }
    }

    #[test]
    fn a_part_asks_for_every_name_that_has_it() {
        assert_eq!(
            did_you_mean("stiffness", &EFFECTS),
            " (did you mean `cubic_stiffness` or `quadratic_stiffness`?)"
        );
        for typed in ["friction", "frictoin"] {
            assert_eq!(
                did_you_mean(typed, &EFFECTS),
                " (did you mean `coulomb_friction`?)"
            );
        }
    }

    #[test]
    fn what_is_like_nothing_suggests_nothing() {
        for typed in ["", "lag", "gyroscope", "x"] {
            assert_eq!(did_you_mean(typed, &EFFECTS), "", "{typed}");
        }
        assert_eq!(did_you_mean("anything", &[] as &[&str]), "");
    }
}
