//! Starts for an effect whose force comes again with a wavelength of the displacement: read off the measurement, since the
//! cost has a minimum for every wavelength or so.
//!
//! For every wavelength the sizes follow by linear least squares, from the [`balance`] of torques, what the model explains
//! projected out, and from how the output [responds](response): two periodograms of the missing force over the displacement. The force is
//! a function of x/λ that repeats, so that one wave of it is worked out once.

mod balance;
mod response;

use crate::data::cases::Cases;
use crate::pooled::equation::values;
use crate::pooled::fitted::Fitted;
use crate::pooled::parameter_place::first_parameter;
use crate::ranking::thresholds::{
    FEW, FINER, HALF_WIDTHS_OF_BALANCE, PARTS_OF_A_WAVE, PEAKS, PER_WAVE, SAMPLES_OF_BALANCE,
    SAMPLES_OF_RESPONSE, WAVELENGTHS,
};
use balance::{Balance, Measured};
use rayon::prelude::*;
use response::Response;
use snug_campaign::Quantity;
use snug_identify::{FitTask, integral};
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use snug_model::{Effect, Instant, Law, PlausibleRange};
use std::borrow::Cow;

/// Parameters of `effect` with which a refit may begin, the most promising first; none where no wavelength is among them.
pub(crate) fn starts(cases: Cases<'_>, current: &Fitted, effect: Effect) -> Vec<Vec<f64>> {
    let Some(place) = effect.wavelength() else {
        return Vec::new();
    };
    let few = current.spread(FEW);
    let some = cases.some(&few);
    let values = values(cases, current);
    let record = |(case, &member): (&FitTask<'_>, &usize)| {
        let mut record = Record::of(case, SAMPLES_OF_BALANCE / some.len())?;
        let response = values.as_ref().and_then(|values| {
            let (effects, values) = (&current.effects, &values[member]);
            record.explain_away_waves(effects, values);
            Response::of(case, effects, values, SAMPLES_OF_RESPONSE / some.len())
        });
        record.shown.push(response.map(Shown::InOutput));
        Some(record)
    };
    let records: Vec<Record> = some.iter().zip(&few).filter_map(record).collect();
    let ranges = some[0].model.ranges(effect);
    let all = peaks(&records, effect, place, &ranges).into_iter();
    let is_in_torques = |(way, _): &(usize, Peak)| *way < HALF_WIDTHS_OF_BALANCE.len();
    let (in_torques, in_output): (Vec<_>, Vec<_>) = all.partition(is_in_torques);
    let mut starts: Vec<Vec<f64>> = Vec::new();
    for mut best in [in_torques, in_output] {
        best.sort_by(|(_, a), (_, b)| b.share.total_cmp(&a.share));
        let most = starts.len() + PEAKS;
        for (_, peak) in best {
            let is_near = |known: &Vec<f64>| (known[place] / peak.values[place] - 1.0).abs() < 0.02;
            if starts.len() < most && !starts.iter().any(is_near) {
                starts.push(peak.values);
            }
        }
    }
    starts
}

/// A wavelength that explains more than its neighbours.
struct Peak {
    /// Share of the squares of what was left that it removes.
    share: f64,
    /// Parameters of the effect.
    values: Vec<f64>,
}

/// The highest peaks of what wavelengths explain, each with the way in which it shows, one way after the other.
fn peaks(
    records: &[Record],
    effect: Effect,
    place: usize,
    ranges: &[PlausibleRange],
) -> Vec<(usize, Peak)> {
    let reach = records.iter().map(Record::reach).fold(0.0, f64::max);
    let (shortest, longest) = (ranges[place].minimum, ranges[place].maximum);
    let step = 1.0 / (PER_WAVE * reach);
    let count = ((1.0 / shortest - 1.0 / longest) / step).ceil();
    if !(reach > 0.0 && count >= 1.0) {
        return Vec::new();
    }
    let waves = Wave::of(effect, place, records[0].lever_arm_m);
    let explained =
        |ways: &[usize], wave_number: f64| explain(records, ways, &waves, place, wave_number);
    let at = |index: f64| 1.0 / longest + step * index;
    let is_shown = |way: &usize| records.iter().any(|one| one.shown[*way].is_some());
    let ways: Vec<usize> = (0..records[0].shown.len()).filter(is_shown).collect();
    let grid: Vec<Vec<Peak>> = (0..(count as usize).min(WAVELENGTHS))
        .into_par_iter()
        .map(|index| explained(&ways, at(index as f64)))
        .collect();
    let mut found = Vec::new();
    for (number, &way) in ways.iter().enumerate() {
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
            near.flat_map(|wave_number| explained(&[way], wave_number))
                .max_by(|a, b| a.share.total_cmp(&b.share))
                .map(|peak| (way, peak))
        }));
    }
    for (_, peak) in &mut found {
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

/// What an effect of these waves explains with so many waves per metre, its sizes those that explain most, in each of the ways.
fn explain(
    records: &[Record],
    ways: &[usize],
    waves: &[Wave],
    place: usize,
    wave_number: f64,
) -> Vec<Peak> {
    let mut normals: Vec<Normal> = ways.iter().map(|_| Normal::new(waves.len())).collect();
    for record in records {
        // The force at every sample is the same in each.
        let places: Vec<InWave> = (record.x_m.iter())
            .map(|x_m| InWave::after(x_m * wave_number))
            .collect();
        let forces: Vec<Vec<f64>> = (waves.iter())
            .map(|wave| places.iter().map(|place| wave.at(place)).collect())
            .collect();
        for (normal, &way) in normals.iter_mut().zip(ways) {
            if let Some(shown) = &record.shown[way] {
                normal.add(shown, &forces, record.lever_arm_m);
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
    /// What there is to explain.
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

    /// Adds what is shown, where size number i makes force number i.
    fn add(&mut self, shown: &Shown, forces: &[Vec<f64>], lever_arm_m: f64) {
        let columns: Vec<Vec<f64>> = (forces.iter())
            .map(|force| shown.of_force(force, lever_arm_m))
            .collect();
        let left = shown.left();
        for (i, column) in columns.iter().enumerate() {
            self.scores[i] += dot(column, left);
            for (j, other) in columns.iter().enumerate() {
                self.squares[i][j] += dot(column, other);
            }
        }
        self.whole += dot(left, left);
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

/// How a force shows in one tightening.
enum Shown {
    InTorques(Balance),
    InOutput(Response),
}

impl Shown {
    /// What there is to explain.
    fn left(&self) -> &[f64] {
        match self {
            Self::InTorques(balance) => &balance.left_nm,
            Self::InOutput(response) => &response.left,
        }
    }

    /// What a force \[N\] at every sample makes there.
    fn of_force(&self, force_n: &[f64], lever_arm_m: f64) -> Vec<f64> {
        match self {
            Self::InTorques(balance) => balance.of_force(force_n, lever_arm_m),
            Self::InOutput(response) => response.of_force(force_n, lever_arm_m),
        }
    }
}

/// What was measured of one tightening, and how a force shows in it.
struct Record {
    lever_arm_m: f64,
    /// Displacement of the grip at every sample \[m\].
    x_m: Vec<f64>,
    /// In the balance over each of [`HALF_WIDTHS_OF_BALANCE`], and in the output; as far as the record is long enough.
    shown: Vec<Option<Shown>>,
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
        let balances = (HALF_WIDTHS_OF_BALANCE.iter())
            .map(|&half_width| Balance::of(&measured, half_width, most).map(Shown::InTorques))
            .collect();
        let lever_arm_m = case.model.rig().lever_arm_m;
        Some(Self {
            lever_arm_m,
            x_m: angle[..measured.end()]
                .iter()
                .map(|angle| lever_arm_m * angle)
                .collect(),
            shown: balances,
        })
    }

    /// Takes up, in the balances, what the waves explain that are in a model of these `effects` and `values`.
    fn explain_away_waves(&mut self, effects: &[Effect], values: &[f64]) {
        for &effect in effects {
            let Some(place) = effect.wavelength() else {
                continue;
            };
            let wavelength_m = values[first_parameter(effects, effect) + place];
            let places: Vec<InWave> = (self.x_m.iter())
                .map(|x_m| InWave::after(x_m / wavelength_m))
                .collect();
            let forces: Vec<Vec<f64>> = (Wave::of(effect, place, self.lever_arm_m).iter())
                .map(|wave| places.iter().map(|place| wave.at(place)).collect())
                .collect();
            for shown in self.shown.iter_mut().flatten() {
                if let Shown::InTorques(balance) = shown {
                    let columns = forces.iter();
                    let columns = columns.map(|force| balance.of_force(force, self.lever_arm_m));
                    let columns: Vec<Vec<f64>> = columns.collect();
                    balance.explain_away(columns);
                }
            }
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::Tally;
    use crate::pooled::fit::fit_effects;
    use crate::pooled::model::PooledModel;
    use crate::tests::made_up::{WHOLE, close, exact, noisy};
    use snug_least_squares::PooledSettings;

    /// The most promising start of `effect` where some tightenings hide what is `hidden` in them, beside the base model, with the first ripple as
    /// far as it is `known`.
    fn first(
        of: fn(usize, &[Effect], &[f64]) -> FitTask<'static>,
        hidden: (&[Effect], &[f64]),
        known: Option<&[f64]>,
        effect: Effect,
    ) -> Option<Vec<f64>> {
        let cases: Vec<FitTask> = (0..4)
            .map(|number| of(number, hidden.0, hidden.1))
            .collect();
        let tally = Tally::default();
        let counted = Cases::new(&cases, &tally);
        let mut current = fit_effects(counted, &[], None, WHOLE).expect("it can be fitted");
        if let Some(known) = known {
            let mut pooled = PooledModel::new(counted, &[Effect::TorqueRipple]).expect("it is one");
            let start = current.start(&pooled);
            let start = pooled.with_effect(start, Effect::TorqueRipple, known);
            let there = PooledSettings {
                max_iterations: 0,
                ..PooledSettings::default()
            };
            let end = pooled.fit(&start, &there);
            current = Fitted::new(&pooled, end.expect("it can be fitted"), &WHOLE);
        }
        starts(counted, &current, effect).into_iter().next()
    }

    fn is_near(found: &[f64], sizes: &[f64]) {
        close(found[2], sizes[2], 0.02);
        let off = (found[0] - sizes[0]).hypot(found[1] - sizes[1]);
        let size = sizes[0].hypot(sizes[1]);
        assert!(off < 0.3 * size, "{found:?} for {sizes:?}");
    }

    #[test]
    fn a_ripple_s_wavelength_and_amplitudes_are_read_off() {
        for sizes in [[8.0, 4.0, 0.006], [-1.0, 2.0, 0.0031], [3.0, 0.0, 0.0123]] {
            for of in [exact, noisy] {
                let hidden = ([Effect::TorqueRipple], sizes);
                let found = first(of, (&hidden.0, &hidden.1), None, Effect::TorqueRipple);
                is_near(&found.expect("it has a wavelength"), &sizes);
            }
        }
    }

    #[test]
    fn beside_a_ripple_that_is_known_the_next_is_read_off() {
        let (strong, weak) = ([8.0, 4.0, 0.0091], [-1.0, 1.5, 0.0035]);
        let effects = [Effect::TorqueRipple, Effect::SecondRipple];
        let hidden = (&effects[..], &[strong, weak].concat()[..]);
        for of in [exact, noisy] {
            let found = first(of, hidden, Some(&strong), Effect::SecondRipple);
            is_near(&found.expect("it has a wavelength"), &weak);
        }
    }

    #[test]
    fn other_effects_have_none() {
        let hidden = (&[Effect::TorqueRipple][..], &[8.0, 4.0, 0.006][..]);
        assert!(first(exact, hidden, None, Effect::CubicStiffness).is_none());
    }
}
