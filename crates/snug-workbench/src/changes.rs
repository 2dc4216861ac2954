//! Sets of effects, and the way from one to the other that can be gone back.

/// Effects by name, in the order in which they came in; two are the same model if they hold the same names.
#[derive(Debug, Clone, Default)]
pub(crate) struct EffectSet(Vec<String>);

impl EffectSet {
    /// Each name once.
    pub fn of<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        let mut set = Vec::new();
        for name in names
            .into_iter()
            .map(str::trim)
            .filter(|name| !name.is_empty())
        {
            if !set.iter().any(|known| known == name) {
                set.push(name.to_owned());
            }
        }
        Self(set)
    }

    /// As an address has them, separated by commas.
    pub fn from_address(text: &str) -> Self {
        Self::of(text.split(','))
    }

    pub fn names(&self) -> &[String] {
        &self.0
    }

    pub fn has(&self, name: &str) -> bool {
        self.0.iter().any(|known| known == name)
    }

    /// By how many effects the two differ.
    pub fn distance(&self, other: &Self) -> usize {
        self.beyond(other).count() + other.beyond(self).count()
    }

    /// All but this one.
    pub fn without(&self, name: &str) -> Self {
        Self::of(
            self.0
                .iter()
                .map(String::as_str)
                .filter(|known| *known != name),
        )
    }

    /// What it has and the other has not.
    pub fn beyond<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = &'a str> {
        let own = self.0.iter().map(String::as_str);
        own.filter(|name| !other.has(name))
    }
}

impl PartialEq for EffectSet {
    fn eq(&self, other: &Self) -> bool {
        self.distance(other) == 0
    }
}

/// Models one after the other: the present one, those before it, and those that were gone back from.
#[derive(Debug, Clone, Default)]
pub(crate) struct Changes {
    past: Vec<EffectSet>,
    present: EffectSet,
    future: Vec<EffectSet>,
}

/// Models that can be gone back to. Chosen.
const MOST: usize = 200;

impl Changes {
    pub fn begin(present: EffectSet) -> Self {
        Self {
            present,
            ..Self::default()
        }
    }

    pub fn present(&self) -> &EffectSet {
        &self.present
    }

    /// Those before the present one, the first first.
    pub fn past(&self) -> &[EffectSet] {
        &self.past
    }

    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }

    /// Goes to another model; where it is the present one, nothing changes.
    pub fn choose(&mut self, effects: EffectSet) {
        if effects == self.present {
            return;
        }
        self.past
            .push(std::mem::replace(&mut self.present, effects));
        self.future.clear();
        if self.past.len() > MOST {
            self.past.remove(0);
        }
    }

    /// Goes back to number `rung` of those before the present one, from 0; where there is none such, nothing changes.
    pub fn back_to(&mut self, rung: usize) {
        for _ in rung..self.past.len() {
            self.undo();
        }
    }

    /// Goes back; where there is nothing to go back to, nothing changes.
    pub fn undo(&mut self) {
        if let Some(before) = self.past.pop() {
            self.future
                .push(std::mem::replace(&mut self.present, before));
        }
    }

    /// Goes forth again.
    pub fn redo(&mut self) {
        if let Some(after) = self.future.pop() {
            self.past.push(std::mem::replace(&mut self.present, after));
        }
    }

    /// Goes back from a model that cannot be fitted, for good.
    pub fn take_back(&mut self) {
        self.present = self.past.pop().unwrap_or_default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(names: &str) -> EffectSet {
        EffectSet::from_address(names)
    }

    #[test]
    fn a_model_is_its_effects_whatever_their_order() {
        assert_eq!(set("a,b"), set("b, a,,b"));
        assert_ne!(set("a"), set("a,b"));
        assert_eq!(set("a,b,c").distance(&set("a,d")), 3);
    }

    #[test]
    fn what_was_undone_is_redone_until_something_else_is_chosen() {
        let mut changes = Changes::begin(set(""));
        changes.choose(set("a"));
        changes.choose(set("a,b"));
        changes.choose(set("b,a"));
        assert_eq!(changes.past().len(), 2);
        changes.undo();
        assert_eq!((changes.present(), changes.can_redo()), (&set("a"), true));
        changes.redo();
        assert_eq!(
            (changes.present(), changes.can_redo()),
            (&set("a,b"), false)
        );
        changes.undo();
        changes.undo();
        changes.undo();
        assert_eq!(changes.present(), &set(""));
        changes.choose(set("c"));
        assert!(!changes.can_redo() && changes.past() == [set("")]);
    }

    #[test]
    fn one_goes_back_to_any_model_so_far_and_on_again() {
        let mut changes = Changes::begin(set(""));
        for names in ["a", "a,b", "b"] {
            changes.choose(set(names));
        }
        changes.back_to(1);
        assert_eq!(changes.present(), &set("a"));
        changes.back_to(7);
        assert_eq!(changes.present(), &set("a"));
        changes.redo();
        assert_eq!(changes.present(), &set("a,b"));
    }

    #[test]
    fn what_cannot_be_fitted_leaves_no_trace() {
        let mut changes = Changes::begin(set("a"));
        changes.choose(set("a,b"));
        changes.take_back();
        assert_eq!(changes.present(), &set("a"));
        assert!(!changes.can_redo() && changes.past().is_empty());
    }
}
