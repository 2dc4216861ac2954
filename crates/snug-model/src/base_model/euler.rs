//! The base model as the original program stepped it, for comparison with its results.

use crate::base_model::forces::base_values;
use crate::error::ModelError;
use crate::input::torque::check_interval;
use snug_campaign::Rig;

/// Displacement θ \[rad\] of the base model by the explicit Euler method, as in the original program.
///
/// θ_{k+1} = θ_k + h ω_k, ω_{k+1} = ω_k + h (T_k − l² (k θ_k + c ω_k)) / (I_n + m l²), from rest. `values` begins with
/// m \[kg\], c \[kg/s\], k \[N/m\]; `torque_nm` is sampled every `interval_s`. First-order accurate: about 0.14 % of the
/// peak at 10 kHz.
///
/// # Errors
/// [`ModelError::Length`] for fewer than three values, [`ModelError::InputTime`] for the interval.
pub fn euler_displacement(
    rig: &Rig,
    values: &[f64],
    torque_nm: &[f64],
    interval_s: f64,
) -> Result<Vec<f64>, ModelError> {
    let [mass_kg, damping_kg_per_s, stiffness_n_per_m] = base_values(values)?;
    check_interval(interval_s)?;
    let square = rig.lever_arm_m * rig.lever_arm_m;
    let inertia = rig.known_inertia_kg_m2 + mass_kg * square;
    let (mut angle, mut velocity) = (0.0, 0.0);
    let angles_rad = torque_nm
        .iter()
        .map(|torque| {
            let here = angle;
            let acceleration = (torque
                - square * (stiffness_n_per_m * angle + damping_kg_per_s * velocity))
                / inertia;
            angle += interval_s * velocity;
            velocity += interval_s * acceleration;
            here
        })
        .collect();
    Ok(angles_rad)
}
