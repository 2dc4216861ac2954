//! The pooled fit over all rows: passes over the dataset, between which the client steps the sizes that rows share.

use super::pass::{ByGroup, Pass, added_up};
use super::solve::{Layout, Local, step};
use super::thresholds::{
    DAMPING_FACTOR, FIRST_DAMPING, MOST_SIZES, MOST_STEPS, RESOLUTION, SUFFICIENT, TOLERANCE,
    TOLERANCE_ERRORS,
};
use crate::error::PlantError;
use crate::functions::question::{Held, Totals};
use crate::storage::partition::Partition;
use snug_statistics::distributions::student_t_quantile;
use std::collections::BTreeMap;

/// Where the pooled fit over all rows ended.
#[derive(Debug, Clone)]
pub(crate) struct PooledOverAll {
    /// The sizes, by group where they differ.
    pub held: Held,
    /// Groups in order, one without a name where all share all; each with rows that take part and standard errors of its sizes.
    pub groups: Vec<GroupErrors>,
    /// Quantile of Student's t for 95 % intervals.
    pub quantile: f64,
    /// What all rows say there.
    pub totals: Totals,
    /// What the rows of every partition say there.
    pub parts: BTreeMap<Partition, Totals>,
    /// How many sizes were fitted.
    pub sizes: usize,
    /// Passes over the dataset.
    pub passes: usize,
    /// Whether the sizes are as near to the optimum as was asked.
    pub converged: bool,
}

/// How well the sizes of a group are known.
#[derive(Debug, Clone)]
pub(crate) struct GroupErrors {
    pub name: Option<String>,
    pub members: f64,
    /// In the order of the model's shared parameters; `None` on a bound, and where nothing is known.
    pub errors: Vec<Option<f64>>,
    /// By what share of the group's squared residual a size would raise that if it were nothing, likewise.
    pub shares: Vec<f64>,
}

impl PooledOverAll {
    /// Root mean square of the whitened residual, the parameters accounted for.
    pub fn error(&self) -> f64 {
        let spare = self.totals.residuals - self.totals.own - self.sizes as f64;
        (2.0 * self.totals.cost / spare.max(1.0)).sqrt()
    }
}

/// Where the fit stands.
struct Place {
    held: Held,
    at: Vec<f64>,
    said: ByGroup,
    parts: BTreeMap<Partition, Totals>,
    local: Local,
}

/// Fits the sizes from `start` within `bounds`, which stand in the order of the model's shared parameters; `told` hears of every pass.
///
/// # Errors
/// [`PlantError::Pass`], [`PlantError::Setting`] where there are more sizes than one client solves for.
pub(crate) async fn pooled_over_all(
    pass: &Pass<'_>,
    start: &Held,
    bounds: &[(f64, f64)],
    told: &(dyn Fn(usize, f64) + Sync),
) -> Result<PooledOverAll, PlantError> {
    let p = start.all.len();
    let (said, parts) = added_up(&pass.said(start).await?, p);
    let layout = Layout::new(&start.sharing, &said);
    if layout.size() > MOST_SIZES {
        let allowed = format!("at most {MOST_SIZES} sizes in all");
        let found = format!("{} groups", layout.groups.len());
        return Err(PlantError::setting("sizes by group", &found, &allowed));
    }
    let mut all_bounds = vec![(f64::NEG_INFINITY, f64::INFINITY); layout.size()];
    for group in 0..layout.groups.len() {
        for (place, bound) in layout.places(group).into_iter().zip(bounds) {
            all_bounds[place] = *bound;
        }
    }
    let place = |held: Held, said: ByGroup, parts| Place {
        at: layout.unknowns(&held),
        local: layout.local(&said),
        held,
        said,
        parts,
    };
    let mut here = place(start.clone(), said, parts);
    let mut passes = 1;
    told(passes, here.local.cost);
    let (mut damping, mut before) = (0.0, 0.0);
    let mut converged = layout.size() == 0;
    while !converged && passes <= MOST_STEPS {
        let step = step(&here.local, &here.at, &all_bounds, damping);
        let length = length(&here, &step);
        let predicted = here.local.predicted_fall(&step);
        if length == 0.0 {
            converged = true;
            break;
        }
        let at: Vec<f64> = here
            .at
            .iter()
            .zip(&step)
            .map(|(at, step)| at + step)
            .collect();
        let held = layout.held(&here.held, &at);
        let (said, parts) = added_up(&pass.said(&held).await?, p);
        let there = place(held, said, parts);
        passes += 1;
        told(passes, there.local.cost);
        let fall = here.local.cost - there.local.cost;
        let is_rounding = fall.abs() <= RESOLUTION * here.local.cost;
        if fall > SUFFICIENT * predicted || is_rounding {
            // A step leaves about as much of the way as it left of the way before: what is still to go follows from two.
            let rate = (length / before).min(1.0);
            converged =
                damping == 0.0 && length * rate.min(0.5) <= 1.0 || is_rounding && rate > 0.5;
            before = length;
            damping = 0.0;
            here = there;
        } else {
            damping = (damping * DAMPING_FACTOR).max(FIRST_DAMPING);
        }
    }
    Ok(ended(&layout, here, passes, converged, &all_bounds))
}

/// The longest of a step's ways, in what a size may still be off at the end.
fn length(here: &Place, step: &[f64]) -> f64 {
    let ways = step.iter().enumerate().map(|(index, step)| {
        let information = here.local.curvature.at(index, index);
        let error = if information > 0.0 {
            information.sqrt().recip()
        } else {
            0.0
        };
        let near = TOLERANCE * here.at[index].abs() + TOLERANCE_ERRORS * error;
        if *step == 0.0 { 0.0 } else { step.abs() / near }
    });
    ways.fold(0.0, f64::max)
}

fn ended(
    layout: &Layout,
    here: Place,
    passes: usize,
    converged: bool,
    bounds: &[(f64, f64)],
) -> PooledOverAll {
    let mut totals = Totals::zero(here.held.all.len());
    here.said.values().for_each(|one| totals.add(one));
    let errors = errors(&here.local, totals.members);
    let is_inside =
        |place: usize| here.at[place] > bounds[place].0 && here.at[place] < bounds[place].1;
    let groups = (layout.groups.iter().enumerate()).map(|(group, name)| {
        let places = layout.places(group);
        let said = here.said.get(name);
        let removed = |(column, &place): (usize, &usize)| {
            let said = said.filter(|said| said.cost > 0.0)?;
            let information = said.curvature[column * places.len() + column];
            Some(here.at[place].powi(2) * information / (2.0 * said.cost))
        };
        GroupErrors {
            name: name.clone(),
            members: said.map_or(0.0, |said| said.members),
            errors: (places.iter())
                .map(|&place| errors[place].filter(|error| is_inside(place) && *error > 0.0))
                .collect(),
            shares: (places.iter().enumerate())
                .map(|one| removed(one).unwrap_or(0.0))
                .collect(),
        }
    });
    PooledOverAll {
        groups: groups.collect(),
        quantile: student_t_quantile(0.975, (totals.members - 1.0).max(1.0)),
        parts: here.parts,
        totals,
        sizes: layout.size(),
        passes,
        converged,
        held: here.held,
    }
}

/// Standard errors as `improve` states them: S⁻¹ of unit noise, or the sandwich S⁻¹ (Σ g gᵀ) S⁻¹ U/(U − p) over U tightenings (CR1)
/// where that is larger.
fn errors(local: &Local, members: f64) -> Vec<Option<f64>> {
    let size = local.gradient.len();
    let Some(inverse) = local.curvature.inverse() else {
        return vec![None; size];
    };
    let spare = (members - size as f64).max(1.0);
    let error = |index: usize| {
        let row: Vec<f64> = (0..size).map(|column| inverse.at(index, column)).collect();
        let sandwich = local.scatter.quadratic(&row) * members / spare;
        let variance = inverse.at(index, index).max(sandwich);
        Some(variance.sqrt()).filter(|error| error.is_finite())
    };
    (0..size).map(error).collect()
}
