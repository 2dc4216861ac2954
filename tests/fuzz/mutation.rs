//! Bytes changed at random, as disks, networks and hostile people change them.

use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng, rngs::StdRng};

/// A source of mutated inputs; the same seed gives the same ones.
pub struct Mutation {
    pub random: StdRng,
    corpus: Vec<Vec<u8>>,
}

/// Numbers at which programs go wrong.
const NUMBERS: [u64; 14] = [
    0,
    1,
    7,
    8,
    0x7f,
    0x80,
    0xff,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_fff8,
    0xffff_ffff,
    0x7fff_ffff_ffff_ffff,
    u64::MAX,
];
/// Words at which readers of text go wrong.
const WORDS: [&str; 24] = [
    "nan",
    "inf",
    "-inf",
    "1e309",
    "-0",
    "1e-400",
    "0x1p3",
    "9007199254740993",
    "\"",
    "\"\"",
    "'",
    "\n",
    "\r\n",
    "\t",
    ";",
    ",",
    "(",
    ")",
    "[",
    "]",
    "Some(",
    "/*",
    "\u{feff}",
    "\u{0}",
];

impl Mutation {
    pub fn new(seed: u64, corpus: Vec<Vec<u8>>) -> Self {
        let random = StdRng::seed_from_u64(seed);
        Self { random, corpus }
    }

    /// One of the inputs to start from.
    pub fn start(&mut self) -> Vec<u8> {
        self.corpus
            .choose(&mut self.random)
            .expect("there is a corpus")
            .clone()
    }

    /// An input with some of its bytes changed.
    pub fn bytes(&mut self) -> Vec<u8> {
        let mut input = self.start();
        self.change(&mut input);
        input
    }

    /// Changes a few places.
    pub fn change(&mut self, input: &mut Vec<u8>) {
        for _ in 0..1 << self.random.random_range(0..5) {
            self.change_one(input);
        }
    }

    fn place(&mut self, input: &[u8]) -> usize {
        self.random.random_range(0..=input.len())
    }

    fn stretch(&mut self, input: &[u8]) -> std::ops::Range<usize> {
        let start = self.place(input);
        let length = 1 << self.random.random_range(0..10);
        start..(start + self.random.random_range(0..=length)).min(input.len())
    }

    fn change_one(&mut self, input: &mut Vec<u8>) {
        let at = self.place(input);
        match self.random.random_range(0..10) {
            0 => {
                if let Some(byte) = input.get_mut(at) {
                    *byte ^= 1 << self.random.random_range(0..8);
                }
            }
            1 => {
                if let Some(byte) = input.get_mut(at) {
                    *byte = self.random.random();
                }
            }
            2 | 3 => self.put_number(input, at),
            4 => {
                let range = self.stretch(input);
                input.drain(range);
            }
            5 => {
                let range = self.stretch(input);
                let copied = input[range].to_vec();
                input.splice(at..at, copied);
            }
            6 => {
                let other = self.start();
                let range = self.stretch(&other);
                input.splice(at..at, other[range].iter().copied());
            }
            7 => {
                let word = WORDS.choose(&mut self.random).expect("there are words");
                let end = self.stretch(input).len().min(4) + at;
                input.splice(at..end.min(input.len()), word.bytes());
            }
            8 => {
                let range = self.stretch(input);
                let byte = *[0, 0xff, b' ', self.random.random()]
                    .choose(&mut self.random)
                    .expect("four");
                input[range].fill(byte);
            }
            _ => {
                if self.random.random_range(0..4) == 0 {
                    input.truncate(at);
                }
            }
        }
    }

    /// A telling number of 1 to 8 bytes in either order, or the one that stands there and a little.
    fn put_number(&mut self, input: &mut [u8], at: usize) {
        let width = *[1, 2, 4, 8].choose(&mut self.random).expect("four");
        let Some(place) = input.get_mut(at..at + width) else {
            return;
        };
        let mut bytes = [0; 8];
        bytes[..width].copy_from_slice(place);
        let stands = u64::from_le_bytes(bytes);
        let number = match self.random.random_bool(0.5) {
            true => *NUMBERS.choose(&mut self.random).expect("there are numbers"),
            false => stands
                .wrapping_add(self.random.random_range(0..32))
                .wrapping_sub(16),
        };
        let bytes = number.to_le_bytes();
        place.copy_from_slice(&bytes[..width]);
        if self.random.random_bool(0.2) {
            place.reverse();
        }
    }
}
