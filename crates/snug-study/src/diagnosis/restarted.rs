//! What restarts found, and what a free run over the whole of each recording finds then.

use super::{Search, begun, effects, in_short_enough_steps, with_last_model};
use crate::error::StudyError;
use crate::study::Study;
use crate::tasks::cases::with_settled;
use crate::tasks::free_run::{is_followed, leaves_a_motion};
use crate::tasks::held_input;
use snug_diagnose::{Answer, Goal, Question};
use snug_identify::{FitTask, Simulation};

/// What was found with a model that is restarted from the measured motion, though something brings that back.
pub(super) struct Restarted<'a> {
    pub study: &'a Study,
    /// The study before it was settled.
    pub as_told: &'a Study,
    pub found: &'a Answer,
}

impl Restarted<'_> {
    /// The study run freely and the answer then: from what was found on, where with that a free run follows, and afresh where what was
    /// found leaves a motion. Over the short way between two restarts little shows of most effects. A free run that leaves a motion, too,
    /// says no more than restarts do, unless those found but a law that is in no catalogue.
    pub fn run_freely<'a>(
        &self,
        recorded: &dyn Fn() -> Vec<FitTask<'a>>,
        question: &Question<'_>,
        search: &Search<'_>,
    ) -> Result<Option<(Study, Answer)>, StudyError> {
        let mut free = self.study.clone();
        free.identify.simulation = Simulation::FreeRun;
        (free.diagnosis.search).clone_from(&self.as_told.diagnosis.search);
        let added = &self.found.diagnosis.added;
        let is_listed = added.iter().all(|one| one.expression.is_none());
        let follows = !added.is_empty() && is_followed(&with_found(&free, self.found, recorded())?);
        if !follows && !leaves_a_motion(&with_found(self.study, self.found, recorded())?) {
            return Ok(None);
        }
        let names: Vec<String> = added.iter().map(|one| one.effect.clone()).collect();
        let mut settings = free.diagnosis.search.clone();
        settings.seed = search.settings.seed;
        let with_those = Search {
            settings: &settings,
            ..*search
        };
        let (free, (answer, held, is_better)) =
            in_short_enough_steps(free, search.progress, |free| {
                let cases = with_settled(free, recorded())?;
                let question = Question {
                    goal: match follows {
                        // It declares the laws that are in no catalogue.
                        true => {
                            let last = with_last_model(free, self.found);
                            Goal::ImproveFrom(begun(effects(&last, &names, &cases)?, self.found))
                        }
                        false => Goal::Improve,
                    },
                    cases: &cases,
                    ..question.clone()
                };
                let (answer, held) = with_those.answer(free, &question)?;
                let then = match &held {
                    Some(_) => with_found(free, &answer, held_input::held(free, &cases)?.1)?,
                    None => with_found(free, &answer, recorded())?,
                };
                let is_better = is_followed(&then) && (!is_listed || !leaves_a_motion(&then));
                Ok((answer, held, is_better))
            })?;
        let free = held.unwrap_or(free);
        // Ended on the way, it is not known whether what restarts found is all: the answer says that it was ended.
        Ok((is_better || answer.diagnosis.interrupted).then_some((free, answer)))
    }
}

/// `cases` with the model that an `answer` ends with.
fn with_found<'a>(
    study: &Study,
    answer: &Answer,
    cases: Vec<FitTask<'a>>,
) -> Result<Vec<FitTask<'a>>, StudyError> {
    with_settled(&with_last_model(study, answer), cases)
}
