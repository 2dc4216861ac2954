//! Every way in which labels could have fallen to clusters, or a sample of the ways: what a permutation test counts.

use rand::seq::SliceRandom;

use super::permutation_settings::PermutationSettings;

/// Units whose labels may be exchanged with each other.
pub(super) struct Block {
    /// One value per unit; over all blocks they sum to zero.
    pub values: Vec<f64>,
    /// The label each unit bears.
    pub labels: Vec<usize>,
}

/// Sum of squares between labels of values whose grand mean is zero.
pub(super) fn between_labels(blocks: &[Block], labels: usize) -> f64 {
    let mut sums = vec![(0.0, 0.0); labels];
    for block in blocks {
        for (value, label) in block.values.iter().zip(&block.labels) {
            sums[*label].0 += value;
            sums[*label].1 += 1.0;
        }
    }
    sums.iter().map(|(sum, count)| sum * sum / count).sum()
}

/// How many arrangements reached the observed statistic.
pub(super) struct Outcome {
    /// Arrangements that reached it.
    pub reached: usize,
    /// Arrangements tried.
    pub arrangements: usize,
    /// Whether these were all there are.
    pub exact: bool,
}

impl Outcome {
    /// Share that reached it; random arrangements have the observed one added.
    pub fn p(&self) -> f64 {
        let observed = if self.exact { 0.0 } else { 1.0 };
        (self.reached as f64 + observed) / (self.arrangements as f64 + observed)
    }
}

/// Tries all arrangements, or random ones when there are too many.
pub(super) fn run(
    blocks: &mut [Block],
    labels: usize,
    bar: f64,
    settings: &PermutationSettings,
) -> Outcome {
    let total: f64 = blocks
        .iter()
        .map(|block| arrangements(block, labels))
        .product();
    let reaches = |blocks: &[Block]| usize::from(between_labels(blocks, labels) >= bar);
    if total <= settings.exact_limit as f64 {
        blocks
            .iter_mut()
            .for_each(|block| block.labels.sort_unstable());
        let mut outcome = Outcome {
            reached: 0,
            arrangements: 0,
            exact: true,
        };
        loop {
            outcome.reached += reaches(blocks);
            outcome.arrangements += 1;
            // An odometer: the first block that has a next arrangement moves on.
            if !blocks
                .iter_mut()
                .any(|block| next_arrangement(&mut block.labels))
            {
                return outcome;
            }
        }
    }
    let mut generator = settings.generator();
    let mut reached = 0;
    for _ in 0..settings.permutations {
        blocks
            .iter_mut()
            .for_each(|block| block.labels.shuffle(&mut generator));
        reached += reaches(blocks);
    }
    Outcome {
        reached,
        arrangements: settings.permutations,
        exact: false,
    }
}

/// Number of distinct arrangements of a block's labels, as a float that may be huge.
fn arrangements(block: &Block, labels: usize) -> f64 {
    let mut seen = vec![0.0; labels];
    let mut count = 1.0;
    for (position, label) in block.labels.iter().enumerate() {
        seen[*label] += 1.0;
        count *= (position + 1) as f64 / seen[*label];
    }
    count
}

/// The next arrangement in lexicographic order; after the last, the first again and `false`.
fn next_arrangement(labels: &mut [usize]) -> bool {
    let Some(pivot) = labels.windows(2).rposition(|pair| pair[0] < pair[1]) else {
        labels.reverse();
        return false;
    };
    let successor = labels
        .iter()
        .rposition(|label| *label > labels[pivot])
        .expect("the entry after the pivot is larger");
    labels.swap(pivot, successor);
    labels[pivot + 1..].reverse();
    true
}
