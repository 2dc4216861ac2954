//! What the data answer: the selection told as a diagnosis.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::data::watch::Watch;
use crate::error::DiagnoseError;
use crate::library::{declaration, is_unlisted};
use crate::locate::{Seen, compare, drifts, locate};
use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::parameters;
use crate::question::Question;
use crate::ranking::rank::Ranking;
use crate::rung_model::RungModel;
use crate::selection::path::{Addition, SelectionPath, twins};
use crate::settings::DiagnoseSettings;
use crate::verdict::comparisons::compare_sizes;
use crate::verdict::earned;
use crate::verdict::experiment::separating_experiment;
use crate::verdict::ranking_told::RankingTold;
use crate::verdict::reasons::{
    Held, Situation, explanation, headline, paste, reasons, removal, stopped,
};
use crate::verdict::tightening_fits::TighteningFits;
use crate::verdict::trend::trends;
use crate::verdict::{detectability, in_some_groups, ladder, preparation};
use snug_campaign::words::changes::Changes;
use snug_campaign::words::explained::Explained;
use snug_campaign::words::statement;
use snug_campaign::words::suspicion::{OtherUnits, StandsApart, Suspicion, TurnedRound};
use snug_campaign::{
    AddedEffect, Comparison, CorrectedEffect, Diagnosis, Drift, Experiment, Location,
    NegativeControl, RankedEffect, UnlistedTerm, Verdict, sharing,
};
use snug_model::{Effect, Law};

/// What the data answer.
#[derive(Debug, Clone)]
pub struct Answer {
    /// Everything but what only a whole run of the study can tell of each rung.
    pub diagnosis: Diagnosis,
    /// The model of each rung of the ladder.
    pub models: Vec<RungModel>,
}

/// A question, and the selection that it led to.
pub(crate) struct Examination<'a> {
    pub question: &'a Question<'a>,
    pub cases: Cases<'a>,
    pub settings: &'a DiagnoseSettings,
    pub path: SelectionPath,
    /// Recordings that stand in units of their own, so that nothing was looked for, or that move another load.
    pub units: Option<OtherUnits>,
    /// Whether a channel is not what it is declared to be, so that nothing was looked for.
    pub is_declared_wrong: bool,
    /// Recordings whose input has the other sign.
    pub turned_round: Option<TurnedRound>,
    /// What changes along the recordings by so much that nothing was looked for.
    pub changes: Option<Changes>,
    pub watch: Watch<'a>,
}

/// Where the models at both ends of the selection fail.
pub(super) struct Places {
    pub(super) comparison: Comparison,
    pub(super) location: Location,
    /// `None` where the last model is the first.
    pub(super) final_location: Option<Location>,
    pub(super) drift: Vec<Drift>,
    /// How much the last model explains, where no noise says what is enough.
    pub(super) explained: Option<Explained>,
    /// What no model could explain of it, if that is nearly all.
    pub(super) left_over: Option<Suspicion>,
    /// Whether what it leaves is white noise.
    pub(super) leaves_noise: bool,
    /// Recordings of which it leaves far more than of the others.
    pub(super) stands_apart: Option<StandsApart>,
}

/// The verdict, with what goes into its words.
pub(super) struct Judged {
    pub verdict: Verdict,
    /// What to check where no model fits.
    pub suspicions: Vec<Suspicion>,
    /// What changes along the recordings.
    pub changes: Option<Changes>,
    /// Whether the verdict is open because more is left than noise, though it hardly repeats and nothing explains it.
    pub is_more_than_noise: bool,
}

impl Places {
    pub(super) fn last(&self) -> &Location {
        self.final_location.as_ref().unwrap_or(&self.location)
    }
}

impl Examination<'_> {
    /// Everything that is told of the selection.
    pub fn answer(self) -> Result<Answer, DiagnoseError> {
        self.watch.begin("looking where the model fails")?;
        let cases = self.question.cases;
        let last = self.path.last();
        let places = self.places()?;
        let Judged {
            verdict,
            mut suspicions,
            changes,
            is_more_than_noise,
        } = self.judged(&places);
        suspicions.extend(self.units_that_differ(false).map(Suspicion::Units));
        let ranking = self.ranking(&places.drift);
        let corrected = preparation::corrected(cases);
        let mut added = self.added();
        compare_sizes(cases, last, &mut added);
        let situation = Situation {
            in_model: &added,
            explained: places.explained,
            is_more_than_noise,
            changes,
            suspicions: &suspicions,
            ..self.situation(verdict, &ranking, &corrected)
        };
        let experiment = self.experiment(&situation)?;
        let (headline, reasons, stopped) = (
            headline(&situation),
            reasons(&situation),
            stopped(&situation),
        );
        let rungs = self.path.rungs.iter();
        let diagnosis = Diagnosis {
            verb: self.question.goal.verb().to_owned(),
            verdict,
            headline,
            reasons,
            stopped,
            level: self.settings.level,
            interrupted: self.path.is_interrupted(),
            tightenings: cases.len(),
            noise: preparation::noise(cases),
            compared_output: cases[0].quantity().name().to_owned(),
            added,
            corrected,
            ladder: (rungs.clone().enumerate())
                .map(|(place, one)| ladder::rung(cases, one, self.ranked_beside(place)))
                .collect(),
            ranking,
            removals: self.path.attempts.iter().map(removal).collect(),
            comparison: places.comparison,
            drift: places.drift,
            location: places.location,
            final_location: places.final_location,
            detectability: detectability::cards(
                &self.path.ranking,
                last,
                in_some_groups::groups(cases).as_ref(),
                self.settings,
                cases[0].quantity(),
            ),
            control: self.control(),
            unlisted: self.unlisted(),
            experiment,
            work: self.cases.tally().done(),
        };
        Ok(Answer {
            diagnosis,
            models: rungs.map(|rung| RungModel::of(cases, rung)).collect(),
        })
    }

    /// Where the first model fails, and where the last, if it is another.
    fn places(&self) -> Result<Places, DiagnoseError> {
        let (first, last) = (&self.path.rungs[0], self.path.last());
        let (cases, seed) = (self.question.cases, self.settings.seed);
        let is_longer = last.effects != first.effects;
        let (sight, last_sight) = rayon::join(
            || TighteningFits::of(cases, first),
            || {
                is_longer
                    .then(|| TighteningFits::of(cases, last))
                    .transpose()
            },
        );
        let (sight, last_sight) = (sight?, last_sight?);
        let base = sight.seen();
        let located = |seen: &[Seen<'_>]| {
            let mut location = locate(seen, seed);
            let remarks = location.remarks.into_iter();
            location.remarks = (remarks.map(|one| one.told_in(&self.question.units))).collect();
            location
        };
        let told = |seen: &[Seen<'_>]| {
            let explained = earned::explained(cases, last, seen);
            Places {
                comparison: compare(&base),
                location: located(&base),
                final_location: is_longer.then(|| located(seen)),
                drift: drifts(&base),
                left_over: earned::left_over(cases, explained.as_ref(), seen),
                leaves_noise: earned::leaves_noise(cases, seen),
                stands_apart: (explained.as_ref()).and_then(|_| earned::stands_apart(cases, seen)),
                explained,
            }
        };
        Ok(match &last_sight {
            None => told(&base),
            Some(sight) => told(&sight.seen()),
        })
    }

    /// What the words are about.
    fn situation<'s>(
        &'s self,
        verdict: Verdict,
        ranking: &'s [RankedEffect],
        corrected: &'s [CorrectedEffect],
    ) -> Situation<'s> {
        let path = &self.path;
        let clusters = Clusters::of(self.question.cases);
        Situation {
            verb: self.question.goal.verb(),
            verdict,
            tightenings: self.question.cases.len(),
            fitted_output: self.question.cases[0].quantity(),
            units: &self.question.units,
            clusters,
            before: &path.rungs[0],
            after: path.last(),
            additions: &path.additions,
            chosen: path.chosen.map(|index| &path.ranking.candidates[index]),
            twins: (path.chosen)
                .map_or_else(Vec::new, |index| twins(&path.ranking, index, &clusters)),
            in_model: &[],
            ranking,
            stopped: path.stopped,
            impossible: &path.ranking.impossible,
            corrected,
            rig: Held::of(self.question.cases),
            settings: self.settings,
            explained: None,
            changes: None,
            suspicions: &[],
            is_more_than_noise: false,
            promising: path.is_promising(self.settings).map(|one| one.effect),
        }
    }

    /// The experiment that tells the effect last named from its twin; who ended the selection does not wait for it. It is made of
    /// tightenings, so that a few long records of a machine have none.
    fn experiment(&self, situation: &Situation<'_>) -> Result<Option<Experiment>, DiagnoseError> {
        let Some((first, second)) = situation.twin_pair() else {
            return Ok(None);
        };
        if self.path.is_interrupted() || !situation.clusters.are_whole() {
            return Ok(None);
        }
        self.watch
            .begin("looking for the experiment that tells the twins apart")?;
        Ok(separating_experiment(self.cases, first, second))
    }

    /// The candidates, the chosen one first, and behind them the trends.
    fn ranking(&self, drift: &[Drift]) -> Vec<RankedEffect> {
        let mut ranked = self.told(self.path.last(), &self.path.ranking, self.path.chosen);
        if !ranked.is_empty() {
            let (cases, level) = (self.question.cases, self.settings.level);
            ranked.extend(trends(drift, cases, level));
        }
        ranked
    }

    /// What was ranked beside the model of a rung before the next was taken, what was taken first.
    fn ranked_beside(&self, rung: usize) -> Vec<RankedEffect> {
        let Some(Some(ranked)) = self.path.ranked.get(rung) else {
            return Vec::new();
        };
        let (before, after) = (&self.path.rungs[rung], &self.path.rungs[rung + 1]);
        let is_taken =
            |effect: Effect| after.effects.contains(&effect) && !before.effects.contains(&effect);
        let mut all = ranked.ranking.candidates.iter();
        let taken = all.position(|one| is_taken(one.effect));
        self.told(&ranked.beside, &ranked.ranking, taken)
    }

    fn told(&self, beside: &Fitted, ranking: &Ranking, chosen: Option<usize>) -> Vec<RankedEffect> {
        RankingTold {
            cases: self.question.cases,
            settings: self.settings,
            beside,
            ranking,
        }
        .all(chosen)
    }

    fn added(&self) -> Vec<AddedEffect> {
        let (cases, last) = (self.question.cases, self.path.last());
        let known = self.path.rungs[0]
            .effects
            .iter()
            .map(|&effect| (effect, None));
        let added = self
            .path
            .additions
            .iter()
            .map(|one| (one.effect, Some(one)));
        known
            .chain(added)
            .filter(|(effect, _)| last.effects.contains(effect))
            .map(|(effect, one): (Effect, Option<&Addition>)| {
                let sizes = parameters(cases, last, effect);
                AddedEffect {
                    effect: effect.name().to_owned(),
                    kind: effect.description().kind.name().to_owned(),
                    expression: declaration(effect).map(|d| d.expression),
                    twins: one.map_or_else(Vec::new, |one| {
                        one.twins
                            .iter()
                            .map(|twin| twin.name().to_owned())
                            .collect()
                    }),
                    p_family: one.map(|one| one.p_family),
                    heldout_gain: one.map(|one| one.heldout_gain),
                    needed: (self.path.attempts.iter())
                        .find(|attempt| attempt.effect == effect)
                        .map(|attempt| attempt.loss / last.squares()),
                    explanation: explanation(effect, last, Held::of(cases)),
                    size: sharing(&sizes),
                    parameters: sizes,
                    comparisons: Vec::new(),
                }
            })
            .collect()
    }

    fn control(&self) -> Option<NegativeControl> {
        let (campaigns, false_alarms) = self.path.ranking.control;
        if campaigns == 0 {
            return None;
        }
        let interval = snug_statistics::proportion::wilson(false_alarms, campaigns, 0.95)
            .ok()?
            .interval;
        Some(NegativeControl {
            campaigns,
            false_alarms,
            nominal_rate: self.settings.level,
            rate_low: interval.low,
            rate_high: interval.high,
        })
    }

    /// The unlisted term that was added or that the ranking chose.
    fn unlisted(&self) -> Option<UnlistedTerm> {
        let added = self
            .path
            .additions
            .iter()
            .find(|one| is_unlisted(one.effect));
        let chosen = self
            .path
            .chosen
            .map(|index| &self.path.ranking.candidates[index]);
        let (effect, gain, fitted) = match (added, chosen) {
            (Some(one), _) => (one.effect, one.heldout_gain, self.path.last()),
            (None, Some(one)) if is_unlisted(one.effect) => {
                (one.effect, one.share_beside(self.path.last()), &one.fitted)
            }
            _ => return None,
        };
        let declared = declaration(effect)?;
        let sizes = parameters(self.question.cases, fitted, effect);
        Some(UnlistedTerm {
            statement: statement::unlisted(
                &declared.expression,
                &sizes,
                gain,
                Clusters::of(self.question.cases).cluster(),
            ),
            ron: paste(&declared, &sizes),
            expression: declared.expression,
            heldout_gain: gain,
        })
    }
}
