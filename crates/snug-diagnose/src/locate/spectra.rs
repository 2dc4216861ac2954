//! Power over frequency of every recording: of its misfit, and of what drove it.

use super::residual::{Residuals, White};
use rayon::prelude::*;
use snug_signal::Periodogram;
use std::collections::BTreeMap;

/// The [`Periodogram`]s of the residuals, planned once for each length.
pub struct Spectra<'r, 'a> {
    pub of_misfits: Vec<Spectrum<'r, 'a>>,
    periodograms: BTreeMap<usize, Periodogram>,
}

/// The misfit of one recording: `power[k]` at the frequency k over its length.
pub struct Spectrum<'r, 'a> {
    pub recording: &'r White<'a>,
    pub power: Vec<f64>,
    pub length_s: f64,
}

impl<'r, 'a> Spectra<'r, 'a> {
    pub fn of(residuals: &'r Residuals<'a>) -> Self {
        let mut periodograms: BTreeMap<usize, Periodogram> = BTreeMap::new();
        for one in &residuals.all {
            let length = one.values.len();
            (periodograms.entry(length)).or_insert_with(|| Periodogram::of_length(length));
        }
        let of_misfit = |one: &'r White<'a>| Spectrum {
            recording: one,
            power: periodograms[&one.values.len()].power(&one.values),
            length_s: one.values.len() as f64 * one.interval_s(),
        };
        Self {
            of_misfits: residuals.all.par_iter().map(of_misfit).collect(),
            periodograms,
        }
    }

    /// Power of the torque about its mean, as that of the misfit.
    pub fn of_input(&self, recording: &White<'_>) -> Vec<f64> {
        let torque_nm = &recording.seen.tightening.torque_nm[recording.samples()];
        let mean_nm = torque_nm.iter().sum::<f64>() / torque_nm.len() as f64;
        let about: Vec<f64> = torque_nm.iter().map(|torque| torque - mean_nm).collect();
        self.periodograms[&about.len()].power(&about)
    }
}
