//! What was worked out and may be asked for again, by the models it is of.

pub(crate) mod fits;
pub(crate) mod looks;
pub(crate) mod results;
pub(crate) mod turns;
pub(crate) mod workers;

use std::sync::{Mutex, MutexGuard, PoisonError};

/// What nobody can leave in disorder: every change of it is one assignment.
pub(crate) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
