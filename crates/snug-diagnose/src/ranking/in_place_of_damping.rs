//! A start of dry friction in the damper's place: a model without it takes what it takes out of the motion for damping, and the more of the
//! motion it holds still the farther off that leads.
//!
//! What a damper takes, friction of the same work takes along the same motion (equivalent damping):
//!
//! ```text
//! F_c Σ |v| = c Σ v²
//! ```
//!
//! Source: den Hartog 1931; Meirovitch 2001, Fundamentals of Vibrations, section 3.

use crate::pooled::equation::{values_at, with_base};
use crate::pooled::fitted::Fitted;
use crate::pooled::model::{PooledModel, Start};
use crate::ranking::simulable::simulable;
use crate::ranking::thresholds::DAMPER_LEFT;
use snug_model::Effect;

/// Where `effect` is dry friction: it with most of the damper's work, and as much less of the damper. `None` where nothing can be
/// simulated, or the damper does no work.
pub(super) fn start(pooled: &PooledModel<'_>, current: &Fitted, effect: Effect) -> Option<Start> {
    if effect.name() != Effect::CoulombFriction.name() {
        return None;
    }
    let begun = simulable(
        pooled,
        pooled.with_effect(current.start(pooled), effect, &[0.0]),
    );
    let at = values_at(pooled, &begun);
    let (mut work, mut way) = (0.0, 0.0);
    for ((case, model), values) in pooled.cases.iter().zip(&pooled.models).zip(&at) {
        let motion = model.simulate(values, &case.input).ok()?;
        let arm_m = model.rig().lever_arm_m;
        for omega in motion.velocity_rad_per_s.iter().flatten() {
            let v = arm_m * omega;
            work += values[DAMPING] * v * v;
            way += v.abs();
        }
    }
    let [mass, damping, stiffness] = [0, 1, 2].map(|index| {
        let of_each = at.iter().map(|values| values[index]);
        of_each.sum::<f64>() / at.len() as f64
    });
    let friction_n = (1.0 - DAMPER_LEFT) * work / way;
    let is_work = friction_n.is_finite() && friction_n > 0.0;
    let start = pooled.with_effect(current.start(pooled), effect, &[friction_n]);
    let base = [mass, DAMPER_LEFT * damping, stiffness];
    is_work.then(|| with_base(pooled, &start, &base))
}

const DAMPING: usize = 1;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::{Cases, Tally};
    use crate::tests::made_up::on_machine;
    use snug_campaign::Quantity;
    use snug_identify::FitTask;
    use snug_model::Scale;

    const SCALE: Scale = Scale::Rig {
        torque_nm: 3.0,
        angle_rad: 0.1,
        time_s: 0.1,
    };

    /// Driven at resonance with a sine of `torque_nm`, the damper holds all of it: v = T cos ωt / c, so that Σv² / Σ|v| = π T / (4 c).
    fn driven_at_resonance(torque_nm: f64) -> FitTask<'static> {
        let driven = |k: u32| torque_nm * (10.0 * 1e-3 * f64::from(k)).sin();
        let torque: Vec<f64> = (0..40_000).map(driven).collect();
        let nothing = vec![0.0; torque.len()];
        on_machine(SCALE, 1e-3, torque, Quantity::Displacement, nothing)
    }

    fn begun(effect: Effect) -> Option<(Vec<f64>, Vec<f64>)> {
        let cases = [driven_at_resonance(3.0)];
        let tally = Tally::default();
        let model = &cases[0].model;
        let on_rig = (model.scale().effect(effect, model.rig())).expect("a machine has it");
        let pooled =
            PooledModel::new(Cases::new(&cases, &tally), &[on_rig]).expect("they go together");
        let names = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];
        let current =
            Fitted::made_up(&[], &[1.0], 40_000).with_own(&names, vec![vec![2.0, 5.0, 200.0]], 0);
        let start = start(&pooled, &current, on_rig)?;
        Some((start.own[0].clone(), start.shared))
    }

    #[test]
    fn friction_takes_the_damper_s_work() {
        let (own, shared) = begun(Effect::CoulombFriction).expect("the damper works");
        assert_eq!(own[..3], [2.0, 0.5, 200.0]);
        let expected_n = 0.9 * std::f64::consts::FRAC_PI_4 * 3.0;
        assert!((shared[0] / expected_n - 1.0).abs() < 0.02, "{shared:?}");
    }

    #[test]
    fn no_other_effect_begins_so() {
        assert_eq!(begun(Effect::QuadraticDamping), None);
    }
}
