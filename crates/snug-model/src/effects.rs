//! The catalogue: one file per effect, one line each in the list below.

use crate::effect::{Description, Instant, Kinematics, Law};
use crate::{Input, Number};

/// Declares the effects' modules and an enum over them that forwards every hook of [`Law`].
macro_rules! catalogue {
    ($($module:ident :: $Effect:ident),+ $(,)?) => {
        $(mod $module;)+

        /// One effect of the catalogue.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Effect {
            $(#[doc = concat!("See `effects/", stringify!($module), ".rs`.")] $Effect,)+
        }

        impl Effect {
            /// Every effect, in the catalogue's order.
            pub const ALL: &[Self] = &[$(Self::$Effect,)+];
        }

        impl Law for Effect {
            fn description(&self) -> &'static Description {
                match self { $(Self::$Effect => $module::$Effect.description(),)+ }
            }
            #[inline(always)]
            fn force<N: Number>(&self, p: &[N], at: &Instant<N>, own: &[N]) -> N {
                match self { $(Self::$Effect => $module::$Effect.force(p, at, own),)+ }
            }
            #[inline(always)]
            fn rates<N: Number>(&self, p: &[N], at: &Instant<N>, own: &[N], rates: &mut [N]) {
                match self { $(Self::$Effect => $module::$Effect.rates(p, at, own, rates),)+ }
            }
            #[inline(always)]
            fn torque<N: Number>(&self, p: &[N], input: &Input, time_s: f64) -> N {
                match self { $(Self::$Effect => $module::$Effect.torque(p, input, time_s),)+ }
            }
            #[inline(always)]
            fn initial<N: Number>(&self, p: &[N]) -> (N, N) {
                match self { $(Self::$Effect => $module::$Effect.initial(p),)+ }
            }
            #[inline(always)]
            fn measure<N: Number>(&self, p: &[N], since_rest_s: f64, motion: Kinematics<N>) -> Kinematics<N> {
                match self { $(Self::$Effect => $module::$Effect.measure(p, since_rest_s, motion),)+ }
            }
            fn measurement_only(&self) -> bool {
                match self { $(Self::$Effect => $module::$Effect.measurement_only(),)+ }
            }
        }
    };
}

catalogue! {
    cubic_stiffness::CubicStiffness,
    coulomb_friction::CoulombFriction,
    maxwell_branch::MaxwellBranch,
    torque_delay::TorqueDelay,
    acceleration_bias::AccelerationBias,
    initial_motion::InitialMotion,
    output_offset::OutputOffset,
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
}
