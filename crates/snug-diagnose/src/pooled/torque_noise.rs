//! What the noise of the logged torque does to the simulated output.
//!
//! The tool follows the torque that acts, the model the one that is logged, noise and all: what that noise makes of the
//! simulated output is in every residual. A lag or a smoothing delay takes it out and fits better although nothing lags.
//! Models are therefore compared by what their residual holds beyond it.

mod pull;

use crate::data::clusters::Clusters;
use crate::data::simulation::Asked;
use crate::data::thresholds::SIMULATED_TOGETHER;
use crate::pooled::model::PooledModel;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use snug_least_squares::matrix::inner_product as dot;
use snug_model::Input;
use snug_signal::white_noise_level;

/// Expected Σ r² of each cluster of every member from torque noise alone, the models at `values`; from one drawn noise, the
/// same for every model.
pub(crate) fn passed_on(
    pooled: &PooledModel<'_>,
    values: &[Vec<f64>],
    clusters: &Clusters,
) -> Vec<f64> {
    let members = 0..values.len();
    if !pooled.is_weighted() {
        // Without a known noise nothing is compared with it; and a signal of another rig need not be straight.
        return vec![0.0; clusters.per_case * values.len()];
    }
    let mut passed_on = Vec::new();
    for some in members.collect::<Vec<_>>().chunks(SIMULATED_TOGETHER) {
        let noisy: Vec<Input> = some.iter().map(|&m| noisy(pooled, m)).collect();
        let with = some.iter().zip(&noisy).map(|(&member, input)| Asked {
            member,
            input,
            values: &values[member],
        });
        let without = some.iter().map(|&member| Asked {
            member,
            input: &pooled.cases[member].input,
            values: &values[member],
        });
        let mut change = pooled.outputs(&with.collect::<Vec<_>>());
        let plain = pooled.outputs(&without.collect::<Vec<_>>());
        for ((&member, change), plain) in some.iter().zip(&mut change).zip(plain) {
            change
                .iter_mut()
                .zip(plain)
                .for_each(|(with, without)| *with -= without);
            let weighted = pooled.weigh_signal(member, change);
            let ranges = clusters.ranges(weighted.len());
            passed_on.extend(ranges.map(|range| dot(&weighted[range.clone()], &weighted[range])));
        }
    }
    passed_on
}

/// A member's torque with as much noise again as it has.
fn noisy(pooled: &PooledModel<'_>, member: usize) -> Input {
    let case = &pooled.cases[member];
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
    use crate::data::cases::{Cases, Tally};
    use crate::tests::made_up::{NOISE, RIG, SAMPLES, WHOLE, close, exact, hand};
    use snug_identify::FitTask;

    /// What torque noise of this standard deviation makes of a tool that is held as tightening 0 is.
    fn passed_on_of(
        torque_noise_nm: f64,
        clusters: Clusters,
        change: impl Fn(&mut FitTask<'_>),
    ) -> Vec<f64> {
        let mut case = exact(0, &[], &[]);
        let mut random = ChaCha8Rng::seed_from_u64(7);
        for torque in &mut case.tightening.to_mut().torque_nm {
            let draw: f64 = StandardNormal.sample(&mut random);
            *torque = torque_noise_nm * draw;
        }
        change(&mut case);
        let (cases, tally) = ([case], Tally::default());
        let pooled = PooledModel::new(Cases::new(&cases, &tally), &[]);
        let pooled = pooled.expect("the base model is one");
        passed_on(&pooled, &[hand(0).to_vec()], &clusters)
    }

    /// At single samples the acceleration is (T − l F) / (I_n + m l²), and F, of the velocity, hardly moves within one. The
    /// χ² of 250 samples scatters by 9 %, the level from their median by 7 %, which counts twice.
    #[test]
    fn torque_noise_reaches_the_acceleration_through_the_inertia() {
        let inertia_kg_m2 = RIG.known_inertia_kg_m2 + hand(0)[0] * RIG.lever_arm_m.powi(2);
        let expected = SAMPLES as f64 * (0.2 / (inertia_kg_m2 * NOISE)).powi(2);
        let found = passed_on_of(0.2, WHOLE, |_| {})[0];
        close(found, expected, 0.5);
        close(passed_on_of(0.4, WHOLE, |_| {})[0], 4.0 * found, 1e-9);
    }

    #[test]
    fn stretches_share_out_what_reaches_their_tightening() {
        let whole = passed_on_of(0.2, WHOLE, |_| {})[0];
        let stretches = passed_on_of(0.2, Clusters { per_case: 5 }, |_| {});
        assert_eq!(stretches.len(), 5);
        close(stretches.iter().sum(), whole, 1e-12);
    }

    #[test]
    fn nothing_is_taken_off_where_the_noise_of_the_residual_is_not_known() {
        let unknown = passed_on_of(0.2, Clusters { per_case: 5 }, |case| {
            case.tightening.to_mut().noise = None
        });
        assert_eq!(unknown, [0.0; 5]);
    }

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
