//! A question answered as a study asks it: with a held input where that is the likelier story.

use super::rung_study::{begun, with_last_rung, with_rung};
use super::shorter_steps::in_short_enough_steps;
use super::verb::Verb;
use crate::error::StudyError;
use crate::progress::ProgressEvent;
use crate::study::Study;
use crate::tasks::cases::with_settled;
use crate::tasks::held_input;
use crate::tasks::own_effects::effects;
use snug_campaign::words::number::significant;
use snug_campaign::words::reason::Reason;
use snug_diagnose::{
    Answer, DiagnoseError, Goal, Pieces, Question, RungModel, Until, Watch, examine,
};
use snug_identify::{FitTask, IdentifyError};
use snug_least_squares::SolveError;
use std::sync::atomic::AtomicBool;

/// What is told where a search goes on with a held input.
const HELD: &str = "taking the input as held from sample to sample";

/// How an answer is looked for.
pub(super) struct Search<'a> {
    pub settings: &'a snug_diagnose::DiagnoseSettings,
    pub verb: &'a Verb,
    pub progress: &'a (dyn Fn(ProgressEvent<'_>) + Sync),
    pub interrupted: &'a AtomicBool,
}

impl Search<'_> {
    /// The settings of another form of the study, as this search begins by chance and what it is for.
    pub fn settings_of(&self, study: &Study) -> snug_diagnose::DiagnoseSettings {
        snug_diagnose::DiagnoseSettings {
            seed: self.settings.seed,
            for_prediction: self.settings.for_prediction,
            ..study.diagnosis.search.clone()
        }
    }

    /// The answer, and the study with a held input where that is the likelier story.
    pub fn answer(
        &self,
        study: &Study,
        question: &Question<'_>,
    ) -> Result<(Answer, Option<Study>), StudyError> {
        let cases = question.cases;
        let is_open = *self.verb == Verb::Improve && held_input::is_open(study, cases);
        if is_open && let Some((held, study)) = self.held_at_once(study, question)? {
            return Ok((held, Some(study)));
        }
        // What comes in after a hold that is told as a delay is looked for with the hold.
        let is_a_hold = |rung: &RungModel| {
            held_input::is_a_hold(rung, &with_rung(study, rung), cases).is_ok_and(|is| is)
        };
        let up_to_a_hold = Until::new(&is_a_hold);
        let until = question.until.or(is_open.then_some(&up_to_a_hold));
        let mut straight = self.examined(&Question {
            until,
            ..question.clone()
        })?;
        if question.until.is_some_and(Until::is_reached) {
            return Ok((straight, None));
        }
        let not_tried = held_input::not_tried(study, cases, &straight.diagnosis);
        straight.diagnosis.reasons.extend(not_tried);
        if !is_open || straight.diagnosis.interrupted {
            return Ok((straight, None));
        }
        if up_to_a_hold.is_reached() {
            return self.held_from_there(study, question, straight);
        }
        let last = with_last_rung(study, &straight);
        let is_worth_it = held_input::is_worth_it(&straight.diagnosis, study, &last, cases)?;
        let (held_study, cases) = held_input::held(study, cases)?;
        let question = Question {
            cases: &cases,
            ..question.clone()
        };
        if !is_worth_it && !self.fewer_do(&held_study, &question, &straight)? {
            return Ok((straight, None));
        }
        self.tell(HELD);
        let rest = rest_of(&held_study, &cases, &straight)?;
        let goals = std::iter::once(question.goal.clone()).chain(rest);
        let interval_s = cases[0].tightening.time_base.interval_s;
        for goal in goals {
            let question = Question {
                goal,
                ..question.clone()
            };
            let mut held = self.examined(&question)?;
            if let Some(reason) =
                held_input::speaks_for_it(&held.diagnosis, &straight.diagnosis, interval_s)
            {
                held.diagnosis.reasons.push(reason);
                return Ok((held, Some(held_study)));
            }
            if held.diagnosis.interrupted {
                let quantity = cases[0].quantity();
                let mut diagnosis = straight.diagnosis.ended(quantity, &question.units);
                diagnosis.reasons.push(Reason::HeldUndecided);
                let straight = Answer {
                    diagnosis,
                    ..straight
                };
                return Ok((straight, None));
            }
        }
        Ok((straight, None))
    }

    /// What a search with a held input finds beside the rest of `straight`, whose delay is a hold: known also where it takes shorter steps.
    fn held_from_there(
        &self,
        study: &Study,
        question: &Question<'_>,
        straight: Answer,
    ) -> Result<(Answer, Option<Study>), StudyError> {
        self.tell(HELD);
        let (_, (held_study, mut held)) =
            in_short_enough_steps(study.clone(), self.progress, |study| {
                let (held_study, cases) = held_input::held(study, question.cases)?;
                let goal = rest_of(&held_study, &cases, &straight)?;
                let held = self.examined(&Question {
                    cases: &cases,
                    goal: goal.unwrap_or_else(|| question.goal.clone()),
                    ..question.clone()
                })?;
                Ok((held_study, held))
            })?;
        let reason = held_input::spares_stand_ins(&straight.diagnosis);
        held.diagnosis.reasons.push(reason);
        Ok((held, Some(held_study)))
    }

    /// Whether with the `held` input a model before the last leaves as little as that does without, fitted again from where it ended: what
    /// came in after it may stand in for the hold.
    fn fewer_do(
        &self,
        held: &Study,
        question: &Question<'_>,
        straight: &Answer,
    ) -> Result<bool, StudyError> {
        let rungs = straight.diagnosis.ladder.iter().zip(&straight.models);
        let Some((last, before)) = straight.diagnosis.ladder.split_last() else {
            return Ok(false);
        };
        for (rung, model) in rungs.take(before.len()).skip(1) {
            let begun = with_rung(held, model);
            let cases = question.cases.iter().map(FitTask::lent).collect();
            let cases = with_settled(&begun, cases)?;
            let compared = self.examined(&Question {
                cases: &cases,
                effects: effects(&begun, &begun.model.effects, &cases)?,
                custom: begun.model.custom_effects()?,
                goal: Goal::Compare,
                ..question.clone()
            })?;
            if held_input::leaves_as_little(&compared.diagnosis, rung, last) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// What a search with a held input finds, where one effect already leaves far less with it than any does without.
    fn held_at_once(
        &self,
        study: &Study,
        question: &Question<'_>,
    ) -> Result<Option<(Answer, Study)>, StudyError> {
        if !held_input::is_likely(study, question.cases)? {
            return Ok(None);
        }
        let (held_study, held_cases) = held_input::held(study, question.cases)?;
        let asked = |cases, goal| Question {
            cases,
            goal,
            ..question.clone()
        };
        let held = self
            .examined(&asked(&held_cases, Goal::Diagnose))?
            .diagnosis;
        if held.interrupted || !held_input::takes_nearly_all(&held) {
            return Ok(None);
        }
        let straight = self
            .examined(&asked(question.cases, Goal::Diagnose))?
            .diagnosis;
        if straight.interrupted || !held_input::leaves_far_less(&held, &straight) {
            return Ok(None);
        }
        let mut answer = self.examined(&asked(&held_cases, question.goal.clone()))?;
        answer.diagnosis.reasons.push(Reason::Held {
            spared: Vec::new(),
            is_half_an_interval: false,
        });
        Ok(Some((answer, held_study)))
    }

    fn tell(&self, what: &str) {
        (self.progress)(ProgressEvent::Stage { what });
    }

    pub fn examined(&self, question: &Question<'_>) -> Result<Answer, StudyError> {
        let tell = |what: &str| self.tell(what);
        let count = |pieces: Pieces| {
            (self.progress)(match pieces {
                Pieces::Of(of) => ProgressEvent::Candidates { of },
                Pieces::Done => ProgressEvent::CandidateDone,
            });
        };
        let watch = Watch::new(&tell).counting(&count).until(self.interrupted);
        examine(question, self.settings, &watch).map_err(|error| nothing_fits(error, question))
    }
}

/// To go on from what `straight` found, of which half a sampling interval is a delay, without what stands in for that: the rest is the
/// model, whatever a search afresh would find.
fn rest_of(
    study: &Study,
    cases: &[FitTask<'_>],
    straight: &Answer,
) -> Result<Option<Goal>, StudyError> {
    let Some(first) = cases.first() else {
        return Ok(None);
    };
    let interval_s = first.tightening.time_base.interval_s;
    let rest = held_input::without_stand_ins(&straight.diagnosis, interval_s);
    // It declares the laws that are in no catalogue.
    let last = with_last_rung(study, straight);
    let rest = rest
        .map(|names| effects(&last, &names, cases))
        .transpose()?;
    Ok(rest.map(|rest| Goal::ImproveFrom(begun(rest, straight))))
}

/// Where not a single fit could begin, what was tried and what to check.
fn nothing_fits(error: DiagnoseError, question: &Question<'_>) -> StudyError {
    match (error, question.cases.first()) {
        (
            DiagnoseError::Solve(SolveError::NoStart)
            | DiagnoseError::Identify(IdentifyError::Solve(SolveError::NoStart)),
            Some(case),
        ) => StudyError::NothingFits {
            tightenings: question.cases.len(),
            output: case.quantity().name(),
            starts: (case.model.parameters().iter())
                .map(|one| format!("{} {}", one.name, significant(one.value, 3)))
                .collect(),
        },
        (error, _) => error.into(),
    }
}
