//! The climb: rank, add the best, tidy up, again, until nothing more is justified.

use crate::applicability::candidates;
use crate::fitted::Fitted;
use crate::ranking::{Candidate, Ranking, fit_effects, gains, rank};
use crate::units::Units;
use crate::unlisted::is_unlisted;
use crate::{Case, DiagnoseError, DiagnoseSettings};
use snug_model::Effect;

/// An effect that was added, with what spoke for it then.
#[derive(Debug, Clone)]
pub(crate) struct Addition {
    pub effect: Effect,
    pub p_family: f64,
    /// Share of the misfit at that rung.
    pub heldout_gain: f64,
    pub twins: Vec<Effect>,
}

/// What became of an attempt to do without a term.
#[derive(Debug, Clone)]
pub(crate) struct Attempt {
    pub effect: Effect,
    pub removed: bool,
    /// Growth of the squared residual without it.
    pub loss: f64,
    /// The same as a share of the squared residual.
    pub growth: f64,
}

/// How far the climb went.
pub(crate) struct Climb {
    /// The models in order, the study's own first.
    pub rungs: Vec<Fitted>,
    pub additions: Vec<Addition>,
    pub attempts: Vec<Attempt>,
    /// The ranking against the last model.
    pub ranking: Ranking,
    /// The ranking's candidate that is supported and matters, where the climb ends without adding it.
    pub chosen: Option<usize>,
    /// Why nothing more was added; `None` where nobody tried.
    pub stopped: Option<Stop>,
}

impl Climb {
    /// A model that is not to be changed and nothing ranked beside it.
    pub fn only(fitted: Fitted) -> Self {
        Self {
            rungs: vec![fitted],
            additions: Vec::new(),
            attempts: Vec::new(),
            ranking: Ranking::default(),
            chosen: None,
            stopped: None,
        }
    }

    /// The last model.
    pub fn last(&self) -> &Fitted {
        self.rungs.last().expect("a climb begins with a rung")
    }

    /// A candidate that is not supported, but might be with more tightenings.
    pub fn is_promising(&self, settings: &DiagnoseSettings) -> Option<&Candidate> {
        let squares = self.last().squares();
        self.ranking.candidates.iter().find(|candidate| {
            candidate.p_family > settings.level
                && candidate.p_family < PROMISING_P
                && candidate.gain() > 2.0 * settings.smallest_gain * squares
                && candidate.clearness() > 1.0
        })
    }
}

/// Family-wise p below which a large but unsupported candidate leaves the verdict open.
const PROMISING_P: f64 = 0.3;

/// Why the climb stopped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Stop {
    /// No candidate reaches the level.
    NothingSupported { best_p: f64 },
    /// The best supported candidate lowers the error by too little to matter.
    TooSmall { share: f64 },
    /// The model cannot carry more.
    Full,
}

/// Effects a model can be extended by before the climb is called off.
const MOST_EFFECTS: usize = 5;

impl Candidate {
    /// Whether the data support it: beyond chance over the family, and a gain in held-out tightenings.
    pub fn is_supported(&self, settings: &DiagnoseSettings) -> bool {
        self.p_family <= settings.level && self.gain() > 0.0 && self.clearness() > 1.0
    }
}

/// The first supported candidate that removes enough to matter, or why there is none.
pub(crate) fn justified(
    ranking: &Ranking,
    current: &Fitted,
    settings: &DiagnoseSettings,
) -> Result<usize, Stop> {
    let supported = |candidate: &Candidate| candidate.is_supported(settings);
    match ranking.candidates.iter().position(supported) {
        Some(index) => {
            let share = ranking.candidates[index].gain() / current.squares();
            match share >= settings.smallest_gain {
                true => Ok(index),
                false => Err(Stop::TooSmall { share }),
            }
        }
        None => {
            let gains =
                |candidate: &&Candidate| candidate.gain() > 0.0 && candidate.clearness() > 1.0;
            let all = ranking.candidates.iter().filter(gains);
            Err(Stop::NothingSupported {
                best_p: all.map(|candidate| candidate.p_family).fold(1.0, f64::min),
            })
        }
    }
}

/// The study's own model and what could be missing beside it; nothing is added.
pub(crate) fn rank_only(
    cases: &[Case],
    own: &[Effect],
    custom: &[Effect],
    units: Units,
    settings: &DiagnoseSettings,
    tell: &(dyn Fn(&str) + Sync),
) -> Result<Climb, DiagnoseError> {
    let mut climb = Climb::only(fit_effects(cases, own, None, units)?);
    let search = Search {
        cases,
        custom,
        units,
        settings,
        tell,
    };
    climb.ranking = search.rank(climb.last(), settings.control_campaigns)?;
    match justified(&climb.ranking, climb.last(), settings) {
        Ok(best) => {
            let steps = search.choose(climb.last(), &climb.ranking, best, MOST_EFFECTS)?;
            let first = steps.first().map(|(addition, _)| addition.effect);
            let all = &climb.ranking.candidates;
            climb.chosen = all
                .iter()
                .position(|candidate| Some(candidate.effect) == first);
        }
        Err(stop) => climb.stopped = Some(stop),
    }
    Ok(climb)
}

/// The study's own model with `effects` added one after the other, and what is missing then.
pub(crate) fn add(
    cases: &[Case],
    own: &[Effect],
    effects: &[Effect],
    custom: &[Effect],
    units: Units,
    settings: &DiagnoseSettings,
    tell: &(dyn Fn(&str) + Sync),
) -> Result<Climb, DiagnoseError> {
    let mut climb = Climb::only(fit_effects(cases, own, None, units)?);
    let search = Search {
        cases,
        custom,
        units,
        settings,
        tell,
    };
    for &effect in effects {
        let ranking = search.rank_these(climb.last(), effect)?;
        let index = ranking.candidates.iter().position(|c| c.effect == effect);
        let Some(index) = index else { continue };
        let (addition, fitted) = step(&ranking, index, climb.last());
        climb.additions.push(addition);
        climb.rungs.push(search.settled(&fitted)?);
    }
    climb.ranking = search.rank(climb.last(), settings.control_campaigns)?;
    match justified(&climb.ranking, climb.last(), settings) {
        Ok(best) => climb.chosen = Some(search.single(&climb.ranking, best)),
        Err(stop) => climb.stopped = Some(stop),
    }
    Ok(climb)
}

/// Climbs from the study's own effects as far as the data justify.
pub(crate) fn climb(
    cases: &[Case],
    own: &[Effect],
    custom: &[Effect],
    units: Units,
    settings: &DiagnoseSettings,
    tell: &(dyn Fn(&str) + Sync),
) -> Result<Climb, DiagnoseError> {
    let mut climb = Climb::only(fit_effects(cases, own, None, units)?);
    let search = Search {
        cases,
        custom,
        units,
        settings,
        tell,
    };
    loop {
        climb.ranking = search.rank(climb.last(), settings.control_campaigns)?;
        if climb.additions.len() >= MOST_EFFECTS {
            climb.stopped = Some(Stop::Full);
            break;
        }
        let best = match justified(&climb.ranking, climb.last(), settings) {
            Ok(best) => best,
            Err(stop) => {
                climb.stopped = Some(stop);
                break;
            }
        };
        let room = MOST_EFFECTS - climb.additions.len();
        for (addition, fitted) in search.choose(climb.last(), &climb.ranking, best, room)? {
            climb.additions.push(addition);
            climb.rungs.push(search.settled(&fitted)?);
        }
    }
    search.try_removals(&mut climb)?;
    Ok(climb)
}

type Step = (Addition, Fitted);

fn step(ranking: &Ranking, index: usize, current: &Fitted) -> Step {
    let candidate = &ranking.candidates[index];
    let addition = Addition {
        effect: candidate.effect,
        p_family: candidate.p_family,
        heldout_gain: candidate.gain() / misfit(current),
        twins: twins(ranking, index),
    };
    (addition, candidate.fitted.clone())
}

/// What stays the same during a climb.
struct Search<'a> {
    cases: &'a [Case],
    custom: &'a [Effect],
    units: Units,
    settings: &'a DiagnoseSettings,
    tell: &'a (dyn Fn(&str) + Sync),
}

impl Search<'_> {
    fn rank(&self, current: &Fitted, control_campaigns: usize) -> Result<Ranking, DiagnoseError> {
        (self.tell)(&format!(
            "ranking what is missing beside {}",
            list(&current.effects)
        ));
        let all = candidates(self.cases, current, self.custom)?;
        rank(
            self.cases,
            current,
            &all,
            self.units,
            self.settings,
            control_campaigns,
        )
    }

    /// The same effects, fitted from there to the end.
    fn settled(&self, fitted: &Fitted) -> Result<Fitted, DiagnoseError> {
        fit_effects(self.cases, &fitted.effects, Some(fitted), self.units)
    }

    /// The ranking, with `effect` among the candidates whatever it is.
    fn rank_these(&self, current: &Fitted, effect: Effect) -> Result<Ranking, DiagnoseError> {
        let mut all = candidates(self.cases, current, self.custom)?;
        if !all.contains(&effect) {
            all.push(effect);
        }
        (self.tell)(&format!("adding {}", effect.name()));
        rank(self.cases, current, &all, self.units, self.settings, 0)
    }

    /// The best candidate, or a supported catalogue effect that is as good.
    fn single(&self, ranking: &Ranking, best: usize) -> usize {
        match self.listed(ranking) {
            Some(listed)
                if ranking.candidates[best].ahead_of(&ranking.candidates[listed]) < EQUAL
                    && !self
                        .leaves_more(&ranking.candidates[listed], &ranking.candidates[best]) =>
            {
                listed
            }
            _ => best,
        }
    }

    /// Whether `one` plainly leaves more than `other` of a long record, whose few stretches hardly make that a statistic.
    fn leaves_more(&self, one: &Candidate, other: &Candidate) -> bool {
        !self.units.are_whole() && one.fitted.squares() > PLAINLY_MORE * other.fitted.squares()
    }

    /// The first supported effect of the catalogue.
    fn listed(&self, ranking: &Ranking) -> Option<usize> {
        let all = &ranking.candidates;
        all.iter()
            .position(|c| !is_unlisted(c.effect) && c.is_supported(self.settings))
    }

    /// What to add: one effect, or, where one leaves much, the two that together leave least. Of equals a catalogue
    /// effect comes before an unlisted term.
    fn choose(
        &self,
        current: &Fitted,
        ranking: &Ranking,
        best: usize,
        room: usize,
    ) -> Result<Vec<Step>, DiagnoseError> {
        let winner = &ranking.candidates[best];
        let single = self.single(ranking, best);
        let left = &ranking.candidates[single].fitted;
        let leaves_much = misfit(left) > MUCH_LEFT * misfit(current)
            && (!left.is_weighted || left.scale() > 1.0 + 2.0 * self.settings.smallest_gain);
        let half = |listed: usize| ranking.candidates[listed].gain() > 0.5 * winner.gain();
        let challenged = is_unlisted(winner.effect) && self.listed(ranking).is_some_and(half);
        let alone = vec![step(ranking, single, current)];
        // In stretches of one long record the next rung shows as much, for a third of the work.
        let pays = room > 1 && self.units.are_whole();
        if !pays || !(challenged || leaves_much) {
            return Ok(alone);
        }
        let Some((seed, together, second)) = self.best_pair(current, ranking)? else {
            return Ok(alone);
        };
        let one = &ranking.candidates[single];
        let better = together.gain() > one.gain() && together.ahead_of(one) > EQUAL;
        // Two catalogue effects that leave as little as one unlisted term are the likelier story.
        let as_good = is_unlisted(one.effect) && one.ahead_of(&together) < EQUAL;
        Ok(match better || as_good {
            true => vec![step(ranking, seed, current), second],
            false => alone,
        })
    }

    /// The two catalogue effects that together explain most: where the first stands in the ranking, both, the second.
    fn best_pair(
        &self,
        current: &Fitted,
        ranking: &Ranking,
    ) -> Result<Option<(usize, Candidate, Step)>, DiagnoseError> {
        let heldout = current.heldout_beyond_torque_noise();
        let mut pair: Option<(usize, Candidate, Step)> = None;
        let all = ranking.candidates.iter().enumerate();
        let seeds = all
            .filter(|(_, c)| !is_unlisted(c.effect) && c.is_supported(self.settings))
            .take(SEEDS);
        for (seed, candidate) in seeds {
            let first = &candidate.fitted;
            (self.tell)(&format!("looking ahead from {}", list(&first.effects)));
            let mut seconds = candidates(self.cases, first, self.custom)?;
            seconds.retain(|&effect| !is_unlisted(effect));
            let next = rank(self.cases, first, &seconds, self.units, self.settings, 0)?;
            let Ok(second) = justified(&next, first, self.settings) else {
                continue;
            };
            let mut together = next.candidates[second].clone();
            together.gains = gains(&heldout, &together.fitted);
            if (pair.as_ref()).is_none_or(|(_, known, _)| together.gain() > known.gain()) {
                pair = Some((seed, together, step(&next, second, first)));
            }
        }
        Ok(pair)
    }

    /// Tries to do without each added term once.
    fn try_removals(&self, climb: &mut Climb) -> Result<(), DiagnoseError> {
        if climb.additions.len() < 2 {
            return Ok(());
        }
        let added: Vec<Effect> = climb.additions.iter().map(|one| one.effect).collect();
        for effect in added {
            let full = climb.last().clone();
            (self.tell)(&format!("trying to do without {}", effect.name()));
            let mut effects = full.effects.clone();
            effects.retain(|known| *known != effect);
            // A model that cannot even be run without it needs it.
            let Ok(without) = fit_effects(self.cases, &effects, Some(&full), self.units) else {
                continue;
            };
            let losses = gains(&without.heldout_beyond_torque_noise(), &full);
            let loss: f64 = losses.iter().sum();
            let growth = loss / full.squares();
            let removed = growth < self.settings.smallest_gain
                || crate::evidence::clearness(&losses, full.scale()) < 1.0;
            climb.attempts.push(Attempt {
                effect,
                removed,
                loss,
                growth,
            });
            if removed {
                climb.additions.retain(|one| one.effect != effect);
                climb.rungs.push(without);
            }
        }
        if climb.attempts.iter().any(|attempt| attempt.removed) {
            climb.ranking = self.rank(climb.last(), self.settings.control_campaigns)?;
        }
        Ok(())
    }
}

/// Share of the misfit left by one effect beyond which two are tried together.
const MUCH_LEFT: f64 = 0.1;
/// Effects from which a second is looked for.
const SEEDS: usize = 3;

/// Squared residual beyond the noise of each unit; where the noise is not known, all of it.
pub(crate) fn misfits(fitted: &Fitted) -> Vec<f64> {
    let noise = |count: usize| {
        if fitted.is_weighted {
            count as f64
        } else {
            0.0
        }
    };
    let blocks = fitted.blocks.iter();
    blocks
        .map(|block| block.squares - noise(block.count))
        .collect()
}

/// Squared residual beyond the noise; where the noise is not known, all of it.
pub(crate) fn misfit(fitted: &Fitted) -> f64 {
    let squares = fitted.squares();
    let noise = if fitted.is_weighted {
        fitted.count() as f64
    } else {
        0.0
    };
    (squares - noise).max(squares * 1e-3)
}

/// Growth of the squared residual of a long record that is no matter of chance.
const PLAINLY_MORE: f64 = 1.3;

/// Standard deviations within which two candidates explain equally much.
pub(crate) const EQUAL: f64 = 2.0;

/// Supported candidates that these data cannot tell from the one at `index`.
pub(crate) fn twins(ranking: &Ranking, index: usize) -> Vec<Effect> {
    let chosen = &ranking.candidates[index];
    ranking
        .candidates
        .iter()
        .filter(|other| {
            other.effect != chosen.effect
                && !is_unlisted(other.effect)
                && other.gain() > 0.0
                && other.clearness() > 1.0
                && chosen.ahead_of(other).abs() < EQUAL
        })
        .map(|other| other.effect)
        .collect()
}

fn list(effects: &[Effect]) -> String {
    match effects {
        [] => "the base model".to_owned(),
        some => some
            .iter()
            .map(|effect| effect.name())
            .collect::<Vec<_>>()
            .join(" + "),
    }
}
