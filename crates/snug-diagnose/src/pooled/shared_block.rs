//! What single tightenings say of sizes that all share, for programs that add it up over more tightenings than fit one machine.
//!
//! With the sizes α given, each tightening's own parameters β_i are fitted by themselves, and what is left is linearised over both:
//! cost, gradient and curvature of min over β_i of ½‖r_i(β_i, α)‖². Added up over all tightenings these are a Gauss–Newton step of
//! the pooled fit, whose optimum is where the gradients add up to nothing.

use crate::data::cases::{Cases, Tally};
use crate::error::DiagnoseError;
use crate::pooled::groups::nothing::Nothing;
use crate::pooled::model::PooledModel;
use crate::pooled::parameter_place::effect_of;
use snug_identify::{FitTask, identify_all};
use snug_least_squares::{Linearization, PooledResidual, Trial, profile_of};
use snug_model::{Effect, Law, Model};

/// What one tightening says of the shared sizes; p of them, in the order of [`shared_parameters`]. Squared residuals have no unit, or the
/// output's squared where the noise is not known; derivatives are by each size in the unit that its name says.
#[derive(Debug, Clone, PartialEq)]
pub struct SharedBlock {
    /// Whitened residuals.
    pub residuals: usize,
    /// Parameters of its own.
    pub own: usize,
    /// ½‖r_i‖² at the optimum of its own parameters.
    pub cost: f64,
    /// Of that optimum's cost over α, p.
    pub gradient: Vec<f64>,
    /// Likewise, p × p, column-major.
    pub curvature: Vec<f64>,
}

/// A size that tightenings share; its numbers are in the unit that its name says.
#[derive(Debug, Clone, PartialEq)]
pub struct SharedParameter {
    /// Its name, with unit suffix.
    pub name: String,
    /// Where it begins, in its unit.
    pub start: f64,
    /// The least it may be.
    pub minimum: f64,
    /// The most it may be.
    pub maximum: f64,
    /// Where there is nothing of it.
    pub nothing: Nothing,
}

/// The sizes that tightenings share in the model with these effects.
///
/// # Errors
/// What the model refuses.
pub fn shared_parameters(
    case: &FitTask<'_>,
    effects: &[Effect],
) -> Result<Vec<SharedParameter>, DiagnoseError> {
    let tally = Tally::default();
    let one = [case.lent()];
    let pooled = PooledModel::new(Cases::new(&one, &tally).each_its_own(), effects)?;
    let parameters = pooled.models[0].parameters();
    let described = pooled.common.iter().map(|&index| {
        let parameter = &parameters[index];
        let spec = effect_of(effects, index)
            .map(|(effect, offset)| effect.description().parameters[offset]);
        let limits = (parameter.minimum, parameter.maximum);
        SharedParameter {
            name: parameter.name.clone(),
            start: parameter.value,
            minimum: parameter.minimum,
            maximum: parameter.maximum,
            nothing: Nothing::of(spec.and_then(|spec| spec.vanishes_at), limits),
        }
    });
    Ok(described.collect())
}

/// What each tightening says of the shared sizes, which it has as `sizes` says; `None` where none of its own could be fitted beside
/// them. A tightening has the same bits whatever stands beside it.
///
/// # Errors
/// What the model refuses.
pub fn shared_blocks(
    cases: &[FitTask<'_>],
    effects: &[Effect],
    sizes: &[Vec<f64>],
) -> Result<Vec<Option<SharedBlock>>, DiagnoseError> {
    let tally = Tally::default();
    let mut pooled = PooledModel::new(Cases::new(cases, &tally).each_its_own(), effects)?;
    let owns = own_alone(&pooled, sizes);
    let parameters = pooled.order().len();
    let fitted: Vec<usize> = (0..cases.len())
        .filter(|&one| owns[one].is_some())
        .collect();
    let mut here: Vec<Linearization> = (fitted.iter())
        .map(|_| Linearization::new(parameters))
        .collect();
    let parameters_of = |member: usize| -> Vec<f64> {
        let own = owns[member].iter().flatten();
        own.chain(&sizes[member]).copied().collect()
    };
    let mut trials: Vec<Trial<'_>> = (fitted.iter().zip(&mut here))
        .map(|(&member, linearization)| Trial {
            parameters: parameters_of(member),
            member,
            linearization,
        })
        .collect();
    // One that has no finite value is left out below; the others are whole all the same.
    let _ = pooled.linearize(&mut trials);
    drop(trials);
    let mut blocks: Vec<Option<SharedBlock>> = vec![None; cases.len()];
    for (member, here) in fitted.into_iter().zip(here) {
        let own = owns[member].as_deref().unwrap_or_default();
        if !here.cost().is_finite() || !here.gradient().iter().all(|slope| slope.is_finite()) {
            continue;
        }
        let profile = profile_of(here, own, &pooled.own_sets[member]);
        let is_finite = (profile.gradient.iter().chain(&profile.curvature)).all(|x| x.is_finite());
        blocks[member] = is_finite.then_some(SharedBlock {
            residuals: pooled.residual_count(member),
            own: own.len(),
            cost: profile.cost,
            gradient: profile.gradient,
            curvature: profile.curvature,
        });
    }
    Ok(blocks)
}

/// Each tightening's own parameters, fitted from where they usually begin beside the sizes that it has.
fn own_alone(pooled: &PooledModel<'_>, sizes: &[Vec<f64>]) -> Vec<Option<Vec<f64>>> {
    let start = pooled.usual_start();
    let models: Vec<Model> = (start.own.iter().zip(sizes).enumerate())
        .map(|(member, (own, sizes))| pooled.held(member, own, sizes))
        .collect();
    let tasks: Vec<FitTask<'_>> = (pooled.cases.iter().zip(&models))
        .map(|(case, model)| case.with_model(model))
        .collect();
    let estimates = identify_all(&tasks).into_iter();
    let own = estimates.map(|estimate| {
        let found = estimate.ok()?.parameters;
        let values: Vec<f64> = pooled.own.iter().map(|&index| found[index].value).collect();
        values
            .iter()
            .all(|value| value.is_finite())
            .then_some(values)
    });
    own.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{exact, noisy};
    use snug_least_squares::PooledSettings;
    use snug_least_squares::matrix::SymmetricMatrix;
    use snug_model::Effect::{CubicStiffness, QuadraticDamping};

    const EFFECTS: [Effect; 2] = [CubicStiffness, QuadraticDamping];

    /// Ten tightenings, of which the last may be damped by no less than 90.2 kg/s, more than it is. There is a hundredth of the noise that
    /// they state, so that a fit that ends where costs differ by rounding knows the sizes to 10⁻⁹.
    fn cases() -> Vec<FitTask<'static>> {
        let sizes = [2e6, 150.0];
        let quiet = |number: usize| {
            let (mut case, loud) = (
                exact(number, &EFFECTS, &sizes),
                noisy(number, &EFFECTS, &sizes),
            );
            let noise = loud.measured().iter().zip(case.measured().to_vec());
            let noise: Vec<f64> = noise.map(|(noisy, exact)| 0.01 * (noisy - exact)).collect();
            let measured = &mut case.tightening.to_mut().motion.acceleration_rad_per_s2;
            let measured = measured.iter_mut().flatten();
            measured
                .zip(noise)
                .for_each(|(measured, noise)| *measured += noise);
            case
        };
        let mut cases: Vec<FitTask<'static>> = (0..10).map(quiet).collect();
        let damping = |model: &mut Model| model.parameters_mut()[1].minimum = 90.2;
        damping(cases[9].model.to_mut());
        cases
    }

    /// Gauss–Newton steps of the sum over tightenings, as many as it takes.
    fn added_up(cases: &[FitTask<'_>]) -> Vec<f64> {
        let parameters = shared_parameters(&cases[0], &EFFECTS).expect("the effects go together");
        let mut sizes: Vec<f64> = parameters.iter().map(|one| one.start).collect();
        for _ in 0..12 {
            let all = vec![sizes.clone(); cases.len()];
            let blocks = shared_blocks(cases, &EFFECTS, &all).expect("it can be asked");
            let mut curvature = SymmetricMatrix::zero(2);
            let mut gradient = vec![0.0; 2];
            for block in blocks
                .into_iter()
                .map(|block| block.expect("each is fitted"))
            {
                curvature.add(&SymmetricMatrix::new(2, block.curvature));
                gradient
                    .iter_mut()
                    .zip(&block.gradient)
                    .for_each(|(sum, g)| *sum -= g);
            }
            let step = curvature.solve_scaled(&gradient).expect("both are known");
            sizes
                .iter_mut()
                .zip(&step)
                .for_each(|(size, step)| *size += step);
        }
        sizes
    }

    #[test]
    fn what_tightenings_say_one_by_one_adds_up_to_the_pooled_fit() {
        let cases = cases();
        let tally = Tally::default();
        let counted = Cases::new(&cases, &tally);
        let mut pooled = PooledModel::new(counted, &EFFECTS).expect("the effects go together");
        let to_the_end = PooledSettings {
            cost_tolerance: 0.0,
            ..PooledSettings::default()
        };
        let fit = pooled
            .fit(&pooled.usual_start(), &to_the_end)
            .expect("it can be fitted");
        assert!((fit.own[9][1] - 90.2).abs() < 1e-9, "{:?}", fit.own[9]);
        for (found, expected) in added_up(&cases).iter().zip(&fit.shared) {
            let apart = (found - expected).abs() / expected.abs();
            assert!(apart < 1e-9, "{found} {expected}: {apart:.2e}");
        }
    }

    #[test]
    fn a_tightening_says_the_same_whatever_stands_beside_it() {
        let cases = cases();
        let sizes = vec![vec![1.9e6, 140.0]; cases.len()];
        let together = shared_blocks(&cases, &EFFECTS, &sizes).expect("it can be asked");
        for (case, block) in cases.iter().zip(together) {
            let alone = shared_blocks(&[case.lent()], &EFFECTS, &sizes[..1]);
            assert_eq!(alone.expect("it can be asked"), [block]);
        }
    }
}
