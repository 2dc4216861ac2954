//! One page that somebody works on: its models one after the other, the fit under way, and who listens.

use crate::campaign::focus::Closer;
use crate::changes::Changes;
use serde_json::Value;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tokio::sync::broadcast;

/// One page that somebody works on.
pub(crate) struct Session {
    pub changes: Changes,
    /// What the page looks at more closely.
    pub closer: Closer,
    /// Number of the fit that was asked for last.
    number: usize,
    /// Ends the fit under way.
    end: Arc<AtomicBool>,
    events: broadcast::Sender<Arc<Value>>,
}

/// Events that a page may lag behind before it is told the whole state anew. Chosen.
const ROOM: usize = 1024;

/// A fit that was asked for.
#[derive(Clone)]
pub(crate) struct Ticket {
    pub number: usize,
    pub end: Arc<AtomicBool>,
}

impl Session {
    pub fn new(changes: Changes) -> Self {
        Self {
            changes,
            closer: Closer::default(),
            number: 0,
            end: Arc::default(),
            events: broadcast::Sender::new(ROOM),
        }
    }

    /// Ends the fit under way; the next one's number and end.
    pub fn begin(&mut self) -> Ticket {
        self.end.store(true, Ordering::Relaxed);
        self.number += 1;
        self.end = Arc::default();
        Ticket {
            number: self.number,
            end: Arc::clone(&self.end),
        }
    }

    /// Whether nothing else was asked for since.
    pub fn is_last(&self, ticket: &Ticket) -> bool {
        self.number == ticket.number
    }

    pub fn listen(&self) -> broadcast::Receiver<Arc<Value>> {
        self.events.subscribe()
    }

    /// Tells every page of this session; that none listens is no fault.
    pub fn tell(&self, event: Value) {
        self.events.send(Arc::new(event)).ok();
    }

    pub fn has_listeners(&self) -> bool {
        self.events.receiver_count() > 0
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.end.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whoever_asks_for_another_fit_ends_the_one_before() {
        let mut session = Session::new(Changes::default());
        let first = session.begin();
        let second = session.begin();
        assert!(first.end.load(Ordering::Relaxed) && !second.end.load(Ordering::Relaxed));
        assert!(!session.is_last(&first) && session.is_last(&second));
        drop(session);
        assert!(second.end.load(Ordering::Relaxed));
    }
}
