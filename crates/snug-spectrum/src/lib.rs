#![doc = include_str!("../README.md")]

mod interpolation;
mod periodogram;

pub use interpolation::{between_samples, straight_pieces};
pub use periodogram::Periodogram;
