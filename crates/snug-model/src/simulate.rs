//! The equations of motion with their effects, stepped, seen by sensors, for many tightenings at a time.

pub(crate) mod accelerometer;
pub(crate) mod acting_torque;
mod actuator;
pub(crate) mod along_motion;
pub(crate) mod dry_friction;
mod first_order;
pub(crate) mod history;
pub(crate) mod hook_set;
pub(crate) mod model;
pub(crate) mod plant;
pub(crate) mod record;
pub(crate) mod response;
pub(crate) mod run;
pub(crate) mod runge_kutta;
pub(crate) mod sensors;
pub(crate) mod side_by_side;
pub(crate) mod zeroed;
