//! `y = Xβ + b_cluster + e` with `b ~ N(0, σ_b²)` and `e ~ N(0, σ²)`, by restricted maximum
//! likelihood.
//!
//! The ratio `θ = σ_b²/σ²` is the only unknown that is searched; β and σ² follow in closed form
//! (Harville 1977). All sums over rows are taken once, split into within and between clusters,
//! so that one evaluation costs `O(clusters · coefficients²)`.

mod cluster_moments;
mod fit;
mod likelihood;

pub use fit::{RandomInterceptFit, fit_random_intercept};
