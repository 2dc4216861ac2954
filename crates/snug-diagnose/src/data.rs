//! The tightenings of a question, the work done with them and who watches it, and how they stand side by side; what is noise.

pub(crate) mod cases;
pub(crate) mod clusters;
pub(crate) mod follower;
pub(crate) mod machine;
pub(crate) mod neighbours;
pub(crate) mod power;
pub(crate) mod simulation;
pub(crate) mod thresholds;
pub(crate) mod watch;
pub(crate) mod white_noise;
