//! What speaks for a verdict, as data: the sentences stand in `snug_campaign::words`.

use crate::data::clusters::Clusters;
use crate::data::machine::is_machine;
use crate::library::{declaration, in_words, named};
use crate::pooled::fitted::Fitted;
use crate::ranking::rank::Candidate;
use crate::selection::path::{Addition, Attempt, Stop, laws_may_matter, least_share};
use crate::selection::thresholds::{MATTERS, NEARLY_ALL, SMALL};
use crate::settings::DiagnoseSettings;
use crate::verdict::changes::are_above_all;
use crate::verdict::earned::leaves_more_than_noise;
use snug_campaign::words::changes::Changes;
use snug_campaign::words::effect_name::Named;
use snug_campaign::words::explained::Explained;
use snug_campaign::words::headline::{Fall, Headline, Left, NoModel};
use snug_campaign::words::reason::{MoreData, Reason};
use snug_campaign::words::statement::{self, Fate};
use snug_campaign::words::stopped::Stopped;
use snug_campaign::words::suspicion::Suspicion;
use snug_campaign::{
    AddedEffect, CorrectedEffect, EffectParameter, Factor, Quantity, RankedEffect, Removal,
    SignalUnits, Verdict,
};
use snug_identify::FitTask;
use snug_model::{CustomEffectSettings, Description, Effect, Law, TRENDS};

/// What a verdict rests on.
pub(crate) struct Situation<'a> {
    pub verb: &'static str,
    pub verdict: Verdict,
    pub tightenings: usize,
    pub fitted_output: Quantity,
    pub units: &'a SignalUnits,
    /// What is held out in turn: whole tightenings, or stretches of few long records.
    pub clusters: Clusters,
    pub before: &'a Fitted,
    pub after: &'a Fitted,
    pub additions: &'a [Addition],
    /// The candidate that is supported and not in the model.
    pub chosen: Option<&'a Candidate>,
    /// What these data cannot tell from it.
    pub twins: Vec<Effect>,
    /// The effects of the last model with their sizes.
    pub in_model: &'a [AddedEffect],
    pub ranking: &'a [RankedEffect],
    pub stopped: Option<Stop>,
    /// Candidates that cannot be simulated on this rig.
    pub impossible: &'a [Effect],
    /// What preparation took out.
    pub corrected: &'a [CorrectedEffect],
    pub rig: Held,
    pub settings: &'a DiagnoseSettings,
    /// How much the last model explains, where no noise says what is enough.
    pub explained: Option<Explained>,
    /// What changes along the recordings.
    pub changes: Option<Changes>,
    /// What to check where no model fits.
    pub suspicions: &'a [Suspicion],
    /// Whether the verdict is open because more is left than noise, though it hardly repeats and nothing explains it.
    pub is_more_than_noise: bool,
    /// A candidate that is not supported and might be with more data.
    pub promising: Option<Effect>,
}

impl Situation<'_> {
    /// What changes along the recordings, where that is so much that nothing was looked for.
    fn changes_above_all(&self) -> Option<&Changes> {
        let changes = self.changes.as_ref();
        changes.filter(|changes| are_above_all(changes) && self.ranking.is_empty())
    }

    /// Two effects that are to be told apart by an experiment, if there are: the one that is missing or was added last, and
    /// its twin.
    pub fn twin_pair(&self) -> Option<(&Fitted, Effect)> {
        if let Some(chosen) = self.chosen {
            return Some((&chosen.fitted, *self.twins.first()?));
        }
        let added = self.additions.last()?;
        let twin = *added.twins.first()?;
        (self.after.effects.last() == Some(&added.effect)).then_some((self.after, twin))
    }

    fn left(&self, fitted: &Fitted) -> Left {
        match fitted.is_weighted {
            true => Left::over_noise(fitted.error()),
            false => Left::of_output(fitted.error(), self.fitted_output, self.units),
        }
    }

    fn fall(&self, before: &Fitted, after: &Fitted) -> Fall {
        Fall {
            before: self.left(before),
            after: self.left(after),
        }
    }

    fn is_interrupted(&self) -> bool {
        self.stopped == Some(Stop::Interrupted)
    }

    /// What was added, that first which explains most; what is small beside it only where `is_small`. What takes nearly all of what the
    /// others leave, as it came in or beside all that came after, is not: an angle that is read 5 rad too large makes any friction a
    /// trifle.
    fn added(&self, is_small: bool) -> Vec<Named> {
        let takes_nearly_all = |one: &Addition| {
            let mut in_model = self.in_model.iter();
            let told = in_model.find(|known| known.effect == one.effect.name());
            let lost = told.and_then(|told| told.needed).unwrap_or(0.0);
            one.heldout_gain.max(lost / (1.0 + lost)) >= NEARLY_ALL
        };
        let small = |one: &&Addition| {
            !self.after.is_weighted && one.share_of_first < SMALL && !takes_nearly_all(one)
        };
        let mut added: Vec<&Addition> = (self.additions.iter())
            .filter(|one| small(one) == is_small)
            .collect();
        if !self.after.is_weighted {
            added.sort_by(|a, b| b.share_of_first.total_cmp(&a.share_of_first));
        }
        (added.into_iter())
            .map(|one| with_twins(one.effect, &one.twins, self.after))
            .collect()
    }
}

/// An effect of `fitted` with what these data cannot tell from it.
fn with_twins(effect: Effect, twins: &[Effect], fitted: &Fitted) -> Named {
    Named {
        says: in_words(effect, fitted.size(effect)),
        twins: all_named(twins),
        ..named(effect)
    }
}

fn all_named(effects: &[Effect]) -> Vec<Named> {
    effects.iter().copied().map(named).collect()
}

/// The verdict with what it rests on.
pub(crate) fn headline(situation: &Situation<'_>) -> Headline {
    let fell = situation.fall(situation.before, situation.after);
    let (added, further) = (situation.added(false), situation.added(true));
    if situation.is_interrupted() {
        let added = [added, further].concat();
        return Headline::Stopped { added, fall: fell };
    }
    let is_open = matches!(situation.verdict, Verdict::NotFitted | Verdict::Undecided);
    if let Some(changes) = situation.changes_above_all().filter(|_| is_open) {
        return Headline::Changes {
            changes: changes.clone(),
            left: fell.after,
        };
    }
    match (situation.verdict, situation.chosen) {
        (Verdict::MissingEffect, Some(chosen))
            if situation.after.effects.contains(&chosen.effect) =>
        {
            let factor = chosen.fitted.sharing.factor(chosen.effect);
            Headline::Differs {
                effect: named(chosen.effect),
                groups: factor.map_or("tightenings", Factor::plural),
                fall: situation.fall(situation.after, &chosen.fitted),
            }
        }
        (Verdict::MissingEffect | Verdict::UnlistedEffect, Some(chosen)) => Headline::Lacks {
            effect: with_twins(chosen.effect, &situation.twins, &chosen.fitted),
            fall: situation.fall(situation.after, &chosen.fitted),
        },
        (Verdict::UnlistedEffect, None) if !added.is_empty() => Headline::Unlisted {
            added,
            further,
            describes: !leaves_more_than_noise(
                situation.before,
                situation.after,
                situation.explained.as_ref(),
            ),
            fall: fell,
        },
        (Verdict::UnlistedEffect, None) => Headline::Unexplained(fell.after),
        (Verdict::Adequate, _) => Headline::Adequate {
            added,
            further,
            fall: fell,
            explained: situation.explained,
        },
        (Verdict::NotFitted, _) => {
            no_model(situation).map_or(Headline::Compared(fell.after), Headline::NoModel)
        }
        (Verdict::Undecided, _) if situation.verb == "compare" => Headline::Compared(fell.after),
        (Verdict::Undecided, _) if situation.is_more_than_noise => Headline::MoreThanNoise {
            added: [added, further].concat(),
            fall: fell,
            explained: situation.explained,
            changes: situation.changes.clone(),
        },
        (Verdict::Undecided | Verdict::MissingEffect, _) => Headline::TooLittle {
            tightenings: situation
                .clusters
                .are_whole()
                .then_some(situation.tightenings),
            added: [added, further].concat(),
            fall: fell,
        },
    }
}

/// Why there is no model: what is suspected first, else how much the best explains.
fn no_model(situation: &Situation<'_>) -> Option<NoModel> {
    let told = match situation.suspicions.first() {
        Some(Suspicion::Units(units)) => NoModel::OtherUnits(units.clone()),
        Some(&Suspicion::Sign(share)) => NoModel::OtherChannel {
            are_swapped: false,
            share,
        },
        Some(&Suspicion::Swapped(share)) => NoModel::OtherChannel {
            are_swapped: true,
            share,
        },
        Some(Suspicion::TurnedRound(turned)) => NoModel::TurnedRound(turned.clone()),
        Some(Suspicion::PushesAway(_)) => NoModel::PushesAway,
        Some(&Suspicion::RestartedTooSeldom(seldom)) => NoModel::RestartedTooSeldom(seldom),
        Some(&Suspicion::HardlyTried { tried, of }) => NoModel::HardlyTried { tried, of },
        _ => NoModel::NotFitted(situation.explained?),
    };
    Some(told)
}

/// Why.
pub(crate) fn reasons(situation: &Situation<'_>) -> Vec<Reason> {
    let mut reasons: Vec<Reason> = what_is_left(situation).into_iter().collect();
    reasons.extend(situation.changes.clone().map(Reason::Changes));
    reasons.extend(situation.suspicions.iter().cloned().map(Reason::Check));
    let additions = situation.additions.iter();
    reasons.extend(
        additions.map(|one| removes(one.effect, one.heldout_gain, one.p_family, situation)),
    );
    reasons.extend(whose(situation));
    reasons.extend(what_speaks_for_the_chosen(situation));
    reasons.extend(trends(situation));
    reasons.extend((situation.corrected.iter()).map(|one| taken_out(one, situation.rig)));
    if !situation.impossible.is_empty() {
        reasons.push(Reason::NotSimulated(all_named(situation.impossible)));
    }
    reasons.extend(laws_left_out(situation));
    reasons.extend(what_would_decide(situation));
    reasons
}

/// That laws in no catalogue were not ranked beside the last model, if so.
fn laws_left_out(situation: &Situation<'_>) -> Option<Reason> {
    let (before, after) = (situation.before, situation.after);
    let were_others_only =
        !situation.ranking.is_empty() && !situation.ranking.iter().any(|one| one.unlisted);
    (were_others_only && !laws_may_matter(before, after)).then(|| Reason::LawsLeftOut {
        left: after.squares() / before.squares(),
        least: MATTERS,
    })
}

/// `None` where that is rounding, of which the headline says enough.
fn what_is_left(situation: &Situation<'_>) -> Option<Reason> {
    if situation.after.is_exact {
        return None;
    }
    Some(match situation.after.is_weighted {
        false => Reason::NoiseUnknown {
            left: situation.left(situation.after),
            beside_lines: (situation.explained.as_ref()).is_some_and(|one| one.beside_lines),
        },
        true => Reason::Error {
            tightenings: situation.tightenings,
            error: situation.after.error(),
            is_at_floor: situation.after.is_at_floor(),
            hardly_repeats: situation.verdict == Verdict::Adequate || situation.is_more_than_noise,
        },
    })
}

fn removes(effect: Effect, heldout_gain: f64, p_family: f64, situation: &Situation<'_>) -> Reason {
    Reason::Removes {
        effect: named(effect),
        heldout_gain,
        p_family,
        cluster: situation.clusters.cluster(),
        is_beyond_noise: situation.after.is_weighted,
    }
}

/// Of every added effect whose size differs between groups, who has it.
fn whose(situation: &Situation<'_>) -> Vec<Reason> {
    let additions = situation.additions.iter();
    let of_one = |effect: Effect| {
        let added = situation
            .in_model
            .iter()
            .find(|one| one.effect == effect.name());
        let parameters = added.map_or(&[][..], |added| &added.parameters);
        let differing = parameters.iter().filter(|one| one.by_group.is_some());
        differing.map(move |parameter| Reason::Whose {
            effect: named(effect),
            parameter: Box::new(parameter.clone()),
        })
    };
    additions.flat_map(|one| of_one(one.effect)).collect()
}

/// Nothing where there is no model: what takes away some of what is no model's says nothing of the rig.
fn what_speaks_for_the_chosen(situation: &Situation<'_>) -> Vec<Reason> {
    if situation.verdict == Verdict::NotFitted {
        return Vec::new();
    }
    let (Some(chosen), Some(first)) = (situation.chosen, situation.ranking.first()) else {
        return Vec::new();
    };
    let mut reasons = vec![
        removes(chosen.effect, first.heldout_gain, first.p_family, situation),
        Reason::Size(first.parameters.clone()),
    ];
    if !situation.twins.is_empty() {
        reasons.push(Reason::CannotTell(all_named(&situation.twins)));
    }
    reasons
}

fn trends(situation: &Situation<'_>) -> impl Iterator<Item = Reason> {
    TRENDS.iter().filter_map(move |trend| {
        let mut ranking = situation.ranking.iter();
        let found = ranking.find(|one| one.effect == trend.name && one.supported)?;
        Some(Reason::Drifts {
            trend: found.effect.clone(),
            parameters: found.parameters.clone(),
        })
    })
}

/// What preparation took out; where that is the rule and not the exception, with what to check.
fn taken_out(corrected: &CorrectedEffect, rig: Held) -> Reason {
    let effect = Effect::named(&corrected.effect).filter(|_| corrected.share > 0.5);
    Reason::TakenOut {
        corrected: corrected.clone(),
        check: effect.map(|effect| rig.described(effect.description()).check),
    }
}

fn what_would_decide(situation: &Situation<'_>) -> Option<Reason> {
    let is_open = situation.verdict == Verdict::Undecided
        && !situation.is_interrupted()
        && !situation.is_more_than_noise;
    if !is_open || situation.verb == "compare" {
        return None;
    }
    let is_promising = |one: &&RankedEffect| {
        (situation.promising).is_some_and(|effect| effect.name() == one.effect)
    };
    let promising = situation.ranking.iter().find(is_promising);
    let first = promising.or(situation.ranking.first())?;
    let times = (4.0 / first.score.max(0.5)).powi(2);
    let needed = (times * situation.tightenings as f64 / 4.0).ceil() * 4.0;
    Some(Reason::WouldDecide {
        effect: Named::alone(first.effect.clone(), first.expression.clone()),
        p_family: first.p_family,
        more: match situation.clusters.are_whole() {
            true => MoreData::Tightenings(needed),
            false => MoreData::Longer(times.ceil().max(2.0)),
        },
    })
}

/// Why nothing more was added.
pub(crate) fn stopped(situation: &Situation<'_>) -> Option<Stopped> {
    Some(match situation.stopped? {
        Stop::NothingSupported { best_p } => Stopped::NothingSupported {
            best_p,
            level: situation.settings.level,
        },
        Stop::SizeMayBeNothing { effect } => Stopped::SizeMayBeNothing(named(effect)),
        Stop::OfRestarts { effect } => Stopped::OfRestarts(named(effect)),
        Stop::TooSmall { effect, share } => Stopped::TooSmall {
            effect: named(effect),
            share,
            smallest: situation.after.smallest_gain(situation.settings),
            is_at_floor: situation.after.is_at_floor(),
        },
        Stop::Trifle { effect, share } => Stopped::Trifle {
            effect: named(effect),
            share,
            smallest: least_share(effect),
        },
        Stop::Exact => Stopped::Exact,
        Stop::Full => Stopped::Full,
        Stop::Interrupted => Stopped::Interrupted(situation.additions.len()),
    })
}

/// Whether somebody holds the rig: the texts differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Held {
    ByHand,
    Machine,
}

impl Held {
    pub fn of(cases: &[FitTask<'_>]) -> Self {
        match cases.iter().any(is_machine) {
            true => Self::Machine,
            false => Self::ByHand,
        }
    }

    fn described(self, description: &Description) -> Description {
        match self {
            Self::ByHand => *description,
            Self::Machine => description.of_machine(),
        }
    }
}

/// What an effect of `fitted` is, how it shows, what to check at the bench.
pub(crate) fn explanation(effect: Effect, fitted: &Fitted, rig: Held) -> Vec<String> {
    match declaration(effect).zip(in_words(effect, fitted.size(effect))) {
        Some((declared, says)) => statement::described_unlisted(&declared.expression, says),
        None => described(effect.description(), rig),
    }
}

/// What the catalogue says about an effect or a trend.
pub(crate) fn described(description: &Description, rig: Held) -> Vec<String> {
    let description = rig.described(description);
    statement::described(description.summary, description.shows_as, description.check)
}

/// What became of an attempt to do without a term.
pub(crate) fn removal(attempt: &Attempt) -> Removal {
    let name = named(attempt.effect).spoken();
    Removal {
        effect: attempt.effect.name().to_owned(),
        removed: attempt.fate != Fate::Stays,
        statement: statement::removal(&name, attempt.fate, attempt.growth),
    }
}

/// RON for the study's `model.custom` list: the term, starting from what was found.
pub(crate) fn paste(declared: &CustomEffectSettings, found: &[EffectParameter]) -> String {
    let pairs = declared.parameters.iter().zip(found);
    let parameters: Vec<String> = pairs
        .map(|(one, found)| {
            let mut text = format!(
                "(name: \"{}\", unit: \"{}\", start: {:.4e}",
                one.name, found.unit, found.value
            );
            for (name, bound) in [("minimum", one.minimum), ("maximum", one.maximum)] {
                if bound.is_finite() {
                    text += &format!(", {name}: {bound}");
                }
            }
            text + ")"
        })
        .collect();
    format!(
        "(name: \"{}\", place: Force, expression: \"{}\", parameters: [{}])",
        declared.name,
        declared.expression,
        parameters.join(", ")
    )
}
