//! What fails one after another for long: the store or the cluster is gone, and what is left is not tried.

use crate::engine::thresholds::GIVEN_UP_AFTER;
use std::time::{Duration, Instant};

/// Failures since something last came out.
#[derive(Debug)]
pub(crate) struct InVain {
    failures: usize,
    since: Instant,
    limit: Duration,
}

impl InVain {
    /// None yet; given up after so long.
    pub fn none(limit: Duration) -> Self {
        Self {
            failures: 0,
            since: Instant::now(),
            limit,
        }
    }

    /// Something came out, or not.
    pub fn count(&mut self, came_out: bool) {
        match came_out {
            true => *self = Self::none(self.limit),
            false => self.failures += 1,
        }
    }

    /// Why nothing more is tried; `None` while it is.
    pub fn given_up(&self) -> Option<String> {
        let is_over = self.failures >= GIVEN_UP_AFTER && self.since.elapsed() >= self.limit;
        is_over.then(|| {
            format!(
                "not tried: for {} s nothing came out, and {} were tried in vain",
                self.limit.as_secs(),
                self.failures
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_fails_often_and_for_long_is_given_up() {
        let mut quick = InVain::none(Duration::from_secs(60));
        (0..100).for_each(|_| quick.count(false));
        assert_eq!(quick.given_up(), None);
        let mut long = InVain::none(Duration::ZERO);
        long.count(false);
        long.count(false);
        assert_eq!(long.given_up(), None);
        long.count(false);
        assert!(
            long.given_up()
                .is_some_and(|why| why.contains("3 were tried in vain"))
        );
        long.count(true);
        assert_eq!(long.given_up(), None);
    }
}
