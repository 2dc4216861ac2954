//! Whoever watches a diagnosis: hears of its stages, and may end it.

use crate::error::DiagnoseError;
use std::sync::atomic::{AtomicBool, Ordering};

/// Who watches a diagnosis: hears of each stage as it begins, and may end it.
pub struct Watch<'a> {
    tell: &'a (dyn Fn(&str) + Sync),
    interrupted: Option<&'a AtomicBool>,
}

impl<'a> Watch<'a> {
    /// `tell` hears of each stage as it begins.
    pub fn new(tell: &'a (dyn Fn(&str) + Sync)) -> Self {
        Self {
            tell,
            interrupted: None,
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
            interrupted: None,
        }
    }

    /// A stage begins, unless the diagnosis is to end.
    pub(crate) fn begin(&self, stage: &str) -> Result<(), DiagnoseError> {
        self.go_on()?;
        (self.tell)(stage);
        Ok(())
    }

    /// Asked between pieces of work that take a while.
    pub(crate) fn go_on(&self) -> Result<(), DiagnoseError> {
        match self.interrupted {
            Some(flag) if flag.load(Ordering::Relaxed) => Err(DiagnoseError::Interrupted),
            _ => Ok(()),
        }
    }
}
