use crate::{Result, StatisticsError};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

/// What is exchanged in [`super::permutation_test`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scheme {
    /// Within clusters when any cluster holds more than one label, else between clusters.
    #[default]
    Automatic,
    /// Labels are exchanged among the rows of each cluster.
    WithinClusters,
    /// Labels are exchanged among whole clusters.
    BetweenClusters,
}

/// Settings of [`super::permutation_test`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PermutationSettings {
    /// What is exchanged. Default: automatic.
    pub scheme: Scheme,
    /// Random arrangements when there are too many to try all. Default: 9999.
    pub permutations: usize,
    /// Up to this many arrangements, all of them are tried instead. Default: 20000.
    pub exact_limit: usize,
    /// Seed of the random arrangements. Default: 1.
    pub seed: u64,
}

impl Default for PermutationSettings {
    fn default() -> Self {
        Self {
            scheme: Scheme::Automatic,
            permutations: 9999,
            exact_limit: 20_000,
            seed: 1,
        }
    }
}

impl PermutationSettings {
    /// The generator of the random arrangements.
    pub(super) fn generator(&self) -> ChaCha8Rng {
        ChaCha8Rng::seed_from_u64(self.seed)
    }

    pub(super) fn check(&self) -> Result<()> {
        if self.permutations == 0 {
            return Err(StatisticsError::OutOfRange {
                argument: "permutations",
                value: 0.0,
                allowed: "at least 1",
            });
        }
        Ok(())
    }
}
