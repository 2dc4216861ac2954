//! A start near the optimum: the equation of motion, integrated twice, is linear in m, c, k.
//!
//! From rest, with θ the measured angle and T the torque,
//!
//! ```text
//! l² (m θ + c ∫θ + k ∬θ) = ∬T − I_n θ
//! ```
//!
//! One regression over the samples is off by a per cent or so, because the noise is in θ on the left as well. A fit from
//! there takes about half the sweeps of one from anywhere.

use crate::dense::{chosen, chosen_square, solve_upper};
use crate::{Linearization, Subject};
use snug_campaign::{Parameter, ParameterSource, Quantity};
use snug_model::Input;

/// Values of the free parameters among m, c, k; `None` when a start was stated, without a measured displacement, or when
/// the regression has no sensible answer.
pub(crate) fn integral_start(subject: &Subject<'_>) -> Option<Vec<f64>> {
    let Subject {
        model,
        input,
        tightening,
    } = *subject;
    let parameters = model.parameters();
    let is_default = |p: &Parameter| p.fixed || p.source == ParameterSource::Default;
    let angle_rad = tightening.motion.get(Quantity::Displacement)?;
    if parameters.len() != 3 || !parameters.iter().all(is_default) {
        return None;
    }
    let (free, rig) = (model.free(), model.rig());
    let square = rig.lever_arm_m * rig.lever_arm_m;
    let known = |index: usize| match parameters[index].fixed {
        true => parameters[index].value,
        false => 0.0,
    };
    let [m, c, k] = [known(0), known(1), known(2)];
    let sums = Sums::over(angle_rad, input, |[angle, once, twice], torque| {
        torque - rig.known_inertia_kg_m2 * angle - square * (m * angle + c * once + k * twice)
    });
    let mut regression = Linearization::new(free.len());
    let gradient = sums.right.map(|right| -square * right);
    let matrix = (sums.products).map(|row| row.map(|product| square * square * product));
    let (gradient, matrix) = (chosen(&gradient, &free), chosen_square(&matrix, &free));
    (regression.set_normal_equations(0.0, &gradient, &matrix)).ok()?;
    let mut values: Vec<f64> = regression.reachable.iter().map(|q| -q).collect();
    solve_upper(&regression.factor, free.len(), &mut values);
    let is_sensible = |value: &f64| value.is_finite() && *value > 0.0;
    values.iter().all(is_sensible).then_some(values)
}

/// Every this many samples enter the regression: a start need not be better, and the integrals know them all.
const SCORED: usize = 8;

/// Inner products of (θ, ∫θ, ∬θ) with each other and with the right-hand side.
#[derive(Default)]
struct Sums {
    products: [[f64; 3]; 3],
    right: [f64; 3],
}

impl Sums {
    /// `right` gives the right-hand side from (θ, ∫θ, ∬θ) and ∬T; integrals are trapezoids.
    fn over(angle_rad: &[f64], input: &Input, right: impl Fn([f64; 3], f64) -> f64) -> Self {
        let half = 0.5 * input.grid_interval_s() * input.substeps() as f64;
        let torque_nm = input.grid_nm().iter().step_by(input.substeps());
        let mut sums = Self::default();
        let first = angle_rad.first().copied().unwrap_or(0.0);
        let first_torque = input.grid_nm().first().copied().unwrap_or(0.0);
        let (mut angle, mut once, mut twice) = (first, 0.0, 0.0);
        let (mut torque, mut impulse, mut drive) = (first_torque, 0.0, 0.0);
        let mut samples = angle_rad.iter().zip(torque_nm).skip(1);
        while samples.len() > 0 {
            for (&next, &next_torque) in samples.by_ref().take(SCORED) {
                let ahead = once + half * (angle + next);
                twice += half * (once + ahead);
                (angle, once) = (next, ahead);
                let ahead = impulse + half * (torque + next_torque);
                drive += half * (impulse + ahead);
                (torque, impulse) = (next_torque, ahead);
            }
            let motion = [angle, once, twice];
            sums.add(motion, right(motion, drive));
        }
        sums
    }

    fn add(&mut self, motion: [f64; 3], right: f64) {
        for i in 0..3 {
            self.right[i] += motion[i] * right;
            for j in 0..3 {
                self.products[i][j] += motion[i] * motion[j];
            }
        }
    }
}
