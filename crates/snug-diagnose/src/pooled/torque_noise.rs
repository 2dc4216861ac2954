//! What the noise of the logged torque does to the simulated output.
//!
//! The tool follows the torque that acts, the model the one that is logged, noise and all: what that noise makes of the
//! simulated output is in every residual. A lag or a smoothing delay takes it out and fits better although nothing lags.
//! Models are therefore compared by what their residual holds beyond it.

use crate::data::clusters::Units;
use crate::data::simulation::Asked;
use crate::pooled::model::Hypothesis;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use snug_least_squares::matrix::inner_product as dot;
use snug_model::Input;
use snug_signal::white_noise_level;

/// Expected Σ r² of each unit of every member from torque noise alone, the models at `values`; from one drawn noise, the
/// same for every model.
pub(crate) fn passed_on(
    hypothesis: &Hypothesis<'_>,
    values: &[Vec<f64>],
    units: &Units,
) -> Vec<f64> {
    let members = 0..values.len();
    if !hypothesis.is_weighted() {
        // Without a known noise nothing is compared with it; and a signal of another rig need not be straight.
        return vec![0.0; units.per_case * values.len()];
    }
    let mut passed_on = Vec::new();
    for some in members.collect::<Vec<_>>().chunks(TOGETHER) {
        let noisy: Vec<Input> = some.iter().map(|&m| noisy(hypothesis, m)).collect();
        let with = some.iter().zip(&noisy).map(|(&member, input)| Asked {
            member,
            input,
            values: &values[member],
        });
        let without = some.iter().map(|&member| Asked {
            member,
            input: &hypothesis.cases[member].input,
            values: &values[member],
        });
        let mut change = hypothesis.outputs(&with.collect::<Vec<_>>());
        let plain = hypothesis.outputs(&without.collect::<Vec<_>>());
        for ((&member, change), plain) in some.iter().zip(&mut change).zip(plain) {
            change
                .iter_mut()
                .zip(plain)
                .for_each(|(with, without)| *with -= without);
            let weighted = hypothesis.weigh_signal(member, change);
            let ranges = units.ranges(weighted.len());
            passed_on.extend(ranges.map(|range| dot(&weighted[range.clone()], &weighted[range])));
        }
    }
    passed_on
}

/// How many members are simulated together, which bounds the memory.
const TOGETHER: usize = 8;

/// A member's torque with as much noise again as it has.
fn noisy(hypothesis: &Hypothesis<'_>, member: usize) -> Input {
    let case = &hypothesis.cases[member];
    let level = white_noise_level(&case.tightening.torque_nm);
    let mut random = ChaCha8Rng::seed_from_u64(0);
    random.set_stream(member as u64);
    let noise: Vec<f64> = (0..case.tightening.torque_nm.len())
        .map(|_| {
            let draw: f64 = StandardNormal.sample(&mut random);
            level * draw
        })
        .collect();
    case.input.with_added(&noise)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_noise_of_a_pulse_is_measured_where_it_is_straight() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let signal: Vec<f64> = (0..5000)
            .map(|i| {
                let pulse = (300 - (i as i64 - 1000).abs()).max(0) as f64 * 0.05;
                let draw: f64 = StandardNormal.sample(&mut random);
                pulse + 0.02 * draw
            })
            .collect();
        let level = white_noise_level(&signal);
        assert!((level - 0.02).abs() < 0.001, "{level}");
    }
}
