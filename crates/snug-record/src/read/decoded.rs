//! What every decoder of messages makes of one.

use super::budget::Budget;

/// What came of decoding one message; reasons are fixed sentences, so that equal ones are counted together.
pub(super) type Decoded = Result<(), &'static str>;

/// Arrays are spread out element by element up to this length; longer ones (images, point clouds) are no signal.
pub(super) const LONGEST_ARRAY: usize = 256;

/// Why an array was left out.
pub(super) const ARRAY_TOO_LONG: &str = "an array is longer than 256 elements and was left out";

/// Why reading stops: a schema can ask for much work on few bytes.
pub(super) const WORK_SPENT: &str = "the messages ask for too much work";

/// Longest schema that is understood \[bytes\].
pub(super) const LONGEST_SCHEMA_BYTES: usize = 4 << 20;
/// Longest name of a type or field within a schema \[bytes\]; it is repeated in every path below it.
pub(super) const LONGEST_NAME_BYTES: usize = 1024;
/// Most types and fields of one schema, all together.
pub(super) const MOST_DECLARED: usize = 1 << 16;

/// Pays for looking at fields.
pub(super) fn work(budget: &mut Budget, steps: usize) -> Decoded {
    budget.spend(steps as u64).map_err(|_| WORK_SPENT)
}
