//! Thresholds of fits that share parameters. Damping is relative to the reduced curvature of the shared ones.
//! Each stands once, with its unit and how it was found: "chosen" is chosen, not measured.

/// Members that are handed over together: so many can stand side by side in the widest vector registers.
pub(crate) const TOGETHER: usize = 8;
/// Damping beyond which a fit is stuck \[–\]. Chosen.
pub(crate) const POOLED_MOST_DAMPING: f64 = 1e12;
/// Damping of the first step \[–\]. Chosen, as is usual (Marquardt).
pub(crate) const INITIAL_DAMPING: f64 = 1e-3;
/// Damping that cannot be told from none \[–\]. Chosen.
pub(crate) const LEAST_DAMPING: f64 = 1e-15;
/// Where damping that was as good as none begins to grow again \[–\]. Chosen.
pub(crate) const POOLED_FIRST_DAMPING: f64 = 1e-8;
/// Steps in a row that hardly lower the cost after which a fit has arrived. Where the residual bends sharply, as at the
/// edge of a gap, every step predicts more than it keeps, and a fit would creep on for hundreds of simulations. Chosen.
pub(crate) const MOST_IDLE_STEPS: usize = 3;
/// Steps of α after which members' active sets are taken as they are: they shape that step, which in turn may change them. Chosen.
pub(crate) const MOST_PASSES: usize = 4;
