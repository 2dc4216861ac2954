//! What restarts found, and what a free run over the whole of each recording finds then.

use super::{Search, begun, effects, in_short_enough_steps, with_last_model, with_model};
use crate::error::StudyError;
use crate::study::Study;
use crate::tasks::cases::with_settled;
use crate::tasks::free_run::{follows_better, is_followed, leaves_a_motion, leaves_white_noise};
use crate::tasks::held_input;
use snug_diagnose::{Answer, Goal, Question, RungModel, Until};
use snug_identify::{FitTask, Simulation};
use snug_model::Law;

/// A study whose model is restarted from the measured motion, though something brings that back.
pub(super) struct Restarted<'a> {
    pub study: &'a Study,
    /// The study before it was settled.
    pub as_told: &'a Study,
}

/// The recordings, as often as they are asked for.
pub(super) type Recorded<'a, 'f> = &'f (dyn Fn() -> Vec<FitTask<'a>> + Sync);

/// What was found.
pub(super) struct Found {
    pub answer: Answer,
    /// The study with a held input, where that is the likelier story.
    pub held: Option<Study>,
    /// The study run freely, where a free run said it.
    pub free: Option<Study>,
    /// Whether a free run leaves white noise.
    is_all: bool,
}

impl Restarted<'_> {
    /// What restarts find up to a model with which a free run follows, and a free run from there, where that leaves nothing but noise; otherwise
    /// what restarts find to the end, and a free run then: what they find first may stand in for several.
    pub fn answer<'a>(
        &self,
        recorded: Recorded<'a, '_>,
        question: &Question<'_>,
        search: &Search<'_>,
    ) -> Result<Found, StudyError> {
        let mut free = self.study.clone();
        free.identify.simulation = Simulation::FreeRun;
        let follows = |rung: &RungModel| {
            let cases = with_settled(&with_model(&free, rung, true), recorded());
            cases.is_ok_and(|cases| is_followed(&cases))
        };
        let until = Until::new(&follows);
        let early = Question {
            until: Some(&until),
            ..question.clone()
        };
        let found = self.found(recorded, &early, search)?;
        match !until.is_reached() || found.is_all || found.answer.diagnosis.interrupted {
            true => Ok(found),
            false => self.found(recorded, question, search),
        }
    }

    fn found<'a>(
        &self,
        recorded: Recorded<'a, '_>,
        question: &Question<'_>,
        search: &Search<'_>,
    ) -> Result<Found, StudyError> {
        let (answer, held) = search.answer(self.study, question)?;
        let question = Question {
            until: None,
            ..question.clone()
        };
        let freely = match answer.diagnosis.interrupted {
            true => None,
            false => self.run_freely(&answer, recorded, &question, search)?,
        };
        Ok(match freely {
            Some(found) => found,
            None => Found {
                answer,
                held,
                free: None,
                is_all: false,
            },
        })
    }

    /// The study run freely and the answer then: from what was found on, where with that a free run follows, and afresh where what was
    /// found leaves a motion. Over the short way between two restarts little shows of most effects. A free run that leaves a motion, too,
    /// says no more than restarts do, unless those found but a law that is in no catalogue, or what does not show in it.
    fn run_freely<'a>(
        &self,
        found: &Answer,
        recorded: Recorded<'a, '_>,
        question: &Question<'_>,
        search: &Search<'_>,
    ) -> Result<Option<Found>, StudyError> {
        let mut free = self.study.clone();
        free.identify.simulation = Simulation::FreeRun;
        (free.diagnosis.search).clone_from(&self.as_told.diagnosis.search);
        let added = &found.diagnosis.added;
        let is_listed = added.iter().all(|one| one.expression.is_none());
        let follows = !added.is_empty() && is_followed(&with_found(&free, found, recorded())?);
        let shows = follows || shows_freely(&free, found, recorded)?;
        if shows && !follows && !leaves_a_motion(&with_found(self.study, found, recorded())?) {
            return Ok(None);
        }
        let names: Vec<String> = added.iter().map(|one| one.effect.clone()).collect();
        let mut settings = free.diagnosis.search.clone();
        settings.seed = search.settings.seed;
        let with_those = Search {
            settings: &settings,
            ..*search
        };
        let (free, (answer, held, is_better, is_all)) =
            in_short_enough_steps(free, search.progress, |free| {
                let cases = with_settled(free, recorded())?;
                let question = Question {
                    goal: match follows {
                        // It declares the laws that are in no catalogue.
                        true => {
                            let last = with_last_model(free, found);
                            Goal::ImproveFrom(begun(effects(&last, &names, &cases)?, found))
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
                Ok((answer, held, is_better, leaves_white_noise(&then)))
            })?;
        let free = held.unwrap_or(free);
        // Ended on the way, it is not known whether what restarts found is all: the answer says that it was ended.
        let is_taken = is_better || !shows || answer.diagnosis.interrupted;
        Ok(is_taken.then_some(Found {
            answer,
            held: None,
            free: Some(free),
            is_all,
        }))
    }
}

/// Whether what was `found` with a state of its own lets a free run follow better: where the motion is taken up again and again, such a state goes
/// on, is driven by what was measured, and foretells what moves the rig that nobody recorded.
fn shows_freely<'a>(
    free: &Study,
    found: &Answer,
    recorded: Recorded<'a, '_>,
) -> Result<bool, StudyError> {
    let mut stateful = Vec::new();
    for one in &found.diagnosis.added {
        if one.expression.is_none() && has_a_state(free, &one.effect)? {
            stateful.push(&one.effect);
        }
    }
    let is_without = |model: &&RungModel| !model.effects.iter().any(|one| stateful.contains(&one));
    let (Some(last), Some(without)) = (
        found.models.last(),
        found.models.iter().rev().find(is_without),
    ) else {
        return Ok(true);
    };
    let run = |model: &RungModel| with_settled(&with_model(free, model, true), recorded());
    Ok(stateful.is_empty() || follows_better(&run(last)?, &run(without)?))
}

fn has_a_state(study: &Study, name: &str) -> Result<bool, StudyError> {
    Ok(!study.model.effect(name)?.description().states.is_empty())
}

/// `cases` with the model that an `answer` ends with.
fn with_found<'a>(
    study: &Study,
    answer: &Answer,
    cases: Vec<FitTask<'a>>,
) -> Result<Vec<FitTask<'a>>, StudyError> {
    with_settled(&with_last_model(study, answer), cases)
}
