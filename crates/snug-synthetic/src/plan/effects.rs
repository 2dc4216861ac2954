//! What a campaign can hide: the catalogue's effects, and laws that no catalogue lists.
//!
//! What each effect does stands in its description: the tool's and the hand's laws are put to work in `plant.rs`, those of
//! the sensors in `sensing.rs`.

use crate::error::SyntheticError;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// Speed over which dry friction changes sign \[m/s\].
const FRICTION_SPEED_M_PER_S: f64 = 0.01;
/// Displacement over which the exponential spring stiffens \[m\].
const STIFFENING_M: f64 = 0.012;
/// Displacement at which the end stop is met \[m\].
const STOP_M: f64 = 0.007;

/// An effect that a campaign can hide, with the numbers that its law has, in this order.
///
/// x = l θ and v = l ω at the grip; a positive force acts as −l F on the tool. Times count from the torque's onset, s is the
/// smooth step from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum HiddenEffect {
    /// F += k3 x³; k3 \[N/m³\].
    CubicStiffness,
    /// F += k2 x²; k2 \[N/m²\].
    QuadraticStiffness,
    /// F += Fc tanh(v/v_s); Fc \[N\], v_s \[m/s\].
    CoulombFriction,
    /// F += c2 v |v|; c2 \[N s²/m²\].
    QuadraticDamping,
    /// F += c_r v where v < 0; c_r \[kg/s\].
    DirectionalDamping,
    /// Spring and damper act only where |x| > g, the spring on x ∓ g; g \[m\].
    Backlash,
    /// F += f, f' = k_m v − f/τ; k_m \[N/m\], τ \[s\].
    MaxwellBranch,
    /// Spring and damper end on a second mass: F = k (x − x2) + c (v − v2), m2 x2'' = F − k2 x2 − c2 v2; m2 \[kg\],
    /// k2 \[N/m\], c2 \[kg/s\].
    SecondMass,
    /// F becomes F_max tanh(F/F_max); F_max \[N\].
    GripSlip,
    /// F += k_h z, hysteretic: z' = v (1 − (½ sgn(v z) + ½) |z|/z_max); k_h \[N/m\], z_max \[m\].
    BoucWen,
    /// F += k_r x(t − τ); k_r \[N/m\], τ \[s\].
    StretchReflex,
    /// F += F_v s((t − t_on)/t_rise); F_v \[N\], t_on \[s\], t_rise \[s\].
    VoluntaryPush,
    /// k becomes k (1 + r s((t − t_on)/t_rise)); r, t_on \[s\], t_rise \[s\].
    CoContraction,
    /// k becomes k (1 + κ |T|); κ \[1/Nm\].
    TorqueDependentStiffness,
    /// T − T0 acts, T is logged: the torque sensor reads T0 \[Nm\] too much.
    TorqueOffset,
    /// The logged torque is early: what acts at t was logged at t − d; d \[s\].
    TorqueDelay,
    /// The logged torque y follows the acting torque: τ y' = T − y; τ \[s\].
    TorqueLag,
    /// The measured acceleration y follows the true one: τ y' = α − y; τ \[s\].
    AccelerationLag,
    /// a + b; each tightening has its own b \[rad/s²\].
    AccelerationBias,
    /// The tool already moves at the window's start; each tightening has its own θ0 \[rad\] and ω0 \[rad/s\].
    InitialMotion,
    /// a + y0 from the window's start on: unlike a bias, the quiet part does not show it; y0 \[rad/s²\].
    OutputOffset,
    /// a + ε ω²; ε.
    CentripetalCrosstalk,
    /// a + γ sin θ; γ \[rad/s²\].
    GravityLeakage,
    /// F += f0 (e^{|x|/x0} − 1) sgn x, tissue that stiffens as it is stretched; f0 \[N\], x0 \[m\].
    ExponentialStiffness,
    /// F += (F_c + (F_s − F_c) e^{−(v/v_1)²}) tanh(v/v_s); F_c \[N\], F_s \[N\], v_1 \[m/s\], v_s \[m/s\].
    StribeckFriction,
    /// F += a_s sin(2π x/λ) + a_c (cos(2π x/λ) − 1); a_s \[N\], a_c \[N\], λ \[m\].
    TorqueRipple,
    /// (1 + g) T is logged, exactly invisible; g.
    TorqueGain,
    /// l (1 + e) is the true lever arm, exactly invisible; e.
    LeverArmError,
    /// k, c and m are multiplied by 1 + slope · n, n the 0-based number of the tightening in its file; the slopes of k, c
    /// and m.
    Fatigue,
    /// F += d x² v (unlisted); d \[N s/m³\].
    X2vDamping,
    /// F += d x v (unlisted); d \[N s/m²\].
    XvDamping,
    /// F += μ |x| tanh(v/v_s), friction that grows with displacement (unlisted); μ \[N/m\], v_s \[m/s\].
    PositionFriction,
    /// F += d v³ (unlisted); d \[N s³/m³\].
    CubicDamping,
    /// F += k5 x⁵ (unlisted); k5 \[N/m⁵\].
    QuinticStiffness,
    /// F += k_s max(0, x − x_s), the grip meets something that gives way less (unlisted); k_s \[N/m\], x_s \[m\].
    EndStop,
}

/// An effect with its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Law {
    /// The effect.
    pub effect: HiddenEffect,
    /// Its numbers, in the order and the units of the effect's description; no unit where that gives none.
    pub numbers: Vec<f64>,
}

impl Law {
    /// Effect and numbers, to be told apart and taken to pieces at once.
    pub(crate) fn parts(&self) -> (HiddenEffect, &[f64]) {
        (self.effect, &self.numbers)
    }
}

impl HiddenEffect {
    /// Every effect with its fixed name, in the order of declaration: the catalogue's, then the unlisted laws.
    pub const ALL: [(Self, &str); 35] = [
        (Self::CubicStiffness, "cubic_stiffness"),
        (Self::QuadraticStiffness, "quadratic_stiffness"),
        (Self::CoulombFriction, "coulomb_friction"),
        (Self::QuadraticDamping, "quadratic_damping"),
        (Self::DirectionalDamping, "directional_damping"),
        (Self::Backlash, "backlash"),
        (Self::MaxwellBranch, "maxwell_branch"),
        (Self::SecondMass, "second_mass"),
        (Self::GripSlip, "grip_slip"),
        (Self::BoucWen, "bouc_wen"),
        (Self::StretchReflex, "stretch_reflex"),
        (Self::VoluntaryPush, "voluntary_push"),
        (Self::CoContraction, "co_contraction"),
        (Self::TorqueDependentStiffness, "torque_dependent_stiffness"),
        (Self::TorqueOffset, "torque_offset"),
        (Self::TorqueDelay, "torque_delay"),
        (Self::TorqueLag, "torque_lag"),
        (Self::AccelerationLag, "acceleration_lag"),
        (Self::AccelerationBias, "acceleration_bias"),
        (Self::InitialMotion, "initial_motion"),
        (Self::OutputOffset, "output_offset"),
        (Self::CentripetalCrosstalk, "centripetal_crosstalk"),
        (Self::GravityLeakage, "gravity_leakage"),
        (Self::ExponentialStiffness, "exponential_stiffness"),
        (Self::StribeckFriction, "stribeck_friction"),
        (Self::TorqueRipple, "torque_ripple"),
        (Self::TorqueGain, "torque_gain"),
        (Self::LeverArmError, "lever_arm_error"),
        (Self::Fatigue, "fatigue"),
        (Self::X2vDamping, "x2v_damping"),
        (Self::XvDamping, "xv_damping"),
        (Self::PositionFriction, "position_friction"),
        (Self::CubicDamping, "cubic_damping"),
        (Self::QuinticStiffness, "quintic_stiffness"),
        (Self::EndStop, "end_stop"),
    ];

    /// The fixed name, in snake case.
    pub fn name(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// The effect called `name`.
    ///
    /// # Errors
    /// [`SyntheticError::UnknownEffect`].
    pub fn from_name(name: &str) -> Result<Self, SyntheticError> {
        Self::ALL
            .into_iter()
            .find(|&(_, known)| known == name)
            .map(|(effect, _)| effect)
            .ok_or_else(|| SyntheticError::UnknownEffect { name: name.into() })
    }

    /// The effect at `strength` (1 = as strong as is plausible, 0.15 = weak, 0 = absent: `None`).
    ///
    /// From 0.15 to 1 every parameter is within the catalogue's plausible range; most sizes are proportional to the
    /// strength. `rng` is only drawn from by effects that differ from tightening to
    /// tightening.
    pub fn law(self, strength: f64, rng: &mut ChaCha8Rng) -> Option<Law> {
        (strength > 0.0).then(|| Law {
            effect: self,
            numbers: self.numbers(strength, rng),
        })
    }

    fn numbers(self, strength: f64, rng: &mut ChaCha8Rng) -> Vec<f64> {
        match self {
            Self::CubicStiffness => vec![3.3e6 * strength],
            Self::QuadraticStiffness => vec![6.0e4 * strength],
            Self::CoulombFriction => vec![8.0 * strength, FRICTION_SPEED_M_PER_S],
            Self::QuadraticDamping => vec![150.0 * strength],
            Self::DirectionalDamping => vec![80.0 * strength],
            Self::Backlash => vec![0.003 * strength],
            Self::MaxwellBranch => vec![3000.0 * strength, 0.03],
            // Weak means a heavy support that hardly gives: stiffness and damping grow as the strength falls.
            Self::SecondMass => vec![1.5, 8000.0 / strength, 60.0 / strength],
            // What saturation takes grows as 1/F_max², so this is linear in the strength.
            Self::GripSlip => vec![80.0 / strength.sqrt()],
            Self::BoucWen => vec![4000.0 * strength, 0.0025],
            Self::StretchReflex => vec![800.0 * strength, 0.06],
            Self::VoluntaryPush => vec![15.0 * strength, 0.08, 0.05],
            Self::CoContraction => vec![0.8 * strength, 0.07, 0.06],
            Self::TorqueDependentStiffness => vec![0.03 * strength],
            Self::TorqueOffset => vec![strength],
            Self::TorqueDelay => vec![0.004 * strength],
            Self::TorqueLag => vec![0.006 * strength],
            Self::AccelerationLag => vec![0.006 * strength],
            Self::AccelerationBias => vec![0.3 * strength * signed(rng)],
            Self::InitialMotion => vec![
                0.004 * strength * signed(rng),
                0.15 * strength * signed(rng),
            ],
            Self::OutputOffset => vec![0.5 * strength * signed(rng)],
            Self::CentripetalCrosstalk => vec![0.8 * strength],
            Self::GravityLeakage => vec![20.0 * strength],
            Self::TorqueGain => vec![0.1 * strength],
            Self::LeverArmError => vec![0.05 * strength],
            Self::Fatigue => vec![-0.04 * strength, -0.02 * strength, 0.01 * strength],
            Self::X2vDamping => vec![4.4e5 * strength],
            Self::XvDamping => vec![6000.0 * strength],
            Self::PositionFriction => vec![800.0 * strength, FRICTION_SPEED_M_PER_S],
            Self::CubicDamping => vec![200.0 * strength],
            Self::QuinticStiffness => vec![4.0e9 * strength],
            Self::StribeckFriction => vec![
                4.0 * strength,
                12.0 * strength,
                0.08,
                FRICTION_SPEED_M_PER_S,
            ],
            Self::TorqueRipple => vec![8.0 * strength, 4.0 * strength, 0.006],
            Self::ExponentialStiffness => vec![8.0 * strength, STIFFENING_M],
            Self::EndStop => vec![5000.0 * strength, STOP_M],
        }
    }
}

/// About 1 in size with a spread of 0.2, either sign.
fn signed(rng: &mut ChaCha8Rng) -> f64 {
    let sign = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
    let standard: f64 = StandardNormal.sample(rng);
    sign * (1.0 + 0.2 * standard)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use rand::SeedableRng;

    #[test]
    fn every_effect_has_a_law_and_its_own_name() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut names = HiddenEffect::ALL.map(|(effect, _)| effect.name()).to_vec();
        for (effect, name) in HiddenEffect::ALL {
            assert_eq!(effect.name(), name);
            assert!(!effect.law(0.3, &mut rng).unwrap().numbers.is_empty());
            assert!(effect.law(0.0, &mut rng).is_none());
            assert_eq!(HiddenEffect::from_name(effect.name()).unwrap(), effect);
            let json = serde_json::to_string(&effect).unwrap();
            assert_eq!(json, format!("\"{}\"", effect.name()));
        }
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), HiddenEffect::ALL.len());
        assert!(HiddenEffect::from_name("phlogiston").is_err());
    }
}
