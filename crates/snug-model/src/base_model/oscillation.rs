//! Natural frequency and damping ratio of m, c, k, as reports and the thesis give them.

use snug_campaign::Rig;
use std::f64::consts::PI;

/// √(k/m) / 2π \[Hz\] of the hand–arm alone, as the thesis reports it; `None` when k/m is negative or not a number.
pub fn natural_frequency_hz(mass_kg: f64, stiffness_n_per_m: f64) -> Option<f64> {
    let square = stiffness_n_per_m / mass_kg;
    (square >= 0.0 && square.is_finite()).then(|| square.sqrt() / (2.0 * PI))
}

/// ζ = c l² / (2 √(k l² (I_n + m l²))) of tool and hand–arm together; light damping is ζ < 1.
pub fn damping_ratio(
    rig: &Rig,
    mass_kg: f64,
    damping_kg_per_s: f64,
    stiffness_n_per_m: f64,
) -> Option<f64> {
    let square = rig.lever_arm_m * rig.lever_arm_m;
    let inertia = rig.known_inertia_kg_m2 + mass_kg * square;
    let ratio = damping_kg_per_s * square / (2.0 * (stiffness_n_per_m * square * inertia).sqrt());
    ratio.is_finite().then_some(ratio)
}

/// ζ as the thesis checks it, c / (2 √(k (m + m_n))) with the tool's mass m_n in place of I_n/l².
pub fn thesis_damping_ratio(
    tool_mass_kg: f64,
    mass_kg: f64,
    damping_kg_per_s: f64,
    stiffness_n_per_m: f64,
) -> Option<f64> {
    let ratio = damping_kg_per_s / (2.0 * (stiffness_n_per_m * (mass_kg + tool_mass_kg)).sqrt());
    ratio.is_finite().then_some(ratio)
}

/// Damped frequency of tool and hand–arm together \[Hz\]: √(K/I) √(1 − ζ²) / 2π; `None` when ζ ≥ 1.
pub fn damped_frequency_hz(
    rig: &Rig,
    mass_kg: f64,
    damping_kg_per_s: f64,
    stiffness_n_per_m: f64,
) -> Option<f64> {
    let ratio = damping_ratio(rig, mass_kg, damping_kg_per_s, stiffness_n_per_m)?;
    let square = rig.lever_arm_m * rig.lever_arm_m;
    let inertia = rig.known_inertia_kg_m2 + mass_kg * square;
    let natural = (stiffness_n_per_m * square / inertia).sqrt();
    (ratio < 1.0).then(|| natural * (1.0 - ratio * ratio).sqrt() / (2.0 * PI))
}
