//! Comparing any number of independent samples.

mod anova;
mod kruskal_wallis;
mod welch_anova;

pub use anova::{OneWayAnova, one_way_anova};
pub use kruskal_wallis::{KruskalWallis, kruskal_wallis};
pub use welch_anova::welch_anova;
