//! Random streams: every draw belongs to a named place, so that one draw more or less elsewhere changes nothing.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// What a stream of random numbers is for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stream {
    /// A participant's own hand–arm, by participant number.
    Person(u32),
    /// One tightening's hand–arm and pulse.
    Tightening { file: usize, index: usize },
    /// One tightening's sensor noise.
    Noise { file: usize, index: usize },
    /// One tightening's nuisances: bias, vibration.
    Nuisance { file: usize, index: usize },
    /// One tightening's share of the hidden effects.
    Effect { file: usize, index: usize },
}

impl Stream {
    fn number(self) -> u64 {
        let place = |kind: u64, file: usize, index: usize| {
            (kind << 56) | ((file as u64) << 24) | index as u64
        };
        match self {
            Self::Person(number) => place(1, 0, number as usize),
            Self::Tightening { file, index } => place(2, file, index),
            Self::Noise { file, index } => place(3, file, index),
            Self::Nuisance { file, index } => place(4, file, index),
            Self::Effect { file, index } => place(5, file, index),
        }
    }

    /// The generator of this stream under `seed`.
    pub(crate) fn rng(self, seed: u64) -> ChaCha8Rng {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(self.number());
        rng
    }
}
