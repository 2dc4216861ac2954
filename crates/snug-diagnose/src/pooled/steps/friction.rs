//! In how many steps a machine's motion is simulated from sample to sample: two where dry friction stops it within a sample.
//!
//! In the step in which the motion stops, all that acts beside friction is taken as constant. Of a drive that stops within a sample that is a
//! good part of what is measured, and half a step is enough for it not to show.

use crate::data::cases::Cases;
use crate::pooled::equation::DryFriction;
use crate::pooled::fitted::Fitted;
use crate::pooled::steps::MOST_STEPS;
use snug_campaign::Quantity;
use snug_identify::FitTask;
use snug_signal::white_noise_level;

/// Steps from sample to sample where friction stops the motion within one \[–\]. Chosen: of a drive at 20 Hz that rests half of the time, its
/// friction and lag given, 1.38 times the noise is left with one step, 1.16 with two and 1.15 with eight.
const STEPS: usize = 2;
/// Dry friction over the typical torque from which on it is looked at \[–\]. Chosen.
const LEAST_FRICTION: f64 = 0.02;
/// What friction takes of the speed over a sample, over the speed across which it turns along a measured motion, up to which it does not stop
/// that within one \[–\]. Chosen.
const STEADY: f64 = 1.0;
/// By how much of the measured noise a step may be off as the motion stops \[–\]. Chosen.
const WITHIN_NOISE: f64 = 0.5;

/// Steps for `cases`, simulated with a model of their scale.
pub fn steps_per_sample(cases: &[FitTask<'_>]) -> usize {
    steps_with(cases, DryFriction::of(cases))
}

/// Steps where those that `cases` are simulated in are too long for the dry friction of `fitted`; `None` where they do.
pub(crate) fn shorter_steps(cases: Cases<'_>, fitted: &Fitted) -> Option<usize> {
    let begun = cases.first()?.input.substeps();
    let steps = steps_with(&cases, DryFriction::of_fitted(cases, fitted));
    (steps > begun).then_some(steps)
}

fn steps_with(cases: &[FitTask<'_>], friction: Option<DryFriction>) -> usize {
    let samples: usize = cases.iter().map(|case| case.measured().len()).sum();
    let stops = friction.and_then(|friction| stops(cases, friction));
    let stops = stops.is_some_and(|stops| cases.iter().any(|case| stops.show(case)));
    match stops && samples * STEPS <= MOST_STEPS {
        true => STEPS,
        false => 1,
    }
}

/// How dry friction stops a motion.
struct Stops {
    /// How much friction slows the motion \[m/s²\].
    slows_m_per_s2: f64,
    /// Speed over which it turns \[m/s\].
    turns_over_m_per_s: f64,
}

/// `None` where friction is too small to matter, or the input brings a grid of its own.
fn stops(cases: &[FitTask<'_>], friction: DryFriction) -> Option<Stops> {
    let model = &cases.first()?.model;
    if cases.iter().any(|case| case.input.is_band_limited()) {
        return None;
    }
    let turns_over_m_per_s = model.scale().friction_turns_over(model.rig())?;
    let squares = |case: &FitTask<'_>| case.tightening.torque_nm.iter().map(|t| t * t).sum::<f64>();
    let samples: usize = (cases.iter())
        .map(|case| case.tightening.torque_nm.len())
        .sum();
    let typical_nm = f64::sqrt(cases.iter().map(squares).sum::<f64>() / samples.max(1) as f64);
    let friction_nm = friction.force_n * model.rig().lever_arm_m;
    (friction_nm >= LEAST_FRICTION * typical_nm).then_some(Stops {
        slows_m_per_s2: friction.force_n / friction.mass_kg,
        turns_over_m_per_s,
    })
}

impl Stops {
    /// Whether the motion of a `case` stops within a sample, by so much that the measured noise does not hide it.
    fn show(&self, case: &FitTask<'_>) -> bool {
        let noise = white_noise_level(case.measured()) * case.model.rig().lever_arm_m;
        let interval_s = case.tightening.time_base.interval_s;
        let taken_m_per_s = self.slows_m_per_s2 * interval_s;
        let size = match case.quantity() {
            Quantity::Displacement => 0.25 * taken_m_per_s * interval_s,
            Quantity::Velocity => taken_m_per_s,
            Quantity::Acceleration => self.slows_m_per_s2,
        };
        tracing::debug!(taken_m_per_s, size, noise, "a machine that friction stops");
        taken_m_per_s > STEADY * self.turns_over_m_per_s && size > WITHIN_NOISE * noise
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::Tally;
    use crate::pooled::fit::fit_effects;
    use crate::tests::made_up::{WHOLE, machine_with_friction};
    use snug_model::Effect;

    /// 15 Nm on 0.4 kg m² slow it by 0.19 rad/s in 5 ms; friction turns over 0.016 rad/s.
    #[test]
    fn a_machine_that_stops_within_a_sample_is_simulated_in_shorter_steps() {
        assert_eq!(steps_per_sample(&[machine_with_friction(15.0)]), 2);
        assert_eq!(steps_per_sample(&[machine_with_friction(0.1)]), 1);
    }

    #[test]
    fn a_fit_whose_friction_stops_within_a_sample_asks_for_shorter_steps() {
        let cases = [machine_with_friction(15.0)];
        let tally = Tally::default();
        let cases = Cases::new(&cases, &tally);
        let model = &cases[0].model;
        let friction = (model.scale()).effect(Effect::CoulombFriction, model.rig());
        let friction = friction.expect("a machine has it");
        let of = |effects: &[Effect]| {
            let fitted = fit_effects(cases, effects, None, WHOLE);
            shorter_steps(cases, &fitted.expect("it can be fitted"))
        };
        assert_eq!(of(&[friction]), Some(STEPS));
        assert_eq!(of(&[]), None);
    }

    /// Noise of 1 rad/s hides it.
    #[test]
    fn within_noise_no_stop_shows() {
        let mut case = machine_with_friction(15.0);
        let tightening = case.tightening.to_mut();
        let mut measured = tightening
            .motion
            .get(Quantity::Velocity)
            .map(<[f64]>::to_vec);
        for (sample, value) in measured.iter_mut().flatten().enumerate() {
            *value += [1.0, -1.0][(sample * sample / 7) % 2];
        }
        tightening
            .motion
            .set(Quantity::Velocity, measured.unwrap_or_default());
        assert_eq!(steps_per_sample(&[case.lent()]), 1);
        let cases = [case];
        let stops = DryFriction::of(&cases).and_then(|friction| stops(&cases, friction));
        assert!(stops.is_some_and(|one| one.slows_m_per_s2 > 10.0));
    }
}
