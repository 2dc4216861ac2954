//! What a first-order lag keeps, also as its time constant goes to nothing.

use crate::numeric::lanewise::Lanewise;
use crate::numeric::number::Number;

/// τ over a time below which exp(−t/τ) is zero in double precision.
const NEGLIGIBLE_RATIO: f64 = 1e-3;

/// exp(−`steps`/`ratio`): what is left of a deviation after so many steps, of which τ is `ratio`.
#[inline(always)]
pub fn left_after<N: Number>(steps: f64, ratio: N) -> N {
    let value = ratio.value();
    let slow = value.is_above(value.constant(steps * NEGLIGIBLE_RATIO));
    let left = (ratio.constant(-steps) / ratio).exp();
    N::select(slow, left, ratio.constant(0.0))
}
