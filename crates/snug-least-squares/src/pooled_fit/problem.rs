//! Residuals that share parameters, when their fit stops, and what it comes to.

use crate::error::EvaluationError;
use crate::problem::linearization::Linearization;
use crate::solver::fit::Work;

/// Residuals r_i(β_i, α) of many members, i = 0 … members − 1.
pub trait PooledResidual {
    /// Number of members.
    fn member_count(&self) -> usize;

    /// Number n of each member's own parameters β_i.
    fn own_count(&self) -> usize;

    /// Number p of the shared parameters α.
    fn shared_count(&self) -> usize;

    /// Which of the shared parameters one member's residual depends on, ascending; all unless said otherwise.
    fn shared_of(&self, member: usize) -> Vec<usize> {
        let _ = member;
        (0..self.shared_count()).collect()
    }

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
    /// (β_i, those of α on which it depends).
    pub parameters: Vec<f64>,
    /// Gets cost, gradient and curvature there.
    pub linearization: &'a mut Linearization,
}

/// When a pooled fit stops.
#[derive(Debug, Clone, PartialEq)]
pub struct PooledSettings {
    /// Most steps tried.
    pub max_iterations: usize,
    /// Converged when a step without damping predicts less than this share of the cost, or when three steps in a row
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

/// Where a pooled fit stands after a step that it tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PooledStep {
    /// Steps tried so far; 0 at the start.
    pub iterations: usize,
    /// Σ_i ½‖r_i‖² where it stands.
    pub cost: f64,
    /// Whether that is somewhere else than before: the start, or a step that was accepted.
    pub moved: bool,
}

/// What one member says about the shared parameters once its own are free to follow.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// ½‖r_i‖².
    pub cost: f64,
    /// Which p of the shared parameters it depends on, ascending.
    pub shared: Vec<usize>,
    /// Projected curvature S_i = Z̃ᵀZ̃ of these, p × p, column-major, where Z̃ is ∂r_i/∂α without what ∂r_i/∂β_i can imitate in the
    /// directions that the inequalities β_i presses on leave.
    pub curvature: Vec<f64>,
    /// Projected gradient Z̃ᵀr_i of these, p; its sum over members vanishes at a free optimum.
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
    /// Whether no step predicts more than the tolerance.
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
            let size = profile.shared.len();
            for (column, &to) in profile.shared.iter().enumerate() {
                for (row, &place) in profile.shared.iter().enumerate() {
                    sum[to * p + place] += profile.curvature[column * size + row];
                }
            }
        }
        sum
    }
}
