//! How many arrangements a permutation test looks at, and from which seed.

use crate::{Result, StatisticsError};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

/// Settings of [`super::permutation_test`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PermutationSettings {
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
