//! The hand–arm model of a nutrunner and its catalogue of physical effects, simulated with sensitivities.
#![doc = include_str!("../README.md")]

mod assembly;
mod base_model;
mod custom;
mod description;
pub mod effects;
mod error;
mod input;
mod law;
mod numeric;
mod reaction;
mod resonance;
mod simulate;

pub use assembly::layout::{Assembly, BASE_PARAMETERS, MAXIMUM_FREE};
pub use assembly::model::{Model, THESIS_START};
pub use assembly::scale::{PlausibleRange, Scale};
pub use assembly::settings::{GroupValue, ModelSettings, ParameterSettings, ValuesByGroup};
pub use assembly::unidentifiable::{INVISIBLE, Invisible};
pub use base_model::euler::euler_displacement;
pub use base_model::forces::{inverse_dynamics_force, spring_damper_force};
pub use base_model::normal_equations::NormalEquations;
pub use base_model::oscillation::{
    damped_frequency_hz, damping_ratio, natural_frequency_hz, thesis_damping_ratio,
};
pub use base_model::sweep::{ScoredRecord, Sweep};
pub use custom::law::CustomEffect;
pub use custom::settings::{CustomEffectSettings, CustomParameterSettings, Place};
pub use description::{ActsOn, Description, Kind, OUTPUT_UNIT, OnMachine, ParameterSpec, Scope};
#[doc(inline)]
pub use effects::{Effect, TRENDS};
pub use error::ModelError;
pub use input::torque::{Earlier, Input};
pub use law::{
    Corner, Deflection, Delayed, ExcitedBy, Instant, Kinematics, Law, LoggedTorque, Resonance,
};
pub use numeric::arithmetic::Arithmetic;
pub use numeric::dual::Dual;
pub use numeric::lanewise::{Lanewise, Task};
pub use numeric::number::{Number, Real};
pub use numeric::simd::{LaneTask, in_lanes, with_processor_instructions};
pub use simulate::along_motion::GivenMotion;
pub use simulate::run::Run;
pub use simulate::side_by_side::simulate_side_by_side;
