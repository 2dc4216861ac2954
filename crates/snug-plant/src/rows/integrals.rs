//! Motion that is the trapezoid sum of what was measured is not stored: it is made again, with the same bits.

use snug_campaign::{Motion, Quantity};
use snug_preprocess::cumulative_trapezoid;

/// From a quantity, those below it.
const CHAINS: [(Quantity, &[Quantity]); 2] = [
    (
        Quantity::Acceleration,
        &[Quantity::Velocity, Quantity::Displacement],
    ),
    (Quantity::Velocity, &[Quantity::Displacement]),
];

/// The quantity of which those below are the trapezoid sums, to the bit; `None` where none is.
pub(super) fn integrated_from(motion: &Motion, interval_s: f64) -> Option<Quantity> {
    let is_sum = |(from, below): &(Quantity, &[Quantity])| {
        let Some(measured) = motion.get(*from) else {
            return false;
        };
        let mut above = measured.to_vec();
        below.iter().all(|quantity| {
            above = cumulative_trapezoid(&above, interval_s);
            motion
                .get(*quantity)
                .is_some_and(|stored| same_bits(stored, &above))
        })
    };
    CHAINS
        .iter()
        .find(|chain| is_sum(chain))
        .map(|(from, _)| *from)
}

/// Whether the motion called `quantity` follows from `from`.
pub(super) fn follows(from: Option<Quantity>, quantity: Quantity) -> bool {
    CHAINS
        .iter()
        .any(|(known, below)| Some(*known) == from && below.contains(&quantity))
}

/// Makes again what follows from `from`.
pub(super) fn complete(motion: &mut Motion, from: Quantity, interval_s: f64) {
    let Some((_, below)) = CHAINS.iter().find(|(known, _)| *known == from) else {
        return;
    };
    let mut above = from;
    for quantity in *below {
        let Some(samples) = motion.get(above) else {
            return;
        };
        let integral = cumulative_trapezoid(samples, interval_s);
        motion.set(*quantity, integral);
        above = *quantity;
    }
}

fn same_bits(one: &[f64], other: &[f64]) -> bool {
    one.len() == other.len()
        && one
            .iter()
            .zip(other)
            .all(|(a, b)| a.to_bits() == b.to_bits())
}
