//! The memory that reading one file may take.

mod machine;

use crate::IngestError;
use std::cell::{Cell, RefCell};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread::available_parallelism;

/// Bytes of the unit in which the setting is given \[bytes/MB\].
const BYTES_PER_MB: u64 = 1_000_000;

/// Without a setting a file gets this part of what the machine has to give: a large file may be read while the others
/// together hold as much again, and what was read before has to stay.
const PART_OF_MACHINE: u64 = 4;

/// The default is never less \[MB\]: the largest file of a thesis takes 20.
const LEAST_MB: u64 = 64;

/// The default is never more \[MB\]: an hour of four channels at 100 kHz takes 12,000 with its text.
const MOST_MB: u64 = 16_000;

/// The default where the machine does not say what it has \[MB\].
const UNKNOWN_MACHINE_MB: u64 = 1_000;

/// What a short list on the heap takes beside its elements: the allocator's own bookkeeping and rounding \[bytes\].
pub(crate) const ALLOCATION_BYTES: u64 = 32;

/// Held by the one file that may be in memory beyond its share.
static LARGE_FILE: Mutex<()> = Mutex::new(());

/// What one file may still ask for. Everything that is made of it is taken from here before it is asked of the system.
///
/// As many files as the machine has processors share the budget. A file that goes beyond its share waits until no other
/// one is beyond its own, so that all together never hold more than twice the budget, and whether a file can be read
/// does not depend on what is read beside it.
#[derive(Debug)]
pub(crate) struct Budget {
    budget_bytes: u64,
    share_bytes: u64,
    used_bytes: Cell<u64>,
    large: RefCell<Option<MutexGuard<'static, ()>>>,
}

impl Budget {
    /// The setting's, or what the machine has to give.
    pub(crate) fn new(memory_mb: Option<u32>) -> Self {
        match memory_mb {
            Some(memory_mb) => Self::of(u64::from(memory_mb) * BYTES_PER_MB),
            None => Self::of(default_bytes()),
        }
    }

    fn of(budget_bytes: u64) -> Self {
        let readers = available_parallelism().map_or(1, |count| count.get() as u64);
        Self {
            budget_bytes,
            share_bytes: budget_bytes / readers,
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
        if needed_bytes > self.share_bytes {
            self.large
                .borrow_mut()
                // The lock guards nothing that a panic could leave half done.
                .get_or_insert_with(|| LARGE_FILE.lock().unwrap_or_else(PoisonError::into_inner));
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
        self.used_bytes
            .set(self.used_bytes.get().saturating_sub(bytes));
    }

    /// What is taken now; [`Budget::back_to`] gives back whatever was taken since.
    pub(crate) fn mark(&self) -> u64 {
        self.used_bytes.get()
    }

    pub(crate) fn back_to(&self, mark: u64) {
        self.used_bytes.set(mark.min(self.used_bytes.get()));
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
    fn large_files_wait_for_each_other_and_small_ones_do_not() {
        let large = Budget::new(Some(100));
        large.spend("all", 100_000_000).expect("fits");
        std::thread::scope(|scope| {
            let small = scope.spawn(|| Budget::new(Some(100)).spend("little", 1000).is_ok());
            assert!(small.join().expect("no panic"));
            let other = scope.spawn(|| Budget::new(Some(100)).spend("all", 100_000_000).is_ok());
            drop(large);
            assert!(other.join().expect("no panic"));
        });
    }
}
