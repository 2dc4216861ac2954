//! A misfit that is one steady tone: hum of the mains, a fan, a pump.
//!
//! P(f) of the residual is summed over the recordings, each on its own lines (see [`Periodogram`]). A tone lies within two lines of one
//! frequency, is as loud in every quarter of a recording, and has no line in the input: what rings after each push, or answers a sine that
//! drives the rig, is none.

use super::residual::{Residuals, White};
use crate::locate::thresholds::{
    AS_LOUD, FEWEST_CYCLES, LINES, MOST, OUTSTANDING, QUARTERS, SURROUNDINGS,
};
use snug_signal::{Complex, Periodogram};
use std::f64::consts::TAU;

/// One steady tone.
pub struct Tone {
    /// Its frequency \[Hz\].
    pub hz: f64,
    /// Share of the misfit \[–\].
    pub share: f64,
}

/// The tone that holds most of the misfit, if one does.
pub fn tone(residuals: &Residuals<'_>) -> Option<Tone> {
    let spectra: Vec<Spectrum> = residuals.all.iter().map(Spectrum::of).collect();
    let longest = spectra
        .iter()
        .max_by(|a, b| a.length_s.total_cmp(&b.length_s))?;
    let loudest = (1..longest.of_misfit.len())
        .max_by(|&a, &b| longest.of_misfit[a].total_cmp(&longest.of_misfit[b]))?;
    let hz = longest.centre_hz(loudest);
    let (near, all) = spectra.iter().fold((0.0, 0.0), |(near, all), one| {
        let (here, every) = one.near(hz);
        (near + here, all + every)
    });
    let share = near / all;
    let is_steady = || {
        let loudness = residuals.all.iter().flat_map(|one| quarters(one, hz));
        variation(&loudness.collect::<Vec<_>>()) <= AS_LOUD
    };
    let is_narrow = hz * longest.length_s >= FEWEST_CYCLES && share >= MOST;
    let is_tone = is_narrow && !spectra.iter().any(|one| one.is_driven_at(hz)) && is_steady();
    is_tone.then_some(Tone { hz, share })
}

/// Power over frequency of one recording.
struct Spectrum {
    of_misfit: Vec<f64>,
    of_input: Vec<f64>,
    length_s: f64,
}

impl Spectrum {
    fn of(one: &White<'_>) -> Self {
        let periodogram = Periodogram::of_length(one.values.len());
        let tightening = one.seen.tightening;
        let input = &tightening.torque_nm[one.samples()];
        let mean = input.iter().sum::<f64>() / input.len() as f64;
        let input: Vec<f64> = input.iter().map(|torque| torque - mean).collect();
        Self {
            of_misfit: periodogram.power(&one.values),
            of_input: periodogram.power(&input),
            length_s: one.values.len() as f64 * tightening.time_base.interval_s,
        }
    }

    /// Where the power of the lines about one lies \[Hz\].
    fn centre_hz(&self, line: usize) -> f64 {
        let about = self.about(line, LINES);
        let power: f64 = self.of_misfit[about.clone()].iter().sum();
        let moment: f64 = about.map(|k| k as f64 * self.of_misfit[k]).sum();
        moment / power / self.length_s
    }

    fn line(&self, hz: f64) -> usize {
        (hz * self.length_s).round() as usize
    }

    fn about(&self, line: usize, lines: usize) -> std::ops::Range<usize> {
        line.saturating_sub(lines)..(line + lines + 1).min(self.of_misfit.len())
    }

    /// Power of the misfit near a frequency, and at all.
    fn near(&self, hz: f64) -> (f64, f64) {
        let here = self.of_misfit.get(self.about(self.line(hz), LINES));
        let sum = |power: &[f64]| power.iter().sum::<f64>();
        (here.map_or(0.0, sum), sum(&self.of_misfit))
    }

    /// Whether the input has a line there.
    fn is_driven_at(&self, hz: f64) -> bool {
        let line = self.line(hz);
        let about = self.about(line, SURROUNDINGS);
        let mut surroundings = self.of_input[about].to_vec();
        surroundings.sort_unstable_by(f64::total_cmp);
        let usual = surroundings[surroundings.len() / 2];
        let here = self.of_input[self.about(line, 1)].iter();
        here.copied().fold(0.0, f64::max) > OUTSTANDING * usual
    }
}

/// How loud a frequency is in the quarters of a recording: |Σ w e^{−2πi f t}| over each.
fn quarters(one: &White<'_>, hz: f64) -> Vec<f64> {
    let turns = TAU * hz * one.seen.tightening.time_base.interval_s;
    let length = one.values.len() / QUARTERS;
    let parts = one.values.chunks_exact(length.max(1));
    let sum = |part: &[f64]| -> Complex<f64> {
        let terms = part.iter().enumerate();
        terms
            .map(|(t, w)| w * Complex::cis(-turns * t as f64))
            .sum()
    };
    parts.map(|part| sum(part).norm()).collect()
}

/// Standard deviation over mean.
fn variation(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|one| (one - mean).powi(2)).sum();
    (squares / n).sqrt() / mean
}
