//! Sorts what is simulated side by side into the output and the sensitivities of each run.

use crate::numeric::number::Real;
use crate::simulate::run::Run;

/// Samples that are kept together until each lane's go where they belong: writing every lane of every sample to its own
/// place would take longer than to compute it.
const BLOCK: usize = 32;

/// Writes what is simulated side by side into every run's own output and sensitivity.
pub struct Record<'a, 'r, R> {
    runs: &'a mut [Run<'r>],
    /// Values per row: the output and its derivatives.
    width: usize,
    block: Vec<R>,
    rows: usize,
    written: usize,
}

impl<'a, 'r, R: Real> Record<'a, 'r, R> {
    /// Rows will hold an output and `columns` derivatives.
    pub fn new(runs: &'a mut [Run<'r>], columns: usize, zero: R) -> Self {
        let width = columns + 1;
        Self {
            runs,
            width,
            block: vec![zero; BLOCK * width],
            rows: 0,
            written: 0,
        }
    }

    /// Where the next sample goes.
    #[inline(always)]
    pub fn next_row(&mut self) -> &mut [R] {
        &mut self.block[self.rows * self.width..][..self.width]
    }

    /// Keeps that sample.
    #[inline(always)]
    pub fn keep_row(&mut self) {
        self.rows += 1;
        if self.rows == BLOCK {
            self.write();
        }
    }

    /// Writes what is kept.
    #[inline(never)]
    pub fn write(&mut self) {
        for (lane, run) in self.runs.iter_mut().enumerate() {
            let samples = run.input.samples();
            // Others may go on for longer.
            let rows = self.rows.min(samples.saturating_sub(self.written));
            for column in 0..self.width {
                let to = match column {
                    0 => &mut run.output[self.written.min(samples)..],
                    _ => &mut run.sensitivity[(column - 1) * samples + self.written.min(samples)..],
                };
                let from = self.block[column..].iter().step_by(self.width);
                for (to, from) in to[..rows].iter_mut().zip(from) {
                    *to = from.lanes()[lane];
                }
            }
        }
        self.written += self.rows;
        self.rows = 0;
    }
}
