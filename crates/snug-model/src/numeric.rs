//! What laws compute with: numbers with derivatives, many side by side in the registers of the processor at hand.

pub(crate) mod arithmetic;
pub(crate) mod dual;
pub(crate) mod elementary;
#[cfg(test)]
pub(crate) mod even_noise;
pub(crate) mod lanewise;
pub(crate) mod matrix_exponential;
pub(crate) mod number;
pub(crate) mod simd;
