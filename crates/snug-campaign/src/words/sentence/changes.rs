//! That a rig changes while it is measured, as data, and the sentence it is said with.

use crate::words::effect_name::Named;
use crate::words::number::{significant, whole_percent};
use std::fmt::{self, Display, Formatter};

/// Digits of a growth.
const DIGITS: i32 = 2;

/// What of a rig goes from one value at the beginning of every recording to another at its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Changes {
    /// Which number.
    pub what: Changing,
    /// Its value at the end over that at the beginning \[–\].
    pub times: f64,
    /// Share of what a plain regression leaves without the change that it takes.
    pub taken: f64,
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

impl Display for Changes {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
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
        write!(
            f,
            "The rig changes while it is measured: from the beginning of the recordings to their end {what} {how}, and a plain regression in which it does leaves {} less. It may warm up, empty or wear; `preprocess.stretch` looks at a part of every recording alone.",
            whole_percent(self.taken)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn falls_grows_or_changes_its_sign() {
        let said = |times: f64| {
            let what = Changing::Mass;
            let changes = Changes {
                what,
                times,
                taken: 0.9,
            };
            changes.to_string().replace('\u{a0}', " ")
        };
        assert!(said(0.5).contains("the mass falls by about 50 %, and"));
        assert!(said(2.5).contains("the mass grows to about 2.5 times as much, and"));
        assert!(said(-0.1).contains("the mass changes its sign, and"));
        assert!(said(0.5).contains("leaves 90 % less"));
    }
}
