//! What every row is asked in one pass: the sizes that it shares, as a literal of the plan, and which of them are its group's own.

use crate::storage::partition::date_of;
use serde::{Deserialize, Serialize};
use snug_campaign::{Factor, Tightening};
use snug_study::Compared;
use std::collections::BTreeMap;

/// Days of a tool on which the model at first leaves more than elsewhere, in days since 1970-01-01.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct State {
    /// The first of them.
    pub first: i32,
    /// The last; `None` where it has not ended.
    pub last: Option<i32>,
}

/// By what rows are known: their tool, on days on which it is in a state of its own that too.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct States(pub BTreeMap<String, State>);

impl States {
    /// The state of a tool on a day, if that is one.
    pub fn of(&self, tool: &str, day: Option<i32>) -> Option<State> {
        let (state, day) = (self.0.get(tool)?, day?);
        let is_in = day >= state.first && state.last.is_none_or(|last| day <= last);
        is_in.then_some(*state)
    }

    /// What its rows are called: `T07`, `T07 since 2026-03-11`, `T07 2026-03-05/2026-03-09`.
    pub fn name(&self, tool: &str, day: Option<i32>) -> String {
        match self.of(tool, day) {
            None => tool.to_owned(),
            Some(State { first, last: None }) => format!("{tool} since {}", date_of(first)),
            Some(State {
                first,
                last: Some(last),
            }) => {
                format!("{tool} {}/{}", date_of(first), date_of(last))
            }
        }
    }
}

/// How sizes are shared.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sharing {
    /// What groups the rows whose sizes differ; `None` where all share all.
    pub factor: Option<Factor>,
    /// Which of the sizes differ by it, in the order of the model's shared parameters.
    pub differs: Vec<bool>,
}

/// Sizes at which every row is asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Held {
    /// What rows are compared by.
    pub compared: Compared,
    /// By what rows are known.
    pub states: States,
    /// How sizes are shared.
    pub sharing: Sharing,
    /// Of rows whose group nobody knows yet, in the order of the model's shared parameters.
    pub all: Vec<f64>,
    /// Of each group.
    pub groups: BTreeMap<String, Vec<f64>>,
}

impl Held {
    /// The group of a tightening; `None` where there are none, or nothing says it.
    pub fn group(&self, tightening: &Tightening) -> Option<String> {
        let level = self.sharing.factor.as_ref()?.level(tightening)?;
        Some(level.name)
    }

    /// The sizes of a tightening.
    pub fn of(&self, tightening: &Tightening) -> Vec<f64> {
        let group = self.group(tightening);
        let own = group.and_then(|group| self.groups.get(&group));
        own.unwrap_or(&self.all).clone()
    }
}

/// What rows add up: one list a row, and their sums. Counts and squared residuals have no unit (the output's squared where the noise is
/// not known); derivatives are by each size in the unit that its name says.
#[derive(Debug, Clone, PartialEq)]
pub struct Totals {
    /// Rows, those that take no part among them.
    pub rows: f64,
    /// Rows that take part.
    pub members: f64,
    /// Whitened residuals.
    pub residuals: f64,
    /// Parameters of the rows' own.
    pub own: f64,
    /// Σ ½‖r‖².
    pub cost: f64,
    /// Σ g, p.
    pub gradient: Vec<f64>,
    /// Σ S, p × p, symmetric, row by row.
    pub curvature: Vec<f64>,
    /// Σ g gᵀ, likewise.
    pub scatter: Vec<f64>,
}

impl Totals {
    /// Of no row.
    pub fn zero(p: usize) -> Self {
        Self {
            rows: 0.0,
            members: 0.0,
            residuals: 0.0,
            own: 0.0,
            cost: 0.0,
            gradient: vec![0.0; p],
            curvature: vec![0.0; p * p],
            scatter: vec![0.0; p * p],
        }
    }

    /// Of one row that says `block`, or takes no part.
    pub fn of(p: usize, block: Option<&snug_diagnose::SharedBlock>) -> Self {
        let mut totals = Self::zero(p);
        totals.rows = 1.0;
        let Some(block) = block else { return totals };
        totals.members = 1.0;
        totals.residuals = block.residuals as f64;
        totals.own = block.own as f64;
        totals.cost = block.cost;
        totals.gradient.clone_from(&block.gradient);
        totals.curvature.clone_from(&block.curvature);
        let g = &block.gradient;
        totals.scatter = (0..p * p).map(|at| g[at / p] * g[at % p]).collect();
        totals
    }

    /// As a list.
    pub fn into_list(self) -> Vec<f64> {
        let Self {
            rows,
            members,
            residuals,
            own,
            cost,
            gradient,
            curvature,
            scatter,
        } = self;
        let front = [rows, members, residuals, own, cost];
        [front.as_slice(), &gradient, &curvature, &scatter].concat()
    }

    /// A list back; `None` where it is none of `p` sizes.
    pub fn from_list(p: usize, list: &[f64]) -> Option<Self> {
        let (front, rest) = list.split_at_checked(5)?;
        let (gradient, rest) = rest.split_at_checked(p)?;
        let (curvature, scatter) = rest.split_at_checked(p * p)?;
        (scatter.len() == p * p).then(|| Self {
            rows: front[0],
            members: front[1],
            residuals: front[2],
            own: front[3],
            cost: front[4],
            gradient: gradient.to_vec(),
            curvature: curvature.to_vec(),
            scatter: scatter.to_vec(),
        })
    }

    /// Adds what others say.
    pub fn add(&mut self, other: &Self) {
        let lists = [
            (&mut self.gradient, &other.gradient),
            (&mut self.curvature, &other.curvature),
            (&mut self.scatter, &other.scatter),
        ];
        for (to, from) in lists {
            to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
        }
        self.rows += other.rows;
        self.members += other.members;
        self.residuals += other.residuals;
        self.own += other.own;
        self.cost += other.cost;
    }
}
