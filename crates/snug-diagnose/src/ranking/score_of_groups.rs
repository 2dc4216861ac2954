//! What groups of tightenings promise that have sizes of their own, asked of a fit with one size for all.
//!
//! With g_i and S_i the projected gradient and curvature of a tightening over the effect's sizes (Rao's score test): a group
//! wants to move by δ = S_G⁻¹ Σ g, and all groups together lower the squared residual by Q = Σ gᵀδ. Under one size for all
//! Q over the scatter within the groups is χ² with a degree of freedom less for each size than there are groups.

use crate::pooled::fitted::Fitted;
use crate::pooled::sharing::Groups;
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// What groups of one factor would make of the size of an effect that all share so far.
pub(super) struct Promise {
    pub groups: Groups,
    /// Q: by how much the squared residual would fall.
    pub gain: f64,
    /// Chance of as much where all have the same size.
    pub p: f64,
    /// Q over the noise, less two for each size more and for each factor 2.7 of groupings among which this is the best (Akaike).
    pub worth: f64,
}

/// Q of `groups`, the best of so many, over the sizes at `places`.
pub(super) fn promise(
    fitted: &Fitted,
    places: &[usize],
    groups: Groups,
    of: usize,
) -> Option<Promise> {
    let (p, count) = (places.len(), groups.levels.len());
    let shares: Vec<Vec<(usize, f64)>> = (0..groups.of.len())
        .map(|member| groups.shares(member))
        .collect();
    let mut curvature = SymmetricMatrix::zero(p * count);
    let mut gradient = vec![0.0; p * count];
    let of_one: Vec<(SymmetricMatrix, Vec<f64>)> = (0..shares.len())
        .map(|member| fitted.of_sizes(&[member], places))
        .collect::<Option<_>>()?;
    for ((own, g), shares) in of_one.iter().zip(&shares) {
        for &(group, share) in shares {
            for i in 0..p {
                gradient[group * p + i] += share * g[i];
            }
            for &(other, beside) in shares {
                for i in 0..p {
                    for j in 0..p {
                        let (row, column) = (group * p + i, other * p + j);
                        let sum = curvature.at(row, column) + share * beside * own.at(i, j);
                        curvature.set(row, column, sum);
                    }
                }
            }
        }
    }
    let shift: Vec<f64> = (curvature.solve_scaled(&gradient)?.iter())
        .map(|step| -step)
        .collect();
    let gain = -2.0 * dot(&gradient, &shift) - curvature.quadratic(&shift);
    let mut within = 0.0;
    for ((own, g), shares) in of_one.iter().zip(&shares) {
        let mut left = g.clone();
        for &(group, share) in shares {
            for (row, left) in left.iter_mut().enumerate() {
                *left += (0..p)
                    .map(|j| own.at(row, j) * share * shift[group * p + j])
                    .sum::<f64>();
            }
        }
        let step = own.solve_scaled(&left).unwrap_or_default();
        within += dot(&step, &left);
    }
    let sizes = p as f64;
    let scatter = within / (sizes * (shares.len() as f64 - count as f64)).max(1.0);
    let noise = fitted.scale().max(scatter);
    let freedom = sizes * (count as f64 - 1.0);
    let chance = ChiSquared::new(freedom).map_or(1.0, |chi| chi.sf(gain / noise));
    Some(Promise {
        groups,
        gain,
        p: (chance * of as f64).min(1.0),
        worth: gain / noise - 2.0 * (freedom + (of as f64).ln()),
    })
}
