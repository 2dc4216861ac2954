//! Which column is taken for what: by its name, or by its numbers.

use super::events::Pulse;
use super::numbers::{derivative, is_constant, median_step, rises, runs_away, short, work};
use super::roles::{self, Meaning};
use super::units::{self, unit_of};
use super::{DraftColumn, told_place};
use crate::error::StudyError;
use snug_campaign::Quantity;
use snug_ingest::csv::TimeUnit;
use snug_ingest::survey::{Survey, SurveyedColumn, SurveyedFormat};
use snug_ingest::{Signal, Unit};
use std::path::Path;

/// A column that the study declares.
#[derive(Debug, Clone)]
pub(super) struct Taken {
    pub(super) column: SurveyedColumn,
    pub(super) signal: Signal,
    pub(super) unit: Unit,
    /// Factor before the unit.
    pub(super) scale: f64,
    pub(super) why: String,
}

/// Where times come from.
#[derive(Debug, Clone)]
pub(super) enum Clock {
    Column(Box<SurveyedColumn>, TimeUnit),
    Rate { hz: f64, why: String },
}

/// What the study will say.
#[derive(Debug, Clone)]
pub(super) struct Choice {
    pub(super) format: SurveyedFormat,
    pub(super) taken: Vec<Taken>,
    pub(super) clock: Clock,
    /// Where each recording is a tightening, its pulse.
    pub(super) pulse: Option<Pulse>,
    pub(super) notes: Vec<String>,
    /// What is said of each column of the survey.
    whys: Vec<String>,
}

impl Choice {
    /// # Errors
    /// [`StudyError::NothingToDraft`] where no column can be the input, or none a motion.
    pub(super) fn of(file: &Path, found: &Survey) -> Result<Self, StudyError> {
        let mut choice = Self {
            format: SurveyedFormat::of(file).unwrap_or(SurveyedFormat::Csv),
            taken: Vec::new(),
            clock: Clock::Rate {
                hz: 1.0,
                why: String::new(),
            },
            pulse: None,
            notes: Vec::new(),
            whys: vec![String::new(); found.columns.len()],
        };
        let mut open = choice.first_look(found);
        choice.set_clock(found, &mut open);
        choice.take_by_name(found, &mut open);
        if choice.motions().next().is_none() {
            choice.take_derivatives(found, &mut open);
        }
        choice.take_the_rest(file, found, &mut open)?;
        choice.compare_motions();
        choice.turn_the_input();
        choice.try_the_sign(file);
        for (place, meaning) in open {
            choice.whys[place] = match meaning {
                Meaning::Wanted => {
                    "not taken: by its name what was wanted, not what was measured".to_owned()
                }
                Meaning::Validation => "not taken: by its name kept for validation".to_owned(),
                _ => "not taken".to_owned(),
            };
        }
        Ok(choice)
    }

    /// The columns that change, with what their names say.
    fn first_look(&mut self, found: &Survey) -> Vec<(usize, Meaning)> {
        let mut open = Vec::new();
        for (place, column) in found.columns.iter().enumerate() {
            if is_constant(&column.values) {
                self.whys[place] = "not taken: it does not change".to_owned();
            } else {
                open.push((place, roles::meaning(&column.name)));
            }
        }
        open
    }

    fn set_clock(&mut self, found: &Survey, open: &mut Vec<(usize, Meaning)>) {
        let column = |place: usize| &found.columns[place];
        let is_named = |&(place, meaning): &(usize, Meaning)| {
            meaning == Meaning::Time && median_step(&column(place).values) > 0.0
        };
        let counts_up = |&(place, meaning): &(usize, Meaning)| {
            meaning == Meaning::Unknown
                && column(place).name.is_empty()
                && rises(&column(place).values)
        };
        let at = open
            .iter()
            .position(is_named)
            .or_else(|| open.iter().position(counts_up));
        if let Some(at) = at {
            let (place, meaning) = open.remove(at);
            let unit = roles::time_unit(&column(place).unit, &column(place).name);
            let why = match meaning {
                Meaning::Time => "by its name",
                _ => "it has no name and rises evenly",
            };
            let (unit, unit_told) = match (unit, units::since_1970(&column(place).values)) {
                (Some(unit), _) => (unit, String::new()),
                (None, Some(unit)) => {
                    let told = format!("; no unit given: {unit:?}s since 1970, by its size");
                    (unit, told.to_lowercase())
                }
                (None, None) => (TimeUnit::default(), "; no unit given: s".to_owned()),
            };
            let step_s = median_step(&column(place).values) * unit.seconds();
            self.whys[place] = format!("time, {why}: {} Hz{unit_told}", short(1.0 / step_s));
            self.clock = Clock::Column(Box::new(column(place).clone()), unit);
            return;
        }
        let rate = found.numbers.iter().find_map(|(name, value)| {
            let hz = if roles::is_rate(name)? {
                *value
            } else {
                1.0 / *value
            };
            (hz.is_finite() && hz > 0.0).then(|| (hz, format!("the file says {name} = {value}")))
        });
        self.clock = match rate {
            Some((hz, why)) => {
                self.notes
                    .push(format!("Sampled at {} Hz: {why}.", short(hz)));
                Clock::Rate { hz, why }
            }
            None => {
                let why = "nothing says how fast it was sampled: 1 Hz stands for it, and every time counts samples; write the \
                           true rate here";
                self.notes
                    .push(format!("No time and no rate: {why} (sampling)."));
                Clock::Rate {
                    hz: 1.0,
                    why: why.to_owned(),
                }
            }
        };
    }

    /// Takes recordings for tightenings where each holds one pulse, and times are known.
    pub(super) fn set_window(&mut self, pulse: Option<Pulse>) {
        self.pulse = pulse.filter(|_| self.interval_s().is_some());
        if let Some(Pulse { start_s, length_s }) = self.pulse {
            self.notes.push(format!(
                "Each recording is a tightening: one pulse of the input behind a quiet part; the window is {length_s} s from {start_s} s."
            ));
        }
    }

    /// Steps of the clock \[s\]; `None` where it only counts.
    fn interval_s(&self) -> Option<f64> {
        match &self.clock {
            Clock::Column(column, unit) => Some(median_step(&column.values) * unit.seconds()),
            Clock::Rate { hz, .. } => (*hz != 1.0).then(|| 1.0 / hz),
        }
    }

    /// The motions that are taken, in the order of preference for the fit.
    pub(super) fn motions(&self) -> impl Iterator<Item = &Taken> {
        self.taken
            .iter()
            .filter(|one| one.signal.quantity().is_some())
    }

    pub(super) fn take(&mut self, found: &Survey, place: usize, signal: Signal, why: &str) {
        let column = &found.columns[place];
        let linear = self.taken.iter().any(|one| one.signal == Signal::Force);
        let (unit, unit_why) = unit_of(found, column, signal, linear);
        let why = format!("taken as {signal:?} in {unit:?}: {why}; {unit_why}");
        self.whys[place].clone_from(&why);
        self.taken.push(Taken {
            column: column.clone(),
            signal,
            unit,
            scale: 1.0,
            why,
        });
    }

    /// Takes what its name says, every signal once, a torque rather than a force.
    fn take_by_name(&mut self, found: &Survey, open: &mut Vec<(usize, Meaning)>) {
        for signal in [
            Signal::Torque,
            Signal::Force,
            Signal::Displacement,
            Signal::Velocity,
            Signal::Acceleration,
            Signal::GripForce,
        ] {
            let is_second_input =
                signal.is_input() && self.taken.iter().any(|one| one.signal.is_input());
            let at = open
                .iter()
                .position(|&(_, meaning)| meaning == Meaning::Signal(signal));
            if let (Some(at), false) = (at, is_second_input) {
                let (place, _) = open.remove(at);
                self.take(found, place, signal, "by its name");
            }
        }
    }

    /// Of columns without a name, one that is the derivative of another makes both known.
    fn take_derivatives(&mut self, found: &Survey, open: &mut Vec<(usize, Meaning)>) {
        let interval_s = self.interval_s().unwrap_or(1.0);
        let unknown: Vec<usize> = (open
            .iter()
            .filter(|(_, meaning)| *meaning == Meaning::Unknown))
        .map(|(place, _)| *place)
        .collect();
        let values = |place: usize| &found.columns[place].values;
        let mut best: Option<(f64, usize, usize)> = None;
        for &of in &unknown {
            for &rate in unknown.iter().filter(|&&rate| rate != of) {
                let Some(ratio) = derivative(values(of), values(rate), interval_s) else {
                    continue;
                };
                // In the units of a rig that is recorded whole one is the other's derivative as it is.
                let off = ratio.ln().abs();
                if best.is_none_or(|(least, ..)| off < least) {
                    best = Some((off, of, rate));
                }
            }
        }
        if let Some((_, of, rate)) = best {
            open.retain(|(place, _)| *place != of && *place != rate);
            let other = told_place(&found.columns[rate].place);
            let why = format!("{other} is its derivative");
            self.take(found, of, Signal::Displacement, &why);
            let other = told_place(&found.columns[of].place);
            let why = format!("it is the derivative of {other}");
            self.take(found, rate, Signal::Velocity, &why);
        }
    }

    /// Says whether measured motions are each other's derivatives, which tells about their units.
    fn compare_motions(&mut self) {
        let of = |signal: Signal| self.taken.iter().find(|one| one.signal == signal);
        let (Some(position), Some(speed), Some(interval_s)) = (
            of(Signal::Displacement),
            of(Signal::Velocity),
            self.interval_s(),
        ) else {
            return;
        };
        let factors = (
            position.unit.factor(position.signal, 1.0),
            speed.unit.factor(speed.signal, 1.0),
        );
        let (Some(a), Some(b)) = factors else { return };
        let (one, other) = (
            told_place(&position.column.place),
            told_place(&speed.column.place),
        );
        let ratio = derivative(&position.column.values, &speed.column.values, interval_s)
            .map(|ratio| ratio * a / b);
        match ratio {
            Some(ratio) if (ratio - 1.0).abs() < 0.1 => {
                self.notes.push(format!(
                    "{other} is the derivative of {one}, in these units, too."
                ));
            }
            Some(ratio) => {
                self.notes.push(format!(
                    "{other} goes like the derivative of {one} but {} times as large: check the units.",
                    short(1.0 / ratio)
                ));
            }
            None => {}
        }
    }

    /// Turns the input's sign where it brakes the motion all the time, as a torque does that was counted as the load's.
    fn turn_the_input(&mut self) {
        /// Power of the torque over what it would be if it always drove the motion, below which it brakes it \[–\]. Chosen.
        const MOSTLY: f64 = -0.5;
        let of = |signal: Signal| self.taken.iter().find(|one| one.signal == signal);
        let Some(at) = self.taken.iter().position(|one| one.signal.is_input()) else {
            return;
        };
        let input = &self.taken[at].column.values;
        let share = match (of(Signal::Velocity), of(Signal::Displacement)) {
            (Some(speed), _) => work(input, speed.column.values.iter().copied()),
            (None, Some(position)) => {
                let pairs = position.column.values.windows(2);
                work(input, pairs.map(|pair| pair[1] - pair[0]))
            }
            (None, None) => None,
        };
        if share.is_some_and(|share| share < MOSTLY) {
            let input = &mut self.taken[at];
            input.scale = -1.0;
            input.why += "; its sign is turned: it counts against the motion nearly always, and what drives a rig does not";
            let turned = format!(
                "The sign of {} is turned (scale: -1.0): it counts against the motion nearly always, and what drives a rig does not.",
                told_place(&input.column.place)
            );
            self.notes.push(turned);
        }
    }

    /// The motion that is fitted: the angle or position unless it runs on and on.
    pub(super) fn fitted(&self) -> (Quantity, &'static str) {
        let of = |quantity| {
            self.motions()
                .find(|one| one.signal.quantity() == Some(quantity))
        };
        let (position, speed) = (of(Quantity::Displacement), of(Quantity::Velocity));
        match (position, speed) {
            (Some(position), Some(_)) if runs_away(&position.column.values) => (
                Quantity::Velocity,
                "the position only runs on, so the speed says more",
            ),
            (Some(_), _) => (Quantity::Displacement, "it was measured"),
            (None, Some(_)) => (Quantity::Velocity, "it was measured"),
            (None, None) => (Quantity::Acceleration, "it was measured"),
        }
    }

    /// Every column with what is said of it.
    pub(super) fn told(&self, found: &Survey) -> Vec<DraftColumn> {
        let told = |(column, why): (&SurveyedColumn, &String)| DraftColumn {
            place: told_place(&column.place),
            told: why.clone(),
            values: column.values.clone(),
        };
        found.columns.iter().zip(&self.whys).map(told).collect()
    }
}
