//! A misfit that is one steady tone: hum of the mains, a fan, a pump.
//!
//! P(f) of the residual is summed over the recordings, each on its own lines (see [`Spectra`]). A tone lies within two lines of one
//! frequency, is as loud in every quarter of every recording, and has no line in the input, or a faint one of the mains: what rings after
//! each push, or answers a sine that drives the rig, is none. Recordings that are sampled too slowly for it have no say.

use super::residual::White;
use super::spectra::{Spectra, Spectrum};
use crate::locate::thresholds::{
    AS_LOUD, FAINT, FEWEST_CYCLES, LINES, MOST, OUTSTANDING, QUARTERS, SURROUNDINGS,
};
use snug_campaign::words::remark::is_of_the_mains;
use snug_signal::Complex;
use snug_statistics::descriptive::{mean, standard_deviation};
use std::f64::consts::TAU;
use std::ops::Range;

/// One steady tone.
pub struct Tone {
    /// Its frequency \[Hz\].
    pub hz: f64,
    /// Share of the misfit \[–\].
    pub share: f64,
    /// Whether the input has a faint one, too.
    pub in_input: bool,
}

/// The tone that holds most of the misfit, if one does.
pub fn tone(spectra: &Spectra<'_, '_>) -> Option<Tone> {
    let all = &spectra.of_misfits;
    let longest = (all.iter()).max_by(|a, b| a.length_s.total_cmp(&b.length_s))?;
    let hz = longest.loudest_hz()?;
    let (near, whole) = all.iter().fold((0.0, 0.0), |(near, whole), one| {
        (near + one.near(hz), whole + one.power.iter().sum::<f64>())
    });
    let share = near / whole;
    let is_narrow = hz * longest.length_s >= FEWEST_CYCLES && share >= MOST;
    let has_it: Vec<&Spectrum> = all.iter().filter(|one| one.shows(hz)).collect();
    let part_of_input = || {
        let parts = (has_it.iter()).map(|one| part(&spectra.of_input(one.recording), one.line(hz)));
        parts.fold(0.0, f64::max)
    };
    let is_steady = || {
        let loudness = has_it.iter().flat_map(|one| quarters(one.recording, hz));
        is_as_loud(&loudness.collect::<Vec<_>>())
    };
    if !is_narrow || !is_steady() {
        return None;
    }
    let part = part_of_input();
    let in_input = part > 0.0;
    let is_picked_up = part <= FAINT && is_of_the_mains(hz);
    (!in_input || is_picked_up).then_some(Tone {
        hz,
        share,
        in_input,
    })
}

impl Spectrum<'_, '_> {
    /// Where the loudest line and those about it lie \[Hz\].
    fn loudest_hz(&self) -> Option<f64> {
        let loudest =
            (1..self.power.len()).max_by(|&a, &b| self.power[a].total_cmp(&self.power[b]))?;
        let about = about(loudest, LINES, &self.power);
        let power: f64 = self.power[about.clone()].iter().sum();
        let moment: f64 = about.map(|k| k as f64 * self.power[k]).sum();
        Some(moment / power / self.length_s)
    }

    fn line(&self, hz: f64) -> usize {
        (hz * self.length_s).round() as usize
    }

    /// Whether it is sampled fast enough for a frequency.
    fn shows(&self, hz: f64) -> bool {
        self.line(hz) < self.power.len()
    }

    /// Power near a frequency.
    fn near(&self, hz: f64) -> f64 {
        let here = self.power.get(about(self.line(hz), LINES, &self.power));
        here.map_or(0.0, |power| power.iter().sum())
    }
}

/// Lines on each side of one.
fn about(line: usize, lines: usize, power: &[f64]) -> Range<usize> {
    line.saturating_sub(lines)..(line + lines + 1).min(power.len())
}

/// Share of `power` near a line that stands out of those about it; 0 where it does not.
fn part(power: &[f64], line: usize) -> f64 {
    let mut surroundings = power[about(line, SURROUNDINGS, power)].to_vec();
    surroundings.sort_unstable_by(f64::total_cmp);
    let usual = surroundings[surroundings.len() / 2];
    let here = power[about(line, 1, power)].iter();
    let stands_out = here.copied().fold(0.0, f64::max) > OUTSTANDING * usual;
    let sum = |lines: &[f64]| lines.iter().sum::<f64>();
    match stands_out {
        true => sum(&power[about(line, LINES, power)]) / sum(power),
        false => 0.0,
    }
}

/// How loud a frequency is in the quarters of a recording: |Σ w e^{−2πi f t}| over each.
fn quarters(one: &White<'_>, hz: f64) -> Vec<f64> {
    let turns = TAU * hz * one.interval_s();
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

fn is_as_loud(loudness: &[f64]) -> bool {
    let both = standard_deviation(loudness).ok().zip(mean(loudness).ok());
    both.is_some_and(|(deviation, mean)| deviation <= AS_LOUD * mean)
}
