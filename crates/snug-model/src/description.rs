//! What an effect says of itself: name, equation, parameters with their ranges, and how it shows; never a number of a fit.

use snug_campaign::Quantity;

/// Where in the chain from bolt to sample an effect sits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Passive mechanics of hand, arm and grip.
    Mechanical,
    /// Muscles and nerves.
    Muscular,
    /// How a drive gives what it is told.
    Drive,
    /// Sensors and their alignment.
    Measurement,
    /// Change from tightening to tightening.
    Trend,
    /// A law that the study wrote itself.
    Custom,
}

impl Kind {
    /// What it is called in texts and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mechanical => "mechanical",
            Self::Muscular => "muscular",
            Self::Drive => "drive",
            Self::Measurement => "measurement",
            Self::Trend => "trend",
            Self::Custom => "custom",
        }
    }
}

/// On which rigs an effect may be what is missing. Who looks for what is missing tries no other: with every further candidate,
/// what is missing must be clearer to be named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ActsOn {
    /// A hand on a tool, and machines.
    Anything,
    /// A hand on a tool only.
    Hands,
    /// Machines only: rigs that nobody holds.
    Machines,
    /// Machines only, as long as they make no more than a few turns.
    MachinesOfFewTurns,
}

impl ActsOn {
    /// What it is called in texts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Anything => "a hand on a tool and machines",
            Self::Hands => "a hand on a tool",
            Self::Machines => "machines, which nobody holds",
            Self::MachinesOfFewTurns => "machines, which nobody holds, of a few turns",
        }
    }
}

/// Over what an effect's parameter is constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scope {
    /// A property of the rig or the sensor: may be shared by tightenings.
    Shared,
    /// Each tightening has its own.
    PerTightening,
}

/// Unit of a parameter that is added to the fitted output, whichever that is: rad, rad/s or rad/s².
pub const OUTPUT_UNIT: &str = "output unit";

/// Unit of what is added to the fitted output with every second.
pub const OUTPUT_UNIT_PER_SECOND: &str = "output unit/s";

/// One parameter of an effect; its numbers are in its unit.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct ParameterSpec {
    /// Name with unit suffix.
    pub name: &'static str,
    /// What it is, in a few words.
    pub meaning: &'static str,
    /// Unit as people write it.
    pub unit: &'static str,
    /// Starting values, the usual one first; more than one where the cost has several minima.
    pub starts: &'static [f64],
    /// Smallest plausible value.
    pub minimum: f64,
    /// Largest plausible value.
    pub maximum: f64,
    /// What a fit may reach: beyond what is plausible, where the law still means something. An estimate there says that
    /// something is wrong, and how much; one held at the edge of the plausible would hide it.
    pub limits: (f64, f64),
    /// Value at which the effect is not there, to computing precision; none for a parameter that only shapes it: a time or a
    /// length whose zero would mean something else.
    pub vanishes_at: Option<f64>,
    /// Over what it is constant.
    pub scope: Scope,
}

impl ParameterSpec {
    /// Its unit where the fitted output is this one.
    pub fn unit_where(&self, output: Quantity) -> &'static str {
        match self.unit {
            OUTPUT_UNIT => output.unit(),
            OUTPUT_UNIT_PER_SECOND => match output {
                Quantity::Displacement => Quantity::Velocity.unit(),
                Quantity::Velocity => Quantity::Acceleration.unit(),
                Quantity::Acceleration => "rad/s^3",
            },
            unit => unit,
        }
    }
}

/// States what an effect is and its equation once: `SUMMARY` and `EQUATION` for its [`Description`], and both as `page!()` for
/// the documentation of its variant of the catalogue's enum, which takes literals only.
macro_rules! state {
    (summary: $summary:literal, equation: $equation:literal,) => {
        const SUMMARY: &str = $summary;
        const EQUATION: &str = $equation;

        macro_rules! page {
            () => {
                concat!($summary, "\n\n```text\n", $equation, "\n```")
            };
        }
        pub(super) use page;
    };
}
pub(crate) use state;

/// What an effect's texts are on a rig that nobody holds, as far as they differ from those of a hand on a tool.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct OnMachine {
    /// In place of the summary.
    pub summary: Option<&'static str>,
    /// In place of how it shows.
    pub shows_as: Option<&'static str>,
    /// What to check at the bench.
    pub check: &'static str,
}

/// What people read about an effect; the catalogue's text, bounds, columns and help all come from here.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Description {
    /// Fixed name in snake case.
    pub name: &'static str,
    /// Where it sits.
    pub kind: Kind,
    /// On which rigs it may be what is missing.
    pub acts_on: ActsOn,
    /// One sentence in plain words.
    pub summary: &'static str,
    /// What is added to the model's equations.
    pub equation: &'static str,
    /// Its parameters.
    pub parameters: &'static [ParameterSpec],
    /// Names of its own states, all zero at the start.
    pub states: &'static [&'static str],
    /// Effects that look alike in data.
    pub twins: &'static [&'static str],
    /// What has to happen in a tightening for it to show.
    pub excited_by: &'static str,
    /// How it shows in the residual of a model without it.
    pub shows_as: &'static str,
    /// What to check at the bench when it is suspected.
    pub check: &'static str,
    /// What is said instead on a machine, where that differs.
    pub on_machine: Option<OnMachine>,
    /// What the law holds for and where it stops: amplitude, time scale, rig.
    pub valid_for: &'static str,
    /// Where it comes from in the literature.
    pub source: &'static str,
}

impl Description {
    /// The same in the words of a machine.
    pub fn of_machine(self) -> Self {
        match self.on_machine {
            Some(words) => Self {
                summary: words.summary.unwrap_or(self.summary),
                shows_as: words.shows_as.unwrap_or(self.shows_as),
                check: words.check,
                ..self
            },
            None => self,
        }
    }

    /// Whether its sizes are accelerations, or it comes of how an acceleration is measured.
    pub fn of_accelerometer(&self) -> bool {
        let is_acceleration = |spec: &ParameterSpec| spec.unit == "rad/s^2";
        self.parameters.iter().any(is_acceleration) || self.equation.starts_with("a ")
    }
}
