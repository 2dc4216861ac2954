//! In how many steps a machine's motion is simulated from sample to sample: as many as its dry friction asks for.
//!
//! Where the motion stops, friction turns within one step of a slow recording and throws it back further than it came: the simulation
//! shivers about rest, by as much as friction slows it over a step, and no fit of it settles.

use crate::pooled::equation::DryFriction;
use snug_campaign::Quantity;
use snug_identify::FitTask;
use snug_signal::white_noise_level;

/// Steps from sample to sample that are tried, the fewest that do are taken. Chosen: on a drive at 20 Hz that rests half of the time the
/// sixteenth part of a sample does.
const STEPS: [usize; 6] = [1, 2, 4, 8, 16, 32];
/// Steps of all recordings together up to which they are made shorter: a search takes as long as with as many samples. Chosen.
const MOST_STEPS: usize = 200_000;
/// Dry friction over the typical torque from which on it is looked at \[–\]. Chosen.
const LEAST_FRICTION: f64 = 0.02;
/// What a step takes of the speed, over the speed across which friction turns, up to which rest is steady \[–\]: at 2.8 a step of the
/// classical method throws it back as far as it came; the mass that a regression knows may be twice the one that is found.
const STEADY: f64 = 1.0;
/// By how much of the measured noise the simulation may shiver \[–\]. Chosen.
const WITHIN_NOISE: f64 = 0.5;

/// Steps for `cases`, simulated with a model of their scale.
pub fn steps_per_sample(cases: &[FitTask<'_>]) -> usize {
    let asked_for = shivers(cases).map(|shivers| {
        let steps = cases.iter().map(|case| shivers.steps(case));
        steps.max().unwrap_or(1)
    });
    let samples: usize = cases.iter().map(|case| case.measured().len()).sum();
    let may_be = |steps: &usize| *steps == 1 || samples * steps <= MOST_STEPS;
    let most = STEPS.into_iter().rev().find(may_be);
    asked_for.unwrap_or(1).min(most.unwrap_or(1))
}

/// What dry friction does to a simulation at rest.
struct Shivers {
    /// How much friction slows the motion \[m/s²\].
    slows_m_per_s2: f64,
    /// Speed over which it turns \[m/s\].
    turns_over_m_per_s: f64,
}

/// `None` where nothing is known of dry friction, it is too small to matter, or the input brings a grid of its own.
fn shivers(cases: &[FitTask<'_>]) -> Option<Shivers> {
    let model = &cases.first()?.model;
    if cases.iter().any(|case| case.input.is_band_limited()) {
        return None;
    }
    let turns_over_m_per_s = model.scale().friction_turns_over(model.rig())?;
    let friction = DryFriction::of(cases)?;
    let squares = |case: &FitTask<'_>| case.tightening.torque_nm.iter().map(|t| t * t).sum::<f64>();
    let samples: usize = (cases.iter())
        .map(|case| case.tightening.torque_nm.len())
        .sum();
    let typical_nm = f64::sqrt(cases.iter().map(squares).sum::<f64>() / samples.max(1) as f64);
    let friction_nm = friction.force_n * model.rig().lever_arm_m;
    (friction_nm >= LEAST_FRICTION * typical_nm).then_some(Shivers {
        slows_m_per_s2: friction.force_n / friction.mass_kg,
        turns_over_m_per_s,
    })
}

impl Shivers {
    /// The fewest steps with which a simulation of `case` is steady at rest, or its shivering is lost in the measured noise; the most where
    /// none are enough.
    fn steps(&self, case: &FitTask<'_>) -> usize {
        let noise = white_noise_level(case.measured()) * case.model.rig().lever_arm_m;
        let are_enough = |steps: &usize| {
            let step_s = case.tightening.time_base.interval_s / *steps as f64;
            let taken_m_per_s = self.slows_m_per_s2 * step_s;
            let size = match case.quantity() {
                Quantity::Displacement => 0.25 * taken_m_per_s * step_s,
                Quantity::Velocity => taken_m_per_s,
                Quantity::Acceleration => self.slows_m_per_s2,
            };
            let is_steady = taken_m_per_s <= STEADY * self.turns_over_m_per_s;
            tracing::debug!(
                steps,
                is_steady,
                size,
                noise,
                "a machine that friction stops"
            );
            is_steady || size <= WITHIN_NOISE * noise
        };
        let most = STEPS[STEPS.len() - 1];
        STEPS.into_iter().find(are_enough).unwrap_or(most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::machine_with_friction;

    /// 15 Nm on 0.4 kg m² slow it by 0.19 rad/s in 5 ms; friction turns over 0.016 rad/s. By hand: a sixteenth of that is less.
    #[test]
    fn a_machine_that_stops_within_a_sample_is_simulated_in_shorter_steps() {
        assert_eq!(steps_per_sample(&[machine_with_friction(15.0)]), 16);
        assert_eq!(steps_per_sample(&[machine_with_friction(0.1)]), 1);
    }

    /// Its shivering would be lost in noise of 1 rad/s.
    #[test]
    fn within_noise_nothing_shivers() {
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
        assert!(shivers(&[case]).is_some_and(|one| one.slows_m_per_s2 > 10.0));
    }
}
