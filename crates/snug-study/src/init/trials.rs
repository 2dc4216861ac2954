//! An input and a motion that no name tells: each that can be is tried with mass, damping and stiffness.

use super::choice::Choice;
use super::numbers::is_constant;
use super::roles::{self, Meaning};
use super::told_place;
use crate::error::StudyError;
use crate::tasks::cases;
use snug_identify::spectral_start;
use snug_ingest::Signal;
use snug_ingest::survey::{Survey, SurveyedColumn, SurveyedPlace};
use std::path::Path;

/// Share of the motion's power that must be explained beside what is, for a sign to be asked about \[–\]. Chosen.
const CLEARLY: f64 = 0.1;
/// Share of the motion's power below which signs, columns and the rig itself are asked about \[–\]. Chosen.
const HALF: f64 = 0.5;

impl Choice {
    /// An input and a motion that names do not tell are those with which mass, damping and stiffness explain most.
    pub(super) fn take_the_rest(
        &mut self,
        file: &Path,
        found: &Survey,
        open: &mut Vec<(usize, Meaning)>,
    ) -> Result<(), StudyError> {
        let (inputs, outputs) = self.candidates(file, found, open)?;
        let mut trials: Vec<Trial> = Vec::new();
        for input in options(&inputs) {
            for output in options(&outputs).filter(|output| output.is_none() || *output != input) {
                let kinds = [Signal::Displacement, Signal::Velocity, Signal::Acceleration];
                for signal in kinds.into_iter().take(if output.is_some() { 3 } else { 1 }) {
                    let output = output.map(|place| (place, signal));
                    trials.push(self.tried(file, found, input, output));
                }
            }
        }
        // What explains a hundredth more is no reason: of equals the first counts.
        let best = trials
            .iter()
            .map(|trial| trial.left)
            .fold(f64::INFINITY, f64::min);
        let Some(chosen) = trials.iter().position(|trial| trial.left <= best + 0.01) else {
            return Err(lost(file, found, "the input"));
        };
        let told = told_of(&trials, found);
        let trial = trials.swap_remove(chosen);
        for place in [trial.input, trial.output.map(|(place, _)| place)]
            .into_iter()
            .flatten()
        {
            open.retain(|one| one.0 != place);
        }
        *self = trial.choice;
        if let Some(told) = told {
            self.notes.push(told);
        }
        Ok(())
    }

    /// Columns that can be the input and the motion, where names did not tell; of equals, what stands beside the motion first.
    fn candidates(
        &self,
        file: &Path,
        found: &Survey,
        open: &[(usize, Meaning)],
    ) -> Result<(Vec<usize>, Vec<usize>), StudyError> {
        let of_kind = |named: Meaning| -> Vec<usize> {
            let places = |wanted: Meaning| {
                let fitting = open.iter().filter(move |one| one.1 == wanted);
                fitting.map(|one| one.0)
            };
            match places(named).next() {
                Some(first) => vec![first],
                None => places(Meaning::Unknown).collect(),
            }
        };
        let lacks_input = !self.taken.iter().any(|one| one.signal.is_input());
        let lacks_motion = self.motions().next().is_none();
        let mut inputs = if lacks_input {
            of_kind(Meaning::Input)
        } else {
            Vec::new()
        };
        let outputs = if lacks_motion {
            of_kind(Meaning::Output)
        } else {
            Vec::new()
        };
        if lacks_input && inputs.is_empty() {
            return Err(lost(file, found, "the input (a torque or a force)"));
        }
        if lacks_motion && outputs.iter().all(|place| inputs == [*place]) {
            return Err(lost(
                file,
                found,
                "a motion (angle, position, speed or acceleration)",
            ));
        }
        let is_beside = |place: &usize| {
            self.motions()
                .any(|one| is_beside(&one.column, &found.columns[*place]))
        };
        inputs.sort_by_key(|place| !is_beside(place));
        Ok((inputs, outputs))
    }

    /// The choice with an input and a motion more, and what the linear model leaves of the motion's power.
    fn tried(
        &self,
        file: &Path,
        found: &Survey,
        input: Option<usize>,
        output: Option<(usize, Signal)>,
    ) -> Trial {
        let mut choice = self.clone();
        let named = |place: usize| match roles::meaning(&found.columns[place].name) {
            Meaning::Input | Meaning::Output => "by its name",
            _ => "nothing else can be it, or it explains most",
        };
        if let Some(place) = input {
            choice.take(
                found,
                place,
                Signal::Torque,
                &format!("the input, {}", named(place)),
            );
        }
        if let Some((place, signal)) = output {
            choice.take(
                found,
                place,
                signal,
                &format!(
                    "the output, {}, of this kind because it explains most",
                    named(place)
                ),
            );
        }
        let left = choice.unexplained(file).unwrap_or(1.0);
        Trial {
            choice,
            input,
            output,
            left,
        }
    }

    /// Says what the model explains of the motion, and whether it were more with the input's sign turned; nothing is turned.
    pub(super) fn try_the_sign(&mut self, file: &Path) {
        let mut turned = self.clone();
        let inputs = turned.taken.iter_mut().filter(|one| one.signal.is_input());
        inputs.for_each(|input| input.scale *= -1.0);
        let Some(left) = self.unexplained(file) else {
            self.notes.push(format!(
                "Whether mass, damping and stiffness explain the motion could not be tried: of {} a run has nothing to fit, and says \
                 why.",
                file.file_name().unwrap_or_default().display()
            ));
            return;
        };
        let as_it_is = 1.0 - left.min(1.0);
        let other = 1.0 - turned.unexplained(file).unwrap_or(1.0).min(1.0);
        if other > as_it_is + CLEARLY {
            self.notes.push(format!(
                "With the input's sign turned (scale) mass, damping and stiffness explained {:.0} % of the motion rather than \
                 {:.0} %: check which way input and motion count.",
                100.0 * other,
                100.0 * as_it_is
            ));
        } else if as_it_is < HALF {
            self.notes.push(format!(
                "Mass, damping and stiffness explain {:.0} % of the motion only: check signs and columns, or this rig is no body on a \
                 spring.",
                100.0 * as_it_is
            ));
        }
    }

    /// Share of the motion's power that mass, damping and stiffness leave, as spectra tell; `None` where they say nothing.
    fn unexplained(&self, file: &Path) -> Option<f64> {
        let study = self.study().ok()?;
        let cases = cases::cases(&study, &[file.to_path_buf()], 1).ok()?;
        let left = spectral_start(&cases)?.unexplained;
        left.is_finite().then_some(left)
    }
}

/// That no column can be what is needed.
fn lost(file: &Path, found: &Survey, what: &str) -> StudyError {
    StudyError::NothingToDraft {
        path: file.to_path_buf(),
        found: format!("columns, but none that can be {what}: {}", named(found)),
    }
}

/// A choice that was tried.
struct Trial {
    choice: Choice,
    input: Option<usize>,
    output: Option<(usize, Signal)>,
    left: f64,
}

/// Whether two columns are parts of one variable.
fn is_beside(one: &SurveyedColumn, other: &SurveyedColumn) -> bool {
    match (&one.place, &other.place) {
        (SurveyedPlace::Path(one, _), SurveyedPlace::Path(other, _)) => one == other,
        _ => false,
    }
}

/// Each of the places, or none where none is needed.
fn options(places: &[usize]) -> impl Iterator<Item = Option<usize>> + Clone {
    let none = places.is_empty().then_some(None);
    none.into_iter().chain(places.iter().copied().map(Some))
}

/// What each trial explained, where there was more than one.
fn told_of(trials: &[Trial], found: &Survey) -> Option<String> {
    if trials.len() < 2 {
        return None;
    }
    let name = |place: usize| told_place(&found.columns[place].place);
    let told = trials.iter().map(|trial| {
        let input = trial.input.map(|place| format!("{} as input", name(place)));
        let output = trial
            .output
            .map(|(place, signal)| format!("{} as {signal:?}", name(place)));
        let parts: Vec<String> = input.into_iter().chain(output).collect();
        format!(
            "{} {:.0} %",
            parts.join(" and "),
            100.0 * (1.0 - trial.left).max(0.0)
        )
    });
    let told: Vec<String> = told.collect();
    Some(format!(
        "Mass, damping and stiffness alone explain of the motion: {}.",
        told.join(", ")
    ))
}

/// The columns by place, and whether they say anything.
fn named(found: &Survey) -> String {
    /// As many as a line of a message holds. Chosen.
    const MOST: usize = 12;
    let told = |column: &SurveyedColumn| match is_constant(&column.values) {
        true => format!("{} (does not change)", told_place(&column.place)),
        false => told_place(&column.place),
    };
    let names: Vec<String> = found.columns.iter().map(told).take(MOST).collect();
    names.join(", ")
}
