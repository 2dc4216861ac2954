//! One recording's equation of motion, averaged at places all along it.
//!
//! Acceleration, velocity and angle come of the fitted output alone, as the fit sees it: by parts what would have to be
//! differentiated, by a sum what would have to be integrated once. What is measured as an acceleration would drift if it were
//! integrated twice, so that its whole equation is differentiated twice by parts instead.

use crate::equation_error::modulation::{CubicWeights, Modulation, integral};
use crate::equation_error::thresholds::{
    AT_REST, LEAST_OF_MOTION, MOSTLY, MOTION_FINER, PARTS_OF_A_HALF, PLACES_PER_HALF,
};
use crate::residual::local_cubic::cubic_at;
use crate::task::FitTask;
use snug_campaign::Quantity;
use snug_least_squares::matrix::dot;
use snug_model::{GivenMotion, Model};
use snug_signal::without_trend;

/// The averages of one recording.
#[derive(Debug, Clone)]
pub struct AveragedRecord {
    /// α \[rad/s²\] at every place, ...
    pub acceleration: Vec<f64>,
    /// ... ω \[rad/s\], ...
    pub velocity: Vec<f64>,
    /// ... θ \[rad\] ...
    pub angle: Vec<f64>,
    /// ... and T \[Nm\]; all four twice differentiated where an acceleration was measured.
    pub torque: Vec<f64>,
    /// Places by which two averages are apart that share no sample.
    pub apart: usize,
    /// Averages that share no sample.
    pub independent: usize,
    /// Samples between the instants at which laws are asked.
    stride: usize,
    /// Their motion.
    angle_rad: Vec<f64>,
    velocity_rad_per_s: Vec<f64>,
    /// First of these instants of every place.
    places: Vec<usize>,
    /// What averages what acts at these instants.
    weights: Vec<f64>,
}

impl AveragedRecord {
    /// Averages over `half_width` samples to either side, at no more than about `most` places; at none where the recording is too short or
    /// the rig rests.
    pub fn of(task: &FitTask<'_>, half_width: usize, most: usize) -> Self {
        let interval_s = task.tightening.time_base.interval_s;
        let (measured, torque_nm) = (task.measured(), &task.tightening.torque_nm);
        let stride = (half_width / PARTS_OF_A_HALF).max(1);
        let least = (half_width / PLACES_PER_HALF).max(stride);
        let hop = (measured.len() / most.max(1)).div_ceil(least).max(1) * least;
        let fine = Modulation::new(half_width, interval_s);
        let length = fine.of_value.len();
        let first = task.unscored().div_ceil(stride) * stride;
        let end = measured.len().min(torque_nm.len());
        let half_width_of_motion = (half_width / MOTION_FINER).max(LEAST_OF_MOTION);
        let [angle_rad, velocity_rad_per_s] = motion(task, stride, half_width_of_motion);
        let mut starts: Vec<usize> = (first..(end + 1).saturating_sub(length))
            .step_by(hop)
            .collect();
        leave_out_rests(
            &mut starts,
            stride,
            &velocity_rad_per_s,
            length.div_ceil(stride),
        );
        let mean = |signal: &[f64], weight: &[f64]| -> Vec<f64> {
            let at = |&start: &usize| dot(&signal[start..start + length], weight);
            starts.iter().map(at).collect()
        };
        let acting = acting(task);
        let [of_value, of_slope, of_curvature] =
            [&fine.of_value, &fine.of_slope, &fine.of_curvature].map(Vec::as_slice);
        let quantity = task.quantity();
        let [acceleration, velocity, angle] = match quantity {
            Quantity::Displacement => {
                [of_curvature, of_slope, of_value].map(|weight| mean(measured, weight))
            }
            Quantity::Velocity => [
                mean(measured, of_slope),
                mean(measured, of_value),
                mean(&integral(measured, interval_s), of_value),
            ],
            Quantity::Acceleration => {
                [of_curvature, of_slope, of_value].map(|weight| mean(measured, weight))
            }
        };
        let coarse = Modulation::new(half_width / stride, interval_s * stride as f64);
        let is_differentiated = quantity == Quantity::Acceleration;
        let (of_torque, weights) = match is_differentiated {
            true => (of_curvature, coarse.of_curvature),
            false => (of_value, coarse.of_value),
        };
        Self {
            torque: mean(&acting, of_torque),
            acceleration,
            velocity,
            angle,
            apart: (2 * (half_width + half_width_of_motion) + 1).div_ceil(hop),
            independent: starts.len() * hop / length,
            stride,
            angle_rad,
            velocity_rad_per_s,
            places: starts.iter().map(|start| start / stride).collect(),
            weights,
        }
    }

    /// What acts along the measured motion beside the torque of the base model \[Nm\]: T − l F of `model` without the torque,
    /// averaged as the torque is. `None` where that is not finite.
    pub fn acting(&self, task: &FitTask<'_>, model: &Model, values: &[f64]) -> Option<Vec<f64>> {
        let motion = GivenMotion {
            stride: self.stride,
            angle_rad: &self.angle_rad,
            velocity_rad_per_s: &self.velocity_rad_per_s,
        };
        let net_nm = model.net_torque_along(values, &task.input, &motion).ok()?;
        let length = self.weights.len();
        let at = |&place: &usize| dot(&net_nm[place..place + length], &self.weights);
        let means: Vec<f64> = self.places.iter().map(at).collect();
        means.iter().all(|mean| mean.is_finite()).then_some(means)
    }

    /// Where in the recording each place is, from −1 at the first to 1 at the last.
    pub fn times(&self) -> impl Iterator<Item = f64> {
        let first = self.places.first().copied().unwrap_or_default();
        let span = self.places.last().map_or(0, |last| last - first).max(1);
        let time = move |&place: &usize| 2.0 * (place - first) as f64 / span as f64 - 1.0;
        self.places.iter().map(time)
    }

    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Number of places.
    pub fn len(&self) -> usize {
        self.places.len()
    }
}

/// Leaves out averages over so many instants, a `stride` of samples apart, of which the rig rests for a good part. Dry friction then
/// holds whatever it is asked to, and a velocity that is nothing but noise says neither how much nor which way.
fn leave_out_rests(starts: &mut Vec<usize>, stride: usize, velocity: &[f64], instants: usize) {
    let square = dot(velocity, velocity) / velocity.len() as f64;
    let least = AT_REST * square.sqrt();
    starts.retain(|start| {
        let some = velocity[start / stride..].iter().take(instants);
        let moving = some.filter(|velocity| velocity.abs() > least).count();
        moving as f64 > MOSTLY * instants as f64
    });
}

/// The torque that acts at the samples: of one that is held from sample to sample, the mean of before and after.
fn acting(task: &FitTask<'_>) -> Vec<f64> {
    let torque_nm = &task.tightening.torque_nm;
    match (task.input.held(), torque_nm.first()) {
        (true, Some(&first)) => {
            let before = std::iter::once(first).chain(torque_nm.iter().copied());
            let pairs = before.zip(torque_nm);
            pairs
                .map(|(before, after)| 0.5 * (before + after))
                .collect()
        }
        _ => torque_nm.clone(),
    }
}

/// Angle and velocity at every `stride`-th sample, those of cubics over `half_width` samples to either side.
fn motion(task: &FitTask<'_>, stride: usize, half_width: usize) -> [Vec<f64>; 2] {
    let interval_s = task.tightening.time_base.interval_s;
    let measured = task.measured();
    let smoothed = |signal: &[f64]| smoothed(signal, interval_s, stride, half_width);
    match task.quantity() {
        Quantity::Displacement => smoothed(measured),
        Quantity::Velocity => {
            let angle = integral(measured, interval_s);
            let [velocity, _] = smoothed(measured);
            [angle.into_iter().step_by(stride).collect(), velocity]
        }
        Quantity::Acceleration => {
            let velocity = without_trend(integral(measured, interval_s));
            let angle = without_trend(integral(&velocity, interval_s));
            [angle, velocity].map(|signal| signal.into_iter().step_by(stride).collect())
        }
    }
}

/// Value and rate of a signal at every `stride`-th sample, those of cubics over `half_width` samples to either side, as far as
/// there are.
fn smoothed(signal: &[f64], interval_s: f64, stride: usize, half_width: usize) -> [Vec<f64>; 2] {
    let weights = CubicWeights::new(half_width);
    let (length, count) = (weights.of_value.len(), signal.len());
    let at = |place: usize| -> [f64; 2] {
        if place >= half_width && place + half_width < count {
            let some = &signal[place - half_width..][..length];
            return [
                dot(some, &weights.of_value),
                dot(some, &weights.of_slope) / interval_s,
            ];
        }
        let from = place.saturating_sub(half_width);
        let some = &signal[from..(place + half_width + 1).min(count)];
        cubic_at(some, interval_s, place - from)
    };
    let both: Vec<[f64; 2]> = (0..count).step_by(stride).map(at).collect();
    [0, 1].map(|index| both.iter().map(|one| one[index]).collect())
}
