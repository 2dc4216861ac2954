//! The balance of torques of one tightening, from what was measured: no simulation is needed.
//!
//! I α + C ω + K θ + l F = T is averaged with a smooth weight φ that is 0 at both ends, so that what was not measured comes of what was
//! by parts (∫ φ α = −∫ φ' ω = ∫ φ'' θ). What a model explains is projected out of the torque.

use crate::ranking::thresholds::ROUNDING;
use snug_identify::Modulation;
use snug_least_squares::matrix::inner_product as dot;

/// The signals of one tightening, in SI units.
pub(super) struct Measured<'a> {
    pub torque_nm: &'a [f64],
    pub angle: &'a [f64],
    pub velocity: Option<&'a [f64]>,
    pub acceleration: Option<&'a [f64]>,
    /// First sample that is scored.
    pub first: usize,
    pub interval_s: f64,
}

impl Measured<'_> {
    /// Behind the last sample of which torque and angle are known.
    pub fn end(&self) -> usize {
        self.angle.len().min(self.torque_nm.len())
    }
}

/// The balance of torques of one tightening, averaged here and there.
pub(super) struct Balance {
    weights: Modulation,
    /// First sample of every place.
    places: Vec<usize>,
    /// Orthonormal: what the model may explain.
    explained: Vec<Vec<f64>>,
    /// What that leaves of the torque \[Nm\].
    pub left_nm: Vec<f64>,
}

impl Balance {
    /// At no more than `most` places.
    pub fn of(measured: &Measured<'_>, half_width: usize, most: usize) -> Option<Self> {
        let weights = Modulation::new(half_width, measured.interval_s);
        let &Measured {
            torque_nm,
            angle,
            velocity,
            acceleration,
            ..
        } = measured;
        let length = weights.of_value.len();
        let hop = (2 * half_width / 3).max(1);
        let is_known = |place: &usize| {
            let of = |signal: &[f64]| {
                signal[*place..*place + length]
                    .iter()
                    .all(|v| v.is_finite())
            };
            of(angle) && velocity.is_none_or(of) && acceleration.is_none_or(of)
        };
        let places: Vec<usize> = (measured.first..(measured.end() + 1).saturating_sub(length))
            .step_by(hop)
            .filter(is_known)
            .take(most)
            .collect();
        let mean = |signal: &[f64], weight: &[f64]| -> Vec<f64> {
            let at = |&place: &usize| dot(&signal[place..place + length], weight);
            places.iter().map(at).collect()
        };
        let of_velocity = match velocity {
            Some(velocity) => mean(velocity, &weights.of_value),
            None => mean(angle, &weights.of_slope),
        };
        let of_acceleration = match (acceleration, velocity) {
            (Some(acceleration), _) => mean(acceleration, &weights.of_value),
            (None, Some(velocity)) => mean(velocity, &weights.of_slope),
            (None, None) => mean(angle, &weights.of_curvature),
        };
        let of_angle = mean(angle, &weights.of_value);
        let left_nm = mean(torque_nm, &weights.of_value);
        let smooth = smooth([of_angle, of_velocity, of_acceleration]);
        let mut balance = Self {
            weights,
            places,
            explained: Vec::new(),
            left_nm,
        };
        balance.explain_away(smooth);
        (!balance.places.is_empty()).then_some(balance)
    }

    /// Takes up what the model may explain: these columns, as far as they are new.
    pub fn explain_away(&mut self, columns: impl IntoIterator<Item = Vec<f64>>) {
        for mut column in columns {
            let length = dot(&column, &column);
            self.project(&mut column);
            let rest = dot(&column, &column);
            if rest > ROUNDING * length {
                column.iter_mut().for_each(|value| *value /= rest.sqrt());
                let share = dot(&column, &self.left_nm);
                let left = self.left_nm.iter_mut().zip(&column);
                left.for_each(|(left, known)| *left -= share * known);
                self.explained.push(column);
            }
        }
    }

    /// The torque \[Nm\] of a force, averaged, without what every model may explain.
    pub fn of_force(&self, force_n: &[f64], lever_arm_m: f64) -> Vec<f64> {
        let weight = &self.weights.of_value;
        let mean =
            |&place: &usize| lever_arm_m * dot(&force_n[place..place + weight.len()], weight);
        let mut column: Vec<f64> = self.places.iter().map(mean).collect();
        self.project(&mut column);
        column
    }

    fn project(&self, column: &mut [f64]) {
        for known in &self.explained {
            let share = dot(known, column);
            for (value, known) in column.iter_mut().zip(known) {
                *value -= share * known;
            }
        }
    }
}

/// What every model may explain of a motion with these angles, velocities and accelerations: the base model's terms, and what
/// friction and springs of a simple shape add.
fn smooth([angle, velocity, acceleration]: [Vec<f64>; 3]) -> [Vec<f64>; 8] {
    let of_each = |f: &dyn Fn(f64) -> f64, values: &[f64]| -> Vec<f64> {
        values.iter().map(|&value| f(value)).collect()
    };
    [
        of_each(&|_| 1.0, &angle),
        of_each(&f64::signum, &velocity),
        of_each(&f64::abs, &velocity),
        of_each(&|a| a * a, &angle),
        of_each(&|a| a * a * a, &angle),
        acceleration,
        velocity,
        angle,
    ]
}
