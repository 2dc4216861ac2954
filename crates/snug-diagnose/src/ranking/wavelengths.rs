//! Starts for an effect whose force comes again with a wavelength of the displacement: read off the measurement, since the
//! cost has a minimum for every wavelength or so.
//!
//! The balance of torques I α + C ω + K θ + l F = T is averaged with a smooth weight φ that is 0 at both ends, so that what was
//! not measured comes of what was by parts (∫ φ α = −∫ φ' ω = ∫ φ'' θ); no simulation is needed. What every model may explain is
//! projected out, and for every wavelength the sizes follow by linear least squares: a periodogram of the missing force over
//! the displacement. The force is a function of x/λ that repeats, so that one wave of it is worked out once.

use crate::data::cases::Cases;
use crate::pooled::fitted::Fitted;
use crate::ranking::thresholds::{
    FEW, FINER, HALF_WIDTHS_OF_BALANCE, PARTS_OF_A_WAVE, PEAKS, PER_WAVE, ROUNDING,
    SAMPLES_OF_BALANCE, WAVELENGTHS,
};
use rayon::prelude::*;
use snug_campaign::Quantity;
use snug_identify::{FitTask, Modulation, integral};
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use snug_model::{Effect, Instant, Law, PlausibleRange};
use std::borrow::Cow;

/// Parameters of `effect` with which a refit may begin, the most promising first; none where no wavelength is among them.
pub(crate) fn starts(cases: Cases<'_>, current: &Fitted, effect: Effect) -> Vec<Vec<f64>> {
    let Some(place) = effect.wavelength() else {
        return Vec::new();
    };
    let some = cases.some(&current.spread(FEW));
    let records: Vec<Record> = (some.iter())
        .filter_map(|case| Record::of(case, SAMPLES_OF_BALANCE / some.len()))
        .collect();
    let ranges = some[0].model.ranges(effect);
    let mut best = peaks(&records, effect, place, &ranges);
    best.sort_by(|a, b| b.share.total_cmp(&a.share));
    let mut starts: Vec<Vec<f64>> = Vec::new();
    for peak in best {
        let is_near = |known: &Vec<f64>| (known[place] / peak.values[place] - 1.0).abs() < 0.02;
        if starts.len() < PEAKS && !starts.iter().any(is_near) {
            starts.push(peak.values);
        }
    }
    starts
}

/// A wavelength that explains more than its neighbours.
struct Peak {
    /// Share of what was left of the squared torque that it removes.
    share: f64,
    /// Parameters of the effect.
    values: Vec<f64>,
}

/// The highest peaks of what wavelengths explain of the balances of each width, width by width.
fn peaks(records: &[Record], effect: Effect, place: usize, ranges: &[PlausibleRange]) -> Vec<Peak> {
    let reach = records.iter().map(Record::reach).fold(0.0, f64::max);
    let (shortest, longest) = (ranges[place].minimum, ranges[place].maximum);
    let step = 1.0 / (PER_WAVE * reach);
    let count = ((1.0 / shortest - 1.0 / longest) / step).ceil();
    if !(reach > 0.0 && count >= 1.0) {
        return Vec::new();
    }
    let waves = Wave::of(effect, place, records[0].lever_arm_m);
    let explained =
        |widths: &[usize], wave_number: f64| explain(records, widths, &waves, place, wave_number);
    let at = |index: f64| 1.0 / longest + step * index;
    let has_balance = |width: &usize| records.iter().any(|one| one.balances[*width].is_some());
    let widths: Vec<usize> = (0..HALF_WIDTHS_OF_BALANCE.len())
        .filter(has_balance)
        .collect();
    let grid: Vec<Vec<Peak>> = (0..(count as usize).min(WAVELENGTHS))
        .into_par_iter()
        .map(|index| explained(&widths, at(index as f64)))
        .collect();
    let mut found = Vec::new();
    for (number, &width) in widths.iter().enumerate() {
        let share = |index: usize| grid[index][number].share;
        let is_highest = |&index: &usize| {
            let beside = [index.wrapping_sub(1), index + 1];
            let mut known = beside.iter().filter(|other| **other < grid.len());
            known.all(|&other| share(other) <= share(index))
        };
        let mut highest: Vec<usize> = (0..grid.len()).filter(is_highest).collect();
        highest.sort_by(|&a, &b| share(b).total_cmp(&share(a)));
        found.extend(highest.into_iter().take(PEAKS).filter_map(|index| {
            let offsets = (0..=2 * FINER).map(|part| part as f64 / FINER as f64 - 1.0);
            let near = offsets.map(|offset| at((index as f64 + offset).max(0.0)));
            near.flat_map(|wave_number| explained(&[width], wave_number))
                .max_by(|a, b| a.share.total_cmp(&b.share))
        }));
    }
    for peak in &mut found {
        for (value, range) in peak.values.iter_mut().zip(ranges) {
            *value = value.clamp(range.limits.0, range.limits.1);
        }
    }
    found
}

/// One wave of the force that size number `size` alone, of 1, makes.
struct Wave {
    size: usize,
    force_n: Vec<f64>,
}

impl Wave {
    /// That of every size of an effect whose parameter number `place` is the wavelength.
    fn of(effect: Effect, place: usize, lever_arm_m: f64) -> Vec<Self> {
        let count = effect.description().parameters.len();
        let alone = |size: usize| {
            let mut values = vec![0.0; count];
            (values[place], values[size]) = (1.0, 1.0);
            let force_n = (0..=PARTS_OF_A_WAVE).map(|part| {
                let at = Instant {
                    torque_nm: 0.0,
                    x_m: part as f64 / PARTS_OF_A_WAVE as f64,
                    v_m_per_s: 0.0,
                    since_onset_s: 0.0,
                    lever_arm_m,
                };
                effect.force(&values, &at, &[]).unwrap_or(0.0)
            });
            Self {
                size,
                force_n: force_n.collect(),
            }
        };
        let sizes = (0..count).filter(|&size| size != place);
        sizes.map(alone).collect()
    }

    /// The force at a place of the wave \[N\].
    fn at(&self, place: &InWave) -> f64 {
        let (before, after) = (self.force_n[place.part], self.force_n[place.part + 1]);
        before + (after - before) * place.beyond
    }
}

/// A place within a wave.
struct InWave {
    /// Which of its parts.
    part: usize,
    /// How far into it \[–\].
    beyond: f64,
}

impl InWave {
    fn after(waves: f64) -> Self {
        // Toward 0, and on: `floor` is a call for every sample.
        let beyond = waves - waves as i64 as f64;
        let beyond = if beyond < 0.0 { beyond + 1.0 } else { beyond };
        let along = beyond * PARTS_OF_A_WAVE as f64;
        let part = (along as usize).min(PARTS_OF_A_WAVE - 1);
        Self {
            part,
            beyond: along - part as f64,
        }
    }
}

/// What an effect of these waves explains with so many waves per metre, its sizes those that explain most, of the balances of each width.
fn explain(
    records: &[Record],
    widths: &[usize],
    waves: &[Wave],
    place: usize,
    wave_number: f64,
) -> Vec<Peak> {
    let mut normals: Vec<Normal> = widths.iter().map(|_| Normal::new(waves.len())).collect();
    for record in records {
        // The force at every sample is the same for every width.
        let places: Vec<InWave> = (record.x_m.iter())
            .map(|x_m| InWave::after(x_m * wave_number))
            .collect();
        let forces: Vec<Vec<f64>> = (waves.iter())
            .map(|wave| places.iter().map(|place| wave.at(place)).collect())
            .collect();
        for (normal, &width) in normals.iter_mut().zip(widths) {
            if let Some(balance) = &record.balances[width] {
                normal.add(balance, &forces, record.lever_arm_m);
            }
        }
    }
    let solved = normals.into_iter().map(|normal| {
        let mut values = vec![0.0; waves.len() + 1];
        values[place] = 1.0 / wave_number;
        normal.solved(values, waves)
    });
    solved.collect()
}

/// Normal equations of the sizes of an effect.
struct Normal {
    squares: Vec<Vec<f64>>,
    scores: Vec<f64>,
    /// What there is to explain \[(Nm)²\].
    whole: f64,
}

impl Normal {
    fn new(sizes: usize) -> Self {
        Self {
            squares: vec![vec![0.0; sizes]; sizes],
            scores: vec![0.0; sizes],
            whole: 0.0,
        }
    }

    /// Adds a balance, in which size number i makes force number i.
    fn add(&mut self, balance: &Balance, forces: &[Vec<f64>], lever_arm_m: f64) {
        let columns: Vec<Vec<f64>> = (forces.iter())
            .map(|force| balance.of_force(force, lever_arm_m))
            .collect();
        for (i, column) in columns.iter().enumerate() {
            self.scores[i] += dot(column, &balance.left_nm);
            for (j, other) in columns.iter().enumerate() {
                self.squares[i][j] += dot(column, other);
            }
        }
        self.whole += dot(&balance.left_nm, &balance.left_nm);
    }

    /// The sizes that explain most, put into `values`.
    fn solved(self, mut values: Vec<f64>, waves: &[Wave]) -> Peak {
        let information = SymmetricMatrix::new(waves.len(), self.squares.concat());
        let Some(sizes) = information.solve_scaled(&self.scores) else {
            return Peak { share: 0.0, values };
        };
        for (wave, &size) in waves.iter().zip(&sizes) {
            values[wave.size] = size;
        }
        let share = dot(&sizes, &self.scores).abs() / self.whole.max(f64::MIN_POSITIVE);
        Peak {
            share: if share.is_finite() { share } else { 0.0 },
            values,
        }
    }
}

/// What was measured of one tightening, and its balances of torques.
struct Record {
    lever_arm_m: f64,
    /// Displacement of the grip at every sample \[m\].
    x_m: Vec<f64>,
    /// One for each of [`HALF_WIDTHS_OF_BALANCE`] that the record is long enough for.
    balances: Vec<Option<Balance>>,
}

impl Record {
    /// Balances at no more than `most` places; nothing where angle or velocity are not known.
    fn of(case: &FitTask<'_>, most: usize) -> Option<Self> {
        let interval_s = case.tightening.time_base.interval_s;
        let known = |quantity| case.tightening.motion.get(quantity);
        let velocity = known(Quantity::Velocity);
        let angle = match (known(Quantity::Displacement), velocity) {
            (Some(angle), _) => Cow::Borrowed(angle),
            (None, Some(velocity)) => Cow::Owned(integral(velocity, interval_s)),
            _ => return None,
        };
        let measured = Measured {
            torque_nm: &case.tightening.torque_nm,
            angle: &angle,
            velocity,
            acceleration: known(Quantity::Acceleration),
            first: case.unscored(),
            interval_s,
        };
        let balances = HALF_WIDTHS_OF_BALANCE
            .iter()
            .map(|&half_width| Balance::of(&measured, half_width, most))
            .collect();
        let lever_arm_m = case.model.rig().lever_arm_m;
        Some(Self {
            lever_arm_m,
            x_m: angle[..measured.end()]
                .iter()
                .map(|angle| lever_arm_m * angle)
                .collect(),
            balances,
        })
    }

    /// How far the grip moves \[m\].
    fn reach(&self) -> f64 {
        let all = self.x_m.iter().copied().filter(|x| x.is_finite());
        let (low, high) = all.fold((f64::MAX, f64::MIN), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        high - low
    }
}

/// The signals of one tightening, in SI units.
struct Measured<'a> {
    torque_nm: &'a [f64],
    angle: &'a [f64],
    velocity: Option<&'a [f64]>,
    acceleration: Option<&'a [f64]>,
    /// First sample that is scored.
    first: usize,
    interval_s: f64,
}

impl Measured<'_> {
    /// Behind the last sample of which torque and angle are known.
    fn end(&self) -> usize {
        self.angle.len().min(self.torque_nm.len())
    }
}

/// The balance of torques of one tightening, averaged here and there.
struct Balance {
    weights: Modulation,
    /// First sample of every place.
    places: Vec<usize>,
    /// Orthonormal: what every model may explain.
    explained: Vec<Vec<f64>>,
    /// What is left of the torque \[Nm\].
    left_nm: Vec<f64>,
}

impl Balance {
    /// At no more than `most` places.
    fn of(measured: &Measured<'_>, half_width: usize, most: usize) -> Option<Self> {
        let weights = Modulation::new(half_width, measured.interval_s);
        let &Measured {
            torque_nm,
            angle,
            velocity,
            acceleration,
            ..
        } = measured;
        let length = weights.of_value.len();
        let hop = (2 * half_width / 3).max(1);
        let is_known = |place: &usize| {
            let of = |signal: &[f64]| {
                signal[*place..*place + length]
                    .iter()
                    .all(|v| v.is_finite())
            };
            of(angle) && velocity.is_none_or(of) && acceleration.is_none_or(of)
        };
        let places: Vec<usize> = (measured.first..(measured.end() + 1).saturating_sub(length))
            .step_by(hop)
            .filter(is_known)
            .take(most)
            .collect();
        let mean = |signal: &[f64], weight: &[f64]| -> Vec<f64> {
            let at = |&place: &usize| dot(&signal[place..place + length], weight);
            places.iter().map(at).collect()
        };
        let of_velocity = match velocity {
            Some(velocity) => mean(velocity, &weights.of_value),
            None => mean(angle, &weights.of_slope),
        };
        let of_acceleration = match (acceleration, velocity) {
            (Some(acceleration), _) => mean(acceleration, &weights.of_value),
            (None, Some(velocity)) => mean(velocity, &weights.of_slope),
            (None, None) => mean(angle, &weights.of_curvature),
        };
        let of_angle = mean(angle, &weights.of_value);
        let mut left_nm = mean(torque_nm, &weights.of_value);
        let smooth = smooth([of_angle, of_velocity, of_acceleration]);
        let mut balance = Self {
            weights,
            places,
            explained: Vec::new(),
            left_nm: Vec::new(),
        };
        balance.explain_away(smooth);
        balance.project(&mut left_nm);
        balance.left_nm = left_nm;
        (!balance.places.is_empty()).then_some(balance)
    }

    /// Takes up what every model may explain: these columns, as far as they are new.
    fn explain_away(&mut self, columns: [Vec<f64>; 8]) {
        for mut column in columns {
            let length = dot(&column, &column);
            self.project(&mut column);
            let rest = dot(&column, &column);
            if rest > ROUNDING * length {
                column.iter_mut().for_each(|value| *value /= rest.sqrt());
                self.explained.push(column);
            }
        }
    }

    /// The torque \[Nm\] of a force, averaged, without what every model may explain.
    fn of_force(&self, force_n: &[f64], lever_arm_m: f64) -> Vec<f64> {
        let weight = &self.weights.of_value;
        let mean =
            |&place: &usize| lever_arm_m * dot(&force_n[place..place + weight.len()], weight);
        let mut column: Vec<f64> = self.places.iter().map(mean).collect();
        self.project(&mut column);
        column
    }

    fn project(&self, column: &mut [f64]) {
        for known in &self.explained {
            let share = dot(known, column);
            for (value, known) in column.iter_mut().zip(known) {
                *value -= share * known;
            }
        }
    }
}

/// What every model may explain of a motion with these angles, velocities and accelerations: the base model's terms, and what
/// friction and springs of a simple shape add.
fn smooth([angle, velocity, acceleration]: [Vec<f64>; 3]) -> [Vec<f64>; 8] {
    let of_each = |f: &dyn Fn(f64) -> f64, values: &[f64]| -> Vec<f64> {
        values.iter().map(|&value| f(value)).collect()
    };
    [
        of_each(&|_| 1.0, &angle),
        of_each(&f64::signum, &velocity),
        of_each(&f64::abs, &velocity),
        of_each(&|a| a * a, &angle),
        of_each(&|a| a * a * a, &angle),
        acceleration,
        velocity,
        angle,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::Tally;
    use crate::tests::made_up::{SAMPLES, close, exact, hand, noisy};

    /// The most promising start of `effect` where some tightenings hide `hidden`.
    fn first(
        of: fn(usize, &[Effect], &[f64]) -> FitTask<'static>,
        effect: Effect,
        sizes: &[f64],
    ) -> Option<Vec<f64>> {
        let cases: Vec<FitTask> = (0..4)
            .map(|number| of(number, &[Effect::TorqueRipple], sizes))
            .collect();
        let own = (0..4).map(|number| hand(number).to_vec()).collect();
        let current = Fitted::made_up(&[], &[1.0; 4], SAMPLES).with_own(&["m", "c", "k"], own, 0);
        let tally = Tally::default();
        starts(Cases::new(&cases, &tally), &current, effect)
            .into_iter()
            .next()
    }

    #[test]
    fn a_ripple_s_wavelength_and_amplitudes_are_read_off() {
        for sizes in [[8.0, 4.0, 0.006], [-1.0, 2.0, 0.0031], [3.0, 0.0, 0.0123]] {
            for of in [exact, noisy] {
                let found = first(of, Effect::TorqueRipple, &sizes).expect("it has a wavelength");
                close(found[2], sizes[2], 0.02);
                let off = (found[0] - sizes[0]).hypot(found[1] - sizes[1]);
                let size = sizes[0].hypot(sizes[1]);
                assert!(off < 0.3 * size, "{found:?} for {sizes:?}");
            }
        }
    }

    #[test]
    fn other_effects_have_none() {
        assert!(first(exact, Effect::CubicStiffness, &[8.0, 4.0, 0.006]).is_none());
    }
}
