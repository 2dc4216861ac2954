//! A start from which a model with effects can be simulated.
//!
//! Mass, damper and spring alone are solved exactly, whatever their time constants. With effects the classical method of Runge and Kutta
//! goes from sample to sample, which grows without bounds where c h/m > 2.79 or h √(k/m) > 2.83. A rig that moves slowly for
//! its damping (a valve, a heater) shows no mass at its sampling rate: any that decays within a sample fits as well, and one of them
//! can be simulated.
//!
//! Source: Hairer and Wanner 1996, Solving Ordinary Differential Equations II, section IV.2 (stability domains).

use crate::pooled::model::{PooledModel, Start};
use crate::ranking::thresholds::{DECAYS_OF_A_STEP, RADIANS_OF_A_STEP};

/// Raises the masses of `start` to where the slowest sampled recording can be simulated; those that can be stay as they are.
pub(crate) fn make_simulable(pooled: &PooledModel<'_>, start: &mut Start) {
    let intervals = pooled.cases.iter().map(|case| case.input.grid_interval_s());
    let interval_s = intervals.fold(0.0, f64::max);
    let shared: Vec<usize> = pooled.shared.iter().map(|size| size.index).collect();
    raise(&mut start.shared, &shared, &[], &[], interval_s);
    for own in &mut start.own {
        raise(own, &pooled.own, &start.shared, &shared, interval_s);
    }
}

/// Raises the mass among `values`, whose parameters have these `indices`; what is not among them is among `others`.
fn raise(
    values: &mut [f64],
    indices: &[usize],
    others: &[f64],
    of_others: &[usize],
    interval_s: f64,
) {
    let among = |index: usize, values: &[f64], indices: &[usize]| {
        let place = indices.iter().position(|&one| one == index)?;
        values.get(place).copied()
    };
    let value =
        |index: usize| among(index, values, indices).or_else(|| among(index, others, of_others));
    let (damping, stiffness) = (value(1).unwrap_or(0.0), value(2).unwrap_or(0.0));
    let decays = damping * interval_s / DECAYS_OF_A_STEP;
    let turns = stiffness * (interval_s / RADIANS_OF_A_STEP).powi(2);
    if let Some(mass) = indices.iter().position(|&index| index == 0) {
        values[mass] = values[mass].max(decays).max(turns);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mass_that_decays_within_a_sample_is_raised_and_no_other() {
        let raised = |mass: f64| {
            let mut values = [mass, 400.0, 0.8];
            raise(&mut values, &[0, 1, 2], &[], &[], 1.0);
            values
        };
        let [mass, ..] = raised(1e-6);
        assert!(400.0 / mass < 2.0, "{mass}");
        assert_eq!(raised(1e4), [1e4, 400.0, 0.8]);
    }

    #[test]
    fn what_is_shared_counts_for_what_each_has_of_its_own() {
        let mut own = [1e-6];
        raise(&mut own, &[0], &[0.0, 9e4], &[1, 2], 0.01);
        assert!((9e4_f64 / own[0]).sqrt() * 0.01 < 2.0, "{own:?}");
    }
}
