//! Which tightenings and measurement files are whole, as the messages pass by.

use super::Recovery;
use crate::messages::measurement;
use crate::messages::measurement::FileHeader;
use crate::messages::signals;
use crate::messages::window::Window;
use crate::topic::Measured;
use snug_campaign::TighteningId;
use std::collections::HashMap;

/// Longest messages about a window and a file that are looked into \[bytes\].
const LONGEST_WINDOW_BYTES: usize = 1 << 20;
const LONGEST_FILE_BYTES: usize = 4 << 20;
/// Incomplete tightenings and files that are listed.
const MOST_LISTED: usize = 100;

/// A tightening or file whose samples are coming.
struct Open<T> {
    name: T,
    tightening: u64,
    wanted: u64,
    found: u64,
}

#[derive(Default)]
pub(super) struct Contents {
    topics: HashMap<u16, Measured>,
    window: Option<Open<TighteningId>>,
    file: Option<Open<String>>,
    tightenings: Gathered<TighteningId>,
    files: Gathered<String>,
}

struct Gathered<T> {
    whole: u64,
    last: Option<T>,
    incomplete: Vec<T>,
}

impl<T> Default for Gathered<T> {
    fn default() -> Self {
        Self {
            whole: 0,
            last: None,
            incomplete: Vec::new(),
        }
    }
}

impl<T> Gathered<T> {
    fn close(&mut self, open: Option<Open<T>>) {
        let Some(open) = open else { return };
        if open.found >= open.wanted {
            self.whole += 1;
            self.last = Some(open.name);
        } else if self.incomplete.len() < MOST_LISTED {
            self.incomplete.push(open.name);
        }
    }
}

impl Contents {
    pub(super) fn channel(&mut self, id: u16, name: &str, schema: &str) {
        match Measured::of(name, schema) {
            Some(found) => self.topics.insert(id, found),
            None => self.topics.remove(&id),
        };
    }

    /// Looks at a message; what cannot be understood does not count.
    pub(super) fn message(&mut self, id: u16, data: &[u8]) -> Option<()> {
        match self.topics.get(&id)? {
            Measured::Window if data.len() > LONGEST_WINDOW_BYTES => {}
            Measured::File if data.len() > LONGEST_FILE_BYTES => {}
            Measured::Window => {
                let window: Window = serde_json::from_slice(data).ok()?;
                let open = Open {
                    wanted: window.stored_samples() as u64,
                    name: TighteningId {
                        file: window.file,
                        number: window.number,
                    },
                    tightening: window.tightening,
                    found: 0,
                };
                self.tightenings.close(self.window.replace(open));
            }
            Measured::Signals => {
                let window = self.window.as_mut()?;
                let sample = signals::decode(data)?;
                window.found += u64::from(sample.tightening == window.tightening);
            }
            Measured::File => {
                let header: FileHeader = serde_json::from_slice(data).ok()?;
                let open = Open {
                    wanted: header.samples as u64,
                    name: header.file,
                    tightening: 0,
                    found: 0,
                };
                self.files.close(self.file.replace(open));
            }
            Measured::Samples => {
                let file = self.file.as_mut()?;
                let (first, end) = measurement::block_samples(data)?;
                // A block that does not follow the one before leaves a gap that no later one closes.
                if first == file.found {
                    file.found = end;
                }
            }
        }
        Some(())
    }

    pub(super) fn tell(mut self, recovery: &mut Recovery) {
        self.tightenings.close(self.window);
        self.files.close(self.file);
        recovery.tightenings = self.tightenings.whole;
        recovery.last_tightening = self.tightenings.last;
        recovery.incomplete_tightenings = self.tightenings.incomplete;
        recovery.files = self.files.whole;
        recovery.last_file = self.files.last;
        recovery.incomplete_files = self.files.incomplete;
    }
}
