//! What every candidate would explain: score test, refit, gain on tightenings that took no part, against chance.

pub(crate) mod applicability;
pub(crate) mod by_group;
mod by_time;
pub(crate) mod first_ranking;
pub(crate) mod free_run;
mod in_place_of_damping;
pub(crate) mod kin;
pub(crate) mod max_t;
pub(crate) mod nuisance;
pub(crate) mod paired_gain;
pub(crate) mod pairs;
pub(crate) mod rank;
pub(crate) mod refit;
pub(crate) mod resonances;
mod score_of_groups;
pub(crate) mod score_test;
pub(crate) mod sensitivity;
mod shows;
mod simulable;
pub(crate) mod thresholds;
pub(crate) mod wavelengths;
mod where_it_shows;
