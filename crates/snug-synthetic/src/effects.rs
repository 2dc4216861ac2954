//! What a campaign can hide: the catalogue's effects, and laws that no catalogue lists.

mod measurement;
mod mechanical;
mod muscular;
mod trend;
mod unlisted;

pub use measurement::MeasurementLaw;
pub use mechanical::MechanicalLaw;
pub use muscular::MuscularLaw;
pub use trend::TrendLaw;
pub use unlisted::UnlistedLaw;

use crate::SyntheticError;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

/// Name of an effect that a campaign can hide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HiddenEffect {
    /// F += k3 x³.
    CubicStiffness,
    /// F += k2 x².
    QuadraticStiffness,
    /// F += Fc tanh(v/v_s).
    CoulombFriction,
    /// F += c2 v |v|.
    QuadraticDamping,
    /// F += c_r v where v < 0.
    DirectionalDamping,
    /// Spring and damper act only beyond a gap.
    Backlash,
    /// F += f, f' = k_m v − f/τ.
    MaxwellBranch,
    /// Spring and damper end on a second mass.
    SecondMass,
    /// F becomes F_max tanh(F/F_max).
    GripSlip,
    /// F += k_h z, z hysteretic.
    BoucWen,
    /// F += k_r x(t − τ).
    StretchReflex,
    /// F += F_v s((t − t_on)/t_rise).
    VoluntaryPush,
    /// k (1 + r s((t − t_on)/t_rise)).
    CoContraction,
    /// k (1 + κ |T|).
    TorqueDependentStiffness,
    /// T − T0 acts, T is logged.
    TorqueOffset,
    /// The logged torque is early.
    TorqueDelay,
    /// The logged torque lags.
    TorqueLag,
    /// The measured acceleration lags.
    AccelerationLag,
    /// a + b.
    AccelerationBias,
    /// θ0 and ω0 at the window's start.
    InitialMotion,
    /// The output + y0, from the window's start on.
    OutputOffset,
    /// a + ε ω².
    CentripetalCrosstalk,
    /// a + γ sin θ.
    GravityLeakage,
    /// (1 + g) T is logged; exactly invisible.
    TorqueGain,
    /// l (1 + e) is the true lever arm; exactly invisible.
    LeverArmError,
    /// k, c, m drift with the tightening's number.
    Fatigue,
    /// F += d x² v (unlisted).
    X2vDamping,
    /// F += d x v (unlisted).
    XvDamping,
    /// F += μ |x| tanh(v/v_s) (unlisted).
    PositionFriction,
    /// F += d v³ (unlisted).
    CubicDamping,
    /// F += k5 x⁵ (unlisted).
    QuinticStiffness,
    /// F += f0 (e^{x/x0} − 1 − x/x0) (unlisted).
    ExponentialStiffness,
    /// F += k_s max(0, x − x_s) (unlisted).
    EndStop,
}

/// An effect with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// Passive mechanics of hand, arm and grip.
    Mechanical(MechanicalLaw),
    /// Muscles and nerves.
    Muscular(MuscularLaw),
    /// Sensors and what stands wrong in the rig's description.
    Measurement(MeasurementLaw),
    /// Change from tightening to tightening.
    Trend(TrendLaw),
    /// In no catalogue.
    Unlisted(UnlistedLaw),
}

impl HiddenEffect {
    /// Every effect, the catalogue's order first, then the unlisted laws.
    pub const ALL: [Self; 33] = [
        Self::CubicStiffness,
        Self::QuadraticStiffness,
        Self::CoulombFriction,
        Self::QuadraticDamping,
        Self::DirectionalDamping,
        Self::Backlash,
        Self::MaxwellBranch,
        Self::SecondMass,
        Self::GripSlip,
        Self::BoucWen,
        Self::StretchReflex,
        Self::VoluntaryPush,
        Self::CoContraction,
        Self::TorqueDependentStiffness,
        Self::TorqueOffset,
        Self::TorqueDelay,
        Self::TorqueLag,
        Self::AccelerationLag,
        Self::AccelerationBias,
        Self::InitialMotion,
        Self::OutputOffset,
        Self::CentripetalCrosstalk,
        Self::GravityLeakage,
        Self::TorqueGain,
        Self::LeverArmError,
        Self::Fatigue,
        Self::X2vDamping,
        Self::XvDamping,
        Self::PositionFriction,
        Self::CubicDamping,
        Self::QuinticStiffness,
        Self::ExponentialStiffness,
        Self::EndStop,
    ];

    /// The fixed name, in snake case.
    pub fn name(self) -> &'static str {
        match self {
            Self::CubicStiffness => "cubic_stiffness",
            Self::QuadraticStiffness => "quadratic_stiffness",
            Self::CoulombFriction => "coulomb_friction",
            Self::QuadraticDamping => "quadratic_damping",
            Self::DirectionalDamping => "directional_damping",
            Self::Backlash => "backlash",
            Self::MaxwellBranch => "maxwell_branch",
            Self::SecondMass => "second_mass",
            Self::GripSlip => "grip_slip",
            Self::BoucWen => "bouc_wen",
            Self::StretchReflex => "stretch_reflex",
            Self::VoluntaryPush => "voluntary_push",
            Self::CoContraction => "co_contraction",
            Self::TorqueDependentStiffness => "torque_dependent_stiffness",
            Self::TorqueOffset => "torque_offset",
            Self::TorqueDelay => "torque_delay",
            Self::TorqueLag => "torque_lag",
            Self::AccelerationLag => "acceleration_lag",
            Self::AccelerationBias => "acceleration_bias",
            Self::InitialMotion => "initial_motion",
            Self::OutputOffset => "output_offset",
            Self::CentripetalCrosstalk => "centripetal_crosstalk",
            Self::GravityLeakage => "gravity_leakage",
            Self::TorqueGain => "torque_gain",
            Self::LeverArmError => "lever_arm_error",
            Self::Fatigue => "fatigue",
            Self::X2vDamping => "x2v_damping",
            Self::XvDamping => "xv_damping",
            Self::PositionFriction => "position_friction",
            Self::CubicDamping => "cubic_damping",
            Self::QuinticStiffness => "quintic_stiffness",
            Self::ExponentialStiffness => "exponential_stiffness",
            Self::EndStop => "end_stop",
        }
    }

    /// The effect called `name`.
    ///
    /// # Errors
    /// [`SyntheticError::UnknownEffect`].
    pub fn from_name(name: &str) -> Result<Self, SyntheticError> {
        Self::ALL
            .into_iter()
            .find(|effect| effect.name() == name)
            .ok_or_else(|| SyntheticError::UnknownEffect { name: name.into() })
    }

    /// The effect at `strength` (1 = as strong as is plausible, 0.15 = weak, 0 = absent: `None`).
    ///
    /// From 0.15 to 1 every parameter is within the catalogue's plausible range; most sizes are proportional to the
    /// strength. `rng` is only drawn from by effects that differ from tightening to
    /// tightening.
    pub fn law(self, strength: f64, rng: &mut ChaCha8Rng) -> Option<Law> {
        if strength <= 0.0 {
            return None;
        }
        MechanicalLaw::of(self, strength)
            .map(Law::Mechanical)
            .or_else(|| MuscularLaw::of(self, strength).map(Law::Muscular))
            .or_else(|| MeasurementLaw::of(self, strength, rng).map(Law::Measurement))
            .or_else(|| TrendLaw::of(self, strength).map(Law::Trend))
            .or_else(|| UnlistedLaw::of(self, strength).map(Law::Unlisted))
    }
}

impl Law {
    /// The law's numbers, in the order of its fields.
    pub fn values(&self) -> Vec<f64> {
        match self {
            Self::Mechanical(law) => law.values(),
            Self::Muscular(law) => law.values(),
            Self::Measurement(law) => law.values(),
            Self::Trend(law) => law.values(),
            Self::Unlisted(law) => law.values(),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use rand::SeedableRng;

    #[test]
    fn every_effect_has_a_law_and_its_own_name() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut names: Vec<_> = HiddenEffect::ALL.iter().map(|e| e.name()).collect();
        for effect in HiddenEffect::ALL {
            assert!(!effect.law(0.3, &mut rng).unwrap().values().is_empty());
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
