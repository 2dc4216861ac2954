//! A misfit that is one steady tone: hum of the mains, a fan, a pump.
//!
//! P(f) of the residual is summed over the recordings, each on its own lines (see [`Spectra`]). A tone lies within two lines of one
//! frequency, is as loud in every quarter of every recording, and has no line in the input, or a faint one of the mains alone: what rings after
//! each push, or answers a sine that drives the rig, is none. Recordings that are sampled too slowly for it have no say.

use super::residual::White;
use super::spectra::{Spectra, Spectrum};
use crate::locate::thresholds::{
    AS_LOUD, AS_LOUD_AS_IT, FAINT, FEWEST_CYCLES, LINES, MOST, NEAR, OUTSTANDING, QUARTERS,
    SURROUNDINGS,
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
    let is_steady = || {
        let loudness = has_it.iter().flat_map(|one| quarters(one.recording, hz));
        is_as_loud(&loudness.collect::<Vec<_>>())
    };
    if !is_narrow || !is_steady() {
        return None;
    }
    let inputs = (has_it.iter()).map(|one| (spectra.of_input(one.recording), one.line(hz)));
    let driving: Vec<_> = inputs
        .filter(|(power, line)| stands_out(power, *line))
        .collect();
    let in_input = !driving.is_empty();
    let is_faint = |(power, line): &(Vec<f64>, usize)| is_faint_and_alone(power, *line);
    let is_picked_up = || is_of_the_mains(hz) && driving.iter().all(is_faint);
    (!in_input || is_picked_up()).then_some(Tone {
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

/// Whether a line of `power` stands out of those about it.
fn stands_out(power: &[f64], line: usize) -> bool {
    let mut surroundings = power[about(line, SURROUNDINGS, power)].to_vec();
    surroundings.sort_unstable_by(f64::total_cmp);
    let usual = surroundings[surroundings.len() / 2];
    loudest(&power[about(line, 1, power)]) > OUTSTANDING * usual
}

/// Whether a line of `power` has little of all, and none near it is as loud: one of many drives the rig with them.
fn is_faint_and_alone(power: &[f64], line: usize) -> bool {
    let here = about(line, LINES, power);
    let sum = |lines: &[f64]| lines.iter().sum::<f64>();
    let far = about(line, (line as f64 * NEAR) as usize, power);
    let below = loudest(&power[far.start..here.start.max(far.start)]);
    let above = loudest(&power[here.end.min(far.end)..far.end]);
    sum(&power[here.clone()]) <= FAINT * sum(power)
        && below.max(above) < AS_LOUD_AS_IT * loudest(&power[here])
}

fn loudest(power: &[f64]) -> f64 {
    power.iter().copied().fold(0.0, f64::max)
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
