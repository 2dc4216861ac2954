//! One Levenberg–Marquardt step: free, or from the conic program where the free one leaves the constraints.

use crate::conic::constraints::Constraints;
use crate::conic::inequalities::inequalities;
use crate::conic::program::{Active, ConicProgram};
use crate::matrix::{
    add_scaled, dot, norm, solve_upper, solve_upper_transposed, triangularize, upper_times,
};
use crate::problem::linearization::Linearization;
use crate::solver::fit::Work;
use crate::solver::thresholds::{DEPENDENT, LARGEST_ACCELERATION};

/// Where a step leads and what the local model predicts.
pub struct Step {
    /// The parameters after the step.
    pub target: Vec<f64>,
    /// Decrease of ½‖q + R d‖².
    pub predicted: f64,
    /// √(2 · decrease) that a feasible step without damping could still bring, as far as this step shows.
    pub decrement: f64,
    /// Largest change of a parameter relative to its value.
    pub relative_change: f64,
    /// Whether constraints shaped it.
    pub is_conic: bool,
    /// Inequalities pressed on, with multipliers in natural units.
    pub active: Vec<Active>,
}

/// Computes steps; owns the room they need.
pub struct Stepper {
    /// Scale D of each parameter: the length of its sensitivity, where it was large.
    scale: Vec<f64>,
    pub step: Step,
    stacked: Vec<f64>,
    right: Vec<f64>,
    displacement: Vec<f64>,
    reached: Vec<f64>,
    /// The inequalities active in the last conic step, tried first in the next.
    expected: Vec<usize>,
}

impl Stepper {
    pub fn new(n: usize) -> Self {
        Self {
            scale: vec![0.0; n],
            step: Step {
                target: vec![0.0; n],
                predicted: 0.0,
                decrement: 0.0,
                relative_change: 0.0,
                is_conic: false,
                active: Vec::new(),
            },
            stacked: vec![0.0; 2 * n * n],
            right: vec![0.0; 2 * n],
            displacement: vec![0.0; n],
            reached: vec![0.0; n],
            expected: Vec::new(),
        }
    }

    /// Lets the scale follow the sensitivities: with `memory` 1 it is their largest length so far (Moré 1978), with less
    /// it forgets what was long ago. Units of parameters do not matter either way.
    pub fn rescale(&mut self, linearization: &Linearization, memory: f64) {
        let n = self.scale.len();
        for (scale, column) in self
            .scale
            .iter_mut()
            .zip(linearization.factor.chunks(n.max(1)))
        {
            *scale = (memory * *scale).max(norm(column));
        }
    }

    fn unit(&self, index: usize) -> f64 {
        match self.scale[index] {
            0.0 => 1.0,
            scale => 1.0 / scale,
        }
    }

    /// Minimises ½‖q + R d‖² + ½ λ ‖D d‖² over the constraints. Returns false when no step was found.
    pub fn find(
        &mut self,
        parameters: &[f64],
        model: &Linearization,
        damping: f64,
        constraints: &Constraints,
        work: &mut Work,
    ) -> bool {
        self.free_step(model, damping);
        self.set_target(parameters);
        self.step.is_conic = !constraints.contains(&self.step.target);
        self.step.active.clear();
        if self.step.is_conic {
            if !self.conic_step(parameters, model, damping, constraints, work) {
                return false;
            }
        } else {
            self.step.decrement = norm(&model.reachable);
        }
        self.judge(parameters, model);
        true
    }

    /// QR of [R D⁻¹; √λ I]: z = D d stands in `right`, d in `displacement`.
    fn free_step(&mut self, model: &Linearization, damping: f64) {
        let n = self.scale.len();
        let root = damping.sqrt();
        self.stacked.fill(0.0);
        self.right.fill(0.0);
        for column in 0..n {
            let unit = self.unit(column);
            let (stacked, factor) = (
                &mut self.stacked[2 * n * column..],
                &model.factor[n * column..],
            );
            for row in 0..=column {
                stacked[row] = factor[row] * unit;
            }
            stacked[n + column] = root;
            self.right[column] = -model.reachable[column];
        }
        triangularize(&mut self.stacked, &mut self.right, 2 * n, n);
        solve_upper(&self.stacked, 2 * n, &mut self.right[..n]);
        for index in 0..n {
            self.displacement[index] = self.right[index] * self.unit(index);
        }
    }

    fn set_target(&mut self, parameters: &[f64]) {
        let steps = parameters.iter().zip(&self.displacement);
        for (target, (p, d)) in self.step.target.iter_mut().zip(steps) {
            *target = p + d;
        }
    }

    /// A step that changes nothing.
    pub fn stay(&mut self, parameters: &[f64]) {
        self.displacement.fill(0.0);
        self.step.target.copy_from_slice(parameters);
        self.step.predicted = 0.0;
        self.step.active.clear();
    }

    /// Directions d, orthonormal in D d, along the inequalities that the last step presses on; all where it presses on none.
    pub fn free_directions(&self, parameters: &[f64], constraints: &Constraints) -> Vec<Vec<f64>> {
        let n = parameters.len();
        let mut normals: Vec<Vec<f64>> = Vec::new();
        for entry in &self.step.active {
            let normal = constraints.inequality_normal(entry.inequality, parameters);
            let scaled = (0..n).map(|i| normal[i] * self.unit(i)).collect();
            normals.extend(orthonormal(scaled, &normals));
        }
        let mut directions: Vec<Vec<f64>> = Vec::new();
        for index in 0..n {
            let mut axis = vec![0.0; n];
            axis[index] = 1.0;
            let known = [normals.as_slice(), &directions].concat();
            directions.extend(orthonormal(axis, &known));
        }
        for direction in &mut directions {
            (direction.iter_mut().enumerate()).for_each(|(i, d)| *d *= self.unit(i));
        }
        directions
    }

    /// What the last step would change in each parameter.
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// Bends a free step along the curve of constant direction: d + ½ a, (JᵀJ + λ D²) a = −Jᵀ r″.
    ///
    /// False when the path bends so much that the step itself is not to be trusted. A bent step that leaves the
    /// constraints stays straight.
    pub fn accelerate(&mut self, second_derivative: &[f64], constraints: &Constraints) -> bool {
        let n = self.scale.len();
        let mut a: Vec<f64> = (0..n)
            .map(|i| -second_derivative[i] * self.unit(i))
            .collect();
        solve_upper_transposed(&self.stacked, 2 * n, &mut a);
        solve_upper(&self.stacked, 2 * n, &mut a);
        let is_gentle = norm(&a) <= LARGEST_ACCELERATION * norm(&self.right[..n]);
        if is_gentle {
            let bent = |i: usize| self.step.target[i] + 0.5 * a[i] * self.unit(i);
            let target: Vec<f64> = (0..n).map(bent).collect();
            if constraints.contains(&target) {
                self.step.target = target;
            }
        }
        is_gentle
    }

    /// The same minimisation over the constraints, as a conic program in coordinates of unit size.
    fn conic_step(
        &mut self,
        parameters: &[f64],
        model: &Linearization,
        damping: f64,
        constraints: &Constraints,
        work: &mut Work,
    ) -> bool {
        let n = parameters.len();
        let slope: Vec<f64> = (0..n).map(|i| model.gradient[i] * self.unit(i)).collect();
        let size = match norm(&slope) {
            0.0 => 1.0,
            size => size,
        };
        let unit: Vec<f64> = (0..n).map(|i| size * self.unit(i)).collect();
        let column = |i: usize| &model.factor[n * i..n * i + n];
        let mut hessian = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..n {
                hessian[i * n + j] = dot(column(i), column(j)) * self.unit(i) * self.unit(j);
            }
            hessian[i * n + i] += damping;
        }
        let program = ConicProgram {
            hessian,
            gradient: slope.iter().map(|value| value / size).collect(),
            inequalities: inequalities(constraints, parameters, &unit),
        };
        let free: Vec<f64> = self.right[..n].iter().map(|z| z / size).collect();
        let Some(solution) = program.solve(&free, &self.expected, work) else {
            self.expected.clear();
            return false;
        };
        for (d, (z, unit)) in self
            .displacement
            .iter_mut()
            .zip(solution.z.iter().zip(&unit))
        {
            *d = z * unit;
        }
        self.set_target(parameters);
        constraints.clamp(&mut self.step.target);
        self.expected.clear();
        for entry in &solution.active {
            self.expected.push(entry.inequality);
            constraints.settle(entry.inequality, &mut self.step.target);
            let per_unit = constraints.inequality_size(entry.inequality, &unit);
            self.step.active.push(Active {
                inequality: entry.inequality,
                multiplier: entry.multiplier * size * size / per_unit,
            });
        }
        self.step.active.sort_by_key(|entry| entry.inequality);
        true
    }

    /// What the step changes and what the model predicts for it.
    fn judge(&mut self, parameters: &[f64], model: &Linearization) {
        let n = parameters.len();
        let mut largest = 0.0_f64;
        for ((d, target), p) in (self.displacement.iter_mut())
            .zip(&self.step.target)
            .zip(parameters)
        {
            *d = target - p;
            if *d != 0.0 {
                largest = largest.max(d.abs() / p.abs());
            }
        }
        self.step.relative_change = largest;
        upper_times(&model.factor, n, &self.displacement, &mut self.reached);
        let length = dot(&self.reached, &self.reached);
        self.step.predicted = -dot(&self.reached, &model.reachable) - 0.5 * length;
        if self.step.is_conic {
            self.step.decrement = (2.0 * self.step.predicted.max(0.0)).sqrt();
        }
    }
}

/// What of `vector` is orthogonal to the orthonormal `known`, of length 1; nothing where that is rounding.
fn orthonormal(mut vector: Vec<f64>, known: &[Vec<f64>]) -> Option<Vec<f64>> {
    let whole = norm(&vector);
    for _ in 0..2 {
        for other in known {
            let along = dot(&vector, other);
            add_scaled(&mut vector, -along, other);
        }
    }
    let rest = norm(&vector);
    vector.iter_mut().for_each(|value| *value /= rest);
    (rest > DEPENDENT * whole).then_some(vector)
}

/// The nearest point of the set, distances relative to each parameter's size.
pub fn project(start: &[f64], constraints: &Constraints, work: &mut Work) -> Option<Vec<f64>> {
    let n = start.len();
    let unit: Vec<f64> = start
        .iter()
        .map(|p| if *p == 0.0 { 1.0 } else { p.abs() })
        .collect();
    let mut identity = vec![0.0; n * n];
    (0..n).for_each(|index| identity[index * n + index] = 1.0);
    let program = ConicProgram {
        hessian: identity,
        gradient: vec![0.0; n],
        inequalities: inequalities(constraints, start, &unit),
    };
    let solution = program.solve(&vec![0.0; n], &[], work)?;
    let mut projected = start.to_vec();
    let mut shift = solution.z;
    shift.iter_mut().zip(&unit).for_each(|(z, unit)| *z *= unit);
    add_scaled(&mut projected, 1.0, &shift);
    constraints.clamp(&mut projected);
    for entry in &solution.active {
        constraints.settle(entry.inequality, &mut projected);
    }
    constraints.contains(&projected).then_some(projected)
}
