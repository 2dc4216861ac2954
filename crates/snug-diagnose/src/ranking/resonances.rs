//! Starts for an effect that resonates: read off the spectra, since the cost of a lightly damped resonance has a valley no
//! wider than the resonance.
//!
//! With Q the power of jω that makes the compared quantity of a displacement, H = Q / (K − I ω² + j ω C) the fitted base model and
//! U the spectrum of the torque, a mode of frequency f and damping ζ adds r Q / (ω_f² − ω² + 2 j ζ ω_f ω) U. For every f and ζ the
//! size r follows by linear least squares beside H U and what small changes of I, C and K make of it. Of a mass that hangs on what is
//! driven, by what is measured, Y,
//!
//! ```text
//! Y − H U = (m_a l² ω² G − δK − j ω δC + ω² δI) Y / (K − I ω² + j ω C),   G = (ω_f² + 2 j ζ ω_f ω) / (ω_f² − ω² + 2 j ζ ω_f ω)
//! ```
//!
//! in which m_a and the changes are linear, too, and need not be small.

use crate::data::cases::Cases;
use crate::pooled::fitted::Fitted;
use crate::ranking::thresholds::{APART, DAMPING_RATIOS, FEW, LINES, PEAKS, RESONANCES, ROUNDING};
use rayon::prelude::*;
use snug_campaign::Quantity;
use snug_identify::FitTask;
use snug_model::{BASE_PARAMETERS, Effect, ExcitedBy, Law};
use snug_signal::{Complex, spectrum};
use std::f64::consts::TAU;

type Line = Complex<f64>;

/// Parameters of `effect` with which a refit may begin, the most promising first; none where it has no resonance.
pub(crate) fn starts(cases: Cases<'_>, current: &Fitted, effect: Effect) -> Vec<Vec<f64>> {
    let Some(resonance) = effect.resonance() else {
        return Vec::new();
    };
    let records: Vec<Record> = (current.spread(FEW).into_iter())
        .filter_map(|member| {
            let own = current.all_named(member);
            Record::of(&cases[member], &own, resonance.excited_by)
        })
        .collect();
    let ranges = cases[0].model.ranges(effect);
    let sizes = ranges[resonance.size].limits;
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
                let (share, size) = explain(&records, hz, zeta);
                match (sizes.0..=sizes.1).contains(&size) {
                    true => (share, hz, zeta),
                    false => (0.0, hz, zeta),
                }
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

/// Share of the squared output of all records that a resonance removes, and its size.
fn explain(records: &[Record], hz: f64, zeta: f64) -> (f64, f64) {
    let (mut score, mut information, mut whole) = (0.0, 0.0, 0.0);
    for record in records {
        let mut column = record.resonance(hz, zeta);
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

/// The spectra of a record where its torque is heard, and the base model there.
struct Spectra {
    /// ω of every line \[rad/s\].
    omega: Vec<f64>,
    /// K − I ω² + j ω C.
    below: Vec<Line>,
    /// Q U.
    driven: Vec<Line>,
    /// The compared output.
    seen: Vec<Line>,
    /// l².
    square: f64,
}

impl Spectra {
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
        let below = |&omega: &f64| Line::new(stiffness - inertia * omega * omega, damping * omega);
        let driven = (heard.iter().zip(&omega))
            .map(|(&line, &omega)| Line::new(0.0, omega).powu(power) * torque[line]);
        Some(Self {
            below: omega.iter().map(below).collect(),
            driven: driven.collect(),
            seen: heard.iter().map(|&line| measured[line]).collect(),
            omega,
            square,
        })
    }

    /// H U: what the base model makes of the torque.
    fn moved(&self) -> Vec<Line> {
        let each = self.driven.iter().zip(&self.below);
        each.map(|(driven, below)| driven / below).collect()
    }

    /// What forces that go with each line of `through` add to the output.
    fn pushed(&self, through: &[Line], force: impl Fn(f64) -> Line) -> Vec<Line> {
        let each = self.omega.iter().zip(&self.below).zip(through);
        each.map(|((&omega, below), line)| line * force(omega) / below)
            .collect()
    }

    /// The same of stiffness, damping and inertia.
    fn of_base(&self, through: &[Line]) -> [Vec<Line>; 3] {
        [0, 1, 2].map(|power| self.pushed(through, |omega| Line::new(0.0, omega).powu(power)))
    }
}

/// What is left of one record, and what may explain it.
struct Record {
    /// ω of every line \[rad/s\].
    omega: Vec<f64>,
    excited_by: ExcitedBy,
    /// What excites a resonance of size one: Q U of every line, per kilogram at the grip, so that it is that of an angle; or what its own
    /// motion, as much as what it hangs on, makes of the output.
    exciting: Vec<Line>,
    /// Orthonormal over real sizes: what the base model may explain.
    explained: Vec<Vec<Line>>,
    /// What is left of the compared output.
    left: Vec<Line>,
}

impl Record {
    fn of(case: &FitTask<'_>, own: &[(String, f64)], excited_by: ExcitedBy) -> Option<Self> {
        let spectra = Spectra::of(case, own)?;
        let (moved, seen, square) = (spectra.moved(), &spectra.seen, spectra.square);
        let (columns, exciting, mut left) = match excited_by {
            ExcitedBy::Torque => {
                let of_base = spectra.of_base(&moved);
                let exciting = spectra.driven.iter().map(|line| line / square).collect();
                let columns: Vec<_> = [moved].into_iter().chain(of_base).collect();
                (columns, exciting, seen.clone())
            }
            ExcitedBy::Motion => {
                let exciting = spectra.pushed(seen, |omega| Line::new(square * omega * omega, 0.0));
                let left = seen.iter().zip(&moved).map(|(seen, moved)| seen - moved);
                (spectra.of_base(seen).into(), exciting, left.collect())
            }
        };
        let mut record = Self {
            left: Vec::new(),
            explained: Vec::new(),
            excited_by,
            exciting,
            omega: spectra.omega,
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

    /// What a resonance of size one adds to the compared output.
    fn resonance(&self, hz: f64, zeta: f64) -> Vec<Line> {
        let own = TAU * hz;
        let each = self.omega.iter().zip(&self.exciting);
        let each = each.map(|(&omega, exciting)| {
            let damped = Line::new(0.0, 2.0 * zeta * own * omega);
            let pulled = match self.excited_by {
                ExcitedBy::Torque => Line::new(1.0, 0.0),
                ExcitedBy::Motion => own * own + damped,
            };
            exciting * pulled / (own * own - omega * omega + damped)
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

    /// Starts of `effect` in data with `there`, of this size.
    fn found(effect: Effect, there: Effect, sizes: &[f64]) -> Vec<Vec<f64>> {
        let cases: Vec<FitTask> = (0..4)
            .map(|number| exact(number, &[there], sizes))
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
            let best = &found(Effect::SecondMode, Effect::SecondMode, &sizes)[0];
            close(best[1], sizes[1], 0.05);
            close(best[0], sizes[0], 0.5);
        }
    }

    #[test]
    fn a_mass_that_hangs_on_what_is_driven_is_read_off() {
        for sizes in [[1.2, 20.0, 0.03], [1.0, 35.0, 0.15]] {
            let best = &found(Effect::AttachedMass, Effect::AttachedMass, &sizes)[0];
            close(best[1], sizes[1], 0.05);
            close(best[0], sizes[0], 0.5);
        }
    }

    #[test]
    fn what_has_no_resonance_has_no_start() {
        assert!(
            found(
                Effect::SecondMass,
                Effect::SecondMode,
                &[0.1, 40.0, 0.03, 0.0]
            )
            .is_empty()
        );
    }
}
