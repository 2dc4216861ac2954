//! What each cluster says of the shared parameters, for a sandwich over clusters.
//!
//! A stretch of a record that has parameters α of its own beside the shared β pulls at β by g_β − S_βα S_αα⁻¹ g_α: what it asks of α is
//! followed there by the whole record. S is the curvature of the record, and S_ββ − S_βα S_αα⁻¹ S_αβ what it knows of β (partitioned
//! regression: Frisch and Waugh 1933). Bounds that hold are not counted as knowledge.

use super::{Fitted, add_in};
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};

impl Fitted {
    /// Curvature and the gradient of each cluster, whose last entries belong to the shared parameters. Stretches of one
    /// record speak of its own parameters, too.
    pub fn shared_evidence(&self) -> (SymmetricMatrix, Vec<Vec<f64>>) {
        let of_blocks = || {
            let blocks = self.blocks.iter();
            blocks.map(|block| block.gradient.clone()).collect()
        };
        match self.member_curvature.first() {
            Some(whole) if self.own.len() == 1 => (whole.clone(), of_blocks()),
            Some(_) if self.shares_all() => (self.shared_curvature(), of_blocks()),
            Some(_) => self.of_stretches().unwrap_or_else(|| self.of_profiles()),
            None => self.of_profiles(),
        }
    }

    fn of_profiles(&self) -> (SymmetricMatrix, Vec<Vec<f64>>) {
        let all = self.profiles.iter().enumerate();
        let gradients = all.map(|(member, (_, gradient))| self.of_all_shared(member, gradient));
        (self.shared_curvature(), gradients.collect())
    }

    /// `None` where a record knows nothing of a parameter of its own.
    fn of_stretches(&self) -> Option<(SymmetricMatrix, Vec<Vec<f64>>)> {
        let mut curvature = SymmetricMatrix::zero(self.shared.len());
        let mut slopes = Vec::new();
        for (whole, places) in self.member_curvature.iter().zip(&self.shared_of) {
            let slope = slopes_of_own(whole, whole.size() - places.len())?;
            add_in(&mut curvature, &projected(whole, &slope), places);
            slopes.push(slope);
        }
        let of_block = |(&member, block): (&usize, &super::Block)| {
            let slopes = &slopes[member];
            let (own, shared) = (block.gradient).split_at(block.gradient.len() - slopes.len());
            let pull = shared.iter().zip(slopes);
            let pull: Vec<f64> = pull.map(|(g, slope)| g - dot(slope, own)).collect();
            self.of_all_shared(member, &pull)
        };
        let blocks = self.members.iter().zip(&self.blocks);
        Some((curvature, blocks.map(of_block).collect()))
    }
}

/// S_αα⁻¹ S_αβ of the first `own` parameters α, one row for each β.
pub(in crate::pooled) fn slopes_of_own(
    whole: &SymmetricMatrix,
    own: usize,
) -> Option<Vec<Vec<f64>>> {
    let mut of_own = SymmetricMatrix::zero(own);
    for i in 0..own {
        for j in 0..own {
            of_own.set(i, j, whole.at(i, j));
        }
    }
    let beside = |shared: usize| (0..own).map(|i| whole.at(i, shared)).collect::<Vec<f64>>();
    let shared = own..whole.size();
    shared
        .map(|place| of_own.solve_scaled(&beside(place)))
        .collect()
}

/// S_ββ − S_βα S_αα⁻¹ S_αβ.
pub(in crate::pooled) fn projected(
    whole: &SymmetricMatrix,
    slopes: &[Vec<f64>],
) -> SymmetricMatrix {
    let (count, own) = (slopes.len(), whole.size() - slopes.len());
    let mut left = SymmetricMatrix::zero(count);
    for (i, slope) in slopes.iter().enumerate() {
        for j in 0..count {
            let beside: Vec<f64> = (0..own).map(|k| whole.at(k, own + j)).collect();
            let value = whole.at(own + i, own + j) - dot(slope, &beside);
            left.set(i, j, value);
        }
    }
    left
}
