//! What restarts found, and what a free run over the whole of each recording finds then.

use super::rung_study::{begun, with_last_rung, with_rung};
use super::search::Search;
use super::shorter_steps::in_short_enough_steps;
use crate::error::StudyError;
use crate::study::Study;
use crate::tasks::cases::with_settled;
use crate::tasks::free_run::{Missed, missed};
use crate::tasks::held_input;
use crate::tasks::own_effects::effects;
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
    /// The study that says it, where that is not the restarted one as it is: with a held input, or run freely.
    pub study: Option<Study>,
    pub runs_freely: bool,
    /// Whether it runs freely and leaves white noise.
    is_all: bool,
}

impl Found {
    /// By the study's own search, run as it is.
    pub fn as_searched((answer, held): (Answer, Option<Study>)) -> Self {
        Self {
            answer,
            study: held,
            runs_freely: false,
            is_all: false,
        }
    }
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
        let free = self.run_free();
        let follows = |rung: &RungModel| {
            let cases = cases_with_rung(&free, rung, recorded());
            cases.is_ok_and(|cases| missed(&cases).is_some_and(|left| left.follows()))
        };
        let until = Until::new(&follows);
        let up_to_there = Question {
            until: Some(&until),
            ..question.clone()
        };
        let first = search.answer(self.study, &up_to_there)?;
        let freely = self.run_freely(&first.0, recorded, question, search)?;
        let told = freely.as_ref().map_or(&first.0, |found| &found.answer);
        let is_all = freely.as_ref().is_some_and(|found| found.is_all);
        if !until.is_reached() || is_all || told.diagnosis.interrupted {
            return Ok(freely.unwrap_or_else(|| Found::as_searched(first)));
        }
        let whole = search.answer(self.study, question)?;
        // From the same models a free run finds the same.
        let is_known = whole.0.models == first.0.models && !whole.0.diagnosis.interrupted;
        let freely = match is_known {
            true => freely,
            false => self.run_freely(&whole.0, recorded, question, search)?,
        };
        Ok(freely.unwrap_or_else(|| Found::as_searched(whole)))
    }

    /// The study, its model not restarted.
    fn run_free(&self) -> Study {
        let mut free = self.study.clone();
        free.identify.simulation = Simulation::FreeRun;
        (free.diagnosis.search).clone_from(&self.as_told.diagnosis.search);
        free
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
        if found.diagnosis.interrupted {
            return Ok(None);
        }
        let free = self.run_free();
        let added = &found.diagnosis.added;
        let is_listed = added.iter().all(|one| one.expression.is_none());
        let left = missed(&with_found(&free, found, recorded())?);
        let follows = !added.is_empty() && left.as_ref().is_some_and(Missed::follows);
        let shows = follows || shows_freely(&free, found, left.as_ref(), recorded)?;
        if shows && !follows {
            let restarted = missed(&with_found(self.study, found, recorded())?);
            if !restarted.is_some_and(|left| left.leaves_a_motion()) {
                return Ok(None);
            }
        }
        let names: Vec<String> = added.iter().map(|one| one.effect.clone()).collect();
        let settings = search.settings_of(&free);
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
                            let last = with_last_rung(free, found);
                            Goal::ImproveFrom(begun(effects(&last, &names, &cases)?, found))
                        }
                        false => Goal::Improve,
                    },
                    cases: &cases,
                    ..question.clone()
                };
                let (answer, held) = with_those.answer(free, &question)?;
                let then = match &held {
                    Some(held) => with_found(held, &answer, held_input::held(held, &cases)?.1)?,
                    None => with_found(free, &answer, recorded())?,
                };
                let left = missed(&then);
                let says = |what: fn(&Missed) -> bool| left.as_ref().is_some_and(what);
                let is_better =
                    says(Missed::follows) && (!is_listed || !says(Missed::leaves_a_motion));
                Ok((answer, held, is_better, says(Missed::leaves_white_noise)))
            })?;
        let free = held.unwrap_or(free);
        // Ended on the way, it is not known whether what restarts found is all: the answer says that it was ended.
        let is_taken = is_better || !shows || answer.diagnosis.interrupted;
        Ok(is_taken.then_some(Found {
            answer,
            study: Some(free),
            runs_freely: true,
            is_all,
        }))
    }
}

/// Whether what was `found` with a state of its own, with which a free run leaves this, lets it follow better: where the motion is taken up again
/// and again, such a state goes on, is driven by what was measured, and foretells what moves the rig that nobody recorded.
fn shows_freely<'a>(
    free: &Study,
    found: &Answer,
    left: Option<&Missed>,
    recorded: Recorded<'a, '_>,
) -> Result<bool, StudyError> {
    let mut stateful = Vec::new();
    for one in &found.diagnosis.added {
        if one.expression.is_none() && has_a_state(free, &one.effect)? {
            stateful.push(&one.effect);
        }
    }
    let is_without = |model: &&RungModel| !model.effects.iter().any(|one| stateful.contains(&one));
    let without = found.models.iter().rev().find(is_without);
    let Some(without) = without.filter(|_| !stateful.is_empty()) else {
        return Ok(true);
    };
    let other = missed(&cases_with_rung(free, without, recorded())?);
    Ok((left.zip(other)).is_none_or(|(left, other)| left.follows_better_than(&other)))
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
    with_settled(&with_last_rung(study, answer), cases)
}

/// `cases` with the model of a rung.
fn cases_with_rung<'a>(
    study: &Study,
    rung: &RungModel,
    cases: Vec<FitTask<'a>>,
) -> Result<Vec<FitTask<'a>>, StudyError> {
    with_settled(&with_rung(study, rung), cases)
}
