//! Forces between tool and hand, from parameters and from a measured motion.

use snug_campaign::{Motion, Rig};

/// F1 = l (c ω + k θ) \[N\]: spring and damper of the base model under the given motion.
///
/// Leaves out the arm's inertia: F3 = F1 + l m α. `values` begins with m, c, k.
pub fn spring_damper_force(rig: &Rig, values: &[f64], motion: &Motion) -> Vec<f64> {
    let (Some(angle), Some(velocity)) = (&motion.displacement_rad, &motion.velocity_rad_per_s)
    else {
        return Vec::new();
    };
    angle
        .iter()
        .zip(velocity)
        .map(|(angle, velocity)| rig.lever_arm_m * (values[1] * velocity + values[2] * angle))
        .collect()
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
