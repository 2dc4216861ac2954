//! Which tightenings share the sizes of an effect: all of them, or those of one group of a factor.

use crate::pooled::parameter_place::effect_of;
use snug_campaign::{Factor, Level};
use snug_identify::FitTask;
use snug_model::{Effect, Law, Scope};

/// The effects whose sizes differ from group to group, and by which factor; all others share theirs.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Sharing(Vec<(Effect, Factor)>);

impl Sharing {
    /// By which factor the sizes of `effect` differ.
    pub fn factor(&self, effect: Effect) -> Option<Factor> {
        let known = self.0.iter().find(|(known, _)| *known == effect);
        known.map(|&(_, factor)| factor)
    }

    /// The same with the sizes of `effect` the same for all, or another for each group.
    pub fn with(&self, effect: Effect, factor: Option<Factor>) -> Self {
        let others = self.0.iter().filter(|(known, _)| *known != effect);
        let this = factor.map(|factor| (effect, factor));
        Self(others.copied().chain(this).collect())
    }

    /// What it says of these effects.
    pub fn among(&self, effects: &[Effect]) -> Self {
        let known = self.0.iter().filter(|(effect, _)| effects.contains(effect));
        Self(known.copied().collect())
    }

    pub fn is_by_group(&self) -> bool {
        !self.0.is_empty()
    }
}

/// A size that some tightenings share.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SharedSize {
    /// Which of the model's parameters it is.
    pub index: usize,
    /// The group whose size it is; `None` where all share it.
    pub level: Option<Level>,
}

/// What is shared of the parameters `common`, and which of it each case has.
pub(crate) fn shared_sizes(
    cases: &[FitTask<'_>],
    effects: &[Effect],
    sharing: &Sharing,
    common: &[usize],
) -> (Vec<SharedSize>, Vec<Vec<usize>>) {
    let mut shared = Vec::new();
    let mut shared_of = vec![Vec::new(); cases.len()];
    for &index in common {
        let groups = effect_of(effects, index)
            .filter(|&(effect, offset)| differs_by_group(effect, offset))
            .and_then(|(effect, _)| sharing.factor(effect))
            .and_then(|factor| Groups::of(cases, factor));
        let first = shared.len();
        match groups {
            Some(groups) => {
                for (own, group) in shared_of.iter_mut().zip(groups.of) {
                    own.push(first + group);
                }
                let levels = groups.levels.into_iter().map(Some);
                shared.extend(levels.map(|level| SharedSize { index, level }));
            }
            None => {
                shared_of.iter_mut().for_each(|own| own.push(first));
                shared.push(SharedSize { index, level: None });
            }
        }
    }
    (shared, shared_of)
}

/// The groups of tightenings by one factor.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Groups {
    pub factor: Factor,
    /// In their order.
    pub levels: Vec<Level>,
    /// The group of each tightening.
    pub of: Vec<usize>,
}

impl Groups {
    /// The groups of `factor`; `None` where it is not known of every tightening.
    pub fn of(cases: &[FitTask<'_>], factor: Factor) -> Option<Self> {
        let own: Option<Vec<Level>> = (cases.iter())
            .map(|case| factor.level(&case.tightening))
            .collect();
        let own = own?;
        let mut levels = own.clone();
        levels.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        levels.dedup();
        let place = |level: &Level| levels.iter().position(|known| known == level);
        let of: Option<Vec<usize>> = own.iter().map(place).collect();
        Some(Self {
            factor,
            of: of?,
            levels,
        })
    }

    /// The factors by which sizes could differ: with several groups of at least two tightenings each, and no factor that
    /// groups them as another before it.
    pub fn worth_trying(cases: &[FitTask<'_>]) -> Vec<Self> {
        let mut worth: Vec<Self> = Vec::new();
        for factor in Factor::ALL {
            let Some(groups) = Self::of(cases, factor) else {
                continue;
            };
            let mut counts = vec![0_usize; groups.levels.len()];
            groups.of.iter().for_each(|&group| counts[group] += 1);
            let is_known = worth.iter().any(|known| known.says_the_same_as(&groups));
            if counts.len() > 1 && counts.iter().all(|&count| count > 1) && !is_known {
                worth.push(groups);
            }
        }
        worth
    }

    /// Whether both put the same tightenings together.
    fn says_the_same_as(&self, other: &Self) -> bool {
        if self.levels.len() != other.levels.len() {
            return false;
        }
        let mut partner = vec![None; self.levels.len()];
        (self.of.iter().zip(&other.of))
            .all(|(&own, &others)| *partner[own].get_or_insert(others) == others)
    }

    /// The tightenings of each group.
    pub fn members(&self) -> Vec<Vec<usize>> {
        let mut members = vec![Vec::new(); self.levels.len()];
        for (member, &group) in self.of.iter().enumerate() {
            members[group].push(member);
        }
        members
    }
}

/// Which parameters of an effect are how much there is of it, and so differ where it does; the others say how it acts.
pub(crate) fn differs_by_group(effect: Effect, offset: usize) -> bool {
    let spec = &effect.description().parameters[offset];
    spec.scope == Scope::Shared && (spec.vanishes_at.is_some() || offset == 0)
}
