//! One at a time for the same thing: whoever asks for what another is just making waits and finds it made.

use std::sync::{Arc, Mutex, Weak};

/// Who is making what.
pub(crate) struct Turns<K>(Mutex<Vec<(K, Weak<Mutex<()>>)>>);

impl<K> Default for Turns<K> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: Clone + PartialEq> Turns<K> {
    /// The lock of a thing; while somebody holds it, that is being made.
    pub fn of(&self, key: &K) -> Arc<Mutex<()>> {
        let mut all = super::locked(&self.0);
        all.retain(|(_, turn)| turn.strong_count() > 0);
        let known = all.iter().find(|(known, _)| known == key);
        if let Some(turn) = known.and_then(|(_, turn)| turn.upgrade()) {
            return turn;
        }
        let turn = Arc::default();
        all.push((key.clone(), Arc::downgrade(&turn)));
        turn
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_thing_has_one_lock_for_as_long_as_somebody_wants_it() {
        let turns = Turns::default();
        let (first, second, other) = (turns.of(&1), turns.of(&1), turns.of(&2));
        assert!(Arc::ptr_eq(&first, &second) && !Arc::ptr_eq(&first, &other));
        drop((first, second, other));
        turns.of(&3);
        assert_eq!(super::super::locked(&turns.0).len(), 1);
    }
}
