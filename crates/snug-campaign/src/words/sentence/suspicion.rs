//! What to check where no model fits, each as data, and the sentence it is said with.

use crate::words::effect_name::effect_name;
use crate::words::grammar::joined;
use crate::words::number::significant;
use crate::words::sentence::explained::at_most_all;
use std::fmt::{self, Display, Formatter};

/// Something that may be why no model fits; shares are those of the output's power that mass, damping and stiffness alone would
/// explain then \[–\].
#[derive(Debug, Clone, PartialEq)]
pub enum Suspicion {
    /// Some recordings are in other units than others.
    Units(OtherUnits),
    /// The simulated fit falls short of a plain regression.
    FailedFit(FailedFit),
    /// The fit ended in a poor minimum: where the spectra put m, c, k, they do better.
    PoorMinimum(f64),
    /// The input's sign is the other one.
    Sign(f64),
    /// The input's sign is the other one in some recordings.
    TurnedRound(TurnedRound),
    /// Input and output are swapped.
    Swapped(f64),
    /// The output is another derivative of the angle.
    Derivative {
        /// What it is declared to be.
        declared: &'static str,
        /// What it would be.
        other: &'static str,
        /// Share explained then.
        share: f64,
    },
    /// The output, which is this, lost its sign.
    NoSign(&'static str),
    /// The rig pushes itself away from where it would rest.
    PushesAway(PushesAway),
    /// The model is restarted after it has fallen away.
    RestartedTooSeldom(RestartedTooSeldom),
    /// Most effects cannot be tried on the rig.
    HardlyTried {
        /// How many were.
        tried: usize,
        /// Of how many.
        of: usize,
    },
    /// A few samples hold most of the squared error.
    Outliers {
        /// How many.
        samples: usize,
        /// Of how many.
        of: usize,
        /// Share of the squared error in them \[–\].
        share: f64,
    },
    /// Much is left of some recordings, and hardly anything of the others.
    StandsApart(StandsApart),
    /// What is left is white, so that no model could explain it.
    Noise,
    /// No torque acts in any recording, and nothing says how heavy, damped or stiff the rig is.
    Undriven,
    /// What is measured is white, as if nothing moved.
    Still,
    /// None of these helps.
    NoOscillator,
}

/// Recordings whose input has the other sign than that of the others.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnedRound {
    /// Which.
    pub recordings: Vec<String>,
    /// How many there are in all \[–\].
    pub of: usize,
    /// The least share of any of them that mass, damping and stiffness alone would explain with that sign changed \[–\].
    pub share: f64,
}

impl Display for TurnedRound {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (turned, of) = (self.recordings.len(), self.of);
        write!(f, "in {} ", among(&self.recordings, of))?;
        // Of "the others" only the few can be told.
        f.write_str(match 2 * turned < of {
            true => "the input has the other sign than in the others",
            false => "the input has another sign than the study says",
        })
    }
}

/// `r1.csv and r4.csv (2 of 5 recordings)`.
fn among(recordings: &[String], of: usize) -> String {
    format!(
        "{} ({} of {of} recordings)",
        joined(recordings),
        recordings.len()
    )
}

/// Recordings of which a model leaves far more than of the others.
#[derive(Debug, Clone, PartialEq)]
pub struct StandsApart {
    /// Which.
    pub recordings: Vec<String>,
    /// How many there are in all \[–\].
    pub of: usize,
    /// Share of the squared error in them \[–\].
    pub share: f64,
    /// How many times the largest root mean square error of the others the least of theirs is \[–\].
    pub times: f64,
}

impl Display for StandsApart {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let recordings = among(&self.recordings, self.of);
        let share = at_most_all(self.share);
        let times = significant(self.times, 2);
        write!(
            f,
            "Check what happened there: of {recordings} the model leaves {times} times the error that it leaves of any other, {share} of the squared error in all. A zero that jumped, a cable that caught, a load that was put on: look at it in report.html, and record anew or leave it out."
        )
    }
}

/// Two files, or people, whose masses, dampings and stiffnesses stand apart by one factor.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherUnits {
    /// Whose are larger.
    pub larger: String,
    /// Whose are smaller.
    pub smaller: String,
    /// How many times \[–\].
    pub factor: f64,
    /// Whether a prefix of a unit (milli, micro) would explain it; otherwise another load is the likelier.
    pub is_prefix: bool,
}

impl Display for OtherUnits {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "what moves in {} is {} times as heavy, as damped or as stiff as in {}",
            self.larger,
            significant(self.factor, 2),
            self.smaller
        )
    }
}

/// A simulated fit beside a plain regression of the equation of motion; shares are those of the measured acceleration's power, averaged
/// over neighbouring samples \[–\].
#[derive(Debug, Clone, PartialEq)]
pub struct FailedFit {
    /// Effects of the model.
    pub effects: Vec<String>,
    /// Whether the regression has dry friction and an offset beside them.
    pub is_plain: bool,
    /// Share that the regression explains.
    pub promised: f64,
    /// Share that the numbers of the fit explain; below 0 where no motion at all would do better.
    pub kept: f64,
    /// Mass, damping and stiffness as the regression puts them.
    pub sizes: Vec<(String, f64)>,
}

impl Display for FailedFit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let kept = match self.kept > 0.0 {
            true => at_most_all(self.kept),
            false => "nothing".to_owned(),
        };
        write!(
            f,
            "A plain regression of acceleration on {} explains {}, the simulated fit {kept}: the fit failed, and its numbers are no physics. Start it from the regression's (`model.parameters`): {}. Where it fails from there, too, hold them (`fixed: true`): `compare` then shows where a simulation with them leaves the measurement.",
            regressed_on(&self.effects, self.is_plain),
            at_most_all(self.promised),
            sized(&self.sizes)
        )
    }
}

/// What a plain regression of the equation of motion says of a rig that pushes itself away from where it would rest.
#[derive(Debug, Clone, PartialEq)]
pub struct PushesAway {
    /// Effects beside mass, damping and stiffness, which bring it back from further away.
    pub effects: Vec<String>,
    /// Share of the measured acceleration's power that it explains \[–\].
    pub promised: f64,
    /// Mass, damping and stiffness as the regression puts them.
    pub sizes: Vec<(String, f64)>,
    /// Time in which it falls away to e times as far, undamped \[s\].
    pub falls_in_s: f64,
}

impl Display for PushesAway {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self.effects.is_empty() {
            true => {
                "Check whether a controller holds the rig where it would not stay, as it does an upright pendulum or an armature near a magnet"
            }
            false => {
                "Check whether the rig rests on either side of its zero and not there, as a beam does that has buckled, or is held there"
            }
        })?;
        write!(
            f,
            ": a plain regression of acceleration on {} explains {} with a stiffness below 0 ({}). If so, let it be below in the study, begin there (`model.parameters`), and restart the model before it falls away: `identify: (constraints: [], simulation: Restarted(every_s: {:.1e}))`.",
            regressed_on(&self.effects, false),
            at_most_all(self.promised),
            sized(&self.sizes),
            self.falls_in_s
        )
    }
}

/// On what the acceleration is regressed.
fn regressed_on(effects: &[String], is_plain: bool) -> String {
    let mut on: Vec<String> = ["torque", "speed", "angle"].map(str::to_owned).to_vec();
    on.extend(effects.iter().map(|name| effect_name(name)));
    if is_plain {
        on.extend(["the sign of the speed", "a constant"].map(str::to_owned));
    }
    joined(&on)
}

/// How often a model of a rig that pushes itself away is restarted, and how fast it falls away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestartedTooSeldom {
    /// From one restart to the next \[s\].
    pub every_s: f64,
    /// Time in which it falls away to e times as far, undamped \[s\].
    pub falls_in_s: f64,
}

impl RestartedTooSeldom {
    /// What comes of it, as a clause.
    pub fn so_that(&self) -> String {
        format!(
            "it falls away from where it would rest, and errors of the measured motion that is taken up grow {} times as large in the {} s until the next restart",
            significant((self.every_s / self.falls_in_s).exp(), 2),
            significant(self.every_s, 2)
        )
    }
}

impl Display for RestartedTooSeldom {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "Check how often the model is restarted: {}. Whatever grows likewise, as a limit or a lag, would make up for them. In the study: `identify: (simulation: Restarted(every_s: {:.1e}))`.",
            self.so_that(),
            self.falls_in_s
        )
    }
}

fn sized(sizes: &[(String, f64)]) -> String {
    let sizes = sizes.iter();
    let told = sizes.map(|(name, value)| format!("{name} {}", significant(*value, 3)));
    told.collect::<Vec<_>>().join(", ")
}

impl Display for Suspicion {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Units(units) if units.is_prefix => write!(
                f,
                "Check the units: {units}. Torque, motion or time of one of them is in another unit than the study says (`unit` of its channel), or was logged in one. If it is another load, say so in the study: `diagnosis: (search: (loads_differ: true))`."
            ),
            Self::Units(units) => write!(
                f,
                "Check the load: {units}. If that is no other load, torque, motion or time of one of them is in another unit than the study says (`unit` of its channel); if it is, `diagnosis: (search: (loads_differ: true))` in the study says so."
            ),
            Self::FailedFit(failed) => failed.fmt(f),
            Self::PoorMinimum(share) => write!(
                f,
                "Check the starting values: where the spectra put them, mass, damping and stiffness alone explain {}, so the fit ended in a poor minimum. Leave m, c and k out of the study's `model.parameters`, or start them elsewhere.",
                at_most_all(*share)
            ),
            Self::Sign(share) => write!(
                f,
                "Check the sign: with that of the input changed, mass, damping and stiffness alone would explain {}.",
                at_most_all(*share)
            ),
            Self::TurnedRound(turned) => write!(
                f,
                "Check the sign: {turned}, or its output has. With it changed, mass, damping and stiffness alone would explain {} there or more, with it as it is less than half. Turn one of the two round in the file, or leave it out.",
                at_most_all(turned.share)
            ),
            Self::Swapped(share) => write!(
                f,
                "Check which column is which: with input and output swapped, mass, damping and stiffness alone would explain {}.",
                at_most_all(*share)
            ),
            Self::Derivative {
                declared,
                other,
                share,
            } => write!(
                f,
                "Check the kind of the output: were what is declared as {declared} the {other}, mass, damping and stiffness alone would explain {}.",
                at_most_all(*share)
            ),
            Self::NoSign(output) => write!(
                f,
                "Check whether the output has its sign: the {output} never goes below 0, but turns about there as at a wall. A sensor makes it so that tells how large it is and not which way, as a counter of pulses does of a speed: no model follows that, so measure which way, too. If the rig does hit a wall there, the sign is right."
            ),
            Self::PushesAway(pushes) => pushes.fmt(f),
            Self::RestartedTooSeldom(seldom) => seldom.fmt(f),
            Self::HardlyTried { tried, of } => write!(
                f,
                "Check the sampling rate: {tried} of {of} candidates could be tried, since with the others the rig cannot be simulated from one sample to the next. Sample faster, or state the unit of the time column or the rate if it is another; a rig without inertia has none of the effects that need it."
            ),
            Self::Outliers { samples, of, share } => write!(
                f,
                "Check the recordings for spikes and dropouts: {samples} of {of} samples hold {} of the squared error.",
                at_most_all(*share)
            ),
            Self::StandsApart(apart) => apart.fmt(f),
            Self::Noise => f.write_str(
                "Check the sensor: what is left is white, each sample apart from its neighbours, as noise is and no motion. A model cannot explain it; filter it where it is measured, drive the rig harder, or measure its noise (a quiet part before the input begins) so that it can be counted off.",
            ),
            Self::Undriven => f.write_str(
                "The input is zero in all recordings, and a free motion shows mass, damping and stiffness as ratios only. If a torque acted, check the input's column; if none did, hold one of the three in the study at what it is: `model: (parameters: {\"mass_kg\": (value: 1.0, fixed: true)})`, for example.",
            ),
            Self::Still => f.write_str(
                "Nothing moves in these recordings: what is measured is white, each sample apart from its neighbours, as noise is and no motion. Check the output's column, or record while the input changes.",
            ),
            Self::NoOscillator => f.write_str(
                "Another sign, swapped channels or another derivative of the angle would not help. The rig may be no mass on a spring and damper, several modes may move at once, or something else than the logged input drives it. Units and sampling rate are not to blame: the fit is the same in any.",
            ),
        }
    }
}
