//! What the noise of the logged torque pulls at the sizes, and the sizes without it.
//!
//! The model simulates the logged torque, noise n and all, where the tool follows the torque that acts. The sum of squares therefore
//! holds P = Σ‖G n‖² beside what the data say, G from torque to whitened output, and is least where that is small, too: a lag takes noise
//! out, and comes out longer than it is. So do its curvatures S: a column of the Jacobian is noise as well as signal. Without both the
//! sum's least lies one Newton step from the optimum, Δα = (Σ S_i − N_i)⁻¹ Σ ½ ∂P_i/∂α, N_i = ∂(G n)ᵀ ∂(G n) over the shared sizes α and
//! each tightening's own parameters, which follow (corrected score: Nakamura 1990; for regressions Fuller 1987, 2.2). As much noise again
//! as the torque has says what P and N are.

use crate::data::cases::Cases;
use crate::data::simulation::{Asked, simulate};
use crate::data::thresholds::SIMULATED_TOGETHER;
use crate::error::DiagnoseError;
use crate::pooled::between::once;
use crate::pooled::fitted::evidence::{projected, slopes_of_own};
use crate::pooled::fitted::{Fitted, add_in};
use crate::pooled::model::{PooledModel, Room};
use crate::pooled::thresholds::STILL_KNOWN;
use crate::pooled::torque_noise::{noisy, passed_on};
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use snug_model::Input;

/// What one tightening says around the optimum without the torque's noise.
struct Quiet {
    /// ½ ∂P_i/∂α of its part of the shared sizes, its own parameters following.
    pull: Vec<f64>,
    /// Projected curvature S_i − N_i of these.
    curvature: SymmetricMatrix,
    /// How its own parameters follow each of these: −∂β_i/∂α, one row for each size.
    slopes: Vec<Vec<f64>>,
}

impl Fitted {
    /// The fit with its sizes where they are least without the torque's noise, and with intervals as wide as what is then known of them; as it
    /// is where hardly anything is, where the noise of the residual or the torque is not known, of long records, and where nothing is shared.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn without_torque_noise(&self, cases: Cases<'_>) -> Result<Self, DiagnoseError> {
        let mut without = self.clone();
        let has_noise = self.torque_noise.iter().any(|&squares| squares > 0.0);
        if self.shared.is_empty() || self.are_stretches() || !has_noise {
            return Ok(without);
        }
        let pooled = PooledModel::shared_by(cases, &self.effects, &self.sharing)?;
        let Some(quiet) = quiet(&pooled, self) else {
            return Ok(without);
        };
        let mut pull = vec![0.0; self.shared.len()];
        let mut curvature = SymmetricMatrix::zero(self.shared.len());
        for (places, one) in self.shared_of.iter().zip(&quiet) {
            for (&place, value) in places.iter().zip(&one.pull) {
                pull[place] += value;
            }
            add_in(&mut curvature, &one.curvature, places);
        }
        if !is_still_known(&self.shared_curvature(), &curvature) {
            return Ok(without);
        }
        let Some(step) = curvature.solve_scaled(&pull) else {
            return Ok(without);
        };
        without.take_step(&pooled, quiet, &step);
        Ok(without)
    }

    /// Shared sizes by `step`, within what they may be, and all that follows.
    fn take_step(&mut self, pooled: &PooledModel<'_>, quiet: Vec<Quiet>, step: &[f64]) {
        let parameters = pooled.models[0].parameters();
        let mut moved = vec![0.0; step.len()];
        for (place, size) in self.shared_sizes.iter().enumerate() {
            let of = &parameters[size.index];
            let (least, most, value) = (of.minimum, of.maximum, &mut self.shared[place]);
            // A bound that holds, holds.
            if *value > least && *value < most {
                let now = (*value + step[place]).clamp(least, most);
                moved[place] = now - std::mem::replace(value, now);
            }
        }
        for (member, quiet) in quiet.into_iter().enumerate() {
            let places = self.shared_of[member].iter();
            let part: Vec<f64> = places.map(|&place| moved[place]).collect();
            for (row, step) in quiet.slopes.iter().zip(&part) {
                let own = self.own[member].iter_mut().zip(&pooled.own);
                for ((value, &index), slope) in own.zip(row) {
                    let of = &pooled.models[member].parameters()[index];
                    *value = (*value - slope * step).clamp(of.minimum, of.maximum);
                }
            }
            let (curvature, gradient) = &mut self.profiles[member];
            let block = &mut self.blocks[member];
            block.squares += 2.0 * dot(gradient, &part) + curvature.quadratic(&part);
            *curvature = quiet.curvature;
            for (place, slope) in gradient.iter_mut().enumerate() {
                let bent: f64 = (part.iter().enumerate())
                    .map(|(beside, step)| curvature.at(place, beside) * step)
                    .sum();
                *slope += bent - quiet.pull[place];
            }
            block.gradient.clone_from(gradient);
            block.curvature.clone_from(curvature);
        }
        let values: Vec<Vec<f64>> = (self.own.iter().enumerate())
            .map(|(member, own)| pooled.values(member, own, &self.shared))
            .collect();
        self.torque_noise = passed_on(pooled, &values, &self.clusters);
    }
}

/// Whether every size that the tightenings know with the noise is known well enough without it. Where an instant of contact moves with
/// the noise, its derivative is no small change.
fn is_still_known(with: &SymmetricMatrix, without: &SymmetricMatrix) -> bool {
    let (Some(known), Some(left)) = (with.inverse(), without.inverse()) else {
        return false;
    };
    (0..with.size()).all(|place| {
        let (before, after) = (known.at(place, place), left.at(place, place));
        before <= 0.0 || (after > 0.0 && before > STILL_KNOWN * after)
    })
}

/// Of every tightening; `None` where one knows nothing of a parameter of its own.
fn quiet(pooled: &PooledModel<'_>, fitted: &Fitted) -> Option<Vec<Quiet>> {
    let order = pooled.order();
    let values: Vec<Vec<f64>> = (fitted.own.iter().enumerate())
        .map(|(member, own)| pooled.values(member, own, &fitted.shared))
        .collect();
    let members: Vec<usize> = (0..values.len()).collect();
    let mut room = Room::default();
    let mut all = Vec::new();
    for some in members.chunks(SIMULATED_TOGETHER) {
        let noisy: Vec<Input> = some.iter().map(|&member| noisy(pooled, member)).collect();
        let with = some.iter().copied().zip(&noisy);
        let without = some
            .iter()
            .map(|&member| (member, &*pooled.cases[member].input));
        let asked: Vec<Asked<'_>> = (without.chain(with))
            .map(|(member, input)| Asked {
                member,
                input,
                values: &values[member],
            })
            .collect();
        simulate(
            &pooled.cases,
            &pooled.models,
            &asked,
            &once(&order),
            &mut room.simulated,
        );
        for (index, &member) in some.iter().enumerate() {
            let (residual, jacobian) = pooled.weigh_simulated(member, &order, index, &mut room);
            let (residual, jacobian) = (residual.to_vec(), jacobian.to_vec());
            let more = pooled.weigh_simulated(member, &order, index + some.len(), &mut room);
            all.push(without_noise(&residual, &jacobian, more, pooled.own.len())?);
        }
    }
    Some(all)
}

/// From a tightening's residual and Jacobian (column-major, its own parameters first), without and with as much noise again.
fn without_noise(
    residual: &[f64],
    jacobian: &[f64],
    (noisy, noisy_jacobian): (&mut [f64], &mut [f64]),
    own: usize,
) -> Option<Quiet> {
    let less = |with: &mut [f64], without: &[f64]| {
        with.iter_mut()
            .zip(without)
            .for_each(|(with, without)| *with -= without);
    };
    less(noisy, residual);
    less(noisy_jacobian, jacobian);
    let count = residual.len();
    let columns: Vec<&[f64]> = jacobian.chunks_exact(count).collect();
    let noise: Vec<&[f64]> = noisy_jacobian.chunks_exact(count).collect();
    let pull: Vec<f64> = noise.iter().map(|column| dot(column, noisy)).collect();
    let mut curvature = SymmetricMatrix::zero(columns.len());
    for i in 0..columns.len() {
        for j in 0..columns.len() {
            let known = dot(columns[i], columns[j]) - dot(noise[i], noise[j]);
            curvature.set(i, j, known);
        }
    }
    let slopes = slopes_of_own(&curvature, own)?;
    let (of_own, of_shared) = pull.split_at(own);
    let following = of_shared.iter().zip(&slopes);
    Some(Quiet {
        pull: following.map(|(g, slope)| g - dot(slope, of_own)).collect(),
        curvature: projected(&curvature, &slopes),
        slopes,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::Tally;
    use crate::pooled::fit::fit_effects;
    use crate::tests::made_up::{INTERVAL_S, NOISE, RIG, SAMPLES, WHOLE, exact, hand};
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};
    use snug_campaign::Intersample;
    use snug_identify::FitTask;
    use snug_model::Effect::{self, AccelerationLag, CubicStiffness};
    use snug_model::Model;
    use std::borrow::Cow;
    use std::f64::consts::PI;

    const TORQUE_NOISE_NM: f64 = 0.15;

    /// A soft pulse whose torque is written down with noise while the tool follows it without, and measured with noise as usual.
    fn soft(number: usize, effect: Effect, sizes: &[f64]) -> FitTask<'static> {
        let mut random = ChaCha8Rng::seed_from_u64(number as u64);
        let mut noise = |level: f64| {
            let draw: f64 = StandardNormal.sample(&mut random);
            level * draw
        };
        let peak_nm = 20.0 + 2.0 * number as f64;
        let acting_nm: Vec<f64> = (0..SAMPLES)
            .map(|k| peak_nm * (PI * k as f64 / SAMPLES as f64).sin().powi(2))
            .collect();
        let input = Input::new(&acting_nm, INTERVAL_S, Intersample::Linear);
        let truth = Model::new(RIG, &[effect]).expect("it goes alone");
        let mut motion = truth
            .simulate(&[&hand(number), sizes].concat(), &input)
            .expect("as many values as parameters");
        let measured = motion.acceleration_rad_per_s2.iter_mut().flatten();
        measured.for_each(|value| *value += noise(NOISE));
        let logged_nm: Vec<f64> = acting_nm
            .iter()
            .map(|torque| torque + noise(TORQUE_NOISE_NM))
            .collect();
        let mut case = exact(number, &[], &[]);
        case.input = Cow::Owned(Input::new(&logged_nm, INTERVAL_S, Intersample::Linear));
        let tightening = case.tightening.to_mut();
        (tightening.torque_nm, tightening.motion) = (logged_nm, motion);
        case
    }

    /// Size and standard error, as fitted and without the torque's noise.
    fn sizes(effect: Effect, size: &[f64]) -> [(f64, f64); 2] {
        let cases: Vec<FitTask<'_>> = (0..24).map(|number| soft(number, effect, size)).collect();
        let tally = Tally::default();
        let counted = Cases::new(&cases, &tally);
        let fitted = fit_effects(counted, &[effect], None, WHOLE).expect("it can be fitted");
        let without = fitted
            .without_torque_noise(counted)
            .expect("it can be simulated");
        [fitted, without].map(|fitted| {
            let errors = fitted.shared_errors().expect("all is known");
            (fitted.shared[0], errors[0])
        })
    }

    #[test]
    fn a_lag_that_is_not_there_is_none_without_the_noise_that_it_would_take_out() {
        let [(pulled, error), (size, wider)] = sizes(AccelerationLag, &[0.0]);
        assert!(pulled > 5.0 * error, "{pulled:e} {error:e}");
        assert!(wider > error && size < 3.0 * wider, "{size:e} {wider:e}");
    }

    #[test]
    fn a_lag_that_is_there_is_as_long_as_it_is() {
        let [(pulled, error), (size, wider)] = sizes(AccelerationLag, &[2e-3]);
        assert!(pulled - 2e-3 > 3.0 * error, "{pulled:e} {error:e}");
        assert!((size - 2e-3).abs() < 2.5 * wider, "{size:e} {wider:e}");
    }

    /// What noise moves, it moves on both sides of a spring that stiffens.
    #[test]
    fn a_spring_is_as_stiff_as_it_is() {
        let [(pulled, error), (size, wider)] = sizes(CubicStiffness, &[2e6]);
        assert!(pulled - 2e6 > 3.0 * error, "{pulled:e} {error:e}");
        assert!((size - 2e6).abs() < 2.5 * wider, "{size:e} {wider:e}");
    }
}
