//! Every series judged under false-discovery control, and what is told of it: worst first.

use super::change_point::{Change, change};
use super::daily::{By, Series};
use super::quantities::{Quantities, Quantity};
use super::sisters::{Beside, beside};
use super::thresholds::{FALSE_DISCOVERY_RATE, SMALLEST_SHIFT_SD};
use crate::error::PlantError;
use crate::storage::partition::date_of;
use serde::Serialize;
use snug_statistics::descriptive::{mean, standard_deviation};
use snug_statistics::distributions::student_t_quantile;
use snug_statistics::multiplicity::benjamini_hochberg;
use std::collections::BTreeMap;

/// Where a series is now: since its change, or over all its days.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// Mean of the days' values, in the quantity's unit.
    pub mean: f64,
    /// Standard error over days, in the quantity's unit; `None` for one day.
    pub standard_error: Option<f64>,
    /// 95 % interval over days (Student's t), in the quantity's unit; `None` for one day.
    pub interval: Option<(f64, f64)>,
}

/// A series with what was found of it.
#[derive(Debug, Clone)]
pub struct JudgedSeries {
    pub series: Series,
    pub level: Level,
    pub change: Option<Change>,
    /// Adjusted p of the change (Benjamini and Hochberg).
    pub change_p: Option<f64>,
    pub is_changed: bool,
    pub beside: Option<Beside>,
    /// Adjusted p of the difference from the sisters (Benjamini and Hochberg).
    pub beside_p: Option<f64>,
    pub differs: bool,
}

impl JudgedSeries {
    /// The first day after the change, if there is one that counts.
    pub fn since(&self) -> Option<String> {
        let change = self.change.filter(|_| self.is_changed)?;
        Some(date_of(self.series.days[change.first].day))
    }

    /// How far the level moved \[daily spread\].
    pub fn shift(&self) -> f64 {
        let moved = |change: &Change| ((change.after - change.before) / change.spread).abs();
        self.change.as_ref().map_or(0.0, moved)
    }
}

/// Every series, judged.
#[derive(Debug, Clone)]
pub struct Judged {
    /// All of them.
    pub all: Vec<JudgedSeries>,
    quantities: Quantities,
    by_group: BTreeMap<(By, String), Vec<usize>>,
}

impl Judged {
    pub fn of(series: &[Series], quantities: &Quantities) -> Result<Self, PlantError> {
        let mut judged = series.iter().map(unjudged).collect::<Result<Vec<_>, _>>()?;
        for by in By::ALL {
            changes(&mut judged, by)?;
            levels(&mut judged, by)?;
            differences(&mut judged, by, quantities)?;
        }
        let mut by_group: BTreeMap<(By, String), Vec<usize>> = BTreeMap::new();
        for (index, one) in judged.iter().enumerate() {
            let group = (one.series.by, one.series.group.clone());
            by_group.entry(group).or_default().push(index);
        }
        Ok(Self {
            all: judged,
            quantities: quantities.clone(),
            by_group,
        })
    }

    /// The series of one group.
    pub fn of_group(&self, by: By, group: &str) -> impl Iterator<Item = &JudgedSeries> {
        let own = self.by_group.get(&(by, group.to_owned()));
        own.into_iter().flatten().map(|&index| &self.all[index])
    }

    /// What is told.
    pub fn watched(&self) -> Watched {
        let mut found: Vec<Found> = Vec::new();
        let mut quiet: BTreeMap<By, usize> = BTreeMap::new();
        for (by, group) in self.by_group.keys() {
            let (by, own): (By, Vec<&JudgedSeries>) = (*by, self.of_group(*by, group).collect());
            match own.iter().any(|one| one.is_changed || one.differs) {
                true => found.push(self.found(by, group, &own)),
                false => *quiet.entry(by).or_default() += 1,
            }
        }
        found.sort_by(|one, other| {
            other
                .shift_in_daily_spreads
                .total_cmp(&one.shift_in_daily_spreads)
        });
        let (tools, others) = found
            .into_iter()
            .partition(|one| one.by == By::Tool.column());
        Watched {
            false_discovery_rate: FALSE_DISCOVERY_RATE,
            tools,
            joints_and_stations: others,
            quiet_tools: quiet.get(&By::Tool).copied().unwrap_or(0),
        }
    }

    fn found(&self, by: By, group: &str, own: &[&JudgedSeries]) -> Found {
        let told = |one: &&JudgedSeries| {
            let known = self.quantities.named(&one.series.column)?;
            Some(QuantityFound::of(one, known))
        };
        let mut changed: Vec<&JudgedSeries> =
            own.iter().copied().filter(|one| one.is_changed).collect();
        changed.sort_by(|one, other| other.shift().total_cmp(&one.shift()));
        let effect_of =
            |one: &&JudgedSeries| self.quantities.named(&one.series.column)?.effect.clone();
        let by_effect = changed.iter().find(|one| effect_of(one).is_some());
        let differing: Vec<&JudgedSeries> = own.iter().copied().filter(|one| one.differs).collect();
        Found {
            by: by.column().to_owned(),
            name: group.to_owned(),
            since: by_effect.or(changed.first()).and_then(|one| one.since()),
            effect: by_effect.and_then(effect_of),
            shift_in_daily_spreads: changed.first().map_or(0.0, |one| one.shift().min(f64::MAX)),
            changed: changed.iter().filter_map(told).collect(),
            differs_from_sisters: differing.iter().filter_map(told).collect(),
        }
    }
}

fn unjudged(series: &Series) -> Result<JudgedSeries, PlantError> {
    let values: Vec<f64> = series.days.iter().map(|day| day.value).collect();
    Ok(JudgedSeries {
        level: level(&values)?,
        change: change(&values),
        series: series.clone(),
        change_p: None,
        is_changed: false,
        beside: None,
        beside_p: None,
        differs: false,
    })
}

fn level(values: &[f64]) -> Result<Level, PlantError> {
    let mean = mean(values)?;
    if values.len() < 2 {
        return Ok(Level {
            mean,
            standard_error: None,
            interval: None,
        });
    }
    let error = standard_deviation(values)? / (values.len() as f64).sqrt();
    let reach = student_t_quantile(0.975, (values.len() - 1) as f64) * error;
    Ok(Level {
        mean,
        standard_error: Some(error),
        interval: Some((mean - reach, mean + reach)),
    })
}

/// Which series of these groups changed, over all of them and all quantities.
fn changes(judged: &mut [JudgedSeries], by: By) -> Result<(), PlantError> {
    let tested: Vec<usize> = (0..judged.len())
        .filter(|&index| judged[index].series.by == by && judged[index].change.is_some())
        .collect();
    let p: Vec<f64> = (tested.iter())
        .filter_map(|&index| Some(judged[index].change?.p))
        .collect();
    for (&index, p) in tested.iter().zip(benjamini_hochberg(&p)?) {
        let one = &mut judged[index];
        one.change_p = Some(p);
        one.is_changed = p <= FALSE_DISCOVERY_RATE && one.shift() >= SMALLEST_SHIFT_SD;
    }
    Ok(())
}

/// Levels since the change, of series that changed.
fn levels(judged: &mut [JudgedSeries], by: By) -> Result<(), PlantError> {
    for one in judged
        .iter_mut()
        .filter(|one| one.series.by == by && one.is_changed)
    {
        let first = one.change.map_or(0, |change| change.first);
        let values: Vec<f64> = one.series.days[first..]
            .iter()
            .map(|day| day.value)
            .collect();
        one.level = level(&values)?;
    }
    Ok(())
}

/// Which groups differ from their sisters, quantity by quantity, under one control.
fn differences(
    judged: &mut [JudgedSeries],
    by: By,
    quantities: &Quantities,
) -> Result<(), PlantError> {
    let mut tested: Vec<(usize, Beside)> = Vec::new();
    for Quantity { column, .. } in &quantities.0 {
        let of_quantity: Vec<usize> = (0..judged.len())
            .filter(|&index| {
                let one = &judged[index];
                let error = one.level.standard_error;
                one.series.by == by
                    && one.series.column == *column
                    && error.is_some_and(|error| error > 0.0)
            })
            .collect();
        let means: Vec<f64> = of_quantity
            .iter()
            .map(|&index| judged[index].level.mean)
            .collect();
        let variances: Vec<f64> = (of_quantity.iter())
            .filter_map(|&index| Some(judged[index].level.standard_error?.powi(2)))
            .collect();
        let beside = beside(&means, &variances)?;
        let known = of_quantity.into_iter().zip(beside);
        tested.extend(known.filter_map(|(index, beside)| Some((index, beside?))));
    }
    let p: Vec<f64> = tested.iter().map(|(_, beside)| beside.p).collect();
    for ((index, beside), p) in tested.into_iter().zip(benjamini_hochberg(&p)?) {
        let one = &mut judged[index];
        one.beside = Some(beside);
        one.beside_p = Some(p);
        one.differs = p <= FALSE_DISCOVERY_RATE;
    }
    Ok(())
}

/// What was found, as it is written.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Watched {
    /// Share of what is told that may be false.
    pub false_discovery_rate: f64,
    /// Tools that changed or differ, worst first.
    pub tools: Vec<Found>,
    /// Joints and stations that did.
    pub joints_and_stations: Vec<Found>,
    /// Tools of which nothing is to be told.
    pub quiet_tools: usize,
}

/// A group that changed or differs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Found {
    /// `tool`, `joint` or `station`.
    pub by: String,
    /// Its name.
    pub name: String,
    /// First day of the change; `None` where it only differs.
    pub since: Option<String>,
    /// The effect whose size changed most; `None` where none of the model's did.
    pub effect: Option<String>,
    /// How far the quantity that changed most moved \[spread of its days\].
    pub shift_in_daily_spreads: f64,
    /// What changed, most first.
    pub changed: Vec<QuantityFound>,
    /// In what it differs from its sisters.
    pub differs_from_sisters: Vec<QuantityFound>,
}

/// A quantity that changed or differs, in its unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct QuantityFound {
    /// Its column in the results.
    pub column: String,
    /// What people call it.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// First day of its change.
    pub since: Option<String>,
    /// Mean of the days before.
    pub before: Option<f64>,
    /// Mean of the days since, or of all where it did not change.
    pub now: f64,
    /// Lower end of its 95 % interval.
    pub now_low: Option<f64>,
    /// Upper end of its 95 % interval.
    pub now_high: Option<f64>,
    /// Adjusted p of the change.
    pub change_p_adjusted: Option<f64>,
    /// Mean of its sisters.
    pub sisters: Option<f64>,
    /// Adjusted p of the difference from them.
    pub sisters_p_adjusted: Option<f64>,
}

impl QuantityFound {
    fn of(one: &JudgedSeries, known: &Quantity) -> Self {
        let change = one.change.filter(|_| one.is_changed);
        Self {
            column: known.column.clone(),
            name: known.name.clone(),
            unit: known.unit.clone(),
            since: one.since(),
            before: change.map(|change| change.before),
            now: one.level.mean,
            now_low: one.level.interval.map(|(low, _)| low),
            now_high: one.level.interval.map(|(_, high)| high),
            change_p_adjusted: one.change_p,
            sisters: one.beside.map(|beside| beside.mean),
            sisters_p_adjusted: one.beside_p,
        }
    }
}
