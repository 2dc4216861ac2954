//! Fits of one tightening from several starts.

use super::*;
use crate::multistart::decimated::DecimatedRecord;
use snug_least_squares::{DenseResidual, Residual, ResidualNoise, best, solve_from_starts};

/// Where an effect has several starts, trying them on a decimated record leads to the optimum that all of them together find.
#[test]
fn rough_starts_lead_to_the_best_optimum_of_all() {
    let truth = Model::new(RIG, &[Effect::MaxwellBranch]).unwrap();
    let [m, c, k] = USUAL;
    for (number, tau_s) in [(1, 0.008), (2, 0.03), (3, 0.09)] {
        let mut one = simulated(number, &plan());
        let motion = truth
            .simulate(&[m, c, k, 800.0, tau_s], &one.input)
            .unwrap();
        let noise = coloured(number, &plan(), &[-0.6, 0.2]);
        let pairs = motion
            .acceleration_rad_per_s2
            .unwrap()
            .into_iter()
            .zip(noise);
        one.tightening.motion.acceleration_rad_per_s2 = Some(pairs.map(|(a, n)| a + n).collect());
        one.model = truth.clone();
        let settings = to_the_end();
        let task = one.task(&settings);
        let mut attempt = Attempt::new(&task).unwrap();
        assert!(attempt.starts.len() > 1);
        let record = attempt.decimated(&task, settings.fitted_output);
        let simulator = BatchSimulator::default();
        let multistart_search =
            attempt.multistart_search(&task, record.as_ref(), &settings, &simulator);
        let decimated = alone(&simulator, multistart_search.lowest()).unwrap();
        let mut problem = DenseResidual::new(&mut attempt.residual);
        let all = solve_from_starts(
            &mut problem,
            &attempt.starts,
            &attempt.set,
            &settings.solver,
        );
        let all = all.unwrap();
        assert!(decimated.status.is_converged() && decimated.cost <= all.cost * (1.0 + 1e-9));
        for (found, expected) in decimated.values.iter().zip(&all.values) {
            assert!(
                (found / expected - 1.0).abs() < 1e-7,
                "{decimated:?} {all:?}"
            );
        }
    }
}

/// Along the measured motion the truth is found from starts far away, and the fit from there is taken for the answer; an
/// effect that is not there never is.
#[test]
fn starts_led_along_the_motion_end_at_an_effect_that_is_there() {
    let [m, c, k] = USUAL;
    let settings = IdentifySettings::default();
    for (number, force_n) in [(1, 20.0), (2, -35.0), (3, 0.0)] {
        let one = pushed(number, force_n);
        let task = one.task(&settings);
        let attempt = Attempt::new(&task).unwrap();
        let decimated = DecimatedRecord::of(&task, settings.fitted_output).unwrap();
        let simulator = BatchSimulator::default();
        let multistart_search =
            attempt.multistart_search(&task, Some(&decimated), &settings, &simulator);
        let restarted = alone(&simulator, multistart_search.restarted(&decimated))
            .unwrap()
            .unwrap();
        let ends = alone(
            &simulator,
            multistart_search.fitted_from_starts(&restarted.starts),
        );
        let fit = best(ends.unwrap().0, restarted.work).unwrap();
        let is_there = force_n != 0.0;
        assert_eq!(
            multistart_search.is_beyond_doubt(&fit),
            is_there,
            "{force_n}: {fit:?}"
        );
        let answer = alone(&simulator, multistart_search.lowest()).unwrap();
        assert!(answer.cost <= fit.cost);
        if is_there {
            assert_eq!(answer.values, fit.values);
            let errors = fit.covariance(ResidualNoise::Unit).standard_errors;
            let truth = [m, c, k, force_n, 0.12, 0.06];
            for ((found, truth), error) in fit.values.iter().zip(truth).zip(errors) {
                assert!((found - truth).abs() < 4.0 * error.unwrap(), "{fit:?}");
            }
        }
    }
}

#[test]
fn what_is_unusual_is_there() {
    let all = all();
    let settings = IdentifySettings::default();
    let tasks: Vec<FitTask<'_>> = all.iter().map(|one| one.task(&settings)).collect();
    let found = identify_all(&tasks);
    let found: Vec<Estimate> = found.into_iter().map(Result::unwrap).collect();
    assert_eq!(found[9].active_constraints, ["light_damping"]);
    assert!(found[9].conic_solves > 0);
    let passes = found.iter().map(|estimate| estimate.evaluations);
    let usual = found[0].evaluations;
    assert!(passes.max().unwrap() > usual, "a straggler");
    // The cubic spring widens what the noise alone would leave.
    let errors = |number: usize| found[number].parameters[2].standard_error.unwrap();
    assert!(errors(11) > 3.0 * errors(0), "{} {}", errors(11), errors(0));
}

/// Searches that race are answered by simulations side by side; a fit may not depend on how many still run.
#[test]
fn what_is_simulated_beforehand_has_the_same_bits() {
    let mut one = simulated(1, &plan());
    one.model = Model::new(RIG, &[Effect::MaxwellBranch]).unwrap();
    let settings = IdentifySettings::default();
    let task = one.task(&settings);
    let attempt = Attempt::new(&task).unwrap();
    let free = attempt.residual.free().to_vec();
    for with_slopes in [true, false] {
        let evaluate = |mut residual: TighteningResidual<'_>, start: &[f64]| {
            let count = residual.residual_count();
            let (mut r, mut slopes) = (vec![0.0; count], vec![0.0; count * free.len()]);
            let asked = with_slopes.then_some(&mut slopes[..]);
            residual.evaluate(start, &mut r, asked).unwrap();
            (r, slopes)
        };
        let mut prepared = vec![attempt.residual.clone(); attempt.starts.len()];
        let requests = (prepared.iter_mut().zip(&attempt.starts))
            .map(|(residual, start)| residual.request(start, with_slopes))
            .collect();
        let simulator = BatchSimulator::default();
        let simulated = alone(&simulator, simulator.simulate(requests));
        for (residual, simulated) in prepared.iter_mut().zip(simulated) {
            residual.prefetch(simulated);
        }
        assert!(prepared.len() > 2);
        for (residual, start) in prepared.into_iter().zip(&attempt.starts) {
            let alone = evaluate(attempt.residual.clone(), start);
            assert_eq!(evaluate(residual, start), alone);
        }
    }
}
