//! The memory that reading one file may take.

mod machine;

use crate::error::IngestError;
use std::cell::{Cell, RefCell};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// Bytes of the unit in which the setting is given \[bytes/MB\].
const BYTES_PER_MB: u64 = 1_000_000;

/// Without a setting a file gets this part of what the machine has to give: a large file and the others together take
/// two of them, and what was read before, and is worked on, has to stay.
const PART_OF_MACHINE: u64 = 4;

/// The default is never less \[MB\]: the practice files, 0.9 MB compressed, take 3, so that one twenty times as long still
/// fits.
const LEAST_MB: u64 = 64;

/// The default is never more \[MB\]: an hour of four channels at 100 kHz is 11,520 of doubles.
const MOST_MB: u64 = 16_000;

/// The default where the machine does not say what it has \[MB\].
const UNKNOWN_MACHINE_MB: u64 = 1_000;

/// What a short list on the heap takes beside its elements: the allocator's own bookkeeping and rounding \[bytes\].
pub(crate) const ALLOCATION_BYTES: u64 = 32;

/// What all files together take that are read at the moment, but for the large one \[bytes\].
static SHARED_BYTES: AtomicU64 = AtomicU64::new(0);

/// Held by the large file: the one for which there was no room beside the others.
static LARGE_FILE: Mutex<()> = Mutex::new(());

/// What one file may still ask for. Everything that is made of it is taken from here before it is asked of the system.
///
/// All files that are read at the same time share one budget. A file that finds no room in what the others leave waits
/// until no other such one is read, and then has a budget of its own. So all together never take more than twice the
/// budget, and whether a file can be read does not depend on what is read beside it.
#[derive(Debug)]
pub(crate) struct Budget {
    budget_bytes: u64,
    used_bytes: Cell<u64>,
    large: RefCell<Option<MutexGuard<'static, ()>>>,
}

impl Budget {
    /// The setting's, or what the machine has to give.
    pub(crate) fn new(memory_mb: Option<u32>) -> Self {
        Self {
            budget_bytes: memory_mb.map_or_else(default_bytes, |memory_mb| {
                u64::from(memory_mb) * BYTES_PER_MB
            }),
            used_bytes: Cell::new(0),
            large: RefCell::new(None),
        }
    }

    /// Takes from the budget; `what` names in the error what the memory is for.
    pub(crate) fn spend(&self, what: &'static str, bytes: u64) -> Result<(), IngestError> {
        let needed_bytes = self.used_bytes.get().saturating_add(bytes);
        if needed_bytes > self.budget_bytes {
            return Err(IngestError::OverBudget {
                what,
                needed_bytes,
                budget_bytes: self.budget_bytes,
            });
        }
        let mut large = self.large.borrow_mut();
        if large.is_none() {
            let shared_bytes = SHARED_BYTES.fetch_add(bytes, Ordering::Relaxed) + bytes;
            if shared_bytes > self.budget_bytes {
                SHARED_BYTES.fetch_sub(bytes, Ordering::Relaxed);
                // The lock guards nothing that a panic could leave half done.
                *large = Some(LARGE_FILE.lock().unwrap_or_else(PoisonError::into_inner));
                SHARED_BYTES.fetch_sub(self.used_bytes.get(), Ordering::Relaxed);
            }
        }
        self.used_bytes.set(needed_bytes);
        Ok(())
    }

    /// Takes room for `count` elements of a type.
    pub(crate) fn spend_on<T>(&self, what: &'static str, count: usize) -> Result<(), IngestError> {
        self.spend(what, (count as u64).saturating_mul(size_of::<T>() as u64))
    }

    /// Gives back what was only needed on the way.
    pub(crate) fn give_back(&self, bytes: u64) {
        self.back_to(self.used_bytes.get().saturating_sub(bytes));
    }

    /// What may still be taken.
    #[cfg(feature = "mcap")]
    pub(crate) fn left_bytes(&self) -> u64 {
        self.budget_bytes.saturating_sub(self.used_bytes.get())
    }

    /// What is taken now; [`Budget::back_to`] gives back whatever was taken since.
    pub(crate) fn mark(&self) -> u64 {
        self.used_bytes.get()
    }

    pub(crate) fn back_to(&self, mark: u64) {
        let used_bytes = self.used_bytes.get();
        let kept_bytes = mark.min(used_bytes);
        if self.large.borrow().is_none() {
            SHARED_BYTES.fetch_sub(used_bytes - kept_bytes, Ordering::Relaxed);
        }
        self.used_bytes.set(kept_bytes);
    }

    /// An empty list with room for `capacity` elements, taken from the budget.
    pub(crate) fn list<T>(
        &self,
        what: &'static str,
        capacity: usize,
    ) -> Result<Vec<T>, IngestError> {
        self.spend_on::<T>(what, capacity)?;
        let mut list = Vec::new();
        match list.try_reserve_exact(capacity) {
            Ok(()) => Ok(list),
            // The system has less than it said.
            Err(_) => Err(IngestError::OverBudget {
                what,
                needed_bytes: self.used_bytes.get(),
                budget_bytes: self.budget_bytes,
            }),
        }
    }

    /// Puts one more element behind a list, whose room grows by doubling.
    pub(crate) fn push<T>(
        &self,
        what: &'static str,
        list: &mut Vec<T>,
        element: T,
    ) -> Result<(), IngestError> {
        if list.len() == list.capacity() {
            let old = list.capacity();
            let mut larger = self.list(what, (2 * old).max(64))?;
            larger.append(list);
            *list = larger;
            self.give_back((old * size_of::<T>()) as u64);
        }
        list.push(element);
        Ok(())
    }
}

impl Drop for Budget {
    fn drop(&mut self) {
        self.back_to(0);
    }
}

/// Found once, so that no file's fate depends on what others hold when it is read.
fn default_bytes() -> u64 {
    static DEFAULT_BYTES: OnceLock<u64> = OnceLock::new();
    *DEFAULT_BYTES.get_or_init(|| {
        machine::available_bytes().map_or(UNKNOWN_MACHINE_MB * BYTES_PER_MB, |available| {
            (available / PART_OF_MACHINE).clamp(LEAST_MB * BYTES_PER_MB, MOST_MB * BYTES_PER_MB)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_given_back_can_be_taken_again() {
        let budget = Budget::new(Some(1));
        budget.spend("a", 600_000).expect("fits");
        let error = budget.spend("b", 600_000).expect_err("does not fit");
        assert_eq!(error.code(), "over_budget");
        assert!(error.to_string().contains("source.memory_mb"), "{error}");
        budget.give_back(600_000);
        let mark = budget.mark();
        budget.spend("c", 1_000_000).expect("all of it");
        budget.back_to(mark);
        assert!(budget.list::<u64>("d", 125_001).is_err());
        assert!(budget.list::<u64>("d", 125_000).is_ok());
    }

    #[test]
    fn lists_grow_within_the_budget() {
        let budget = Budget::new(Some(1));
        let mut list = Vec::new();
        let fitted = (0..1_000_000_u64)
            .take_while(|&number| budget.push("list", &mut list, number).is_ok())
            .count();
        assert_eq!(fitted, list.len());
        assert!((31_250..=125_000).contains(&fitted), "{fitted}");
    }

    #[test]
    fn the_default_fits_this_machine() {
        let bytes = default_bytes();
        assert!((LEAST_MB * BYTES_PER_MB..=MOST_MB * BYTES_PER_MB).contains(&bytes));
    }

    #[test]
    fn at_most_two_large_files_are_read_at_once() {
        let (reading, most) = (AtomicU64::new(0), AtomicU64::new(0));
        std::thread::scope(|scope| {
            for _ in 0..6 {
                scope.spawn(|| {
                    let budget = Budget::new(Some(100));
                    budget
                        .spend("all", 100_000_000)
                        .expect("fits, now or later");
                    let now = reading.fetch_add(1, Ordering::SeqCst) + 1;
                    most.fetch_max(now, Ordering::SeqCst);
                    std::thread::sleep(std::time::Duration::from_millis(5));
                    reading.fetch_sub(1, Ordering::SeqCst);
                });
            }
        });
        assert!((1..=2).contains(&most.into_inner()));
    }
}
