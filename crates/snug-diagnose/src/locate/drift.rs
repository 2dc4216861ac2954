//! Drift of fitted m, c, k: effects that the model lacks hide in its parameters.

use super::Seen;
use super::exposure::{peaks, pulse_length_s};
use crate::locate::thresholds::{CONSTANT, FARTHEST, FEWEST_FREEDOM};
use rayon::prelude::*;
use snug_campaign::{Drift, FitStatus, Interval, Tightening, TighteningId};
use snug_model::BASE_PARAMETERS;
use snug_statistics::descriptive::{MAD_OF_NORMAL, median};
use snug_statistics::distributions::{student_t_quantile, student_t_two_sided};
use snug_statistics::multiplicity::benjamini_hochberg;
use std::collections::BTreeMap;

const AGAINST: [&str; 5] = [
    "peak_angle_rad",
    "peak_velocity_rad_per_s",
    "target_torque_nm",
    "pulse_length_s",
    "trial_number",
];

/// One tightening that takes part.
struct Row<'a> {
    seen: &'a Seen<'a>,
    ln: [f64; 3],
    person: String,
}

pub fn drifts(seen: &[Seen<'_>]) -> Vec<Drift> {
    let rows = rows(seen);
    let number_range = number_range(seen.iter().map(|one| one.tightening));
    let covariates = covariates(&rows);
    let mut drifts = Vec::new();
    for (parameter, name) in BASE_PARAMETERS.iter().enumerate() {
        for (covariate, against) in AGAINST.iter().enumerate() {
            let group = |row: &Row<'_>| match *against {
                "trial_number" => row.seen.tightening.id.file.clone(),
                _ => row.person.clone(),
            };
            let points: Vec<Point> = rows
                .iter()
                .zip(&covariates)
                .filter_map(|(row, own)| {
                    Some(Point {
                        group: group(row),
                        z: own[covariate]?,
                        y: row.ln[parameter],
                    })
                })
                .collect();
            if let Some(mut slope) = Slope::within(points) {
                if *against == "trial_number" {
                    slope.range = number_range;
                }
                drifts.push(slope.drift(name, against));
            }
        }
    }
    let p: Vec<f64> = drifts.iter().filter_map(|drift| drift.p).collect();
    if let Ok(adjusted) = benjamini_hochberg(&p) {
        for (drift, adjusted) in drifts.iter_mut().zip(adjusted) {
            drift.p_adjusted = Some(adjusted);
        }
    }
    drifts
}

/// Widest range of numbers within one file \[tightenings\], whether or not their estimates take part: over so many a change
/// with the trial number is stated.
pub(crate) fn number_range<'t>(tightenings: impl Iterator<Item = &'t Tightening>) -> f64 {
    let mut files: BTreeMap<&str, (u32, u32)> = BTreeMap::new();
    for TighteningId { file, number } in tightenings.map(|tightening| &tightening.id) {
        let (first, last) = files.entry(file).or_insert((*number, *number));
        (*first, *last) = ((*first).min(*number), (*last).max(*number));
    }
    let ranges = files.values().map(|(first, last)| last - first);
    f64::from(ranges.max().unwrap_or(0))
}

/// exp(b) − 1 \[1/tightening\] of what changes by 100 (exp(b Δz) − 1) \[%\] over Δz = `range` tightenings.
pub(crate) fn per_tightening(change_percent: f64, range: f64) -> f64 {
    ((change_percent / 100.0).ln_1p() / range).exp_m1()
}

fn rows<'a>(seen: &'a [Seen<'a>]) -> Vec<Row<'a>> {
    seen.iter()
        .filter(|one| one.estimate.status == FitStatus::Converged)
        .filter_map(|one| {
            let [m, c, k] = BASE_PARAMETERS.map(|name| {
                let parameter = one.estimate.parameter(name).filter(|p| !p.fixed)?;
                let ln = parameter.value.ln();
                ln.is_finite().then_some(ln)
            });
            let tightening = one.tightening;
            let person = tightening.conditions.participant.as_ref();
            Some(Row {
                seen: one,
                ln: [m?, c?, k?],
                person: person.unwrap_or(&tightening.id.file).clone(),
            })
        })
        .collect()
}

/// Per row a value of each of `AGAINST`.
fn covariates(rows: &[Row<'_>]) -> Vec<[Option<f64>; 5]> {
    let mut levels: BTreeMap<&str, ([f64; 3], f64)> = BTreeMap::new();
    for row in rows {
        let (sum, count) = levels.entry(&row.person).or_default();
        sum.iter_mut().zip(row.ln).for_each(|(sum, ln)| *sum += ln);
        *count += 1.0;
    }
    rows.par_iter()
        .map(|row| {
            let (sum, count) = &levels[row.person.as_str()];
            let peaks = peaks(row.seen, &sum.map(|sum| (sum / count).exp()));
            let target = row.seen.tightening.target_torque_nm;
            [
                peaks.map(|peaks| peaks[0]),
                peaks.map(|peaks| peaks[1]),
                Some(target).filter(|target| target.is_finite()),
                pulse_length_s(row.seen),
                Some(f64::from(row.seen.tightening.id.number)),
            ]
        })
        .collect()
}

struct Point {
    group: String,
    z: f64,
    y: f64,
}

/// A slope within groups.
struct Slope {
    slope: f64,
    standard_error: f64,
    freedom: f64,
    /// Widest range of the covariate within a group.
    range: f64,
}

impl Slope {
    /// Least squares of y on z within groups; `None` where z does not vary or too little is left to judge scatter.
    fn within(points: Vec<Point>) -> Option<Self> {
        let mut groups: BTreeMap<String, Vec<(f64, f64)>> = BTreeMap::new();
        for point in points {
            groups
                .entry(point.group)
                .or_default()
                .push((point.z, point.y));
        }
        let groups = without_outliers(groups.into_values().collect())?;
        let (mut szz, mut szy, mut syy, mut size, mut range) = (0.0, 0.0, 0.0, 0.0, 0.0_f64);
        for group in &groups {
            let n = group.len() as f64;
            let (z, y) = group
                .iter()
                .fold((0.0, 0.0), |(a, b), p| (a + p.0, b + p.1));
            let (z_mean, y_mean) = (z / n, y / n);
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for (z, y) in group {
                szz += (z - z_mean).powi(2);
                szy += (z - z_mean) * (y - y_mean);
                syy += (y - y_mean).powi(2);
                size += z * z;
                (low, high) = (low.min(*z), high.max(*z));
            }
            range = range.max(high - low);
        }
        let points: usize = groups.iter().map(Vec::len).sum();
        let freedom = points as f64 - groups.len() as f64 - 1.0;
        if freedom < FEWEST_FREEDOM || szz <= CONSTANT * CONSTANT * size {
            return None;
        }
        let slope = szy / szz;
        let variance = (syy - slope * szy).max(0.0) / freedom;
        Some(Self {
            slope,
            standard_error: (variance / szz).sqrt(),
            freedom,
            range,
        })
    }

    fn drift(&self, parameter: &str, against: &str) -> Drift {
        let percent = |slope: f64| 100.0 * (slope * self.range).exp_m1();
        let half = student_t_quantile(0.975, self.freedom) * self.standard_error;
        let judged = self.standard_error > 0.0;
        Drift {
            parameter: parameter.to_owned(),
            against: against.to_owned(),
            change_percent: percent(self.slope),
            interval_percent: judged.then(|| Interval {
                low: percent(self.slope - half),
                high: percent(self.slope + half),
            }),
            p: judged.then(|| student_t_two_sided(self.slope / self.standard_error, self.freedom)),
            p_adjusted: None,
        }
    }
}

/// The groups without values that are far from their group's median, measured by the scatter of all groups.
fn without_outliers(groups: Vec<Vec<(f64, f64)>>) -> Option<Vec<Vec<(f64, f64)>>> {
    let medians: Vec<f64> = groups
        .iter()
        .map(|group| {
            let values: Vec<f64> = group.iter().map(|(_, y)| *y).collect();
            median(&values).ok()
        })
        .collect::<Option<_>>()?;
    let off: Vec<f64> = groups
        .iter()
        .zip(&medians)
        .flat_map(|(group, median)| group.iter().map(move |(_, y)| (y - median).abs()))
        .collect();
    let scatter = median(&off).ok()? / MAD_OF_NORMAL;
    let near = |y: f64, median: f64| scatter == 0.0 || (y - median).abs() <= FARTHEST * scatter;
    Some(
        groups
            .into_iter()
            .zip(medians)
            .map(|(group, median)| {
                group
                    .into_iter()
                    .filter(|(_, y)| near(*y, median))
                    .collect::<Vec<_>>()
            })
            .filter(|group| !group.is_empty())
            .collect(),
    )
}
