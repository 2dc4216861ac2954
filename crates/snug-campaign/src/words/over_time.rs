//! From when on an effect is there, until when it was, or how it grows.

use crate::effect::size::{ChangePoint, GroupSize, GroupSizes};
use crate::tightening::factor::Factor;

/// What is said of sizes that differ by time: `from number 13 on (it may be 12 to 15) 4.1 N, none before (below 0.3 N)`; `None` of
/// other groups.
pub(super) fn sentence(sizes: &GroupSizes, unit: &str) -> Option<String> {
    let [before, after] = sizes.groups.as_slice() else {
        return None;
    };
    let change = sizes.change.as_ref();
    let of_files = match sizes.factor {
        Factor::FromNumber(_) | Factor::Course { .. } => " of each file",
        _ => "",
    };
    match &sizes.factor {
        Factor::Course { .. } => Some(course(before, after, unit, of_files)),
        Factor::FromNumber(_) | Factor::Since(_) => {
            let at = format!("{}{of_files}{}", after.group, between(change));
            Some(match (before.present, after.present) {
                (false, true) => {
                    format!("{at} {}, before {}", after.amount(unit), none(before, unit))
                }
                (true, false) => format!(
                    "{} until then, {at} {}",
                    before.amount(unit),
                    none(after, unit)
                ),
                _ => format!(
                    "{at} {}, before {}",
                    after.amount(unit),
                    before.amount(unit)
                ),
            })
        }
        _ => None,
    }
}

/// Where else the change may be.
fn between(change: Option<&ChangePoint>) -> String {
    match change {
        Some(change) if change.first != change.last => {
            format!(" (it may be {} to {})", change.first, change.last)
        }
        _ => String::new(),
    }
}

fn none(of: &GroupSize, unit: &str) -> String {
    match of.unless() {
        Some(unless) => format!("none ({})", unless.said(unit)),
        None => "none".to_owned(),
    }
}

fn course(first: &GroupSize, last: &GroupSize, unit: &str, of_files: &str) -> String {
    let way = match last.value.abs() < first.value.abs() {
        true => "falls",
        false => "grows",
    };
    let amount = |of: &GroupSize| match of.present {
        true => of.amount(unit),
        false => none(of, unit),
    };
    format!(
        "{way} evenly: {} {}, {}{of_files} {}",
        first.group,
        amount(first),
        last.group,
        amount(last)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sizes(
        factor: Factor,
        of: [(&str, (f64, f64, f64), bool); 2],
        change: Option<(&str, &str)>,
    ) -> String {
        let groups = of.map(|(name, (low, value, high), present)| GroupSize {
            group: name.to_owned(),
            tightenings: 24,
            value,
            standard_error: Some((high - low) / 4.0),
            shrunk: value,
            low: Some(low),
            high: Some(high),
            present,
        });
        let change = change.map(|(first, last)| ChangePoint {
            first: first.to_owned(),
            last: last.to_owned(),
        });
        GroupSizes {
            factor,
            groups: groups.to_vec(),
            change,
        }
        .sentence("N")
    }

    #[test]
    fn from_when_on_it_is_there() {
        let told = sizes(
            Factor::FromNumber(13),
            [
                ("up to number 12", (-0.3, 0.0, 0.3), false),
                ("from number 13 on", (3.9, 4.1, 4.3), true),
            ],
            Some(("12", "15")),
        );
        assert_eq!(
            told,
            "from number 13 on of each file (it may be 12 to 15) 4.10\u{a0}N, before none (below 0.30\u{a0}N)"
        );
    }

    #[test]
    fn until_when_it_was_there() {
        let told = sizes(
            Factor::FromNumber(13),
            [
                ("up to number 12", (3.9, 4.1, 4.3), true),
                ("from number 13 on", (-0.3, 0.0, 0.3), false),
            ],
            Some(("13", "13")),
        );
        assert_eq!(
            told,
            "4.10\u{a0}N until then, from number 13 on of each file none (below 0.30\u{a0}N)"
        );
    }

    #[test]
    fn how_it_grows() {
        let told = sizes(
            Factor::Course { first: 1, last: 30 },
            [
                ("at number 1", (1.9, 2.0, 2.1), true),
                ("at number 30", (3.9, 4.1, 4.3), true),
            ],
            None,
        );
        assert_eq!(
            told,
            "grows evenly: at number 1 2.00\u{a0}N, at number 30 of each file 4.10\u{a0}N"
        );
    }
}
