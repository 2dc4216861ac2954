//! Whose effect it is, and how large for whom.

use crate::effect::size::{GroupSize, GroupSizes};
use crate::words::effect_name::unit_text;
use crate::words::grammar::joined;
use crate::words::group_size::Unless;
use crate::words::over_time;

/// Groups that are told one by one; of more the largest so many, and how many there are. Chosen.
const TOLD: usize = 8;

impl GroupSizes {
    /// Whose it is: `in 3 of 6 participants: TP1 4.04 N, TP3 3.99 N, TP4 3.96 N; none in TP2, TP5, TP6 (below 0.073 N)`. Of groups
    /// that all have it their sizes.
    pub fn sentence(&self, unit: &str) -> String {
        let unit = unit_text(unit);
        if let Some(told) = over_time::sentence(self, &unit) {
            return told;
        }
        let mut with: Vec<&GroupSize> = self.groups.iter().filter(|one| one.present).collect();
        let without: Vec<&GroupSize> = self.groups.iter().filter(|one| !one.present).collect();
        let plural = self.factor.plural();
        let whose = match (with.len(), without.len()) {
            (0, all) => return format!("in none of {all} {plural}"),
            (all, 0) => format!("in all {all} {plural}"),
            (some, _) => format!("in {some} of {} {plural}", self.groups.len()),
        };
        if with.len() > TOLD {
            with.sort_by(|a, b| b.value.abs().total_cmp(&a.value.abs()));
        }
        let mut told: Vec<String> = with.iter().take(TOLD).map(|one| one.said(&unit)).collect();
        if with.len() > TOLD {
            told.push(format!("and {} more, less each", with.len() - TOLD));
        }
        let told = told.join(", ");
        match without.as_slice() {
            [] => format!("{whose}: {told}"),
            none => format!("{whose}: {told}; {}", nothing(none, &unit)),
        }
    }
}

impl GroupSize {
    fn said(&self, unit: &str) -> String {
        format!("{} {}", self.group, self.amount(unit))
    }
}

/// Who is without it, and below which size.
fn nothing(without: &[&GroupSize], unit: &str) -> String {
    let names: Vec<String> = without.iter().map(|one| one.group.clone()).collect();
    let who = match names.len() > TOLD {
        true => format!("none in the other {}", names.len()),
        false => format!("none in {}", joined(&names)),
    };
    let all: Option<Vec<Unless>> = without.iter().map(|one| one.unless()).collect();
    match all.and_then(|all| all.into_iter().reduce(Unless::or)) {
        Some(unless) => format!("{who} ({})", unless.said(unit)),
        None => who,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tightening::factor::Factor;

    fn group(name: &str, (low, value, high): (f64, f64, f64), present: bool) -> GroupSize {
        GroupSize {
            group: name.to_owned(),
            tightenings: 4,
            value,
            standard_error: Some((high - low) / 4.0),
            shrunk: value,
            low: Some(low),
            high: Some(high),
            present,
        }
    }

    fn sizes(groups: Vec<GroupSize>) -> GroupSizes {
        GroupSizes {
            factor: Factor::Participant,
            groups,
            change: None,
        }
    }

    #[test]
    fn who_has_it_and_who_has_not() {
        let some = sizes(vec![
            group("TP1", (3.9, 4.1, 4.3), true),
            group("TP2", (0.0, 0.0, 0.3), false),
            group("TP3", (3.7, 3.9, 4.1), true),
            group("TP5", (0.0, 0.1, 0.2), false),
        ]);
        assert_eq!(
            some.sentence("N"),
            "in 2 of 4 participants: TP1 4.10\u{a0}N, TP3 3.90\u{a0}N; none in TP2 and TP5 (below 0.30\u{a0}N)"
        );
    }

    #[test]
    fn all_have_it_or_none() {
        let all = sizes(vec![
            group("TP1", (1.0, 2.0, 3.0), true),
            group("TP2", (4.0, 5.0, 6.0), true),
        ]);
        assert_eq!(
            all.sentence("N"),
            "in all 2 participants: TP1 2.0\u{a0}N, TP2 5.0\u{a0}N"
        );
        let none = sizes(vec![group("TP1", (-1.0, 0.0, 1.0), false); 3]);
        assert_eq!(none.sentence("N"), "in none of 3 participants");
    }

    #[test]
    fn of_two_hundred_the_largest_are_named() {
        let many = (0..200).map(|n| {
            let present = n % 10 == 0;
            let value = if present { f64::from(n) + 1.0 } else { 0.0 };
            group(
                &format!("tool {n}"),
                (value - 0.5, value, value + 0.5),
                present,
            )
        });
        let told = sizes(many.collect()).sentence("N");
        assert!(
            told.starts_with("in 20 of 200 participants: tool 190 191.00\u{a0}N, tool 180 "),
            "{told}"
        );
        assert!(
            told.ends_with("and 12 more, less each; none in the other 180 (below 0.50\u{a0}N)"),
            "{told}"
        );
    }

    #[test]
    fn of_a_mass_that_hardly_moves_it_is_said_above_which_it_would_be() {
        let without_end = |name: &str, low: f64| GroupSize {
            high: None,
            ..group(name, (low, 1e6, 1e6), false)
        };
        let all = vec![
            group("TP1", (1.41, 1.463, 1.52), true),
            without_end("TP2", 12.4),
            without_end("TP3", 33.0),
        ];
        assert_eq!(
            sizes(all).sentence("kg"),
            "in 1 of 3 participants: TP1 1.463\u{a0}kg; none in TP2 and TP3 (above 12\u{a0}kg)"
        );
    }
}
