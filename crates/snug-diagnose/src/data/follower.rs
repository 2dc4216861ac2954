//! Whoever follows a fit step by step, and may end it.

use crate::error::DiagnoseError;
use snug_least_squares::PooledStep;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

/// A step of a fit to all tightenings that led lower than those before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitStep {
    /// Steps tried so far, wherever they led.
    pub iteration: usize,
    /// Root mean square of the residual there: over noise, where that is known of every tightening, else in the output's
    /// unit.
    pub error: f64,
}

/// Who follows the fits of one question.
pub(crate) struct Follower<'a> {
    tell: &'a (dyn Fn(FitStep) + Sync),
    end: &'a AtomicBool,
    /// How many tightenings there are: fits to a few of them only say where to begin.
    tightenings: usize,
    tried: AtomicUsize,
    /// The lowest error that was told, as bits: of numbers above 0 these are in the same order.
    lowest: AtomicU64,
}

impl<'a> Follower<'a> {
    /// `tell` hears of every step that leads lower than any before; fits end soon after `end` becomes true.
    pub fn new(
        tightenings: usize,
        tell: &'a (dyn Fn(FitStep) + Sync),
        end: &'a AtomicBool,
    ) -> Self {
        Self {
            tell,
            end,
            tightenings,
            tried: AtomicUsize::new(0),
            lowest: AtomicU64::new(f64::INFINITY.to_bits()),
        }
    }

    /// Asked between pieces of work that take a while.
    pub fn go_on(&self) -> Result<(), DiagnoseError> {
        match self.end.load(Ordering::Relaxed) {
            true => Err(DiagnoseError::Interrupted),
            false => Ok(()),
        }
    }

    /// Hears of a step of a fit to so many tightenings; `error` is nothing where what it leaves cannot be compared with others.
    pub fn hear(
        &self,
        step: PooledStep,
        tightenings: usize,
        error: Option<f64>,
    ) -> ControlFlow<()> {
        let iteration = match step.iterations {
            0 => self.tried.load(Ordering::Relaxed),
            _ => self.tried.fetch_add(1, Ordering::Relaxed) + 1,
        };
        let is_told = step.moved && tightenings == self.tightenings;
        if let Some(error) = error.filter(|error| is_told && error.is_finite())
            && error.to_bits() < self.lowest.fetch_min(error.to_bits(), Ordering::Relaxed)
        {
            (self.tell)(FitStep { iteration, error });
        }
        match self.go_on() {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        }
    }
}
