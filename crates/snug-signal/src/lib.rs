//! Signals: values between samples, spectra, periodograms, responses from one to another, noise level; no domain.
#![doc = include_str!("../README.md")]

mod finite;
mod interpolation;
mod noise;
mod periodogram;
mod spectrum;
mod transfer;
mod trend;

pub use finite::first_not_finite;
pub use interpolation::{between_samples, straight_pieces};
pub use noise::white_noise_level;
pub use periodogram::Periodogram;
pub use realfft::num_complex::Complex;
pub use spectrum::spectrum;
pub use transfer::{Taper, Transfer, TransferLine};
pub use trend::without_trend;
