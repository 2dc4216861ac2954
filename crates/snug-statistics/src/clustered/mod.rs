//! Tests for rows that come in clusters (repeats of one participant) and are not independent.
//!
//! Which one: [`fit_random_intercept`] when clusters differ in level only; [`fit_cluster_robust`]
//! when they may also differ in how they respond, or in spread; [`permutation_test`] when nothing
//! is to be presumed about the distribution. With few clusters the first is the most powerful and
//! trusts its model most.

mod arrangements;
mod cluster_robust;
mod contrast;
mod design;
mod mixed_model;
mod orthonormal;
mod partition;
mod permutation;
mod permutation_settings;
mod spectrum;

pub use cluster_robust::{ClusterRobustFit, fit_cluster_robust};
pub use design::Design;
pub use mixed_model::{RandomInterceptFit, fit_random_intercept};
pub use permutation::{PermutationTest, Scheme, permutation_test};
pub use permutation_settings::PermutationSettings;
