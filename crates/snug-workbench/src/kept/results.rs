//! Results as files.

use crate::changes::EffectSet;
use std::path::Path;
use tempfile::TempDir;

/// Results that were made, by their models; the folders go with the workbench.
#[derive(Default)]
pub(crate) struct Results {
    made: Vec<(usize, EffectSet, TempDir)>,
    count: usize,
}

/// Results that are kept; a report and a recording of 24 tightenings take 3 MB. Chosen.
const MOST: usize = 8;

impl Results {
    /// The number under which a model's are kept.
    pub fn number(&self, effects: &EffectSet) -> Option<usize> {
        let found = self.made.iter().find(|(_, known, _)| known == effects);
        found.map(|(number, _, _)| *number)
    }

    /// Where those of this number stand.
    pub fn folder(&self, number: usize) -> Option<&Path> {
        let found = self.made.iter().find(|(known, _, _)| *known == number);
        found.map(|(_, _, folder)| folder.path())
    }

    /// How often some were made, those that are forgotten too.
    #[cfg(test)]
    pub fn made(&self) -> usize {
        self.count
    }

    /// Keeps a model's, and forgets the oldest where there are too many; the number under which they are kept.
    pub fn keep(&mut self, effects: EffectSet, folder: TempDir) -> usize {
        self.count += 1;
        if self.made.len() >= MOST {
            self.made.remove(0);
        }
        self.made.push((self.count, effects, folder));
        self.count
    }
}
