//! Starts for an effect that resonates: read off the spectra, since the cost of a lightly damped resonance has a valley no
//! wider than the resonance.
//!
//! With Q the power of jω that makes the compared quantity of a displacement, H = Q / (K − I ω² + j ω C) the fitted base model and
//! U the spectrum of the torque, a mode of frequency f and damping ζ adds r Q / (ω_f² − ω² + 2 j ζ ω_f ω) U. For every f and ζ the
//! size r follows by linear least squares beside H U and what small changes of I, C and K make of it.

use crate::data::cases::Cases;
use crate::pooled::fitted::Fitted;
use crate::ranking::thresholds::{APART, DAMPING_RATIOS, FEW, LINES, PEAKS, RESONANCES, ROUNDING};
use rayon::prelude::*;
use snug_campaign::Quantity;
use snug_identify::FitTask;
use snug_model::{BASE_PARAMETERS, Effect, Law};
use snug_signal::{Complex, spectrum};
use std::f64::consts::TAU;

type Line = Complex<f64>;

/// Parameters of `effect` with which a refit may begin, the most promising first; none where it has no resonance.
pub(crate) fn starts(cases: Cases<'_>, current: &Fitted, effect: Effect) -> Vec<Vec<f64>> {
    let Some(resonance) = effect.resonance() else {
        return Vec::new();
    };
    let records: Vec<Record> = (current.spread(FEW).into_iter())
        .filter_map(|member| Record::of(&cases[member], &current.all_named(member)))
        .collect();
    let ranges = cases[0].model.ranges(effect);
    let (mut lowest, mut highest) = ranges[resonance.frequency].limits;
    for record in &records {
        lowest = lowest.max(record.first_hz());
        highest = highest.min(record.last_hz());
    }
    if records.is_empty() || lowest >= highest {
        return Vec::new();
    }
    let step = (highest / lowest).powf(1.0 / RESONANCES as f64);
    let grid: Vec<(f64, f64, f64)> = (0..=RESONANCES)
        .into_par_iter()
        .map(|index| {
            let hz = lowest * step.powi(index as i32);
            let tried = DAMPING_RATIOS.iter().map(|&zeta| {
                let (share, _) = explain(&records, hz, zeta);
                (share, hz, zeta)
            });
            tried.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
        })
        .collect();
    let mut best = grid;
    best.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut starts: Vec<Vec<f64>> = Vec::new();
    for (_, hz, zeta) in best {
        let is_near = |known: &Vec<f64>| {
            let ratio = known[resonance.frequency] / hz;
            ratio < APART && ratio > 1.0 / APART
        };
        if starts.len() < PEAKS && !starts.iter().any(is_near) {
            let mut values: Vec<f64> = ranges.iter().map(|range| range.starts[0]).collect();
            (_, values[resonance.size]) = explain(&records, hz, zeta);
            (values[resonance.frequency], values[resonance.damping]) = (hz, zeta);
            for (value, range) in values.iter_mut().zip(&ranges) {
                *value = value.clamp(range.limits.0, range.limits.1);
            }
            starts.push(values);
        }
    }
    starts
}

/// Share of the squared output of all records that a mode removes, and its size.
fn explain(records: &[Record], hz: f64, zeta: f64) -> (f64, f64) {
    let (mut score, mut information, mut whole) = (0.0, 0.0, 0.0);
    for record in records {
        let mut column = record.mode(hz, zeta);
        record.project(&mut column);
        score += dot(&column, &record.left).re;
        information += dot(&column, &column).re;
        whole += dot(&record.left, &record.left).re;
    }
    let size = score / information.max(f64::MIN_POSITIVE);
    let share = size * score / whole.max(f64::MIN_POSITIVE);
    if share.is_finite() && size.is_finite() {
        (share, size)
    } else {
        (0.0, 0.0)
    }
}

/// Spectra of one record.
struct Record {
    /// ω of every line \[rad/s\].
    omega: Vec<f64>,
    /// Q U of every line; per kilogram of the mode at the grip, so that it is that of an angle.
    driven: Vec<Line>,
    /// Orthonormal over real sizes: what the base model may explain.
    explained: Vec<Vec<Line>>,
    /// What is left of the compared output.
    left: Vec<Line>,
}

impl Record {
    fn of(case: &FitTask<'_>, own: &[(String, f64)]) -> Option<Self> {
        let (rig, interval_s) = (case.model.rig(), case.tightening.time_base.interval_s);
        let square = rig.lever_arm_m * rig.lever_arm_m;
        let [m, c, k] = BASE_PARAMETERS.map(|name| {
            let fitted = own.iter().find(|(known, _)| known == name).map(|one| one.1);
            let set = case.model.parameters().iter().find(|p| p.name == name);
            fitted.or_else(|| set.map(|p| p.value))
        });
        let (inertia, damping, stiffness) = (
            m? * square + rig.known_inertia_kg_m2,
            c? * square,
            k? * square,
        );
        let samples = case.measured().len();
        let measured = lines(case.measured());
        let torque = lines(&case.tightening.torque_nm);
        let power = match case.quantity() {
            Quantity::Displacement => 0,
            Quantity::Velocity => 1,
            Quantity::Acceleration => 2,
        };
        let loudest = torque.iter().map(Line::norm_sqr).fold(0.0, f64::max);
        let heard: Vec<usize> = (1..torque.len().min(measured.len()).min(LINES))
            .filter(|&line| torque[line].norm_sqr() > ROUNDING * loudest)
            .collect();
        let rate = TAU / (samples as f64 * interval_s);
        let omega: Vec<f64> = heard.iter().map(|&line| rate * line as f64).collect();
        let driven: Vec<Line> = (heard.iter().zip(&omega))
            .map(|(&line, &omega)| Line::new(0.0, omega).powu(power) * torque[line])
            .collect();
        let base = |of: &dyn Fn(f64, Line) -> Line| -> Vec<Line> {
            let each = omega.iter().zip(&driven).map(|(&omega, &driven)| {
                let below = Line::new(stiffness - inertia * omega * omega, damping * omega);
                of(omega, below) * driven
            });
            each.collect()
        };
        let columns = [
            base(&|_, below| below.inv()),
            base(&|_, below| below.powu(2).inv()),
            base(&|omega, below| Line::new(0.0, omega) / below.powu(2)),
            base(&|omega, below| omega * omega / below.powu(2)),
        ];
        let mut record = Self {
            left: Vec::new(),
            explained: Vec::new(),
            driven: (driven.iter().map(|line| line / square)).collect(),
            omega,
        };
        for mut column in columns {
            let length = dot(&column, &column).re;
            record.project(&mut column);
            let rest = dot(&column, &column).re;
            if rest > ROUNDING * length {
                column.iter_mut().for_each(|line| *line /= rest.sqrt());
                record.explained.push(column);
            }
        }
        let mut left: Vec<Line> = heard.iter().map(|&line| measured[line]).collect();
        record.project(&mut left);
        record.left = left;
        (!record.omega.is_empty()).then_some(record)
    }

    fn first_hz(&self) -> f64 {
        self.omega.first().map_or(0.0, |omega| omega / TAU)
    }

    fn last_hz(&self) -> f64 {
        self.omega.last().map_or(0.0, |omega| omega / TAU)
    }

    /// What a mode of residue 1/kg adds to the compared output.
    fn mode(&self, hz: f64, zeta: f64) -> Vec<Line> {
        let own = TAU * hz;
        let each = self.omega.iter().zip(&self.driven).map(|(&omega, driven)| {
            driven / Line::new(own * own - omega * omega, 2.0 * zeta * own * omega)
        });
        each.collect()
    }

    fn project(&self, column: &mut [Line]) {
        for known in &self.explained {
            let share = dot(known, column).re;
            for (line, known) in column.iter_mut().zip(known) {
                *line -= known * share;
            }
        }
    }
}

/// The spectrum of a record that rises from nothing and ends in nothing (Hann), so that what it begins and ends with does not
/// spread over all lines.
fn lines(samples: &[f64]) -> Vec<Line> {
    let per_sample = TAU / samples.len().max(1) as f64;
    let weigh = |(index, sample): (usize, &f64)| {
        let known = if sample.is_finite() { *sample } else { 0.0 };
        known * (1.0 - (per_sample * index as f64).cos())
    };
    let weighted: Vec<f64> = samples.iter().enumerate().map(weigh).collect();
    spectrum(&weighted)
}

/// Σ conj(a) b.
fn dot(a: &[Line], b: &[Line]) -> Line {
    a.iter().zip(b).map(|(a, b)| a.conj() * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::Tally;
    use crate::tests::made_up::{SAMPLES, close, exact, hand};

    fn found(effect: Effect, sizes: &[f64]) -> Vec<Vec<f64>> {
        let cases: Vec<FitTask> = (0..4)
            .map(|number| exact(number, &[Effect::SecondMode], sizes))
            .collect();
        let own = (0..4).map(|number| hand(number).to_vec()).collect();
        let current = Fitted::made_up(&[], &[1.0; 4], SAMPLES).with_own(&BASE_PARAMETERS, own, 0);
        let tally = Tally::default();
        starts(Cases::new(&cases, &tally), &current, effect)
    }

    /// A line every 4 Hz: a frequency is known to a fraction of that.
    #[test]
    fn a_further_resonance_is_read_off_with_its_sign() {
        for sizes in [[-0.2, 40.0, 0.03, 0.0], [0.1, 90.0, 0.15, 0.0]] {
            let best = &found(Effect::SecondMode, &sizes)[0];
            close(best[1], sizes[1], 0.05);
            close(best[0], sizes[0], 0.5);
        }
    }

    #[test]
    fn what_has_no_resonance_has_no_start() {
        assert!(found(Effect::SecondMass, &[0.1, 40.0, 0.03, 0.0]).is_empty());
    }
}
