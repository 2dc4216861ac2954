//! Measured times to a uniform grid.

use crate::error::IngestError;
use crate::file::finding_log::{About, FindingLog};
use crate::memory::Budget;
use snug_campaign::TimeBase;

/// A filled record may have this many times the measured samples.
const LARGEST_FILL: f64 = 20.0;

/// How far a sample may lie from the uniform grid, in intervals, where a study says nothing.
pub(crate) fn default_tolerance_ratio() -> f64 {
    0.1
}

/// Samples of several channels at common, measured times.
pub(crate) struct Timed<'a> {
    /// Times \[s\], as measured.
    pub(crate) times_s: Vec<f64>,
    /// Channels, each as long as the times.
    pub(crate) channels: &'a mut [Vec<f64>],
    /// How a sample's place is called in messages, by its index: `line 7`.
    pub(crate) place: &'a dyn Fn(usize) -> String,
    /// What the file may take.
    pub(crate) budget: &'a Budget,
}

/// One channel with times of its own.
#[cfg(feature = "mcap")]
pub(crate) struct Track {
    /// Times \[s\], in any order.
    pub(crate) times_s: Vec<f64>,
    /// As many values.
    pub(crate) values: Vec<f64>,
}

/// Brings channels with times of their own to common times: those of the channel with most samples, within the time
/// that all cover; the others are interpolated linearly.
#[cfg(feature = "mcap")]
pub(crate) fn align(
    mut tracks: Vec<Track>,
    log: &mut FindingLog,
) -> Result<(Vec<f64>, Vec<Vec<f64>>), IngestError> {
    if tracks
        .windows(2)
        .all(|pair| pair[0].times_s == pair[1].times_s)
    {
        let times_s = tracks
            .first()
            .map_or_else(Vec::new, |track| track.times_s.clone());
        return Ok((
            times_s,
            tracks.into_iter().map(|track| track.values).collect(),
        ));
    }
    for track in &mut tracks {
        track.sort();
    }
    let start = tracks
        .iter()
        .map(|track| track.times_s[0])
        .fold(f64::NEG_INFINITY, f64::max);
    let end = tracks
        .iter()
        .map(|track| track.times_s[track.times_s.len() - 1])
        .fold(f64::INFINITY, f64::min);
    let densest = tracks
        .iter()
        .max_by_key(|track| track.times_s.len())
        .expect("windows of two were compared above");
    let times_s: Vec<f64> = densest
        .times_s
        .iter()
        .copied()
        .filter(|time| (start..=end).contains(time))
        .collect();
    if times_s.len() < 2 || tracks.iter().any(|track| track.times_s.len() < 2) {
        return Err(IngestError::TimeNotRising {
            rows: densest.times_s.len(),
            usable: times_s.len(),
            place: "sample 1; the channels hardly overlap".to_owned(),
        });
    }
    log.repaired(
        "channels_aligned",
        About::File,
        format!(
            "the channels have different times; all were brought to the {} samples from {start:.4} s to {end:.4} s of the \
             densest one, linearly",
            times_s.len()
        ),
    );
    let channels = tracks
        .iter()
        .map(|track| interpolate(&track.times_s, &track.values, times_s.iter().copied()))
        .collect();
    Ok((times_s, channels))
}

/// Channels whose times do not count, cut to the shortest.
#[cfg(feature = "mcap")]
pub(crate) fn cut_to_shortest(tracks: Vec<Track>, log: &mut FindingLog) -> Vec<Vec<f64>> {
    let lengths: Vec<usize> = tracks.iter().map(|track| track.values.len()).collect();
    let shortest = lengths.iter().copied().min().unwrap_or(0);
    if lengths.iter().any(|&length| length != shortest) {
        log.repaired(
            "unequal_lengths",
            About::File,
            format!("channels have different lengths ({lengths:?}); the first {shortest} samples of each are used"),
        );
    }
    tracks
        .into_iter()
        .map(|mut track| {
            track.values.truncate(shortest);
            track.values
        })
        .collect()
}

#[cfg(feature = "mcap")]
impl Track {
    /// Orders by time; of several values at one time the first stays.
    fn sort(&mut self) {
        let mut order: Vec<usize> = (0..self.times_s.len()).collect();
        order.sort_by(|&a, &b| self.times_s[a].total_cmp(&self.times_s[b]));
        order.dedup_by_key(|index| self.times_s[*index]);
        self.values = order.iter().map(|&index| self.values[index]).collect();
        self.times_s = order.iter().map(|&index| self.times_s[index]).collect();
    }
}

/// Puts the channels on a uniform grid.
///
/// Samples without a time, or not later than all before them, are dropped. Where every time lies within
/// `tolerance_ratio` intervals of the grid from the first to the last, the samples stay as they are. Otherwise they are
/// interpolated linearly at the median interval. Everything that changes is a finding.
pub(crate) fn uniform(
    mut timed: Timed<'_>,
    tolerance_ratio: f64,
    log: &mut FindingLog,
) -> Result<TimeBase, IngestError> {
    timed.keep_rising(log)?;
    let times = &timed.times_s;
    let (start_s, end_s) = (times[0], times[times.len() - 1]);
    let mean_s = (end_s - start_s) / (times.len() - 1) as f64;
    let on_grid = (0_u32..).zip(times).all(|(index, time)| {
        (time - start_s - f64::from(index) * mean_s).abs() <= tolerance_ratio * mean_s
    });
    if on_grid {
        return Ok(TimeBase {
            start_s,
            interval_s: mean_s,
        });
    }
    timed.resample(log)
}

impl Timed<'_> {
    fn keep_rising(&mut self, log: &mut FindingLog) -> Result<(), IngestError> {
        let rows = self.times_s.len();
        // Which samples stay, and the intervals between them.
        let on_the_way = self.budget.mark();
        self.budget.spend_on::<[f64; 4]>("the times", rows)?;
        self.budget.back_to(on_the_way);
        let mut latest = f64::NEG_INFINITY;
        let mut first_break = None;
        let mut kept = Vec::with_capacity(rows);
        for (index, &time) in self.times_s.iter().enumerate() {
            if time.is_finite() && time > latest {
                latest = time;
                kept.push(index);
            } else {
                first_break.get_or_insert(index);
            }
        }
        let place = first_break.map_or(String::new(), self.place);
        if kept.len() < 2 || kept.len() * 2 < rows {
            return Err(IngestError::TimeNotRising {
                rows,
                usable: kept.len(),
                place,
            });
        }
        if kept.len() < rows {
            log.repaired(
                "time_not_rising",
                About::File,
                format!(
                    "{} of {rows} samples have no time later than those before them (first at {place}) and were dropped",
                    rows - kept.len()
                ),
            );
            self.times_s = kept.iter().map(|&index| self.times_s[index]).collect();
            for channel in self.channels.iter_mut() {
                *channel = kept.iter().map(|&index| channel[index]).collect();
            }
        }
        Ok(())
    }

    fn resample(self, log: &mut FindingLog) -> Result<TimeBase, IngestError> {
        let times = &self.times_s;
        let mut intervals: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let (widest, gap_s) =
            intervals
                .iter()
                .copied()
                .enumerate()
                .fold(
                    (0, 0.0),
                    |best, (index, gap)| if gap > best.1 { (index, gap) } else { best },
                );
        let middle = intervals.len() / 2;
        let interval_s = *intervals.select_nth_unstable_by(middle, f64::total_cmp).1;
        let start_s = times[0];
        // The smallest tolerance keeps a last sample that lies on the grid up to rounding.
        let samples = ((times[times.len() - 1] - start_s) / interval_s + 1e-9).floor() + 1.0;
        // Times near the largest numbers give none.
        if samples.is_nan() || samples > LARGEST_FILL * times.len() as f64 {
            return Err(IngestError::TimeGap {
                gap_s,
                time_s: times[widest],
                samples,
                rows: times.len(),
            });
        }
        self.budget.spend_on::<f64>(
            "samples between the measured ones",
            (samples as usize).saturating_mul(self.channels.len()),
        )?;
        let grid = TimeBase {
            start_s,
            interval_s,
        };
        for channel in self.channels.iter_mut() {
            *channel = interpolate(
                times,
                channel,
                (0..samples as usize).map(|index| grid.at(index)),
            );
        }
        log.repaired(
            "resampled",
            About::File,
            format!(
                "the times are not uniform: the largest gap, {:.3} ms, follows the sample at {:.4} s; {} samples were \
                 interpolated linearly at the median interval of {:.5} ms, which gave {samples}",
                1e3 * gap_s,
                times[widest],
                times.len(),
                1e3 * interval_s
            ),
        );
        Ok(grid)
    }
}

/// Values at rising times `at`, on straight lines between the given ones (at least two, at rising times).
fn interpolate(times: &[f64], values: &[f64], at: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut left = 0;
    at.map(|time| {
        while left + 2 < times.len() && times[left + 1] <= time {
            left += 1;
        }
        let share = ((time - times[left]) / (times[left + 1] - times[left])).clamp(0.0, 1.0);
        // The ends are taken as they are, so that a NaN beside an exact hit does not spread.
        match share {
            0.0 => values[left],
            1.0 => values[left + 1],
            share => values[left] + share * (values[left + 1] - values[left]),
        }
    })
    .collect()
}

#[cfg(test)]
mod tests;
