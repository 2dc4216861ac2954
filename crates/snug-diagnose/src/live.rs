//! Models tried by hand: one set of effects after the other, each fitted from where the one before ended, and told step by step.

pub(crate) mod by_hand;
pub(crate) mod cases;
pub(crate) mod fit;
pub(crate) mod focus;
pub(crate) mod held_out;
pub(crate) mod promise;
pub(crate) mod signature;
pub(crate) mod step;
pub(crate) mod tightening;
pub(crate) mod what_is_left;

#[cfg(test)]
mod tests;
