//! That a rig changes while it is measured, as data, and the sentence it is said with.

use crate::words::effect_name::Named;
use crate::words::grammar::joined;
use crate::words::number::{significant, whole_percent};
use std::fmt::{self, Display, Formatter};

/// Digits of a growth.
const DIGITS: i32 = 2;

/// What of a rig goes from one value at the beginning of recordings to another at their end.
#[derive(Debug, Clone, PartialEq)]
pub struct Changes {
    /// Which number.
    pub what: Changing,
    /// Its value at the end over that at the beginning \[–\].
    pub times: f64,
    /// Share of what a plain regression leaves without the change that it takes.
    pub taken: f64,
    /// Share of the recording after which it changes at once; `None` where it does so evenly.
    pub after: Option<f64>,
    /// The recordings that change; empty where all do.
    pub only_in: Vec<String>,
}

/// A number of a rig.
#[derive(Debug, Clone, PartialEq)]
pub enum Changing {
    /// Its mass.
    Mass,
    /// Its damping.
    Damping,
    /// Its stiffness.
    Stiffness,
    /// The size of an effect.
    Size(Named),
}

impl Changes {
    /// What changes, when and by how much: `from beginning to end of each recording the mass falls by about 50 %`.
    pub fn clause(&self) -> String {
        let what = match &self.what {
            Changing::Mass => "the mass".to_owned(),
            Changing::Damping => "the damping".to_owned(),
            Changing::Stiffness => "the stiffness".to_owned(),
            Changing::Size(effect) => effect.spoken(),
        };
        let how = match self.times {
            times if times < 0.0 => "changes its sign".to_owned(),
            times if times < 1.0 => format!("falls by about {}", whole_percent(1.0 - times)),
            times => format!(
                "grows to about {} times as much",
                significant(times, DIGITS)
            ),
        };
        let of = match self.only_in.as_slice() {
            [] => "each recording".to_owned(),
            some => joined(some),
        };
        let when = match self.after {
            None => format!("from beginning to end of {of}"),
            Some(share) => format!("at once, after about {} of {of},", whole_percent(share)),
        };
        format!("{when} {what} {how}")
    }

    /// Whether it is the time between input and output, which is no matter of the rig.
    fn is_delay(&self) -> bool {
        matches!(&self.what, Changing::Size(effect) if effect.effect == "torque_delay")
    }
}

impl Display for Changes {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let why = match (self.is_delay(), self.after) {
            (true, None) => {
                "Input and output may be logged by two clocks, of which one goes faster"
            }
            (true, Some(_)) => "One of input and output may have lost samples there",
            (false, None) => "It may warm up, empty or wear",
            (false, Some(_)) => "Something may be put on, come off, break or be set otherwise",
        };
        write!(
            f,
            "The rig changes while it is measured: {}, and a plain regression in which it does leaves {} less. {why}; `preprocess.stretch` looks at a part of every recording alone.",
            self.clause(),
            whole_percent(self.taken)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(times: f64, after: Option<f64>, only_in: &[&str]) -> String {
        let changes = Changes {
            what: Changing::Mass,
            times,
            taken: 0.9,
            after,
            only_in: only_in.iter().map(|&name| name.to_owned()).collect(),
        };
        changes.to_string().replace('\u{a0}', " ")
    }

    #[test]
    fn where_and_when_it_does() {
        let evenly = of(0.5, None, &[]);
        assert!(evenly.contains("from beginning to end of each recording the mass falls by"));
        let at_once = of(1.5, Some(0.5), &["r1.csv", "r3.csv"]);
        let said = "at once, after about 50 % of r1.csv and r3.csv, the mass grows to";
        assert!(at_once.contains(said), "{at_once}");
        assert!(at_once.contains("put on"), "{at_once}");
    }

    #[test]
    fn a_delay_that_changes_is_no_matter_of_the_rig() {
        let said = |after: Option<f64>| {
            let delay = Changing::Size(Named::alone("torque_delay".to_owned(), None));
            let changes = Changes {
                what: delay,
                times: -1.0,
                taken: 0.9,
                after,
                only_in: Vec::new(),
            };
            changes.to_string()
        };
        assert!(
            said(None).contains("logged by two clocks"),
            "{}",
            said(None)
        );
        assert!(said(Some(0.4)).contains("lost samples"));
        assert!(!said(None).contains("wear"));
    }

    #[test]
    fn falls_grows_or_changes_its_sign() {
        let said = |times: f64| of(times, None, &[]);
        assert!(said(0.5).contains("the mass falls by about 50 %, and"));
        assert!(said(2.5).contains("the mass grows to about 2.5 times as much, and"));
        assert!(said(-0.1).contains("the mass changes its sign, and"));
        assert!(said(0.5).contains("leaves 90 % less"));
    }
}
