//! What models say of several tightenings, simulated side by side.

use snug_identify::FitTask;
use snug_model::{Input, Model, Run, simulate_side_by_side};

/// What is asked of one tightening.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'v> {
    /// Which tightening.
    pub member: usize,
    /// Its torque, or another in its place.
    pub input: &'v Input,
    /// All parameters of its model.
    pub values: &'v [f64],
}

/// The compared output and its derivatives.
#[derive(Default)]
pub(crate) struct Simulated {
    /// One value per sample.
    pub output: Vec<f64>,
    /// Column by column.
    pub sensitivity: Vec<f64>,
}

/// The compared output of every tightening that is `asked` for, and its derivatives to the parameters in `order`.
///
/// `models` are those of `cases`, one each. The first of `simulated` get the answers; they are kept from call to call for
/// their room.
pub(crate) fn simulate(
    cases: &[FitTask<'_>],
    models: &[Model],
    asked: &[Asked<'_>],
    order: &[usize],
    simulated: &mut Vec<Simulated>,
) {
    simulated.resize_with(simulated.len().max(asked.len()), Simulated::default);
    let mut runs: Vec<Run<'_>> = (asked.iter().zip(simulated.iter_mut()))
        .map(|(asked, simulated)| {
            let case = &cases[asked.member];
            let samples = case.measured().len();
            simulated.output.resize(samples, 0.0);
            simulated.sensitivity.resize(samples * order.len(), 0.0);
            Run {
                model: &models[asked.member],
                values: asked.values,
                input: asked.input,
                quantity: case.quantity(),
                output: &mut simulated.output,
                sensitivity: &mut simulated.sensitivity,
            }
        })
        .collect();
    simulate_side_by_side(&mut runs, order)
        .expect("the input of a case is as long as what was measured");
}
