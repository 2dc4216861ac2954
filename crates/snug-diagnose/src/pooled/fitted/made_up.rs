//! Fits of a few numbers, for tests of what is made of them.

use super::{Block, Fitted};
use crate::data::clusters::Clusters;
use crate::pooled::sharing::{SharedSize, Sharing};
use snug_least_squares::matrix::SymmetricMatrix;
use snug_model::Effect;

impl Fitted {
    /// Whole tightenings that leave these `squares`, each in `count` residuals in units of noise. Nothing is shared, and the
    /// torque has no noise.
    pub fn made_up(effects: &[Effect], squares: &[f64], count: usize) -> Self {
        let nothing = || (SymmetricMatrix::zero(0), Vec::new());
        let block = |&squares: &f64| Block {
            squares,
            count,
            gradient: Vec::new(),
            curvature: SymmetricMatrix::zero(0),
        };
        Self {
            effects: effects.to_vec(),
            own_names: Vec::new(),
            shared_names: Vec::new(),
            own_indices: Vec::new(),
            shared_sizes: Vec::new(),
            shared_of: vec![Vec::new(); squares.len()],
            shares: None,
            sharing: Sharing::default(),
            own: vec![Vec::new(); squares.len()],
            shared: Vec::new(),
            converged: true,
            blocks: squares.iter().map(block).collect(),
            members: (0..squares.len()).collect(),
            torque_noise: vec![0.0; squares.len()],
            clusters: Clusters { per_case: 1 },
            is_weighted: true,
            is_exact: false,
            member_curvature: Vec::new(),
            profiles: squares.iter().map(|_| nothing()).collect(),
            own_effect_count: 0,
        }
    }

    /// The same where the noise is not known.
    pub fn unweighted(mut self) -> Self {
        self.is_weighted = false;
        self
    }

    /// The same where only rounding is left.
    pub fn exact(mut self) -> Self {
        self.is_exact = true;
        self.unweighted()
    }

    /// The same of stretches of a long record.
    pub fn in_stretches(mut self) -> Self {
        self.clusters = Clusters { per_case: 8 };
        self
    }

    /// The same with every tightening's own parameters, the model's first ones; the last `of_effects` of them belong to effects.
    pub fn with_own(mut self, names: &[&str], own: Vec<Vec<f64>>, of_effects: usize) -> Self {
        self.own_names = names.iter().map(|name| (*name).to_owned()).collect();
        self.own_indices = (0..names.len()).collect();
        self.own = own;
        self.own_effect_count = of_effects;
        self
    }

    /// The same with one shared parameter, the model's number `index`, of which every tightening says this curvature and this
    /// gradient.
    pub fn with_shared(
        mut self,
        (name, index, value): (&str, usize, f64),
        evidence: &[(f64, f64)],
    ) -> Self {
        self.shared_names = vec![name.to_owned()];
        self.shared_sizes = vec![SharedSize { index, level: None }];
        self.shared_of = vec![vec![0]; evidence.len()];
        self.shared = vec![value];
        let of = |&(curvature, gradient): &(f64, f64)| {
            (SymmetricMatrix::new(1, vec![curvature]), vec![gradient])
        };
        self.profiles = evidence.iter().map(of).collect();
        for (block, (curvature, gradient)) in self.blocks.iter_mut().zip(&self.profiles) {
            (block.curvature, block.gradient) = (curvature.clone(), gradient.clone());
        }
        self
    }

    /// The same with so much of each cluster's squares made by the noise of the torque.
    pub fn with_torque_noise(mut self, squares: &[f64]) -> Self {
        self.torque_noise = squares.to_vec();
        self
    }
}
