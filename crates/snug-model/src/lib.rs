#![doc = include_str!("../README.md")]

mod accelerometer;
mod acting;
mod acting_torque;
mod assembly;
mod bench;
mod custom;
mod custom_settings;
mod dry_friction;
mod dual;
mod effect;
mod effects;
mod error;
mod euler;
#[cfg(test)]
mod even_noise;
mod exponential;
mod exponential_function;
mod expression;
mod forces;
mod history;
mod hooks;
mod input;
mod invisible;
mod lanes;
mod linear;
mod model;
mod normal_equations;
mod number;
mod oscillation;
mod plant;
mod reaction;
mod real;
mod record;
mod response;
mod restart;
mod runge_kutta;
mod scale;
mod sensors;
mod settings;
mod side_by_side;
mod slope;
mod sweep;
mod zeroed;

pub use assembly::{Assembly, BASE_PARAMETERS, MAXIMUM_FREE};
pub use custom::CustomEffect;
pub use custom_settings::{CustomEffectSettings, CustomParameterSettings, Place};
pub use dual::Dual;
pub use effect::{
    Deflection, Delayed, Description, Instant, Kind, Kinematics, Law, LoggedTorque, ParameterSpec,
    Scope,
};
pub use effects::{Effect, TRENDS};
pub use error::ModelError;
pub use euler::euler_displacement;
pub use forces::{inverse_dynamics_force, spring_damper_force};
pub use input::{Earlier, Input};
pub use invisible::{INVISIBLE, Invisible};
pub use lanes::{LaneTask, Lanes, in_lanes, on_this_processor};
pub use model::{Model, THESIS_START};
pub use normal_equations::NormalEquations;
pub use number::Number;
pub use oscillation::{
    damped_frequency_hz, damping_ratio, natural_frequency_hz, thesis_damping_ratio,
};
pub use real::{Real, Task};
pub use scale::{PlausibleRange, Scale};
pub use settings::{ModelSettings, ParameterSettings};
pub use side_by_side::{Run, simulate_side_by_side};
pub use sweep::{ScoredRecord, Sweep};
