//! A start from which a model with effects can be simulated.
//!
//! Mass, damper and spring alone are solved exactly, whatever their time constants. With effects the classical method of Runge and Kutta
//! goes from sample to sample, which grows without bounds where c h/m > 2.79 or h √(k/m) > 2.83. A rig that moves slowly for
//! its damping (a valve, a heater) shows no mass at its sampling rate: any that decays within a sample fits as well, and one of them
//! can be simulated.
//!
//! Source: Hairer and Wanner 1996, Solving Ordinary Differential Equations II, section IV.2 (stability domains).

use crate::pooled::equation::values_at;
use crate::pooled::model::{PooledModel, Start};
use crate::ranking::thresholds::{DECAYS_OF_A_STEP, RADIANS_OF_A_STEP};

/// The start with the masses raised to where every recording can be simulated; those that can be stay as they are, and so does a mass
/// that is held.
pub(crate) fn simulable(pooled: &PooledModel<'_>, mut start: Start) -> Start {
    let shared = pooled.shared.iter().position(|size| size.index == MASS);
    let own = pooled.own.iter().position(|&index| index == MASS);
    for (member, values) in values_at(pooled, &start).into_iter().enumerate() {
        let interval_s = pooled.cases[member].input.grid_interval_s();
        let least = least_mass(values[DAMPING], values[STIFFNESS], interval_s);
        let mass = match (own, shared) {
            (Some(own), _) => start.own[member].get_mut(own),
            (None, Some(shared)) => start.shared.get_mut(shared),
            (None, None) => None,
        };
        if let Some(mass) = mass {
            *mass = mass.max(least);
        }
    }
    start
}

const MASS: usize = 0;
const DAMPING: usize = 1;
const STIFFNESS: usize = 2;

/// The least mass with which a damper and a spring are begun \[kg\].
fn least_mass(damping_kg_per_s: f64, stiffness_n_per_m: f64, interval_s: f64) -> f64 {
    let decays = damping_kg_per_s * interval_s / DECAYS_OF_A_STEP;
    let turns = stiffness_n_per_m * (interval_s / RADIANS_OF_A_STEP).powi(2);
    decays.max(turns)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::{Cases, Tally};
    use crate::tests::made_up::on_machine;
    use snug_campaign::Quantity;
    use snug_identify::FitTask;
    use snug_model::Scale;

    const SCALE: Scale = Scale::Rig {
        torque_nm: 1.0,
        angle_rad: 1.0,
        time_s: 1.0,
    };

    /// m, c, k of two recordings that were to begin with `base`, of one machine or of several; what is `held` is not begun with.
    fn begun(
        interval_s: f64,
        base: [f64; 3],
        is_one_machine: bool,
        held: Option<usize>,
    ) -> Vec<Vec<f64>> {
        let signal = || -> Vec<f64> { (0..4000).map(|k| f64::from(k).sin()).collect() };
        let of = |_| {
            let quantity = Quantity::Displacement;
            let mut case = on_machine(SCALE, interval_s, signal(), quantity, signal());
            if let Some(index) = held {
                let parameter = &mut case.model.to_mut().parameters_mut()[index];
                (parameter.value, parameter.fixed) = (base[index], true);
            }
            case
        };
        let cases: Vec<FitTask<'_>> = (0..2).map(of).collect();
        let tally = Tally::default();
        let all = Cases::new(&cases, &tally);
        let all = match is_one_machine {
            true => all,
            false => all.each_its_own(),
        };
        assert_eq!(all.are_of_one_machine(), is_one_machine);
        let pooled = PooledModel::new(all, &[]).expect("a base model");
        let mut start = pooled.usual_start();
        for (size, value) in pooled.shared.iter().zip(&mut start.shared) {
            *value = base[size.index];
        }
        for own in &mut start.own {
            for (&index, value) in pooled.own.iter().zip(own) {
                *value = base[index];
            }
        }
        values_at(&pooled, &simulable(&pooled, start))
    }

    #[test]
    fn a_mass_that_decays_within_a_sample_is_raised_and_no_other() {
        for is_one_machine in [true, false] {
            for values in begun(1.0, [1e-6, 400.0, 0.8], is_one_machine, None) {
                assert!(400.0 / values[0] < 2.0, "{values:?}");
                assert_eq!(values[1..], [400.0, 0.8]);
            }
            let heavy = [1e4, 400.0, 0.8];
            for values in begun(1.0, heavy, is_one_machine, None) {
                assert_eq!(values, heavy);
            }
            for values in begun(0.01, [1e-6, 0.0, 9e4], is_one_machine, None) {
                assert!((9e4 / values[0]).sqrt() * 0.01 < 2.0, "{values:?}");
            }
        }
    }

    /// What the study holds counts, and is not changed.
    #[test]
    fn a_damping_that_is_held_raises_the_mass_and_a_mass_that_is_held_stays() {
        let base = [1e-6, 400.0, 0.8];
        for values in begun(1.0, base, true, Some(DAMPING)) {
            assert!(400.0 / values[0] < 2.0, "{values:?}");
        }
        for values in begun(1.0, base, true, Some(MASS)) {
            assert_eq!(values, base);
        }
    }
}
