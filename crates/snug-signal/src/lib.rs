#![doc = include_str!("../README.md")]

mod interpolation;
mod noise;
mod periodogram;

pub use interpolation::{between_samples, straight_pieces};
pub use noise::white_noise_level;
pub use periodogram::Periodogram;
