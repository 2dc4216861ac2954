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
    pub fn factor(&self, effect: Effect) -> Option<&Factor> {
        let known = self.0.iter().find(|(known, _)| *known == effect);
        known.map(|(_, factor)| factor)
    }

    /// The same with the sizes of `effect` the same for all, or another for each group.
    pub fn with(&self, effect: Effect, factor: Option<Factor>) -> Self {
        let others = self.0.iter().filter(|(known, _)| *known != effect);
        let this = factor.map(|factor| (effect, factor));
        Self(others.cloned().chain(this).collect())
    }

    /// What it says of these effects.
    pub fn among(&self, effects: &[Effect]) -> Self {
        let known = self.0.iter().filter(|(effect, _)| effects.contains(effect));
        Self(known.cloned().collect())
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

/// How cases share the parameters that are not each one's own.
#[derive(Debug, Clone, Default)]
pub(crate) struct SharedSizes {
    /// What is shared, in all.
    pub sizes: Vec<SharedSize>,
    /// Which of it each case has.
    pub of: Vec<Vec<usize>>,
    /// How much of each; `None` where all count whole.
    pub shares: Option<Vec<Vec<f64>>>,
    /// Which of the model's parameters these are, in every case; of one between two sizes it stands twice.
    pub common: Vec<usize>,
}

/// What is shared of the parameters `common`, and which of it each case has.
pub(crate) fn shared_sizes(
    cases: &[FitTask<'_>],
    effects: &[Effect],
    sharing: &Sharing,
    common: &[usize],
) -> SharedSizes {
    let mut shared = SharedSizes {
        of: vec![Vec::new(); cases.len()],
        ..SharedSizes::default()
    };
    let mut shares: Vec<Vec<f64>> = vec![Vec::new(); cases.len()];
    for &index in common {
        let groups = effect_of(effects, index)
            .filter(|&(effect, offset)| differs_by_group(effect, offset))
            .and_then(|(effect, _)| sharing.factor(effect))
            .and_then(|factor| Groups::of(cases, factor));
        let first = shared.sizes.len();
        shared.common.push(index);
        let Some(groups) = groups else {
            shared.of.iter_mut().for_each(|own| own.push(first));
            shares.iter_mut().for_each(|own| own.push(1.0));
            shared.sizes.push(SharedSize { index, level: None });
            continue;
        };
        if groups.way.is_some() {
            shared.common.push(index);
        }
        for (member, own) in shared.of.iter_mut().enumerate() {
            for (group, share) in groups.shares(member) {
                own.push(first + group);
                shares[member].push(share);
            }
        }
        let levels = groups.levels.into_iter().map(Some);
        (shared.sizes).extend(levels.map(|level| SharedSize { index, level }));
    }
    let is_whole = |own: &Vec<f64>| own.iter().all(|share| *share == 1.0);
    shared.shares = (!shares.iter().all(is_whole)).then_some(shares);
    shared
}

/// The groups of tightenings by one factor.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Groups {
    pub factor: Factor,
    /// In their order.
    pub levels: Vec<Level>,
    /// The group of each tightening, the nearer where it stands between two.
    pub of: Vec<usize>,
    /// How far each tightening has come from the first of two groups to the second; `None` where each belongs to one.
    pub way: Option<Vec<f64>>,
}

impl Groups {
    /// The groups of `factor`; `None` where it is not known of every tightening.
    pub fn of(cases: &[FitTask<'_>], factor: &Factor) -> Option<Self> {
        let shares: Option<Vec<Vec<(Level, f64)>>> = (cases.iter())
            .map(|case| factor.shares(&case.tightening))
            .collect();
        let shares = shares?;
        let known = shares.iter().flatten();
        let mut levels: Vec<Level> = known.map(|(level, _)| level.clone()).collect();
        levels.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        levels.dedup();
        let way = match factor {
            Factor::Course { .. } => {
                let ways = shares.iter().map(|own| own.get(1).map(|(_, way)| *way));
                Some(ways.collect::<Option<Vec<f64>>>()?)
            }
            _ => None,
        };
        let nearer = |own: &Vec<(Level, f64)>| {
            let nearer = own.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
            levels.iter().position(|known| *known == nearer.0)
        };
        let of: Option<Vec<usize>> = shares.iter().map(nearer).collect();
        Some(Self {
            factor: factor.clone(),
            of: of?,
            levels,
            way,
        })
    }

    /// The groups of one tightening, with the share of each.
    pub fn shares(&self, member: usize) -> Vec<(usize, f64)> {
        match &self.way {
            None => vec![(self.of[member], 1.0)],
            Some(ways) => vec![(0, 1.0 - ways[member]), (1, ways[member])],
        }
    }

    /// The factors by which sizes could differ: with several groups of at least two tightenings each, and no factor that
    /// groups them as another before it.
    pub fn worth_trying(cases: &[FitTask<'_>]) -> Vec<Self> {
        let mut worth: Vec<Self> = Vec::new();
        for factor in Factor::ALL {
            let Some(groups) = Self::of(cases, &factor) else {
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
