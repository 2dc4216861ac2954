//! What a free run over long recordings leaves when the model has one more effect.
//!
//! Without a stiffening of its spring a model may miss most of a record, and with it none. Restarted every few samples instead, any
//! model predicts nearly all, by a motion that is taken up with its noise, and effects are hardly told apart.

use crate::data::cases::{Cases, Tally};
use crate::data::clusters::Clusters;
use crate::error::DiagnoseError;
use crate::library::is_unlisted;
use crate::pooled::fit::fit_effects;
use crate::pooled::long_record;
use crate::pooled::model::PooledModel;
use crate::pooled::thresholds::A_FEW_STEPS;
use crate::ranking::applicability::candidates;
use crate::ranking::first_ranking::first_ranking;
use crate::ranking::refit::{Way, as_regressed, refit};
use crate::ranking::thresholds::{RUN_FREELY, WORTH_A_START};
use crate::settings::DiagnoseSettings;
use rayon::prelude::*;
use snug_identify::FitTask;
use snug_model::Effect;

/// Whether a free run leaves less than `most` of the fitted output, Σ r² over all recordings in squares of its unit, with one of the
/// effects of the catalogue beside those of the model: of those that promise most of the equation of motion, from where a regression
/// of it puts all numbers and a few steps on; of those that no regression knows, as a delay, from where they usually begin, unless the
/// recordings take long to simulate.
///
/// # Errors
/// What the model or the fit refuses.
pub fn is_followed_with_an_effect(cases: &[FitTask<'_>], most: f64) -> Result<bool, DiagnoseError> {
    let Some(first) = cases.first() else {
        return Ok(false);
    };
    let (tally, clusters) = (Tally::default(), Clusters::of(cases));
    let own: Vec<Effect> = first.model.effects().collect();
    let cases = Cases::new(cases, &tally);
    let current = fit_effects(cases, &own, None, clusters)?;
    let mut listed = candidates(&cases, &current, &[])?;
    listed.retain(|effect| !is_unlisted(*effect));
    let promises = first_ranking(cases, &current, &listed);
    let promising = promises.iter().take_while(|one| one.share >= WORTH_A_START);
    for promise in promising.take(RUN_FREELY) {
        let effects = [own.as_slice(), &[promise.effect]].concat();
        let mut pooled = PooledModel::new(cases, &effects)?;
        let start = as_regressed(&pooled, &current, promise);
        let Ok(end) = pooled.fit(&start, &A_FEW_STEPS) else {
            continue;
        };
        let left = 2.0 * end.cost();
        tracing::debug!(effect = promise.effect.name(), left, most, "run freely");
        if left < most {
            return Ok(true);
        }
    }
    if long_record::take_long(&cases) {
        return Ok(false);
    }
    listed.retain(|effect| promises.iter().all(|promise| promise.effect != *effect));
    let settings = DiagnoseSettings::default();
    let follows = |&effect: &Effect| {
        let fitted = refit(
            cases,
            &current,
            effect,
            &[],
            Way::Far(None),
            clusters,
            &settings,
        );
        let left = fitted.map_or(f64::INFINITY, |fitted| fitted.squares());
        tracing::debug!(effect = effect.name(), left, most, "run freely");
        left < most
    };
    Ok(listed.par_iter().any(follows))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::tests::made_up::on_machine;
    use snug_campaign::Quantity;
    use snug_model::Scale;

    const INTERVAL_S: f64 = 1e-3;
    const STEPS: u32 = 20;

    /// A mass of 0.5 kg on a spring of 5000 N/m that stiffens, moved by two sines, by small steps of the midpoint rule; the angle is its
    /// place on an arm of 1 m.
    fn on_a_spring(cubic_n_per_m3: f64, samples: u32) -> FitTask<'static> {
        let force = |t: f64| 25.0 * ((70.0 * t).sin() + (131.0 * t).sin());
        let acceleration = |t: f64, x: f64, v: f64| {
            (force(t) - 6.0 * v - 5000.0 * x - cubic_n_per_m3 * x.powi(3)) / 0.5
        };
        let h = INTERVAL_S / f64::from(STEPS);
        let (mut x, mut v) = (0.0, 0.0);
        let (mut forces, mut measured) = (Vec::new(), Vec::new());
        for sample in 0..samples {
            let start = f64::from(sample) * INTERVAL_S;
            forces.push(force(start));
            measured.push(x);
            for step in 0..STEPS {
                let t = start + f64::from(step) * h;
                let middle = (x + 0.5 * h * v, v + 0.5 * h * acceleration(t, x, v));
                x += h * middle.1;
                v += h * acceleration(t + 0.5 * h, middle.0, middle.1);
            }
        }
        let scale = Scale::Rig {
            torque_nm: 25.0,
            angle_rad: 0.007,
            time_s: 0.01,
        };
        on_machine(scale, INTERVAL_S, forces, Quantity::Displacement, measured)
    }

    fn power(task: &FitTask<'_>) -> f64 {
        task.measured().iter().map(|x| x * x).sum()
    }

    #[test]
    fn a_spring_that_stiffens_is_followed_freely_once_it_may() {
        let cases = [on_a_spring(6e6, 3000)];
        let one_percent = 0.01 * power(&cases[0]);
        assert!(is_followed_with_an_effect(&cases, one_percent).unwrap());
        assert!(!is_followed_with_an_effect(&cases, 0.0).unwrap());
    }

    #[test]
    fn without_recordings_nothing_is_run() {
        assert!(!is_followed_with_an_effect(&[], f64::INFINITY).unwrap());
    }
}
