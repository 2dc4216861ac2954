//! Random streams: every draw belongs to a named place, so that one draw more or less elsewhere changes nothing.

pub(crate) mod noise;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// What a stream of random numbers is for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stream {
    /// A participant's own hand–arm, by participant number in file 0.
    Person = 1,
    /// One tightening's hand–arm and pulse.
    Tightening = 2,
    /// One tightening's sensor noise.
    Noise = 3,
    /// One tightening's nuisances: bias, vibration.
    Nuisance = 4,
    /// One tightening's share of the hidden effects.
    Effect = 5,
}

impl Stream {
    /// The generator of this stream under `seed`, for the tightening of this file and index.
    pub(crate) fn rng(self, seed: u64, file: usize, index: usize) -> ChaCha8Rng {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(((self as u64) << 56) | ((file as u64) << 24) | index as u64);
        rng
    }
}
