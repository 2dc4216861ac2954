//! One member of a pooled fit: its own step, and what it leaves to the shared parameters.

use super::problem::Profile;
use crate::conic::constraints::Constraints;
use crate::matrix::{add_scaled, dot, triangularize, upper_transposed_times};
use crate::pooled_fit::thresholds::LEAST_DAMPING;
use crate::problem::linearization::Linearization;
use crate::solver::fit::Work;
use crate::solver::step::Stepper;
use std::collections::BTreeMap;

/// One member while the fit goes on.
pub struct Member {
    pub own: Vec<f64>,
    /// Which of α its residual depends on, ascending.
    pub shared: Vec<usize>,
    pub here: Linearization,
    pub there: Linearization,
    pub stepper: Stepper,
    conditional: Linearization,
    /// Its active set at the last step.
    active_set: Vec<usize>,
    rest: Rest,
}

/// What members say of those p entries of α on which they depend, once every β_i has done what it may: ½‖right + rows · dα‖²,
/// p rows.
#[derive(Default)]
struct Rest {
    rows: Vec<f64>,
    right: Vec<f64>,
}

impl Member {
    /// At its start, beside those shared parameters on which it depends.
    pub fn new(own: Vec<f64>, shared: Vec<usize>) -> Self {
        let (n, p) = (own.len(), shared.len());
        Self {
            own,
            shared,
            here: Linearization::new(n + p),
            there: Linearization::new(n + p),
            stepper: Stepper::new(n),
            conditional: Linearization::new(n),
            active_set: Vec::new(),
            rest: Rest::default(),
        }
    }

    /// Its own parameters and its part of `shared`.
    pub fn parameters(&self, own: &[f64], shared: &[f64]) -> Vec<f64> {
        let part = self.shared.iter().map(|&place| shared[place]);
        own.iter().copied().chain(part).collect()
    }

    /// Steps β_i after α has moved by `shift`; true when its active set has changed.
    pub fn follow(
        &mut self,
        shift: &[f64],
        damping: f64,
        set: &Constraints,
        work: &mut Work,
    ) -> bool {
        let n = self.own.len();
        let size = n + self.shared.len();
        let conditional = &mut self.conditional;
        conditional
            .reachable
            .copy_from_slice(&self.here.reachable[..n]);
        for (column, &place) in self.shared.iter().enumerate() {
            let factor = &self.here.factor[(n + column) * size..][..n];
            add_scaled(&mut conditional.reachable, shift[place], factor);
        }
        for column in 0..n {
            conditional.factor[column * n..(column + 1) * n]
                .copy_from_slice(&self.here.factor[column * size..column * size + n]);
        }
        upper_transposed_times(
            &conditional.factor,
            n,
            &conditional.reachable,
            &mut conditional.gradient,
        );
        self.stepper.rescale(conditional, 0.0);
        if !(self.stepper).find(&self.own, conditional, damping, set, work) {
            self.stepper.stay(&self.own);
        }
        let active = self
            .stepper
            .step
            .active
            .iter()
            .map(|active| active.inequality);
        let has_changed = !active.clone().eq(self.active_set.iter().copied());
        self.active_set.clear();
        self.active_set.extend(active);
        has_changed
    }

    /// The decrease of ½‖r_i‖² that the step of β_i and `shift` predict together.
    pub fn predicted_decrease(&self, shift: &[f64]) -> f64 {
        let step = self.parameters(self.stepper.displacement(), shift);
        -self.here.rise(&step)
    }

    /// Works out what is left to α once β_i follows as damping and constraints let it: along an inequality that its own step
    /// presses on, never through it.
    pub fn eliminate(&mut self, damping: f64, set: &Constraints) {
        let directions = self.stepper.free_directions(&self.own, set);
        let (n, p, free) = (self.own.len(), self.shared.len(), directions.len());
        let size = n + p;
        let (rows, columns) = (size + free, free + p);
        let mut stacked = vec![0.0; rows * columns];
        let mut right = vec![0.0; rows];
        right[..size].copy_from_slice(&self.here.reachable);
        for (column, direction) in directions.iter().enumerate() {
            let target = &mut stacked[column * rows..][..rows];
            for (factor, along) in self.here.factor.chunks_exact(size).zip(direction) {
                add_scaled(&mut target[..n], *along, &factor[..n]);
            }
            target[size + column] = damping.sqrt();
        }
        for column in 0..p {
            stacked[(free + column) * rows..][..size]
                .copy_from_slice(&self.here.factor[(n + column) * size..][..size]);
        }
        triangularize(&mut stacked, &mut right, rows, columns);
        let rest = &mut self.rest;
        rest.right.clear();
        rest.right.extend_from_slice(&right[free..columns]);
        rest.rows.clear();
        rest.rows.resize(p * p, 0.0);
        for column in 0..p {
            rest.rows[column * p..][..=column]
                .copy_from_slice(&stacked[(free + column) * rows + free..][..=column]);
        }
    }

    /// What it says of the parameters that it shares where it stands, its own free to follow: along an inequality of `set` that they
    /// press on, never through it.
    pub fn profile(&mut self, set: &Constraints, work: &mut Work) -> Profile {
        let p = self.shared.len();
        let places = self.shared.last().map_or(0, |last| last + 1);
        self.follow(&vec![0.0; places], LEAST_DAMPING, set, work);
        self.eliminate(LEAST_DAMPING, set);
        let Rest { rows, right } = &self.rest;
        let column = |index: usize| &rows[index * p..][..p];
        Profile {
            cost: self.here.cost,
            shared: self.shared.clone(),
            curvature: (0..p * p)
                .map(|at| dot(column(at % p), column(at / p)))
                .collect(),
            gradient: (0..p).map(|j| dot(column(j), right)).collect(),
        }
    }
}

/// What one member says of the parameters that it shares, its own β_i at their optimum beside these and free to follow: the terms that
/// a pooled fit adds up over members, for programs that add them up elsewhere.
///
/// `here` is linearised over (β_i, α); along an inequality of `set` that β_i presses on it follows, never through it.
pub fn profile_of(here: Linearization, own: &[f64], set: &Constraints) -> Profile {
    let p = here.reachable.len() - own.len();
    let mut member = Member::new(own.to_vec(), (0..p).collect());
    member.here = here;
    member.profile(set, &mut Work::default())
}

/// The least-squares problem in α alone, every β_i following: what all leave to it, stacked and triangularised; first those
/// that depend on the same entries of α, so that the work grows linearly with the number of members however many entries
/// belong to some of them only.
pub fn reduce(members: &[Member], p: usize) -> Linearization {
    let mut groups: BTreeMap<&[usize], Vec<&Rest>> = BTreeMap::new();
    for member in members {
        groups.entry(&member.shared).or_default().push(&member.rest);
    }
    let parts: Vec<(&[usize], Rest)> = (groups.into_iter())
        .map(|(places, rests)| {
            let of_all: Vec<usize> = (0..places.len()).collect();
            let rests: Vec<(&[usize], &Rest)> = rests
                .into_iter()
                .map(|rest| (of_all.as_slice(), rest))
                .collect();
            (places, together(&rests, places.len()))
        })
        .collect();
    let rest = match parts.as_slice() {
        [(places, _)] if places.len() == p => None,
        several => {
            let rests: Vec<(&[usize], &Rest)> = several
                .iter()
                .map(|(places, rest)| (*places, rest))
                .collect();
            Some(together(&rests, p))
        }
    };
    let rest = rest.as_ref().unwrap_or_else(|| &parts[0].1);
    let mut reduced = Linearization::new(p);
    reduced.factor.copy_from_slice(&rest.rows);
    reduced.reachable.copy_from_slice(&rest.right);
    upper_transposed_times(
        &reduced.factor,
        p,
        &reduced.reachable,
        &mut reduced.gradient,
    );
    reduced
}

/// Several, each of so many of `p` entries as it has places, stacked and triangularised.
fn together(rests: &[(&[usize], &Rest)], p: usize) -> Rest {
    let filled: usize = rests.iter().map(|(places, _)| places.len()).sum();
    let rows = filled.max(p);
    let mut stacked = vec![0.0; rows * p];
    let mut right = vec![0.0; rows];
    let mut first = 0;
    for (places, rest) in rests {
        let size = places.len();
        for (column, &place) in places.iter().enumerate() {
            stacked[place * rows + first..][..size]
                .copy_from_slice(&rest.rows[column * size..][..size]);
        }
        right[first..][..size].copy_from_slice(&rest.right);
        first += size;
    }
    triangularize(&mut stacked, &mut right, rows, p);
    let mut upper = vec![0.0; p * p];
    for column in 0..p {
        let filled = column + 1;
        upper[column * p..][..filled].copy_from_slice(&stacked[column * rows..][..filled]);
    }
    right.truncate(p);
    Rest { rows: upper, right }
}
