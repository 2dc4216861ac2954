//! The catalogue: one file per effect, here its `mod` line and its line in the list.

use crate::custom::law::CustomEffect;
use crate::custom::settings::CustomEffectSettings;
use crate::description::Description;
use crate::error::ModelError;
use crate::law::{
    AnsweredHooks, Corner, Deflection, Delayed, Instant, Kinematics, Law, LoggedTorque, Resonance,
    hooks,
};
use crate::numeric::number::Number;
use snug_campaign::Quantity;

pub mod ac_coupling;
pub mod acceleration_bias;
pub mod acceleration_lag;
pub mod actuator_lag;
pub mod asymmetric_viscous_friction;
pub mod attached_mass;
pub mod backlash;
pub mod bouc_wen;
pub mod centripetal_crosstalk;
pub mod co_contraction;
pub mod constant_load;
pub mod coulomb_friction;
pub mod cubic_stiffness;
pub mod directional_damping;
pub mod exponential_stiffness;
pub mod fatigue;
pub mod general_bouc_wen;
pub mod gravity_leakage;
pub mod gravity_torque;
pub mod grip_slip;
pub mod initial_motion;
pub mod maxwell_branch;
pub mod output_drift;
pub mod output_offset;
pub mod quadratic_damping;
pub mod quadratic_stiffness;
pub mod second_mass;
pub mod second_mode;
pub mod second_ripple;
pub mod stretch_reflex;
pub mod stribeck_friction;
pub mod torque_dead_zone;
pub mod torque_delay;
pub mod torque_dependent_stiffness;
pub mod torque_drift;
pub mod torque_lag;
pub mod torque_limit;
pub mod torque_offset;
pub mod torque_rate_limit;
pub mod torque_ripple;
pub mod voluntary_push;

#[cfg(test)]
mod trial;

/// The list: hands every effect of the catalogue, in its order, to the macro `to` after what that was `given`.
macro_rules! catalogue {
    ($to:ident $(, $($given:tt)+)?) => {
        $to! {
            [
                cubic_stiffness::CubicStiffness,
                quadratic_stiffness::QuadraticStiffness,
                coulomb_friction::CoulombFriction,
                quadratic_damping::QuadraticDamping,
                directional_damping::DirectionalDamping,
                backlash::Backlash,
                maxwell_branch::MaxwellBranch,
                second_mass::SecondMass,
                grip_slip::GripSlip,
                bouc_wen::BoucWen,
                general_bouc_wen::GeneralBoucWen,
                exponential_stiffness::ExponentialStiffness,
                stribeck_friction::StribeckFriction,
                asymmetric_viscous_friction::AsymmetricViscousFriction,
                torque_ripple::TorqueRipple,
                second_ripple::SecondRipple,
                second_mode::SecondMode,
                attached_mass::AttachedMass,
                gravity_torque::GravityTorque,
                constant_load::ConstantLoad,
                torque_limit::TorqueLimit,
                torque_dead_zone::TorqueDeadZone,
                torque_rate_limit::TorqueRateLimit,
                actuator_lag::ActuatorLag,
                stretch_reflex::StretchReflex,
                voluntary_push::VoluntaryPush,
                co_contraction::CoContraction,
                torque_dependent_stiffness::TorqueDependentStiffness,
                torque_offset::TorqueOffset,
                torque_drift::TorqueDrift,
                torque_delay::TorqueDelay,
                torque_lag::TorqueLag,
                acceleration_lag::AccelerationLag,
                acceleration_bias::AccelerationBias,
                ac_coupling::AcCoupling,
                initial_motion::InitialMotion,
                output_offset::OutputOffset,
                output_drift::OutputDrift,
                centripetal_crosstalk::CentripetalCrosstalk,
                gravity_leakage::GravityLeakage,
            ]
            $($($given)+)?
        }
    };
}

/// Declares the enum over the list.
macro_rules! declare_effect {
    ([$($module:ident::$Effect:ident,)+]) => {
        /// One effect of the catalogue, or one that a study wrote itself.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum Effect {
            $(
                #[doc = $module::page!()]
                #[doc = concat!("\nSign, validity and source: [`", stringify!($module), "`](mod@", stringify!($module), ").")]
                $Effect,
            )+
            /// A law of the study's own, see [`CustomEffect`].
            Custom(&'static CustomEffect),
        }

        impl Effect {
            /// Every effect of the catalogue, in its order.
            pub const ALL: &[Self] = &[$(Self::$Effect,)+];
        }
    };
}
catalogue!(declare_effect);

/// What the law behind an effect answers.
macro_rules! ask {
    ([$($module:ident::$Effect:ident,)+] $effect:expr, $law:ident => $answer:expr) => {
        match $effect {
            $(Effect::$Effect => {
                let $law = $module::$Effect;
                $answer
            })+
            Effect::Custom($law) => $answer,
        }
    };
}

/// Forwards every hook to the law behind the effect.
macro_rules! forward {
    ($($asked:ident { $($(#[$doc:meta])* fn $hook:ident($($argument:ident: $Kind:ty),*) -> $Answer:ty;)+ })+) => {
        impl Law for Effect {
            fn description(&self) -> &'static Description {
                catalogue!(ask, self, law => law.description())
            }

            $($(
                #[inline(always)]
                fn $hook<N: Number>(&self, p: &[N], $($argument: $Kind),*) -> Option<$Answer> {
                    catalogue!(ask, self, law => law.$hook(p, $($argument),*))
                }
            )+)+

            fn wavelength(&self) -> Option<usize> {
                if let Self::Custom(law) = self {
                    // One that stands in for one of the catalogue's, on a rig of another scale, is of its kind.
                    return Self::named(law.description().name)?.wavelength();
                }
                catalogue!(ask, self, law => law.wavelength())
            }

            fn resonance(&self) -> Option<Resonance> {
                catalogue!(ask, self, law => law.resonance())
            }

            fn same_as(&self, compared: Quantity) -> Option<&'static str> {
                catalogue!(ask, self, law => law.same_as(compared))
            }

            fn likelier(&self) -> Option<&'static str> {
                catalogue!(ask, self, law => law.likelier())
            }

            fn is_general(&self) -> bool {
                if let Self::Custom(law) = self {
                    return Self::named(law.description().name).is_some_and(|one| one.is_general());
                }
                catalogue!(ask, self, law => law.is_general())
            }

            fn of_all(&self) -> Option<&'static str> {
                if let Self::Custom(law) = self {
                    return Self::named(law.description().name)?.of_all();
                }
                catalogue!(ask, self, law => law.of_all())
            }

            fn beside(&self) -> Option<&'static str> {
                if let Self::Custom(law) = self {
                    return Self::named(law.description().name)?.beside();
                }
                catalogue!(ask, self, law => law.beside())
            }
        }
    };
}
hooks!(forward);

/// Trends from tightening to tightening: they act between simulations, not within one, so none of them is an [`Effect`].
pub const TRENDS: &[Description] = &[fatigue::DESCRIPTION];

impl Effect {
    /// What a plain regression of the equation of motion takes beside torque, velocity and angle: sgn v and 1.
    pub const PLAIN: &[Self] = &[Self::CoulombFriction, Self::TorqueOffset];

    /// The effect called `name`, if the catalogue has it.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|effect| effect.description().name == name)
    }

    /// The effect that a study's own law is.
    ///
    /// # Errors
    /// [`ModelError::CustomName`], [`ModelError::CustomParameter`], [`ModelError::CustomRange`],
    /// [`ModelError::Expression`] and [`ModelError::ExpressionValue`] say what is wrong with the declaration and what is
    /// allowed.
    pub fn custom(settings: &CustomEffectSettings) -> Result<Self, ModelError> {
        if Self::named(&settings.name).is_some() {
            return Err(ModelError::CustomName {
                name: settings.name.clone(),
                problem: "is an effect of the catalogue; a custom effect needs a name of its own",
            });
        }
        CustomEffect::intern(settings).map(Self::Custom)
    }

    /// Its fixed name.
    pub fn name(&self) -> &'static str {
        self.description().name
    }

    /// True when the effect only changes what is measured, so that the motion itself stays the base model's.
    pub fn measurement_only(&self) -> bool {
        AnsweredHooks::of(self).are_of_sensors()
    }

    /// Whether what is measured of the motion differs from it where it acts.
    pub fn changes_what_is_measured(&self) -> bool {
        AnsweredHooks::of(self).are_heard_by_sensors()
    }

    /// Whether it is the zero of a sensor that is off, by now or ever more.
    pub fn shifts_the_zero(&self) -> bool {
        AnsweredHooks::of(self).measure
    }

    /// Whether it says with which motion the window begins.
    pub fn sets_initial_motion(&self) -> bool {
        AnsweredHooks::of(self).initial
    }

    /// Whether it lets the grip come and go, as play does: the hand's spring and damper act only on what is left of the
    /// deflection, and the acceleration jumps where contact begins and ends.
    pub fn has_unilateral_contact(self) -> bool {
        AnsweredHooks::of(&self).deflection
    }
}

#[cfg(test)]
mod tests;
