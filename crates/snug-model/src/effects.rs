//! The catalogue: one file per effect, one line each in the list below.

use crate::custom::law::CustomEffect;
use crate::effect::{Deflection, Delayed, Description, Instant, Kinematics, Law, LoggedTorque};
use crate::numeric::number::Number;
use snug_campaign::Quantity;

/// Declares the effects' modules and an enum over them that forwards every hook of [`Law`].
macro_rules! catalogue {
    ($($module:ident :: $Effect:ident),+ $(,)?) => {
        $(mod $module;)+

        /// One effect of the catalogue, or one that a study wrote itself.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Effect {
            $(#[doc = concat!("See `effects/", stringify!($module), ".rs`.")] $Effect,)+
            /// A law of the study's own, see [`CustomEffect`].
            Custom(&'static CustomEffect),
        }

        impl Effect {
            /// Every effect of the catalogue, in its order.
            pub const ALL: &[Self] = &[$(Self::$Effect,)+];
        }

        impl Law for Effect {
            fn description(&self) -> &'static Description {
                match self {
                    $(Self::$Effect => $module::$Effect.description(),)+
                    Self::Custom(law) => law.description(),
                }
            }
            #[inline(always)]
            fn force<N: Number>(&self, p: &[N], at: &Instant<N>, own: &[N]) -> Option<N> {
                match self {
                    $(Self::$Effect => $module::$Effect.force(p, at, own),)+
                    Self::Custom(law) => law.force(p, at, own),
                }
            }
            #[inline(always)]
            fn rates<N: Number>(&self, p: &[N], at: &Instant<N>, own: &[N], hand_n: N, rates: &mut [N]) {
                match self {
                    $(Self::$Effect => $module::$Effect.rates(p, at, own, hand_n, rates),)+
                    Self::Custom(law) => law.rates(p, at, own, hand_n, rates),
                }
            }
            #[inline(always)]
            fn support<N: Number>(&self, p: &[N], own: &[N]) -> Option<Deflection<N>> {
                match self {
                    $(Self::$Effect => $module::$Effect.support(p, own),)+
                    Self::Custom(law) => law.support(p, own),
                }
            }
            #[inline(always)]
            fn deflection<N: Number>(&self, p: &[N], between: Deflection<N>) -> Option<Deflection<N>> {
                match self {
                    $(Self::$Effect => $module::$Effect.deflection(p, between),)+
                    Self::Custom(law) => law.deflection(p, between),
                }
            }
            #[inline(always)]
            fn stiffening<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
                match self {
                    $(Self::$Effect => $module::$Effect.stiffening(p, at),)+
                    Self::Custom(law) => law.stiffening(p, at),
                }
            }
            #[inline(always)]
            fn limit<N: Number>(&self, p: &[N], force_n: N) -> Option<N> {
                match self {
                    $(Self::$Effect => $module::$Effect.limit(p, force_n),)+
                    Self::Custom(law) => law.limit(p, force_n),
                }
            }
            #[inline(always)]
            fn delayed<N: Number>(&self, p: &[N]) -> Option<Delayed<N>> {
                match self {
                    $(Self::$Effect => $module::$Effect.delayed(p),)+
                    Self::Custom(law) => law.delayed(p),
                }
            }
            #[inline(always)]
            fn logged_torque<N: Number>(&self, p: &[N]) -> Option<LoggedTorque<N>> {
                match self {
                    $(Self::$Effect => $module::$Effect.logged_torque(p),)+
                    Self::Custom(law) => law.logged_torque(p),
                }
            }
            #[inline(always)]
            fn torque<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
                match self {
                    $(Self::$Effect => $module::$Effect.torque(p, at),)+
                    Self::Custom(law) => law.torque(p, at),
                }
            }
            #[inline(always)]
            fn initial<N: Number>(&self, p: &[N]) -> Option<(N, N)> {
                match self {
                    $(Self::$Effect => $module::$Effect.initial(p),)+
                    Self::Custom(law) => law.initial(p),
                }
            }
            #[inline(always)]
            fn cross_sensitivity<N: Number>(&self, p: &[N], at: &Instant<N>, motion: &Kinematics<N>) -> Option<N> {
                match self {
                    $(Self::$Effect => $module::$Effect.cross_sensitivity(p, at, motion),)+
                    Self::Custom(law) => law.cross_sensitivity(p, at, motion),
                }
            }
            #[inline(always)]
            fn acceleration_lag_s<N: Number>(&self, p: &[N]) -> Option<N> {
                match self {
                    $(Self::$Effect => $module::$Effect.acceleration_lag_s(p),)+
                    Self::Custom(law) => law.acceleration_lag_s(p),
                }
            }
            #[inline(always)]
            fn measure<N: Number>(&self, p: &[N], since_rest_s: N::Real, motion: Kinematics<N>) -> Option<Kinematics<N>> {
                match self {
                    $(Self::$Effect => $module::$Effect.measure(p, since_rest_s, motion),)+
                    Self::Custom(law) => law.measure(p, since_rest_s, motion),
                }
            }
            fn measurement_only(&self) -> bool {
                match self {
                    $(Self::$Effect => $module::$Effect.measurement_only(),)+
                    Self::Custom(law) => law.measurement_only(),
                }
            }
            fn same_as(&self, compared: Quantity) -> Option<&'static str> {
                match self {
                    $(Self::$Effect => $module::$Effect.same_as(compared),)+
                    Self::Custom(law) => law.same_as(compared),
                }
            }
        }
    };
}

mod fatigue;

/// Trends from tightening to tightening: they act between simulations, not within one, so none of them is an [`Effect`].
pub const TRENDS: &[Description] = &[fatigue::DESCRIPTION];

catalogue! {
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
    stretch_reflex::StretchReflex,
    voluntary_push::VoluntaryPush,
    co_contraction::CoContraction,
    torque_dependent_stiffness::TorqueDependentStiffness,
    torque_offset::TorqueOffset,
    torque_delay::TorqueDelay,
    torque_lag::TorqueLag,
    acceleration_lag::AccelerationLag,
    acceleration_bias::AccelerationBias,
    initial_motion::InitialMotion,
    output_offset::OutputOffset,
    centripetal_crosstalk::CentripetalCrosstalk,
    gravity_leakage::GravityLeakage,
}

impl Effect {
    /// The effect called `name`, if the catalogue has it.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|effect| effect.description().name == name)
    }

    /// Its fixed name.
    pub fn name(&self) -> &'static str {
        self.description().name
    }

    /// Whether it says with which motion the window begins.
    pub fn sets_initial_motion(&self) -> bool {
        let parameters = self.description().parameters.iter();
        let usual: Vec<f64> = parameters.map(|spec| spec.starts[0]).collect();
        self.initial(&usual).is_some()
    }
}
