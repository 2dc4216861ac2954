//! One verb of the diagnosis from tightenings to answer: compare, diagnose, add, improve.

use crate::cases::{Cases, Tally};
use crate::climb::{Addition, Attempt, Climb, misfit, misfits};
use crate::experiment::separating_experiment;
use crate::fitted::{AT_FLOOR, Fitted};
use crate::ranking::{Candidate, Ranking};
use crate::search::Search;
use crate::sight::Sight;
use crate::sizes::parameters;
use crate::units::Units;
use crate::unlisted::{declaration, is_unlisted};
use crate::wording::{self, Situation};
use crate::{
    Case, DiagnoseError, DiagnoseSettings, Watch, compare, detectability, drifts, ladder, locate,
    preparation, trend,
};
use snug_campaign::{
    AddedEffect, Diagnosis, EffectParameter, NegativeControl, RankedEffect, Removal, UnlistedTerm,
    Verdict,
};
use snug_model::{CustomEffectSettings, Effect, Law};

/// What is asked of the data.
#[derive(Debug, Clone, PartialEq)]
pub enum Goal {
    /// Model against measurement, and where it fails.
    Compare,
    /// The same, and which effect is missing; nothing is changed.
    Diagnose,
    /// These effects are added, whatever the ranking says of them.
    Add(Vec<Effect>),
    /// Effects are added as long as the data justify it.
    Improve,
}

/// A question to the data.
#[derive(Debug, Clone)]
pub struct Question<'a> {
    /// The tightenings.
    pub cases: &'a [Case],
    /// Effects of the study's own model.
    pub effects: Vec<Effect>,
    /// Effects that the study declares but does not use: candidates, too.
    pub custom: Vec<Effect>,
    /// What is asked.
    pub goal: Goal,
}

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

/// Answers a question.
///
/// # Errors
/// [`DiagnoseError::NothingToCompare`] without tightenings, [`DiagnoseError::Interrupted`] when `watch` ends it,
/// otherwise what the model or the fit refuses.
pub fn examine(
    question: &Question<'_>,
    settings: &DiagnoseSettings,
    watch: &Watch<'_>,
) -> Result<Answer, DiagnoseError> {
    let cases = question.cases;
    if cases.is_empty() {
        return Err(DiagnoseError::NothingToCompare {
            tightenings: 0,
            reason: "every tightening was left out; the findings say why",
        });
    }
    let tally = Tally::default();
    let counted = Cases::new(cases, &tally);
    let search = Search {
        cases: counted,
        own: &question.effects,
        custom: &question.custom,
        units: Units::of(cases),
        settings,
        watch,
    };
    let climb = match &question.goal {
        Goal::Compare => search.compare()?,
        Goal::Diagnose => search.diagnose()?,
        Goal::Add(effects) => search.add(effects)?,
        Goal::Improve => search.improve()?,
    };
    watch.begin("looking where the model fails")?;
    Examination {
        question,
        cases: counted,
        settings,
        climb,
        watch,
    }
    .answer()
}

struct Examination<'a> {
    question: &'a Question<'a>,
    cases: Cases<'a>,
    settings: &'a DiagnoseSettings,
    climb: Climb,
    watch: &'a Watch<'a>,
}

impl Examination<'_> {
    fn answer(self) -> Result<Answer, DiagnoseError> {
        let cases = self.question.cases;
        let (first, last) = (&self.climb.rungs[0], self.climb.last());
        let sight = Sight::of(cases, first)?;
        let base = sight.seen();
        let changed = last.effects != first.effects;
        let final_location = if changed {
            Some(locate(&Sight::of(cases, last)?.seen(), self.settings.seed))
        } else {
            None
        };
        let location = locate(&base, self.settings.seed);
        let verdict = self.verdict(
            final_location
                .as_ref()
                .unwrap_or(&location)
                .repeatable_share,
        );
        let drift = drifts(&base);
        let mut ranking = self.ranking();
        if !ranking.is_empty() {
            ranking.extend(trend::fatigue(&drift, cases));
        }
        let corrected = preparation::corrected(cases);
        let situation = Situation {
            verb: self.verb(),
            verdict,
            tightenings: cases.len(),
            units: Units::of(cases),
            before: first,
            after: last,
            additions: &self.climb.additions,
            chosen: self
                .climb
                .chosen
                .map(|index| &self.climb.ranking.candidates[index]),
            ranking: &ranking,
            stopped: self.climb.stopped,
            impossible: &self.climb.ranking.impossible,
            corrected: &corrected,
            settings: self.settings,
        };
        let experiment = match situation.twin_pair() {
            Some((first, second)) => {
                self.watch
                    .begin("looking for the experiment that tells the twins apart")?;
                separating_experiment(self.cases, first, second)
            }
            None => None,
        };
        let (headline, reasons, stopped) = (
            wording::headline(&situation),
            wording::reasons(&situation),
            wording::stopped(&situation),
        );
        let diagnosis = Diagnosis {
            verb: self.verb().to_owned(),
            verdict,
            headline,
            reasons,
            stopped,
            tightenings: cases.len(),
            noise: preparation::noise(cases),
            compared_output: cases[0].quantity.name().to_owned(),
            added: self.added(),
            corrected,
            ladder: self
                .climb
                .rungs
                .iter()
                .map(|rung| ladder::rung(cases, rung))
                .collect(),
            ranking,
            removals: self.climb.attempts.iter().map(removal).collect(),
            comparison: compare(&base),
            drift,
            location,
            final_location,
            detectability: detectability::cards(&self.climb.ranking, last, self.settings),
            control: self.control(),
            unlisted: self.unlisted(),
            experiment,
            showcase: None,
            work: self.cases.tally().done(),
        };
        Ok(Answer {
            diagnosis,
            models: self
                .climb
                .rungs
                .iter()
                .map(|rung| rung_model(cases, rung))
                .collect(),
        })
    }

    fn verb(&self) -> &'static str {
        match self.question.goal {
            Goal::Compare => "compare",
            Goal::Diagnose => "diagnose",
            Goal::Add(_) => "add",
            Goal::Improve => "improve",
        }
    }

    fn verdict(&self, repeatable: Option<f64>) -> Verdict {
        let last = self.climb.last();
        let added_unlisted = self
            .climb
            .additions
            .iter()
            .any(|one| is_unlisted(one.effect));
        if self.climb.ranking.candidates.is_empty() {
            return match last.is_weighted && last.error() < AT_FLOOR {
                true => Verdict::Adequate,
                false => Verdict::Undecided,
            };
        }
        if let Some(chosen) = self.climb.chosen {
            return match is_unlisted(self.climb.ranking.candidates[chosen].effect) {
                true => Verdict::UnlistedEffect,
                false => Verdict::MissingEffect,
            };
        }
        if added_unlisted {
            return Verdict::UnlistedEffect;
        }
        if last.is_weighted && last.error() > AT_FLOOR && repeatable.is_some_and(|r| r > REPEATS) {
            return Verdict::UnlistedEffect;
        }
        match self.climb.is_promising(self.settings) {
            Some(_) => Verdict::Undecided,
            None => Verdict::Adequate,
        }
    }

    fn ranking(&self) -> Vec<RankedEffect> {
        let ranking = &self.climb.ranking;
        let mut order: Vec<usize> = (0..ranking.candidates.len()).collect();
        if let Some(chosen) = self.climb.chosen {
            order.retain(|&index| index != chosen);
            order.insert(0, chosen);
        }
        let whole = misfit(self.climb.last());
        let first = order.first().map(|&index| &ranking.candidates[index]);
        order
            .iter()
            .map(|&index| self.ranked(ranking, index, whole, first))
            .collect()
    }

    fn ranked(
        &self,
        ranking: &Ranking,
        index: usize,
        misfit: f64,
        first: Option<&Candidate>,
    ) -> RankedEffect {
        let candidate = &ranking.candidates[index];
        let sizes = parameters(self.question.cases, &candidate.fitted, candidate.effect);
        let supported = candidate.is_supported(self.settings);
        let twins = match supported {
            true => crate::climb::twins(ranking, index),
            false => Vec::new(),
        };
        RankedEffect {
            effect: candidate.effect.name().to_owned(),
            kind: candidate.effect.description().kind.name().to_owned(),
            unlisted: is_unlisted(candidate.effect),
            expression: declaration(candidate.effect.name()).map(|term| term.expression),
            score: candidate.score,
            p_family: candidate.p_family,
            heldout_gain: candidate.gain() / misfit,
            heldout_gain_error: candidate.share_error(&misfits(self.climb.last())),
            error_over_noise: candidate
                .fitted
                .is_weighted
                .then(|| candidate.fitted.error()),
            behind_first: first.map_or(0.0, |first| first.ahead_of(candidate)),
            twins: twins.iter().map(|twin| twin.name().to_owned()).collect(),
            plausible: candidate.fitted.converged
                && sizes.iter().all(EffectParameter::is_plausible),
            explanation: wording::explanation(candidate.effect),
            parameters: sizes,
        }
    }

    fn added(&self) -> Vec<AddedEffect> {
        let (cases, last) = (self.question.cases, self.climb.last());
        let known = self.climb.rungs[0]
            .effects
            .iter()
            .map(|&effect| (effect, None));
        let added = self
            .climb
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
                    expression: declaration(effect.name()).map(|d| d.expression),
                    twins: one.map_or_else(Vec::new, |one| {
                        one.twins
                            .iter()
                            .map(|twin| twin.name().to_owned())
                            .collect()
                    }),
                    p_family: one.map(|one| one.p_family),
                    heldout_gain: one.map(|one| one.heldout_gain),
                    needed: (self.climb.attempts.iter())
                        .find(|attempt| attempt.effect == effect)
                        .map(|attempt| attempt.loss / last.squares()),
                    explanation: wording::explanation(effect),
                    parameters: sizes,
                }
            })
            .collect()
    }

    fn control(&self) -> Option<NegativeControl> {
        let (campaigns, false_alarms) = self.climb.ranking.control;
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
            .climb
            .additions
            .iter()
            .find(|one| is_unlisted(one.effect));
        let chosen = self
            .climb
            .chosen
            .map(|index| &self.climb.ranking.candidates[index]);
        let (effect, gain, fitted) = match (added, chosen) {
            (Some(one), _) => (one.effect, one.heldout_gain, self.climb.last()),
            (None, Some(one)) if is_unlisted(one.effect) => (
                one.effect,
                one.gain() / misfit(self.climb.last()),
                &one.fitted,
            ),
            _ => return None,
        };
        let declared = declaration(effect.name())?;
        let sizes = parameters(self.question.cases, fitted, effect);
        Some(UnlistedTerm {
            statement: wording::unlisted(&declared, gain, &sizes, Units::of(self.question.cases)),
            ron: wording::paste(&declared, &sizes),
            expression: declared.expression,
            heldout_gain: gain,
        })
    }
}

/// Share of the misfit that must repeat before it is called an effect.
const REPEATS: f64 = 0.2;

fn rung_model(cases: &[Case], fitted: &Fitted) -> RungModel {
    RungModel {
        effects: fitted
            .effects
            .iter()
            .map(|effect| effect.name().to_owned())
            .collect(),
        declarations: fitted
            .effects
            .iter()
            .filter_map(|effect| declaration(effect.name()))
            .collect(),
        base: fitted.base(),
        parameters: fitted
            .effects
            .iter()
            .flat_map(|&effect| parameters(cases, fitted, effect))
            .collect(),
    }
}

fn removal(attempt: &Attempt) -> Removal {
    Removal {
        effect: attempt.effect.name().to_owned(),
        removed: attempt.removed,
        statement: wording::removal(attempt),
    }
}
