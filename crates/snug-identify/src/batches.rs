//! Many tightenings in batches of as many as are worth identifying at a time, on all threads.

use rayon::prelude::*;

/// Tightenings of one batch: more than the widest vector registers hold, since fits end one by one, and few enough to be shared
/// out among threads.
pub const SIDE_BY_SIDE: usize = 16;

/// Does `work` with batch after batch of `items`; what comes of each item, in their order.
///
/// # Errors
/// The first that `work` gives.
pub fn in_batches<T: Sync, R: Send, E: Send>(
    items: &[T],
    work: impl Fn(&[T]) -> Result<Vec<R>, E> + Sync,
) -> Result<Vec<R>, E> {
    let done: Vec<Vec<R>> = (items.par_chunks(SIDE_BY_SIDE))
        .map(&work)
        .collect::<Result<_, E>>()?;
    Ok(done.into_iter().flatten().collect())
}
