//! The step response: what a model makes of a torque that steps from nothing to what it was at its largest, and stays.

use snug_campaign::Intersample;
use snug_identify::FitTask;
use snug_model::{Input, Model};

/// The torque \[Nm\] to which a tightening's step response steps: its largest in size, with its sign.
pub(super) fn height_nm(case: &FitTask<'_>) -> f64 {
    let torque_nm = case.tightening.torque_nm.iter().copied();
    torque_nm.fold(0.0, |largest: f64, torque: f64| {
        match torque.abs() > largest.abs() {
            true => torque,
            false => largest,
        }
    })
}

/// The compared output in its SI unit for as long as the window lasts, from the step on; `None` where the model runs away.
pub(super) fn step_response(case: &FitTask<'_>, model: &Model, values: &[f64]) -> Option<Vec<f64>> {
    let samples = case.measured().len();
    let interval_s = case.tightening.time_base.interval_s;
    let torque_nm = vec![height_nm(case); samples];
    let input = Input::new(&torque_nm, interval_s, Intersample::ZeroOrder);
    let input = input.with_torque_before(Some(0.0));
    let mut output = vec![0.0; samples];
    (model.output(values, &input, case.quantity(), &mut output)).ok()?;
    output
        .iter()
        .all(|value| value.is_finite())
        .then_some(output)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{RIG, SAMPLES, close, exact, hand};

    /// J θ'' + c l² θ' + k l² θ = T from rest, by hand: the acceleration of an oscillator with little damping.
    #[test]
    fn a_hands_step_is_that_of_an_oscillator() {
        let case = exact(2, &[], &[]);
        let values = hand(2);
        let found = step_response(&case, &case.model, &values).expect("it stays");
        let square = RIG.lever_arm_m.powi(2);
        let [m, c, k] = values;
        let inertia = RIG.known_inertia_kg_m2 + m * square;
        let decay = 0.5 * c * square / inertia;
        let own = (k * square / inertia - decay * decay).sqrt();
        let start = height_nm(&case) / inertia;
        assert_eq!(found.len(), SAMPLES);
        for (index, value) in found.iter().enumerate() {
            let t = index as f64 * case.tightening.time_base.interval_s;
            let expected =
                start * (-decay * t).exp() * ((own * t).cos() - decay / own * (own * t).sin());
            assert!(
                (value - expected).abs() < 1e-6 * start.abs(),
                "{t} s: {value} {expected}"
            );
        }
        close(height_nm(&case), 29.5, 1e-12);
    }
}
