//! What a force along the measured way changes of the fitted output, beside what the model leaves of it.
//!
//! To first order, and of mass, damping and spring alone: I α + C ω + K θ = −l F from rest, or from every restart, by the trapezoidal rule. No
//! derivative of what was measured is needed, so that a weak wave shows in little noise; where a model has gone far astray a balance of
//! torques shows it better.

use snug_campaign::Quantity;
use snug_identify::FitTask;
use snug_model::Effect;

/// Of the first samples of one tightening.
pub(super) struct Response {
    inertia_kg_m2: f64,
    damping_nm_s: f64,
    stiffness_nm: f64,
    interval_s: f64,
    quantity: Quantity,
    restarted_after: Option<usize>,
    /// First sample that is scored.
    first: usize,
    /// Measured less simulated, in the output's unit.
    pub left: Vec<f64>,
}

impl Response {
    /// Of no more than `most` samples, beside a model of these `effects` and `values`; `None` where it cannot be simulated.
    pub fn of(case: &FitTask<'_>, effects: &[Effect], values: &[f64], most: usize) -> Option<Self> {
        let model = case.model_with(effects).ok()?;
        let simulated = case.simulated(&model, values).ok()?;
        let first = case.unscored();
        let pairs = case.measured().iter().zip(&simulated).skip(first);
        let left: Vec<f64> = pairs.map(|(y, s)| y - s).take(most).collect();
        let rig = case.model.rig();
        let (&[mass_kg, damping, stiffness], lever_m2) =
            (values.first_chunk::<3>()?, rig.lever_arm_m.powi(2));
        let is_known = !left.is_empty() && left.iter().all(|value| value.is_finite());
        is_known.then_some(Self {
            inertia_kg_m2: rig.known_inertia_kg_m2 + mass_kg * lever_m2,
            damping_nm_s: damping * lever_m2,
            stiffness_nm: stiffness * lever_m2,
            interval_s: case.tightening.time_base.interval_s,
            quantity: case.quantity(),
            restarted_after: case.input.samples_between_restarts(),
            first,
            left,
        })
    }

    /// What a force \[N\] at every sample adds to the output.
    pub fn of_force(&self, force_n: &[f64], lever_arm_m: f64) -> Vec<f64> {
        let half_s = 0.5 * self.interval_s;
        let (damping, stiffness) = (
            self.damping_nm_s / self.inertia_kg_m2,
            self.stiffness_nm / self.inertia_kg_m2,
        );
        let per_change = 1.0 / (1.0 + half_s * damping + half_s * half_s * stiffness);
        let (mut angle, mut velocity, mut acceleration) = (0.0, 0.0, 0.0);
        let end = self.first + self.left.len();
        let mut output = Vec::with_capacity(self.left.len());
        for (sample, force) in force_n.iter().take(end).enumerate() {
            let pushed = -lever_arm_m * force / self.inertia_kg_m2;
            let begins = sample == 0 || self.restarted_after.is_some_and(|all| sample % all == 0);
            if begins {
                (angle, velocity, acceleration) = (0.0, 0.0, pushed);
            } else {
                let half_way = velocity + half_s * acceleration;
                let held = stiffness * (angle + half_s * velocity);
                let next = per_change * (half_way + half_s * (pushed - held));
                angle += half_s * (velocity + next);
                velocity = next;
                acceleration = pushed - damping * velocity - stiffness * angle;
            }
            if sample >= self.first {
                output.push(match self.quantity {
                    Quantity::Displacement => angle,
                    Quantity::Velocity => velocity,
                    Quantity::Acceleration => acceleration,
                });
            }
        }
        output
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::close;

    /// A mass on a spring that is pushed from rest with a force that stays: θ = −l F / K (1 − cos ω t), from the last restart on.
    #[test]
    fn a_force_that_stays_swings_it_about_where_it_rests() {
        let response = Response {
            inertia_kg_m2: 0.5,
            damping_nm_s: 0.0,
            stiffness_nm: 200.0,
            interval_s: 1e-3,
            quantity: Quantity::Displacement,
            restarted_after: Some(300),
            first: 10,
            left: vec![0.0; 490],
        };
        let angle_rad = response.of_force(&[2.0; 500], 0.3);
        assert_eq!(angle_rad.len(), 490);
        for sample in [10, 150, 299, 300, 450] {
            let since_s = 1e-3 * f64::from(sample % 300);
            let expected = -0.3 * 2.0 / 200.0 * (1.0 - (20.0 * since_s).cos());
            close(angle_rad[sample as usize - 10] + 1.0, expected + 1.0, 1e-6);
        }
    }
}
