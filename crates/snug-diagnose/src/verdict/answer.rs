//! What the data answer: the selection told as a diagnosis.

use crate::data::cases::Cases;
use crate::data::clusters::Clusters;
use crate::data::watch::Watch;
use crate::error::DiagnoseError;
use crate::library::{declaration, is_unlisted};
use crate::locate::{compare, drifts, locate};
use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::parameters;
use crate::pooled::thresholds::AT_FLOOR;
use crate::question::{Goal, Question};
use crate::ranking::rank::Ranking;
use crate::selection::path::{Addition, SelectionPath, twins};
use crate::settings::DiagnoseSettings;
use crate::verdict::comparisons::compare_sizes;
use crate::verdict::earned::{self, leaves_a_motion};
use crate::verdict::experiment::separating_experiment;
use crate::verdict::ranking_told::RankingTold;
use crate::verdict::reasons::{
    Held, Situation, explanation, headline, paste, reasons, removal, stopped,
};
use crate::verdict::thresholds::{BESIDE_EFFECTS, MOSTLY_EXPLAINED, REPEATS, WHITE};
use crate::verdict::tightening_fits::TighteningFits;
use crate::verdict::trend::trends;
use crate::verdict::{detectability, floor, in_some_groups, ladder, preparation};
use snug_campaign::words::explained::Explained;
use snug_campaign::words::statement;
use snug_campaign::words::suspicion::{FailedFit, OtherUnits, Suspicion};
use snug_campaign::{
    AddedEffect, Comparison, CorrectedEffect, Diagnosis, Drift, EffectParameter, Experiment,
    Location, NegativeControl, RankedEffect, UnlistedTerm, Verdict, sharing,
};
use snug_identify::FitTask;
use snug_model::{CustomEffectSettings, Effect, Law};

/// The model of one rung.
#[derive(Debug, Clone)]
pub struct RungModel {
    /// Its effects.
    pub effects: Vec<String>,
    /// Declarations of those effects that the study does not know yet.
    pub declarations: Vec<CustomEffectSettings>,
    /// Mass, damping and stiffness that go with them, as a place to begin; only where few long records were fitted.
    pub base: Vec<(String, f64)>,
    /// Sizes of the effects, shared ones and each tightening's own.
    pub parameters: Vec<EffectParameter>,
}

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
    pub watch: Watch<'a>,
}

/// Where the models at both ends of the selection fail.
struct Places {
    comparison: Comparison,
    location: Location,
    /// `None` where the last model is the first.
    final_location: Option<Location>,
    drift: Vec<Drift>,
    /// How much the last model explains, where no noise says what is enough.
    explained: Option<Explained>,
}

impl Places {
    fn last(&self) -> &Location {
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
        let (verdict, mut suspicions) = self.verdict_and_suspicions(&places);
        suspicions.extend(self.units_that_differ(false).map(Suspicion::Units));
        let ranking = self.ranking(&places.drift);
        let corrected = preparation::corrected(cases);
        let mut added = self.added();
        compare_sizes(cases, last, &mut added);
        let situation = Situation {
            in_model: &added,
            explained: places.explained,
            is_more_than_noise: verdict == Verdict::Undecided
                && (self.is_more_than_noise()
                    || leaves_a_motion(&self.path, self.settings, places.explained.as_ref())),
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
            ),
            control: self.control(),
            unlisted: self.unlisted(),
            experiment,
            work: self.cases.tally().done(),
        };
        Ok(Answer {
            diagnosis,
            models: rungs.map(|rung| rung_model(cases, rung)).collect(),
        })
    }

    /// Where the first model fails, and where the last, if it is another.
    fn places(&self) -> Result<Places, DiagnoseError> {
        let (first, last) = (&self.path.rungs[0], self.path.last());
        let (cases, seed) = (self.question.cases, self.settings.seed);
        let sight = TighteningFits::of(cases, first)?;
        let base = sight.seen();
        let (final_location, explained) = match last.effects == first.effects {
            true => (None, earned::explained(cases, last, &base)),
            false => {
                let sight = TighteningFits::of(cases, last)?;
                let seen = sight.seen();
                let explained = earned::explained(cases, last, &seen);
                (Some(locate(&seen, seed)), explained)
            }
        };
        Ok(Places {
            comparison: compare(&base),
            location: locate(&base, seed),
            final_location,
            drift: drifts(&base),
            explained,
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

    /// The verdict, and what to check where no model fits. A comparison leaves it at that only where there is something to check:
    /// an effect that does most of the work is for `diagnose` to find.
    fn verdict_and_suspicions(&self, places: &Places) -> (Verdict, Vec<Suspicion>) {
        let is_white = (places.explained.as_ref()).is_some_and(|all| all.neighbours.abs() < WHITE);
        let wrong = [
            self.units_that_differ(true).map(Suspicion::Units),
            self.failed_fit().map(Suspicion::FailedFit),
        ];
        let wrong: Vec<Suspicion> = wrong.into_iter().flatten().collect();
        let verdict = match wrong.is_empty() || self.path.is_interrupted() {
            true => self.verdict(places.last().repeatable_share, is_white),
            false => Verdict::NotFitted,
        };
        let (Verdict::NotFitted, Some(explained)) = (verdict, places.explained) else {
            return (verdict, wrong);
        };
        let mut suspicions = earned::suspicions(self.question.cases, explained);
        if !wrong.is_empty() {
            suspicions.retain(|one| *one != Suspicion::NoOscillator);
            suspicions.splice(0..0, wrong);
        }
        match (&self.question.goal, suspicions.as_slice()) {
            (Goal::Compare, [Suspicion::NoOscillator]) => (Verdict::Undecided, Vec::new()),
            _ => (verdict, suspicions),
        }
    }

    /// Recordings that stand apart by a prefix of a unit, or else by another load.
    fn units_that_differ(&self, is_prefix: bool) -> Option<OtherUnits> {
        let units = self.units.clone();
        units.filter(|units| units.is_prefix == is_prefix)
    }

    /// How the best model falls short of a plain regression, if it does.
    fn failed_fit(&self) -> Option<FailedFit> {
        let candidates = &self.path.ranking.candidates;
        let best = (self.path.chosen).map_or(self.path.last(), |index| &candidates[index].fitted);
        let were_tried = !candidates.is_empty();
        floor::shortfall(self.cases, best, were_tried)
    }

    /// `is_white` where what is left is as white as noise, whatever candidates promise.
    fn verdict(&self, repeatable: Option<f64>, is_white: bool) -> Verdict {
        let (last, candidates) = (self.path.last(), &self.path.ranking.candidates);
        let added_unlisted = self
            .path
            .additions
            .iter()
            .any(|one| is_unlisted(one.effect));
        if self.path.is_interrupted() {
            return Verdict::Undecided;
        }
        let best = (self.path.chosen).map_or(last, |index| &candidates[index].fitted);
        let share = earned::share(self.question.cases, best);
        if !earned::is_a_model(share) {
            return Verdict::NotFitted;
        }
        if self.path.ranking.candidates.is_empty() {
            return match last.is_at_floor() {
                true => Verdict::Adequate,
                false => Verdict::Undecided,
            };
        }
        if let Some(chosen) = self.path.chosen {
            return match is_unlisted(self.path.ranking.candidates[chosen].effect) {
                true => Verdict::UnlistedEffect,
                false => Verdict::MissingEffect,
            };
        }
        if added_unlisted {
            return Verdict::UnlistedEffect;
        }
        // What takes several effects and still leaves more than noise is something else, in pieces.
        if self.path.additions.len() > 1 && last.is_beyond_noise() {
            return Verdict::UnlistedEffect;
        }
        let floor = match self.path.additions.is_empty() {
            true => AT_FLOOR,
            false => BESIDE_EFFECTS,
        };
        if last.is_weighted && last.error() > floor && repeatable.is_some_and(|r| r > REPEATS) {
            return Verdict::UnlistedEffect;
        }
        match self.path.is_promising(self.settings) {
            Some(_) if !is_white => Verdict::Undecided,
            _ if self.is_more_than_noise() && !is_white => Verdict::Undecided,
            _ if earned::keeps_the_promise(share, self.question.cases) => Verdict::Adequate,
            _ => Verdict::NotFitted,
        }
    }

    /// Whether more is left than the noise is uncertain by, or where nobody knows the noise a good part of the output, though no candidate
    /// is chosen or promising: that is no adequate model. Beside an effect that lets go, the instants at which the grip sets in are never
    /// quite right.
    fn is_more_than_noise(&self) -> bool {
        let last = self.path.last();
        let lets_go = last.effects.iter().any(|one| one.has_unilateral_contact());
        let floor = if lets_go { BESIDE_EFFECTS } else { AT_FLOOR };
        let leaves_much = match earned::share(self.question.cases, last) {
            Some(share) => share < MOSTLY_EXPLAINED,
            None => last.error() > floor,
        };
        leaves_much && self.path.chosen.is_none() && self.path.is_promising(self.settings).is_none()
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

fn rung_model(cases: &[FitTask<'_>], fitted: &Fitted) -> RungModel {
    RungModel {
        effects: fitted
            .effects
            .iter()
            .map(|effect| effect.name().to_owned())
            .collect(),
        declarations: fitted
            .effects
            .iter()
            .filter_map(|&effect| declaration(effect))
            .collect(),
        base: fitted.base(),
        parameters: fitted
            .effects
            .iter()
            .flat_map(|&effect| parameters(cases, fitted, effect))
            .collect(),
    }
}
