use snug_campaign::Estimate;
use snug_model::natural_frequency_standard_error_hz;

/// Half the width of the natural frequency's 95 % interval, from the joint covariance of m and k; 0 for what is fixed.
///
/// `None` where neither m nor k has an interval. The estimate's parameters begin with m, c, k.
pub fn natural_frequency_half_width_hz(estimate: &Estimate) -> Option<f64> {
    const NORMAL_95: f64 = 1.959_963_984_540_054;
    let [m, _, k] = std::array::from_fn(|index| estimate.parameters[index].value);
    estimate.parameters[0]
        .interval
        .or(estimate.parameters[2].interval)?;
    let free: Vec<usize> = (0..estimate.parameters.len())
        .filter(|&index| !estimate.parameters[index].fixed)
        .collect();
    let covariance = |a: usize, b: usize| {
        let place = |wanted: usize| free.iter().position(|&index| index == wanted);
        match (place(a), place(b)) {
            (Some(row), Some(column)) => estimate.covariance[row * free.len() + column],
            _ => 0.0,
        }
    };
    let (mass, stiffness, both) = (covariance(0, 0), covariance(2, 2), covariance(0, 2));
    Some(NORMAL_95 * natural_frequency_standard_error_hz(m, k, mass, stiffness, both)?)
}
