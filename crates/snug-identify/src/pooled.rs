//! Many least-squares problems that share some parameters: minimise Σ_i ½‖r_i(β_i, α)‖² over every β_i and the one α.
//!
//! The Jacobian is a block arrow. With R_i the triangular factor of [∂r_i/∂β_i, ∂r_i/∂α] in the directions that β_i may
//! take, its last rows are the sensitivity to α that β_i cannot imitate; stacked over i they give the step in α, and
//! back-substitution gives every β_i's. Work and memory grow linearly with the number of members.

use crate::dense::{add_scaled, dot, triangularize, upper_transposed_times};
use crate::step::{Stepper, project};
use crate::{Constraints, EvaluationError, IdentifyError, Linearization, Work};

/// Residuals r_i(β_i, α) of many members, i = 0 … members − 1.
pub trait PooledResidual {
    /// Number of members.
    fn member_count(&self) -> usize;

    /// Number n of each member's own parameters β_i.
    fn own_count(&self) -> usize;

    /// Number p of the shared parameters α.
    fn shared_count(&self) -> usize;

    /// Cost, gradient and curvature of some members, each at its own trial.
    ///
    /// # Errors
    /// [`EvaluationError`] where a residual has no finite value.
    fn linearize(&mut self, trials: &mut [Trial<'_>]) -> Result<(), EvaluationError>;
}

/// One member at parameters that are tried.
pub struct Trial<'a> {
    /// Which member.
    pub member: usize,
    /// (β_i, α), n + p entries.
    pub parameters: Vec<f64>,
    /// Gets cost, gradient and curvature there.
    pub linearization: &'a mut Linearization,
}

/// How many members are handed over together: so many can stand side by side in the widest vector registers.
const TOGETHER: usize = 8;

/// When a pooled fit stops.
#[derive(Debug, Clone, PartialEq)]
pub struct PooledSettings {
    /// Most steps tried.
    pub max_iterations: usize,
    /// Converged when a step without damping promises less than this share of the cost, or when three steps in a row
    /// lowered it by less.
    pub cost_tolerance: f64,
}

impl Default for PooledSettings {
    fn default() -> Self {
        Self {
            max_iterations: 60,
            // 0.007 squared units of the noise in 24 tightenings of 3000 samples; that last step is still tried.
            cost_tolerance: 1e-7,
        }
    }
}

/// What one member says about the shared parameters once its own are free to follow.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// ½‖r_i‖².
    pub cost: f64,
    /// Projected curvature S_i = Z̃ᵀZ̃, p × p, column-major, where Z̃ is ∂r_i/∂α without what ∂r_i/∂β_i can imitate.
    pub curvature: Vec<f64>,
    /// Projected gradient Z̃ᵀr_i, p; its sum over members vanishes at a free optimum.
    pub gradient: Vec<f64>,
}

/// The outcome of a pooled fit.
#[derive(Debug, Clone, PartialEq)]
pub struct PooledFit {
    /// α.
    pub shared: Vec<f64>,
    /// β_i.
    pub own: Vec<Vec<f64>>,
    /// Per member the profile over α.
    pub profiles: Vec<Profile>,
    /// Whether no step promises more than the tolerance.
    pub converged: bool,
    /// Work done.
    pub work: Work,
}

impl PooledFit {
    /// Σ_i ½‖r_i‖².
    pub fn cost(&self) -> f64 {
        self.profiles.iter().map(|profile| profile.cost).sum()
    }

    /// Σ_i S_i, p × p, column-major.
    pub fn curvature(&self) -> Vec<f64> {
        let p = self.shared.len();
        let mut sum = vec![0.0; p * p];
        for profile in &self.profiles {
            for (sum, value) in sum.iter_mut().zip(&profile.curvature) {
                *sum += value;
            }
        }
        sum
    }
}

/// One member while the fit goes on.
struct Member {
    own: Vec<f64>,
    here: Linearization,
    there: Linearization,
    stepper: Stepper,
    conditional: Linearization,
    /// Faces that its last step presses on.
    pressed: Vec<usize>,
    rest: Rest,
}

/// What a member says of α once β_i has done what it may: ½‖right + rows · dα‖², p rows.
#[derive(Default)]
struct Rest {
    rows: Vec<f64>,
    right: Vec<f64>,
}

/// Step promises below this share of the cost cannot be told from rounding.
const RESOLUTION: f64 = 1e-13;
/// Damping beyond which a fit is stuck.
const MOST_DAMPING: f64 = 1e12;
/// Steps in a row that hardly lower the cost after which a fit has arrived. Where the residual bends sharply, as at the
/// edge of a gap, every step promises more than it keeps, and a fit would creep on for hundreds of simulations.
const MOST_IDLE_STEPS: usize = 3;

/// Steps of α after which the faces that members press on are taken as they are: which they are shapes that step, which in
/// turn may press members on others.
const MOST_PASSES: usize = 4;

/// Fits all members together from one start.
///
/// `own_starts` and `own_sets` hold one entry per member; starts outside their set are projected into it.
///
/// # Errors
/// [`IdentifyError::Start`] when the residual is not finite at the start, [`IdentifyError::NoStart`] without a member.
pub fn solve_pooled(
    residual: &mut dyn PooledResidual,
    own_starts: &[Vec<f64>],
    own_sets: &[Constraints],
    shared_start: &[f64],
    shared_set: &Constraints,
    settings: &PooledSettings,
) -> Result<PooledFit, IdentifyError> {
    let mut fit = PooledSolver::start(residual, own_starts, own_sets, shared_start, shared_set)?;
    let mut converged = false;
    let mut idle_steps = 0;
    while fit.work.iterations < settings.max_iterations && !converged {
        fit.work.iterations += 1;
        let promised = fit.find_step();
        let cost = fit.cost;
        let little = settings.cost_tolerance.max(RESOLUTION) * cost;
        if (-RESOLUTION * cost..=little).contains(&promised) && fit.damping < 1.0 {
            converged = true;
        }
        if promised > 0.0 && fit.try_step(promised) {
            fit.accept();
            let is_idle = cost - fit.cost <= settings.cost_tolerance * cost;
            idle_steps = if is_idle { idle_steps + 1 } else { 0 };
            converged |= idle_steps >= MOST_IDLE_STEPS;
        } else if !converged && !fit.damp_more() {
            break;
        }
    }
    Ok(fit.finish(converged))
}

struct PooledSolver<'a> {
    residual: &'a mut dyn PooledResidual,
    own_sets: &'a [Constraints],
    shared_set: &'a Constraints,
    shared: Vec<f64>,
    shared_stepper: Stepper,
    members: Vec<Member>,
    cost: f64,
    cost_there: f64,
    gain: f64,
    damping: f64,
    growth: f64,
    work: Work,
}

impl<'a> PooledSolver<'a> {
    fn start(
        residual: &'a mut dyn PooledResidual,
        own_starts: &[Vec<f64>],
        own_sets: &'a [Constraints],
        shared_start: &[f64],
        shared_set: &'a Constraints,
    ) -> Result<Self, IdentifyError> {
        let (n, p) = (residual.own_count(), residual.shared_count());
        if own_starts.is_empty() {
            return Err(IdentifyError::NoStart);
        }
        let mut work = Work::default();
        let mut shared = shared_start.to_vec();
        shared_set.clamp(&mut shared);
        let mut members = Vec::with_capacity(own_starts.len());
        for (start, set) in own_starts.iter().zip(own_sets) {
            let own = if set.contains(start) {
                start.clone()
            } else {
                project(start, set, &mut work).unwrap_or_else(|| start.clone())
            };
            members.push(Member {
                own,
                here: Linearization::new(n + p),
                there: Linearization::new(n + p),
                stepper: Stepper::new(n),
                conditional: Linearization::new(n),
                pressed: Vec::new(),
                rest: Rest::default(),
            });
        }
        let mut solver = Self {
            residual,
            own_sets,
            shared_set,
            shared,
            shared_stepper: Stepper::new(p),
            members,
            cost: 0.0,
            cost_there: 0.0,
            gain: 1.0,
            damping: 1e-3,
            growth: 2.0,
            work,
        };
        let shared = &solver.shared;
        let mut trials: Vec<Trial<'_>> = (solver.members.iter_mut().enumerate())
            .map(|(index, member)| Trial {
                member: index,
                parameters: [member.own.as_slice(), shared].concat(),
                linearization: &mut member.here,
            })
            .collect();
        for together in trials.chunks_mut(TOGETHER) {
            (solver.residual.linearize(together)).map_err(|_| IdentifyError::NoStart)?;
        }
        solver.cost = solver.members.iter().map(|member| member.here.cost).sum();
        solver.work.linearizations += solver.members.len();
        Ok(solver)
    }

    /// Computes the damped step of α and of every β_i; returns the decrease it promises.
    fn find_step(&mut self) -> f64 {
        let mut shift = vec![0.0; self.shared.len()];
        for pass in 0..=MOST_PASSES {
            let mut press_elsewhere = false;
            for (member, set) in self.members.iter_mut().zip(self.own_sets) {
                press_elsewhere |= member.follow(&shift, self.damping, set, &mut self.work);
            }
            let is_settled = pass > 0 && !press_elsewhere;
            if is_settled || shift.is_empty() || pass == MOST_PASSES {
                break;
            }
            if !self.find_shift(&mut shift) {
                return 0.0;
            }
        }
        let promises = self.members.iter().map(|member| member.promise(&shift));
        promises.sum()
    }

    /// The damped step of α, every β_i following along the faces that it presses on; false when none was found.
    fn find_shift(&mut self, shift: &mut [f64]) -> bool {
        for (member, set) in self.members.iter_mut().zip(self.own_sets) {
            member.eliminate(shift.len(), self.damping, set);
        }
        let reduced = reduce(&self.members, shift.len());
        self.shared_stepper.rescale(&reduced, 0.0);
        let found = self.shared_stepper.find(
            &self.shared,
            &reduced,
            self.damping,
            self.shared_set,
            &mut self.work,
        );
        shift.copy_from_slice(self.shared_stepper.displacement());
        found
    }

    /// Evaluates the trial point; true when the cost falls by a part of what was promised.
    fn try_step(&mut self, promised: f64) -> bool {
        let target = &self.shared_stepper.step.target;
        let mut cost = 0.0;
        let mut trials: Vec<Trial<'_>> = (self.members.iter_mut().enumerate())
            .map(|(index, member)| Trial {
                member: index,
                parameters: [member.stepper.step.target.as_slice(), target].concat(),
                linearization: &mut member.there,
            })
            .collect();
        for together in trials.chunks_mut(TOGETHER) {
            self.work.linearizations += together.len();
            if self.residual.linearize(together).is_err() {
                return false;
            }
            for trial in together {
                cost += trial.linearization.cost;
            }
            // Members' costs only add up: no need to see the rest of a step that is already worse.
            if cost > self.cost {
                return false;
            }
        }
        self.cost_there = cost;
        self.gain = (self.cost - cost) / promised;
        self.cost - cost > 1e-4 * promised
    }

    fn accept(&mut self) {
        self.shared
            .copy_from_slice(&self.shared_stepper.step.target);
        for member in &mut self.members {
            member.own.copy_from_slice(&member.stepper.step.target);
            std::mem::swap(&mut member.here, &mut member.there);
        }
        self.cost = self.cost_there;
        self.growth = 2.0;
        let relief = match self.gain {
            gain if gain > 0.9 => 0.05,
            gain => (1.0 - (2.0 * gain - 1.0).clamp(-1.0, 1.0).powi(3)).max(0.2),
        };
        self.damping = (self.damping * relief).max(1e-15);
    }

    /// After a rejected step; false when no damping is left that would change anything.
    fn damp_more(&mut self) -> bool {
        self.damping = self.damping.max(1e-8) * self.growth;
        self.growth *= 2.0;
        self.damping < MOST_DAMPING
    }

    fn finish(self, converged: bool) -> PooledFit {
        let p = self.shared.len();
        let profiles = self.members.iter().map(|member| member.profile(p));
        PooledFit {
            profiles: profiles.collect(),
            own: self.members.iter().map(|m| m.own.clone()).collect(),
            shared: self.shared,
            converged,
            work: self.work,
        }
    }
}

impl Member {
    /// Steps β_i after α has moved by `shift`; true when it presses on other faces than before.
    fn follow(&mut self, shift: &[f64], damping: f64, set: &Constraints, work: &mut Work) -> bool {
        let n = self.own.len();
        let size = n + shift.len();
        let conditional = &mut self.conditional;
        conditional
            .reachable
            .copy_from_slice(&self.here.reachable[..n]);
        for (column, step) in shift.iter().enumerate() {
            let factor = &self.here.factor[(n + column) * size..][..n];
            add_scaled(&mut conditional.reachable, *step, factor);
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
        let active = self.stepper.step.active.iter().map(|active| active.face);
        let press_elsewhere = !active.clone().eq(self.pressed.iter().copied());
        self.pressed.clear();
        self.pressed.extend(active);
        press_elsewhere
    }

    /// The decrease of ½‖r_i‖² that the step of β_i and `shift` promise together.
    fn promise(&self, shift: &[f64]) -> f64 {
        let step = [self.stepper.displacement(), shift].concat();
        -self.here.rise(&step)
    }

    /// Works out what is left to α once β_i follows as damping and constraints let it: along a face that its own step
    /// presses on, never through it.
    fn eliminate(&mut self, p: usize, damping: f64, set: &Constraints) {
        let directions = self.stepper.free_directions(&self.own, set);
        let (n, free) = (self.own.len(), directions.len());
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

    fn profile(&self, p: usize) -> Profile {
        let n = self.own.len();
        let size = n + p;
        // The last p rows of the factor: R_αα.
        let column = |index: usize| &self.here.factor[(n + index) * size + n..][..p];
        let reachable = &self.here.reachable[n..];
        let mut curvature = vec![0.0; p * p];
        for j in 0..p {
            for i in 0..p {
                curvature[j * p + i] = dot(column(i), column(j));
            }
        }
        Profile {
            cost: self.here.cost,
            curvature,
            gradient: (0..p).map(|j| dot(column(j), reachable)).collect(),
        }
    }
}

/// The least-squares problem in α alone, every β_i following: what all leave to it, stacked and triangularised.
fn reduce(members: &[Member], p: usize) -> Linearization {
    let rows = members.len() * p;
    let mut stacked = vec![0.0; rows * p];
    let mut right = vec![0.0; rows];
    for (index, member) in members.iter().enumerate() {
        for column in 0..p {
            stacked[column * rows + index * p..][..p]
                .copy_from_slice(&member.rest.rows[column * p..][..p]);
        }
        right[index * p..][..p].copy_from_slice(&member.rest.right);
    }
    let mut reduced = Linearization::new(p);
    triangularize(&mut stacked, &mut right, rows, p);
    for column in 0..p {
        let filled = column + 1;
        reduced.factor[column * p..column * p + filled]
            .copy_from_slice(&stacked[column * rows..column * rows + filled]);
    }
    reduced.reachable.copy_from_slice(&right[..p]);
    upper_transposed_times(
        &reduced.factor,
        p,
        &reduced.reachable,
        &mut reduced.gradient,
    );
    reduced
}
