use crate::fit::{ActiveConstraint, Fit, Status, Work};
use crate::identifiability::analyse;
use crate::step::{NO_DAMPING, Stepper, project};
use crate::{Constraints, IdentifyError, LeastSquares, Linearization, Settings};

/// Minimises ½‖r(p)‖² over a convex set by damped Gauss–Newton steps (Levenberg–Marquardt) from one start.
///
/// A step that leaves the set is replaced by the exact minimiser of the same damped model over the set, a conic program;
/// a start outside is projected onto it. Every iterate lies in the set. The same input gives the same bits.
///
/// # Errors
/// [`IdentifyError`] for wrong dimensions, an empty set or impossible settings. What happens during the fit is told by
/// [`Fit::status`].
pub fn solve(
    problem: &mut dyn LeastSquares,
    start: &[f64],
    constraints: &Constraints,
    settings: &Settings,
) -> Result<Fit, IdentifyError> {
    let mut search = Search::new(problem, start, constraints, settings)?;
    if !search.linearize_start() {
        return Ok(search.failed());
    }
    let status = loop {
        if search.work.iterations == settings.max_iterations {
            break Status::IterationLimit;
        }
        if !search.find_step() {
            if search.damp_more() {
                continue;
            }
            break search.end_of_decrease();
        }
        if let Some(status) = search.optimality() {
            break status;
        }
        search.work.iterations += 1;
        if search.try_step() {
            search.accept();
        } else if !search.damp_more() {
            break search.end_of_decrease();
        }
    };
    Ok(search.finish(status))
}

/// A decrease below this share of the cost drowns in the cost's rounding.
const RESOLUTION: f64 = 1e-13;
/// Damping at which no parameter moves any more.
const MOST_DAMPING: f64 = 1e30;
/// Below this much damping a step is as good as undamped for the optimality tests.
const LITTLE_DAMPING: f64 = 1e-9;
/// Steps taken on trust, because the cost cannot resolve them, before the fit rests.
const TRUSTED_STEPS: usize = 20;
/// Steps after which the scale of the parameters no longer remembers the start: the way to the optimum may lead through a
/// valley where they matter a thousand times less than there.
const LONG_FIT: usize = 400;
/// Share of its scale that a parameter keeps per step then.
const SHORT_MEMORY: f64 = 0.5;
/// Optimality accepted when rounding forbids better.
const ROUGH_TOLERANCE: f64 = 1e-5;

struct Search<'a> {
    problem: &'a mut dyn LeastSquares,
    constraints: &'a Constraints,
    settings: &'a Settings,
    values: Vec<f64>,
    here: Linearization,
    there: Linearization,
    stepper: Stepper,
    damping: f64,
    /// Factor of the next increase of the damping.
    growth: f64,
    /// Decrease of the last trial over the decrease promised.
    gain: f64,
    /// The last trial was rejected, so the next is first judged by its cost alone.
    is_cautious: bool,
    /// A trial was rejected some time: steps are bent along curved valleys.
    is_hard: bool,
    bending: Vec<f64>,
    trusted_steps: usize,
    last_decrement: f64,
    work: Work,
}

impl<'a> Search<'a> {
    fn new(
        problem: &'a mut dyn LeastSquares,
        start: &[f64],
        constraints: &'a Constraints,
        settings: &'a Settings,
    ) -> Result<Self, IdentifyError> {
        let n = problem.parameter_count();
        settings.check()?;
        constraints.check(n)?;
        if start.len() != n {
            return Err(IdentifyError::Dimension {
                what: "the start",
                expected: n,
                found: start.len(),
            });
        }
        if let Some(parameter) = start.iter().position(|value| !value.is_finite()) {
            let value = start[parameter];
            return Err(IdentifyError::Start { parameter, value });
        }
        let mut work = Work::default();
        let values = match constraints.contains(start) {
            true => start.to_vec(),
            false => project(start, constraints, &mut work).ok_or_else(|| {
                let faces = 0..constraints.face_count();
                let names = faces.filter(|&face| constraints.is_finite(face));
                IdentifyError::NoFeasiblePoint {
                    names: names.map(|face| constraints.face_name(face)).collect(),
                }
            })?,
        };
        Ok(Self {
            problem,
            constraints,
            settings,
            values,
            here: Linearization::new(n),
            there: Linearization::new(n),
            stepper: Stepper::new(n),
            damping: settings.initial_damping,
            growth: 2.0,
            gain: 1.0,
            is_cautious: false,
            is_hard: false,
            bending: vec![0.0; n],
            trusted_steps: 0,
            last_decrement: f64::INFINITY,
            work,
        })
    }

    fn linearize_start(&mut self) -> bool {
        self.work.linearizations += 1;
        let outcome = self.problem.linearize(&self.values, &mut self.here);
        if let Err(error) = &outcome {
            tracing::debug!(%error, "no finite residual at the start");
        }
        outcome.is_ok()
    }

    fn find_step(&mut self) -> bool {
        let is_late = self.work.iterations >= LONG_FIT;
        let memory = if is_late { SHORT_MEMORY } else { 1.0 };
        self.stepper.rescale(&self.here, memory);
        self.stepper.find(
            &self.values,
            &self.here,
            self.damping,
            self.constraints,
            &mut self.work,
        )
    }

    /// Whether the step just found shows that there is nothing left to gain.
    fn optimality(&mut self) -> Option<Status> {
        let length = (2.0 * self.here.cost).sqrt();
        let is_small = self.stepper.step.decrement <= self.settings.gradient_tolerance * length;
        if is_small && self.stepper.step.is_conic && self.damping > NO_DAMPING {
            // Damping may hide what is left; look again without.
            let damping = std::mem::replace(&mut self.damping, NO_DAMPING);
            let found = self.find_step();
            let undamped = self.stepper.step.decrement;
            if !found || undamped > self.settings.gradient_tolerance * length {
                self.damping = damping * 1e-3;
                return (!self.find_step()).then_some(Status::Stalled);
            }
        }
        let is_still = self.damping <= LITTLE_DAMPING
            && self.stepper.step.relative_change <= self.settings.step_tolerance;
        (is_small || is_still).then(|| self.converged())
    }

    /// Converged on the faces that press; where the gradient vanishes none does.
    fn converged(&self) -> Status {
        let length = (2.0 * self.here.cost).sqrt();
        let gradient = crate::dense::norm(&self.here.reachable);
        let presses = gradient > self.settings.gradient_tolerance * length;
        if presses && !self.stepper.step.active.is_empty() {
            Status::ConvergedAtConstraint
        } else {
            Status::Converged
        }
    }

    /// Evaluates the trial point; true when it is at least as good as promised in part, or indistinguishable.
    fn try_step(&mut self) -> bool {
        let promised = self.stepper.step.predicted;
        let is_trustworthy =
            self.trusted_steps < TRUSTED_STEPS && self.stepper.step.decrement < self.last_decrement;
        if promised <= 0.0 || (self.is_unresolved() && !is_trustworthy) {
            return false;
        }
        if self.is_hard && !self.is_unresolved() && !self.follow_curve() {
            return false;
        }
        let target = &self.stepper.step.target;
        if self.is_cautious {
            self.work.evaluations += 1;
            match self.problem.cost(target) {
                Ok(cost) if self.is_better(cost, promised) => {}
                _ => return false,
            }
        }
        self.work.linearizations += 1;
        let outcome = self.problem.linearize(target, &mut self.there);
        outcome.is_ok() && self.is_better(self.there.cost, promised) && {
            self.gain = (self.here.cost - self.there.cost) / promised;
            true
        }
    }

    /// Bends a free step with the residual's second derivative along it; false when the step cannot be trusted.
    fn follow_curve(&mut self) -> bool {
        if self.stepper.step.is_conic {
            return true;
        }
        self.work.evaluations += 1;
        let direction = self.stepper.displacement();
        match (self.problem).bending(&self.values, direction, &mut self.bending) {
            Ok(true) => self.stepper.bend(&self.bending, self.constraints),
            Ok(false) => true,
            Err(_) => false,
        }
    }

    /// The promised decrease is too small for the cost to show it.
    fn is_unresolved(&self) -> bool {
        self.stepper.step.predicted < RESOLUTION * self.here.cost
    }

    fn is_better(&self, cost: f64, promised: f64) -> bool {
        if self.is_unresolved() {
            cost <= self.here.cost * (1.0 + 10.0 * RESOLUTION)
        } else {
            self.here.cost - cost > 1e-4 * promised
        }
    }

    /// Moves to the trial point and adapts the damping to how well the model foretold it.
    fn accept(&mut self) {
        if self.is_unresolved() {
            self.trusted_steps += 1;
            self.last_decrement = self.stepper.step.decrement;
            self.gain = 1.0;
        }
        self.damping = (self.damping * relief(self.gain)).max(NO_DAMPING);
        self.values.copy_from_slice(&self.stepper.step.target);
        std::mem::swap(&mut self.here, &mut self.there);
        self.is_cautious = false;
        self.growth = 2.0;
    }

    /// After a rejected step; false when no damping is left that would change anything.
    fn damp_more(&mut self) -> bool {
        self.is_cautious = true;
        self.is_hard = true;
        self.damping = self.damping.max(1e-12) * self.growth;
        self.growth *= 2.0;
        let moves = self.stepper.step.relative_change > f64::EPSILON;
        !self.is_unresolved() && moves && self.damping < MOST_DAMPING
    }

    /// No step decreases the cost: at the optimum as far as rounding allows, or stuck.
    fn end_of_decrease(&mut self) -> Status {
        self.damping = NO_DAMPING;
        if !self.find_step() {
            return Status::Stalled;
        }
        let length = (2.0 * self.here.cost).sqrt();
        let step = &self.stepper.step;
        if step.decrement <= ROUGH_TOLERANCE * length || step.relative_change <= ROUGH_TOLERANCE {
            self.converged()
        } else {
            Status::Stalled
        }
    }

    fn failed(self) -> Fit {
        let n = self.values.len();
        self.result(Status::Failed, f64::NAN, &vec![0.0; n * n], f64::INFINITY)
    }

    fn finish(self, status: Status) -> Fit {
        let (cost, factor) = (self.here.cost, self.here.factor.clone());
        let tolerance = self.here.rank_tolerance;
        self.result(status, cost, &factor, tolerance)
    }

    fn result(self, status: Status, cost: f64, factor: &[f64], rank_tolerance: f64) -> Fit {
        let pressing: Vec<_> = match status {
            Status::Converged | Status::Failed => Vec::new(),
            _ => self.stepper.step.active.clone(),
        };
        let normals: Vec<Vec<f64>> = (pressing.iter())
            .map(|entry| self.constraints.face_normal(entry.face, &self.values))
            .collect();
        let analysis = analyse(factor, &normals, rank_tolerance);
        let identifiability = analysis.identifiability;
        let status = match status {
            Status::Failed => Status::Failed,
            _ if identifiability.rank < identifiability.free => Status::NotIdentifiable,
            status => status,
        };
        let active = pressing.iter().map(|entry| ActiveConstraint {
            name: self.constraints.face_name(entry.face),
            multiplier: entry.multiplier.max(0.0),
        });
        tracing::debug!(?status, cost, work = ?self.work, "fit ended");
        Fit {
            active: active.collect(),
            values: self.values,
            cost,
            residual_count: self.problem.residual_count(),
            status,
            identifiability,
            work: self.work,
            covariance_root: analysis.covariance_root,
            determined: analysis.determined,
        }
    }
}

/// Factor on the damping after an accepted step with this gain (Nielsen 1999), smaller where the model is good.
fn relief(gain: f64) -> f64 {
    let surprise = (2.0 * gain - 1.0).clamp(-1.0, 1.0);
    if gain > 0.9 {
        0.05
    } else {
        (1.0 - surprise.powi(3)).max(0.2)
    }
}
