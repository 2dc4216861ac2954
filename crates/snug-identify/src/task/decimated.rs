//! A tightening at a lower rate: for a search that would take long on every sample.

use crate::residual::restarts::Simulation;
use crate::task::FitTask;
use snug_campaign::{Intersample, Quantity};
use snug_model::Input;
use std::borrow::Cow;

impl FitTask<'_> {
    /// The same with a band-limited input simulated on a grid `substeps` times as fine as the samples.
    pub fn on_grid(&self, substeps: usize) -> FitTask<'static> {
        FitTask {
            input: Cow::Owned(self.input.on_grid(substeps)),
            model: Cow::Owned(self.model.clone().into_owned()),
            settings: Cow::Owned(self.settings.clone().into_owned()),
            tightening: Cow::Owned(self.tightening.clone().into_owned()),
        }
    }

    /// The same with every `factor` samples replaced by their mean, which stands for the middle of them; what is left over at the end is
    /// left out, and nothing is known of the noise. The torque runs straight from mean to mean, in steps as short as before
    /// where those are shorter than the samples', and a model that takes up the measured motion does so about as often.
    ///
    /// Valid for: motion and torque that hardly bend over `factor` samples.
    pub fn decimated(&self, factor: usize) -> FitTask<'static> {
        let (before, factor) = (&*self.tightening, factor.max(1));
        let interval_s = before.time_base.interval_s;
        let late_s = 0.5 * (factor - 1) as f64 * interval_s;
        let mut tightening = before.clone();
        tightening.torque_nm = means(&before.torque_nm, factor);
        tightening.grip_force_n = before.grip_force_n.as_ref().map(|f| means(f, factor));
        for quantity in Quantity::ALL {
            if let Some(signal) = before.motion.get(quantity) {
                tightening.motion.set(quantity, means(signal, factor));
            }
        }
        tightening.time_base.start_s += late_s;
        tightening.time_base.interval_s = interval_s * factor as f64;
        tightening.onset = before.onset.map(|sample| sample / factor);
        tightening.noise = None;
        let input = &*self.input;
        let free = decimated_input(input, input.logged_nm(), factor);
        let simulation = match input.samples_between_restarts() {
            None => Simulation::FreeRun,
            Some(apart) => Simulation::Restarted {
                every_s: apart as f64 * interval_s,
            },
        };
        let mut settings = self.settings.clone().into_owned();
        settings.unscored_samples = settings.unscored_samples.div_ceil(factor);
        FitTask {
            input: Cow::Owned(simulation.of(free, &tightening)),
            model: Cow::Owned(self.model.clone().into_owned()),
            settings: Cow::Owned(settings),
            tightening: Cow::Owned(tightening),
        }
    }
}

/// An input of the means of `torque_nm`, one value for each of its samples; means stand for the middle of what they are taken over.
pub(crate) fn decimated_input(input: &Input, torque_nm: &[f64], factor: usize) -> Input {
    let interval_s = input.interval_s();
    let late_s = 0.5 * (factor - 1) as f64 * interval_s;
    let (torque_nm, interval_s) = (means(torque_nm, factor), interval_s * factor as f64);
    let steps = match input.is_band_limited() || input.substeps() == 1 {
        true => 1,
        false => input.substeps() * factor,
    };
    input
        .of_others(&torque_nm, interval_s, Intersample::Linear)
        .in_steps(steps)
        .with_onset(input.onset_s() - late_s)
        .with_rest_before(input.rest_before_s() + late_s)
        .with_zero_at(input.zero_at().map(|sample| sample / factor))
}

/// Means of every `factor` samples, in the unit of the signal; what is left over at the end is left out.
pub fn means(signal: &[f64], factor: usize) -> Vec<f64> {
    let parts = signal.chunks_exact(factor);
    parts
        .map(|part| part.iter().sum::<f64>() / factor as f64)
        .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use snug_campaign::{Rig, Tightening};

    const RIG: Rig = Rig {
        lever_arm_m: 1.0,
        known_inertia_kg_m2: 0.0,
    };

    /// sin t, every 1 ms for 6 s; of every 10 samples the mean is that of the middle, 4.5 ms later, but for 4e-6 of it.
    #[test]
    fn means_stand_for_the_middle_of_what_they_are_taken_over() {
        let sine: Vec<f64> = (0..6003).map(|k| (1e-3 * f64::from(k)).sin()).collect();
        let task = FitTask::from_arrays(RIG, 1e-3, sine.clone(), Quantity::Displacement, sine);
        let coarse = task.unwrap().decimated(10);
        assert_eq!(coarse.measured().len(), 600);
        assert_eq!(coarse.input.samples(), 600);
        let base = coarse.tightening.time_base;
        assert!((base.interval_s - 0.01).abs() < 1e-15 && (base.start_s - 4.5e-3).abs() < 1e-15);
        for (k, value) in coarse.measured().iter().enumerate() {
            let expected = (base.start_s + base.interval_s * k as f64).sin();
            assert!((value - expected).abs() < 1e-5, "{k}: {value} {expected}");
        }
        assert_eq!(coarse.measured(), coarse.input.logged_nm());
        coarse.check().unwrap();
    }

    #[test]
    fn restarts_come_as_often_and_samples_that_count_for_nothing_go_on_doing_so() {
        let ramp: Vec<f64> = (0..5000).map(|k| 0.002 * f64::from(k)).collect();
        let tightening = Tightening::from_torque(RIG, 1e-3, vec![1.0; 5000]);
        let tightening = tightening.with(Quantity::Displacement, ramp.clone());
        let torque = vec![1.0; 5000];
        let mut task =
            FitTask::from_arrays(RIG, 1e-3, torque, Quantity::Displacement, ramp).unwrap();
        let simulation = Simulation::Restarted { every_s: 0.4 };
        let input = task.input.clone().into_owned();
        task.input = Cow::Owned(simulation.of(input, &tightening));
        task.settings.to_mut().unscored_samples = 95;
        let coarse = task.decimated(10);
        assert_eq!(coarse.input.samples_between_restarts(), Some(40));
        assert_eq!(coarse.unscored(), 10);
        assert_eq!(coarse.quantity(), Quantity::Displacement);
    }
}
