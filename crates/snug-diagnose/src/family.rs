//! Family-wise p: how often the largest statistic of all candidates reaches as far when whole units flip their sign
//! (Westfall and Young's max-T).

use crate::score::Column;
use rand::{RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;
use snug_model::Effect;

/// Sign flips of the units, the same for all columns.
pub(crate) struct Family {
    /// Largest statistic over all columns of each flip, ascending.
    largest: Vec<f64>,
    columns: usize,
}

impl Family {
    pub fn new(columns: &[Column], flips: usize, seed: u64) -> Self {
        let units = columns.first().map_or(0, |column| column.scores.len());
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut signs = vec![1.0; units];
        let mut largest = vec![0.0_f64; flips];
        let shared: Vec<&Column> = columns.iter().filter(|column| !column.is_own()).collect();
        for largest in &mut largest {
            for chunk in signs.chunks_mut(64) {
                let bits = random.next_u64();
                for (index, sign) in chunk.iter_mut().enumerate() {
                    *sign = if bits >> index & 1 == 1 { 1.0 } else { -1.0 };
                }
            }
            for column in &shared {
                *largest = largest.max(column.flipped_statistic(&signs));
            }
        }
        largest.sort_by(f64::total_cmp);
        Self {
            largest,
            columns: columns.len(),
        }
    }

    /// The p of one effect: its best column against the largest of the family.
    pub fn p(&self, columns: &[Column], effect: Effect) -> f64 {
        let own = columns.iter().filter(|column| column.effect == effect);
        own.map(|column| match column.chance_p() {
            // Sizes of their own have no common sign to flip: their energy against the noise, every column counted.
            Some(p) => (p * self.columns as f64).min(1.0),
            None => {
                let statistic = column.statistic();
                let below = self.largest.partition_point(|largest| *largest < statistic);
                (self.largest.len() - below + 1) as f64 / (self.largest.len() + 1) as f64
            }
        })
        .fold(1.0, f64::min)
    }
}
