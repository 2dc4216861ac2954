//! What a fitted pooled model leaves in tightenings, or stretches, that took no part in fixing its sizes.

use crate::pooled::fitted::Fitted;
use crate::pooled::parameter_place::effect_of;
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use std::collections::{BTreeMap, BTreeSet};

impl Fitted {
    /// The same without what torque noise alone makes of each cluster: what models are compared by.
    pub fn heldout_beyond_torque_noise(&self) -> Vec<f64> {
        let squares = self.heldout(&|cluster| cluster).into_iter();
        squares
            .zip(&self.torque_noise)
            .map(|(squares, noise)| squares - noise)
            .collect()
    }

    /// Σ r² of each cluster as predicted for sizes that were fixed without its group: δ = (S − S_g)⁻¹ g_g, then
    /// r² + 2 gᵀδ + δᵀSδ. `group_of` names the group of a cluster; each tightening's own parameters follow, and pay for it.
    pub fn heldout(&self, group_of: &dyn Fn(usize) -> usize) -> Vec<f64> {
        let scale = self.scale();
        let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for cluster in 0..self.blocks.len() {
            groups.entry(group_of(cluster)).or_default().push(cluster);
        }
        let mut squares: Vec<f64> = vec![0.0; self.blocks.len()];
        let all = self.shared_curvature();
        let inverse = self.sharing.is_by_group().then(|| all.inverse()).flatten();
        for clusters in groups.values() {
            if let Some(inverse) = &inverse {
                self.hold_out_of_groups(clusters, inverse, &mut squares);
            } else if self.clusters.are_whole() {
                self.hold_out(clusters, all.clone(), &[], &mut squares);
            } else {
                self.hold_out_stretches(clusters, &mut squares);
            }
        }
        if self.clusters.are_whole() {
            let pays = 2.0 * self.own_effect_count as f64 * scale;
            squares.iter_mut().for_each(|value| *value += pays);
        }
        squares
    }

    /// The parameters at `kept` stay as they were fitted.
    fn hold_out(
        &self,
        clusters: &[usize],
        total: SymmetricMatrix,
        kept: &[usize],
        squares: &mut [f64],
    ) {
        let mut rest = total;
        let mut gradient = vec![0.0; rest.size()];
        for &cluster in clusters {
            rest.subtract(&self.blocks[cluster].curvature);
            for (sum, g) in gradient.iter_mut().zip(&self.blocks[cluster].gradient) {
                *sum += g;
            }
        }
        for &place in kept {
            for other in 0..rest.size() {
                rest.set(place, other, 0.0);
                rest.set(other, place, 0.0);
            }
            rest.set(place, place, 1.0);
            gradient[place] = 0.0;
        }
        let shift = rest.solve_scaled(&gradient);
        for &cluster in clusters {
            let block = &self.blocks[cluster];
            squares[cluster] = block.squares
                + shift.as_ref().map_or(0.0, |shift| {
                    2.0 * dot(&block.gradient, shift) + block.curvature.quadratic(shift)
                });
        }
    }

    /// Whole tightenings of which each shares some parameters only: what all others say of these, `inverse` their covariance. A
    /// group that is held out as a whole is expected to be as the others are on average.
    fn hold_out_of_groups(
        &self,
        clusters: &[usize],
        inverse: &SymmetricMatrix,
        squares: &mut [f64],
    ) {
        let all = clusters
            .iter()
            .flat_map(|&cluster| &self.shared_of[cluster]);
        let places: Vec<usize> = all.copied().collect::<BTreeSet<_>>().into_iter().collect();
        let mut covariance = SymmetricMatrix::zero(places.len());
        for (i, &from) in places.iter().enumerate() {
            for (j, &to) in places.iter().enumerate() {
                covariance.set(i, j, inverse.at(from, to));
            }
        }
        let Some(mut rest) = covariance.inverse() else {
            clusters
                .iter()
                .for_each(|&cluster| squares[cluster] = self.blocks[cluster].squares);
            return;
        };
        let mut gradient = vec![0.0; places.len()];
        for &cluster in clusters {
            let own = self.among(&places, cluster);
            take_from(&mut rest, &self.blocks[cluster].curvature, &own);
            for (&place, g) in own.iter().zip(&self.blocks[cluster].gradient) {
                gradient[place] += g;
            }
        }
        let mut shift = rest
            .solve_scaled(&gradient)
            .unwrap_or_else(|| vec![0.0; places.len()]);
        for (shift, &place) in shift.iter_mut().zip(&places) {
            if let Some(others) = self.mean_without(place, clusters) {
                *shift = others - self.shared[place];
            }
        }
        for &cluster in clusters {
            let block = &self.blocks[cluster];
            let own = self.among(&places, cluster);
            let shift: Vec<f64> = own.iter().map(|&place| shift[place]).collect();
            squares[cluster] = block.squares
                + 2.0 * dot(&block.gradient, &shift)
                + block.curvature.quadratic(&shift);
        }
    }

    /// Where among a record's own parameters those stand that say how it begins.
    fn initial_states(&self) -> Vec<usize> {
        let says_it = |index: &usize| {
            effect_of(&self.effects, *index).is_some_and(|(of, _)| of.sets_initial_motion())
        };
        (0..self.own_indices().len())
            .filter(|&column| says_it(&self.own_indices()[column]))
            .collect()
    }

    /// Where among `places` those of one tightening stand.
    fn among(&self, places: &[usize], member: usize) -> Vec<usize> {
        let own = self.shared_of[member].iter();
        own.filter_map(|place| places.binary_search(place).ok())
            .collect()
    }

    /// The mean size of the other groups, where nobody of this one is left without `clusters`.
    fn mean_without(&self, place: usize, clusters: &[usize]) -> Option<f64> {
        let size = &self.shared_sizes[place];
        size.level.as_ref()?;
        let mut members = (0..self.own.len()).filter(|member| !clusters.contains(member));
        if members.any(|member| self.shared_of[member].contains(&place)) {
            return None;
        }
        let others = self.shared_sizes.iter().zip(&self.shared);
        let others = others.filter(|(other, _)| other.index == size.index && *other != size);
        let values: Vec<f64> = others.map(|(_, value)| *value).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    }

    /// Own parameters are fixed by the other stretches of the same tightening, the shared ones by everything else. How a record
    /// begins is no law that other stretches could tell: it stays as it was fitted.
    fn hold_out_stretches(&self, clusters: &[usize], squares: &mut [f64]) {
        let mut by_member: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for &cluster in clusters {
            by_member
                .entry(self.members[cluster])
                .or_default()
                .push(cluster);
        }
        let states = self.initial_states();
        for (member, own_clusters) in by_member {
            let mut total = self.member_curvature[member].clone();
            let first_shared = total.size() - self.shared.len();
            for (other, (curvature, _)) in self.profiles.iter().enumerate() {
                if other != member {
                    total.add_at(first_shared, curvature);
                }
            }
            self.hold_out(&own_clusters, total, &states, squares);
        }
    }
}

/// Takes a matrix over `places` from one over all.
fn take_from(sum: &mut SymmetricMatrix, part: &SymmetricMatrix, places: &[usize]) {
    for (i, &row) in places.iter().enumerate() {
        for (j, &column) in places.iter().enumerate() {
            sum.set(row, column, sum.at(row, column) - part.at(i, j));
        }
    }
}
