//! Forces between tool and hand, from parameters and from a measured motion.

use crate::assembly::layout::BASE_PARAMETERS;
use crate::error::ModelError;
use snug_campaign::{Motion, Rig};

/// F1 = l (c ω + k θ) \[N\]: spring and damper of the base model under the given motion.
///
/// Leaves out the arm's inertia: F3 = F1 + l m α. `values` begins with m, c, k. Empty where angle or velocity is not there.
///
/// # Errors
/// [`ModelError::Length`] for fewer than three values.
pub fn spring_damper_force(
    rig: &Rig,
    values: &[f64],
    motion: &Motion,
) -> Result<Vec<f64>, ModelError> {
    let [_, damping_kg_per_s, stiffness_n_per_m] = base_values(values)?;
    let (Some(angle), Some(velocity)) = (&motion.displacement_rad, &motion.velocity_rad_per_s)
    else {
        return Ok(Vec::new());
    };
    let force = |(angle, velocity): (&f64, &f64)| {
        rig.lever_arm_m * (damping_kg_per_s * velocity + stiffness_n_per_m * angle)
    };
    Ok(angle.iter().zip(velocity).map(force).collect())
}

/// m, c, k, with which `values` begin.
///
/// # Errors
/// [`ModelError::Length`] where they are not there.
pub(crate) fn base_values(values: &[f64]) -> Result<[f64; 3], ModelError> {
    values.first_chunk().copied().ok_or(ModelError::Length {
        what: "values",
        found: values.len(),
        expected: BASE_PARAMETERS.len(),
    })
}

/// (T − I_n α) / l \[N\]: what the hand must exert given torque and acceleration.
///
/// F2 with the measured acceleration, F3 with the simulated one.
pub fn inverse_dynamics_force(
    rig: &Rig,
    torque_nm: &[f64],
    acceleration_rad_per_s2: &[f64],
) -> Vec<f64> {
    torque_nm
        .iter()
        .zip(acceleration_rad_per_s2)
        .map(|(torque, acceleration)| {
            (torque - rig.known_inertia_kg_m2 * acceleration) / rig.lever_arm_m
        })
        .collect()
}
