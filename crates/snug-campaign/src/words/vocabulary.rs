//! In whose words results are told: of a hand on a tool, or of a machine, which has no hand, no joint and no tightenings.
//!
//! Sentences are written for a hand on a tool; this is the one place that knows what they are on a machine.

use crate::effect::size::EffectParameter;
use crate::measurement::signal_units::SignalUnits;
use crate::words::grammar::capitalised;
use serde::Serialize;

/// In whose words results are told.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub enum Vocabulary {
    /// A hand on a tool.
    #[default]
    Hand,
    /// A machine; `None` where its signals are no mechanical quantities.
    Machine(Option<Axis>),
}

/// How a machine moves; each with its lever arm \[m\].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub enum Axis {
    /// It turns: torques in Nm, angles in rad.
    Turns(f64),
    /// It slides: forces in N, ways in m.
    Slides(f64),
}

/// What is said of a hand and a tool, and of any machine. Of two that fit, the first counts.
const OF_A_MACHINE: &[(&str, &str)] = &[
    (
        "one run of the tool on one bolt: torque builds up, then drops, and the tool kicks the hand",
        "one stretch of measurement that is evaluated by itself",
    ),
    ("mass–spring model of the hand and arm", "mass–spring model"),
    ("the hand and arm as a mass", "the rig as a mass"),
    ("hand–arm mass", "mass"),
    ("the hand–arm alone", "mass and spring alone"),
    ("of tool and hand–arm together", "of all that moves"),
    ("between tool and hand", "of spring and damper"),
    ("tool inertia", "known inertia"),
    ("acceleration lag", "lag of the motion"),
    ("tightening by tightening", "recording by recording"),
    (
        "tightening strategies Quick Step and Turbo Tight",
        "strategies, where a study declares them",
    ),
    (
        "the measured grip force, where a transducer is mounted",
        "a measured force, where a transducer is mounted",
    ),
    ("hand's force", "force"),
    ("at the grip", "at the lever arm"),
    ("of the grip", "of the rig"),
    ("the grip's displacement", "the displacement"),
    ("grip force", "force"),
    ("the joint's axis", "the axis"),
    ("measured at the joint", "measured"),
    ("joint torque", "torque"),
    ("change of torque or joint", "change of the input"),
    ("half the target torque", "half the input"),
    ("1.5 times the target torque", "1.5 times the input"),
    ("on a harder joint", "with a faster input"),
    ("on a softer joint", "with a slower input"),
    ("target torque nm", "peak torque"),
    ("target torque", "peak torque"),
    (
        "time since the pulse began",
        "time since the recording began",
    ),
    ("phase of the pulse", "phase of the recording"),
    (
        "the quiet part before the pulse",
        "the quiet part before the input begins",
    ),
    (
        "the quiet part before each pulse",
        "the quiet part before each input begins",
    ),
    ("before the pulse", "before the input begins"),
    ("rest after the rebound", "rest"),
    ("rebound", "return"),
    ("the tool's angle", "the angle"),
    ("the tool", "the rig"),
    ("tightenings", "recordings"),
    ("tightening's", "recording's"),
    ("tightening", "recording"),
    ("operator", "driver"),
    ("forearm", "base"),
    ("joints", "loads"),
    ("joint", "load"),
    ("hand", "rig"),
    ("grip", "rig"),
    ("gloves", "covers"),
    ("glove", "cover"),
];

/// The same of one that slides, beside those.
const OF_ONE_THAT_SLIDES: &[(&str, &str)] = &[
    ("joint torque t [nm]", "force [N]"),
    ("torque t [nm]", "force F [N]"),
    (
        "angle θ [rad], velocity ω [rad/s], acceleration α [rad/s²]",
        "displacement x [m], velocity v [m/s], acceleration a [m/s²]",
    ),
    ("joint torque", "force"),
    ("target torque nm", "peak force"),
    ("target torque", "peak force"),
    ("torques", "forces"),
    ("torque's", "force's"),
    ("torque", "force"),
];

impl Vocabulary {
    /// Of a machine with these signals.
    pub fn of_machine(units: &SignalUnits, lever_arm_m: f64) -> Self {
        let axis = match units.output.as_str() {
            "m" => Axis::Slides(lever_arm_m),
            _ => Axis::Turns(lever_arm_m),
        };
        Self::Machine(units.mechanical().then_some(axis))
    }

    /// A text in these words. Names of files, columns and commands stay as they are.
    pub fn says(self, text: &str) -> String {
        let tables: &[&[(&str, &str)]] = match self {
            Self::Hand => return text.to_owned(),
            Self::Machine(Some(Axis::Slides(_))) => &[OF_ONE_THAT_SLIDES, OF_A_MACHINE],
            Self::Machine(_) => &[OF_A_MACHINE],
        };
        let mut told = String::with_capacity(text.len());
        let mut rest = text;
        let mut before = None;
        while let Some(letter) = rest.chars().next() {
            let phrase = (letter.is_ascii_alphanumeric() && begins_a_word(before))
                .then(|| phrase(tables, rest))
                .flatten();
            let length = match phrase {
                Some((from, to)) => {
                    match letter.is_uppercase() {
                        true => told += &capitalised(to),
                        false => told += to,
                    }
                    from.len()
                }
                None => {
                    told.push(letter);
                    letter.len_utf8()
                }
            };
            before = rest[..length].chars().next_back();
            rest = &rest[length..];
        }
        told
    }

    /// A size about the rig's own axis: Nm on one that turns, N on one that slides.
    pub fn size(self, size: &EffectParameter) -> EffectParameter {
        match self {
            Self::Machine(Some(axis)) => axis.size(size),
            _ => size.clone(),
        }
    }

    /// By what a number in `unit` is multiplied to be told about the rig's own axis, and the unit that it then has.
    pub fn about(self, unit: &str) -> (f64, String) {
        match self {
            Self::Machine(Some(axis)) => axis.about(unit),
            _ => (1.0, unit.to_owned()),
        }
    }
}

impl Axis {
    /// By what a number in `unit` is multiplied, and the unit that it then has: τ = l F, θ = x / l.
    pub fn about(self, unit: &str) -> (f64, String) {
        let (factor, unit) = match self {
            Self::Turns(l) => match unit {
                "N" => (l, "Nm"),
                "m" => (1.0 / l, "rad"),
                "1/m" => (l, "1/rad"),
                "m/s" => (1.0 / l, "rad/s"),
                "kg" => (l * l, "kg m^2"),
                "1/kg" => (1.0 / (l * l), "1/(kg m^2)"),
                "kg/s" => (l * l, "Nm s/rad"),
                "N/m" => (l * l, "Nm/rad"),
                "N/m^2" => (l.powi(3), "Nm/rad^2"),
                "N/m^3" => (l.powi(4), "Nm/rad^3"),
                "N s^2/m^2" => (l.powi(3), "Nm s^2/rad^2"),
                same => (1.0, same),
            },
            Self::Slides(l) => match unit {
                "Nm" => (1.0 / l, "N"),
                "Nm/s" => (1.0 / l, "N/s"),
                "1/Nm" => (l, "1/N"),
                "N/Nm" => (l, "N/N"),
                "rad" => (l, "m"),
                "rad/s" => (l, "m/s"),
                "rad/s^2" => (l, "m/s^2"),
                "rad/s^3" => (l, "m/s^3"),
                same => (1.0, same),
            },
        };
        (factor, unit.to_owned())
    }

    /// A size about this axis.
    pub(crate) fn size(self, size: &EffectParameter) -> EffectParameter {
        let (factor, unit) = self.about(&size.unit);
        EffectParameter {
            unit,
            ..size.times(factor)
        }
    }
}

/// Whether a word may begin behind `before`: not within a name or a path.
fn begins_a_word(before: Option<char>) -> bool {
    before.is_none_or(|one| !one.is_alphanumeric() && !"_/`.#\u{2019}".contains(one))
}

/// The phrase that `text` begins with, and what it is told as.
fn phrase(
    tables: &[&'static [(&'static str, &'static str)]],
    text: &str,
) -> Option<(&'static str, &'static str)> {
    let mut all = tables.iter().flat_map(|table| table.iter());
    all.find(|(from, _)| {
        let is_it = text.get(..from.len());
        is_it.is_some_and(|start| start.eq_ignore_ascii_case(from))
            && ends_a_word(&text[from.len()..])
    })
    .copied()
}

/// Whether a word may end before `after`: not within a name or a path.
fn ends_a_word(after: &str) -> bool {
    let mut letters = after.chars();
    match letters.next() {
        Some('.') => !letters.next().is_some_and(char::is_alphanumeric),
        Some(one) => !one.is_alphanumeric() && !"_/`".contains(one),
        None => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CARRIAGE: Vocabulary = Vocabulary::Machine(Some(Axis::Slides(0.5)));
    const MOTOR: Vocabulary = Vocabulary::Machine(Some(Axis::Turns(0.5)));

    #[test]
    fn a_machine_has_recordings_and_a_hand_tightenings() {
        let said =
            "Tightenings of the hand, tightening's torque; tightenings.csv, most_tightenings";
        assert_eq!(Vocabulary::Hand.says(said), said);
        assert_eq!(
            MOTOR.says(said),
            "Recordings of the rig, recording's torque; tightenings.csv, most_tightenings"
        );
        assert_eq!(
            CARRIAGE.says("The torque’s sensor: joint torque, `torque`, /data/hand/joint.csv"),
            "The force’s sensor: force, `torque`, /data/hand/joint.csv"
        );
    }

    /// A friction of 2 N on an arm of 0.5 m is one of 1 Nm, and a spring of 8 N/m there one of 2 Nm/rad.
    #[test]
    fn sizes_are_about_the_rig_s_own_axis() {
        let turns = Axis::Turns(0.5);
        assert_eq!(turns.about("N"), (0.5, "Nm".into()));
        assert_eq!(turns.about("N/m"), (0.25, "Nm/rad".into()));
        assert_eq!(turns.about("1/kg"), (4.0, "1/(kg m^2)".into()));
        assert_eq!(turns.about("s"), (1.0, "s".into()));
        assert_eq!(Axis::Slides(0.5).about("Nm"), (2.0, "N".into()));
        assert_eq!(Axis::Slides(0.5).about("N"), (1.0, "N".into()));
    }
}
