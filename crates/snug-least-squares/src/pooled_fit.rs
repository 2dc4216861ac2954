//! Many least-squares problems that share some parameters: minimise Σ_i ½‖r_i(β_i, α)‖² over every β_i and the one α.
//!
//! The Jacobian is a block arrow. With R_i the triangular factor of [∂r_i/∂β_i, ∂r_i/∂α] in the directions that β_i may
//! take, its last rows are the sensitivity to α that β_i cannot imitate; stacked over i they give the step in α, and
//! back-substitution gives every β_i's. Work and memory grow linearly with the number of members.

pub(crate) mod member;
pub(crate) mod problem;
pub(crate) mod solve;
pub(crate) mod thresholds;
