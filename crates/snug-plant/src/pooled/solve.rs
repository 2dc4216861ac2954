//! The client's part of the pooled fit: what groups say put together over all sizes, and a damped Gauss–Newton step within bounds.

use super::pass::ByGroup;
use crate::functions::question::{Held, Sharing};
use snug_least_squares::matrix::SymmetricMatrix;

/// Where the sizes stand among the unknowns: first those that all rows share, then group by group those that are a group's own.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    differs: Vec<bool>,
    /// In order; one without a name where all share all.
    pub groups: Vec<Option<String>>,
}

/// What all rows say of the unknowns, each in the unit that its size's name says; squared residuals have no unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Local {
    /// Σ ½‖r‖².
    pub cost: f64,
    pub gradient: Vec<f64>,
    pub curvature: SymmetricMatrix,
    /// Σ g gᵀ.
    pub scatter: SymmetricMatrix,
}

impl Layout {
    pub fn new(sharing: &Sharing, said: &ByGroup) -> Self {
        Self {
            differs: sharing.differs.clone(),
            groups: said.keys().cloned().collect(),
        }
    }

    fn own_count(&self) -> usize {
        self.differs.iter().filter(|differs| **differs).count()
    }

    fn common_count(&self) -> usize {
        self.differs.len() - self.own_count()
    }

    /// How many unknowns there are.
    pub fn size(&self) -> usize {
        self.common_count() + self.own_count() * self.groups.len()
    }

    /// Which unknowns a group's sizes are, in the order of the model's shared parameters.
    pub fn places(&self, group: usize) -> Vec<usize> {
        let (mut common, mut own) = (0, self.common_count() + group * self.own_count());
        let next = |differs: &bool| {
            let place = if *differs { &mut own } else { &mut common };
            *place += 1;
            *place - 1
        };
        self.differs.iter().map(next).collect()
    }

    /// The unknowns as rows hold them.
    pub fn unknowns(&self, held: &Held) -> Vec<f64> {
        let mut unknowns = vec![0.0; self.size()];
        for (group, name) in self.groups.iter().enumerate() {
            let own = name.as_ref().and_then(|name| held.groups.get(name));
            for (place, value) in self.places(group).into_iter().zip(own.unwrap_or(&held.all)) {
                unknowns[place] = *value;
            }
        }
        unknowns
    }

    /// The same back; what nobody's group is, is as before.
    pub fn held(&self, before: &Held, unknowns: &[f64]) -> Held {
        let mut held = before.clone();
        for (group, name) in self.groups.iter().enumerate() {
            let own: Vec<f64> = (self.places(group).into_iter())
                .map(|place| unknowns[place])
                .collect();
            for (all, (value, differs)) in held.all.iter_mut().zip(own.iter().zip(&self.differs)) {
                *all = if *differs && name.is_some() {
                    *all
                } else {
                    *value
                };
            }
            if let Some(name) = name {
                held.groups.insert(name.clone(), own);
            }
        }
        held
    }

    /// What groups say, put together.
    pub fn local(&self, said: &ByGroup) -> Local {
        let size = self.size();
        let mut local = Local {
            cost: 0.0,
            gradient: vec![0.0; size],
            curvature: SymmetricMatrix::zero(size),
            scatter: SymmetricMatrix::zero(size),
        };
        for (group, name) in self.groups.iter().enumerate() {
            let Some(totals) = said.get(name) else {
                continue;
            };
            let places = self.places(group);
            let p = places.len();
            local.cost += totals.cost;
            for (i, &row) in places.iter().enumerate() {
                local.gradient[row] += totals.gradient[i];
                for (j, &column) in places.iter().enumerate() {
                    let add = |to: &mut SymmetricMatrix, value: f64| {
                        to.set(row, column, to.at(row, column) + value);
                    };
                    add(&mut local.curvature, totals.curvature[i * p + j]);
                    add(&mut local.scatter, totals.scatter[i * p + j]);
                }
            }
        }
        local
    }
}

/// The damped Gauss–Newton step from `at` within bounds (each a least and a most); what would leave them ends there. 0 where nothing is
/// known.
pub fn step(local: &Local, at: &[f64], bounds: &[(f64, f64)], damping: f64) -> Vec<f64> {
    let size = at.len();
    let mut step = vec![0.0; size];
    let presses = |index: usize| {
        let ((low, high), slope) = (bounds[index], local.gradient[index]);
        (at[index] <= low && slope > 0.0) || (at[index] >= high && slope < 0.0)
    };
    let is_known = |index: usize| local.curvature.at(index, index) > 0.0;
    let mut free: Vec<usize> = (0..size).filter(|&i| !presses(i) && is_known(i)).collect();
    while !free.is_empty() {
        let mut matrix = SymmetricMatrix::zero(free.len());
        let mut right = Vec::with_capacity(free.len());
        for (i, &row) in free.iter().enumerate() {
            for (j, &column) in free.iter().enumerate() {
                let value = local.curvature.at(row, column);
                matrix.set(
                    i,
                    j,
                    if i == j {
                        value * (1.0 + damping)
                    } else {
                        value
                    },
                );
            }
            let held = (0..size).filter(|index| !free.contains(index));
            let moved: f64 = held
                .map(|index| local.curvature.at(row, index) * step[index])
                .sum();
            right.push(-local.gradient[row] - moved);
        }
        let Some(found) = matrix.solve_scaled(&right) else {
            return vec![0.0; size];
        };
        let leaves = |&(index, value): &(usize, f64)| {
            let end = at[index] + value;
            end < bounds[index].0 || end > bounds[index].1
        };
        let found: Vec<(usize, f64)> = free.iter().copied().zip(found).collect();
        let out: Vec<(usize, f64)> = found.iter().copied().filter(leaves).collect();
        if out.is_empty() {
            found
                .into_iter()
                .for_each(|(index, value)| step[index] = value);
            break;
        }
        for (index, value) in out {
            let end = (at[index] + value).clamp(bounds[index].0, bounds[index].1);
            step[index] = end - at[index];
            free.retain(|&one| one != index);
        }
    }
    step
}

impl Local {
    /// By how much the cost falls with `step`, as far as gradient and curvature tell.
    pub fn predicted_fall(&self, step: &[f64]) -> f64 {
        let along: f64 = self.gradient.iter().zip(step).map(|(g, d)| g * d).sum();
        -along - 0.5 * self.curvature.quadratic(step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::functions::question::Totals;

    /// ½ Σ (xᵢ − tᵢ)² over two groups that share the first of two unknowns.
    fn said(at: &[f64], target: &[f64]) -> ByGroup {
        let of = |places: [usize; 2]| Totals {
            cost: places
                .iter()
                .map(|&i| 0.5 * (at[i] - target[i]).powi(2))
                .sum(),
            gradient: places.iter().map(|&i| at[i] - target[i]).collect(),
            curvature: vec![1.0, 0.0, 0.0, 1.0],
            ..Totals::zero(2)
        };
        let named = |name: &str| Some(name.to_owned());
        ByGroup::from([(named("A"), of([0, 1])), (named("B"), of([0, 2]))])
    }

    fn layout(said: &ByGroup) -> Layout {
        let sharing = Sharing {
            factor: Some(snug_campaign::Factor::Participant),
            differs: vec![false, true],
        };
        Layout::new(&sharing, said)
    }

    #[test]
    fn groups_have_their_own_and_share_the_rest() {
        let (at, target) = ([0.0; 3], [1.0, 2.0, 3.0]);
        let said = said(&at, &target);
        let layout = layout(&said);
        assert_eq!(
            (layout.places(0), layout.places(1)),
            (vec![0, 1], vec![0, 2])
        );
        let free = [(f64::NEG_INFINITY, f64::INFINITY); 3];
        let step = step(&layout.local(&said), &at, &free, 0.0);
        assert!(
            step.iter().zip(target).all(|(a, b)| (a - b).abs() < 1e-15),
            "{step:?}"
        );
    }

    /// The third ends at 2.5 and stays there, though what it says pulls on.
    #[test]
    fn what_would_leave_its_bounds_ends_there() {
        let target = [1.0, 2.0, 3.0];
        let bounds = [(0.0, 9.0), (0.0, 9.0), (0.0, 2.5)];
        let mut at = [0.0; 3];
        for _ in 0..2 {
            let said = said(&at, &target);
            let found = step(&layout(&said).local(&said), &at, &bounds, 0.0);
            at.iter_mut().zip(found).for_each(|(at, step)| *at += step);
        }
        assert!(
            at.iter()
                .zip([1.0, 2.0, 2.5])
                .all(|(a, b)| (a - b).abs() < 1e-15),
            "{at:?}"
        );
    }
}
