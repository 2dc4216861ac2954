//! Whoever watches a diagnosis: hears of its stages, and may end it.

use crate::error::DiagnoseError;
use std::sync::atomic::{AtomicBool, Ordering};

/// What is counted of a stage that takes long.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pieces {
    /// So many candidates are going to be fitted.
    Of(usize),
    /// One more of them is.
    Done,
}

/// Who watches a diagnosis: hears of each stage as it begins, and may end it.
pub struct Watch<'a> {
    tell: &'a (dyn Fn(&str) + Sync),
    count: Option<&'a (dyn Fn(Pieces) + Sync)>,
    interrupted: Option<&'a AtomicBool>,
}

impl<'a> Watch<'a> {
    /// `tell` hears of each stage as it begins.
    pub fn new(tell: &'a (dyn Fn(&str) + Sync)) -> Self {
        Self {
            tell,
            count: None,
            interrupted: None,
        }
    }

    /// `count` hears how many candidates a stage has, and of each that is done.
    pub fn counting(self, count: &'a (dyn Fn(Pieces) + Sync)) -> Self {
        Self {
            count: Some(count),
            ..self
        }
    }

    /// The diagnosis ends with what it has reached soon after `interrupted` becomes true.
    pub fn until(self, interrupted: &'a AtomicBool) -> Self {
        Self {
            interrupted: Some(interrupted),
            ..self
        }
    }

    /// Hears of the stages and ends nothing any more.
    pub(crate) fn to_the_end(&self) -> Self {
        Self {
            tell: self.tell,
            count: self.count,
            interrupted: None,
        }
    }

    /// A stage begins, unless the diagnosis is to end.
    pub(crate) fn begin(&self, stage: &str) -> Result<(), DiagnoseError> {
        self.go_on()?;
        (self.tell)(stage);
        Ok(())
    }

    /// Counts within the stage at hand.
    pub(crate) fn pieces(&self, pieces: Pieces) {
        if let Some(count) = self.count {
            count(pieces);
        }
    }

    /// Asked between pieces of work that take a while.
    pub(crate) fn go_on(&self) -> Result<(), DiagnoseError> {
        match self.interrupted {
            Some(flag) if flag.load(Ordering::Relaxed) => Err(DiagnoseError::Interrupted),
            _ => Ok(()),
        }
    }
}
