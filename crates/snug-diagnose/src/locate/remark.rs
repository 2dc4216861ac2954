//! What stands out of where a model fails.
//!
//! A part stands out when the low end of its error's interval lies above the whole campaign's error (for stretches of
//! time and frequency: above the noise) and its share of the misfit is well above its share of the data.

use super::force_shape::Followed;
use super::residual::Residuals;
use super::spectra::Spectra;
use super::tone::{Tone, tone};
use crate::locate::thresholds::{
    FOLLOWS, HARDLY_REPEATS, MORE_THAN_DUE, MOST, MOSTLY_REPEATS, NEARLY_AS_WELL, QUIET, RESEMBLES,
    WORTH,
};
use snug_campaign::words::remark::{Remark, Times};
use snug_campaign::{Aspect, Share};

pub fn remarks(
    residuals: &Residuals<'_>,
    spectra: &Spectra<'_, '_>,
    aspects: &[Aspect],
    followed: &Followed,
    repeatable_share: Option<f64>,
) -> Vec<Remark> {
    if !residuals.beyond_noise {
        return vec![Remark::OnlyNoise(residuals.error_over_noise)];
    }
    let seen = Seen { residuals };
    let mut remarks: Vec<Remark> = aspects
        .iter()
        .filter_map(|aspect| match aspect.aspect.as_str() {
            "time_since_onset_s" => seen.time(&aspect.parts),
            "phase" => seen.phase(&aspect.parts),
            "frequency_hz" => steady(spectra).or_else(|| seen.frequency(&aspect.parts)),
            "amplitude_rad" => seen.amplitude(&aspect.parts),
            _ => seen.condition(aspect),
        })
        .collect();
    remarks.extend(follows(&followed.shapes));
    remarks.extend(repeatable_share.and_then(repeats));
    if remarks.is_empty() {
        remarks.push(Remark::SpreadOut);
    }
    remarks
}

struct Seen<'a> {
    residuals: &'a Residuals<'a>,
}

impl Seen<'_> {
    /// How large an error is.
    fn times(&self, error: f64) -> Times {
        Times {
            error,
            of_noise: self.residuals.noise_known,
        }
    }

    fn time(&self, parts: &[Share]) -> Option<Remark> {
        let run = shortest_run(parts, MOST)?;
        Some(Remark::Time {
            share: share(run),
            from_s: run[0].from?,
            to_s: run[run.len() - 1].to?,
            since_onset: self.residuals.has_onset,
        })
    }

    fn phase(&self, parts: &[Share]) -> Option<Remark> {
        let part = self.outstanding(parts)?;
        Some(Remark::Phase {
            phase: part.part.clone(),
            share: part.share_of_excess,
            of_time: of_data(std::slice::from_ref(part), parts),
            error: self.times(part.error_over_noise),
        })
    }

    fn frequency(&self, parts: &[Share]) -> Option<Remark> {
        let run = shortest_run(parts, MOST)?;
        let last_loud = parts.iter().rposition(|part| {
            let above = part.interval.is_some_and(|interval| interval.low > 1.0);
            above && part.error_over_noise > QUIET
        });
        let quiet_from_hz = last_loud.and_then(|last| parts.get(last + 1)?.from);
        Some(Remark::Frequency {
            share: share(run),
            from_hz: run[0].from?,
            to_hz: run[run.len() - 1].to?,
            quiet_from_hz: quiet_from_hz.filter(|_| self.residuals.noise_known),
        })
    }

    /// Smallest against largest angles, where both hold enough to compare.
    fn amplitude(&self, parts: &[Share]) -> Option<Remark> {
        let mut judged = parts.iter().filter(|part| part.interval.is_some());
        let (small, large) = (judged.next()?, judged.next_back()?);
        let (low, high) = (small.interval?, large.interval?);
        let grows = high.low > low.high;
        (grows || low.low > high.high).then_some(Remark::Amplitude {
            grows,
            small: (small.to?, self.times(small.error_over_noise)),
            large: (large.from?, self.times(large.error_over_noise)),
            unit: "rad".to_owned(),
        })
    }

    fn condition(&self, aspect: &Aspect) -> Option<Remark> {
        let part = self.outstanding(&aspect.parts)?;
        Some(Remark::Condition {
            condition: aspect.aspect.clone(),
            value: part.part.clone(),
            share: part.share_of_excess,
            of_data: of_data(std::slice::from_ref(part), &aspect.parts),
        })
    }

    /// The part with the largest share, where it is more than its due beyond chance.
    fn outstanding<'p>(&self, parts: &'p [Share]) -> Option<&'p Share> {
        let part = parts
            .iter()
            .max_by(|a, b| a.share_of_excess.total_cmp(&b.share_of_excess))?;
        let due = of_data(std::slice::from_ref(part), parts);
        let beyond = part.interval?.low > self.residuals.error_over_noise;
        let stands_out =
            part.share_of_excess >= WORTH && part.share_of_excess >= MORE_THAN_DUE * due && beyond;
        (parts.len() > 1 && stands_out).then_some(part)
    }
}

/// One steady tone says more than the band that it lies in.
fn steady(spectra: &Spectra<'_, '_>) -> Option<Remark> {
    let Tone {
        hz,
        share,
        in_input,
    } = tone(spectra)?;
    Some(match in_input {
        true => Remark::PickedUp { share, hz },
        false => Remark::Tone { share, hz },
    })
}

/// What the missing force follows, where one shape explains most of it; with others that do so nearly as well.
fn follows(shapes: &[(&'static str, f64)]) -> Option<Remark> {
    let &(shape, share) = shapes.first().filter(|(_, share)| *share >= RESEMBLES)?;
    if share < FOLLOWS {
        let left = 1.0 - share;
        return Some(Remark::FollowsNothing { shape, left });
    }
    let others = shapes[1..].iter().copied();
    Some(Remark::Follows {
        shape,
        share,
        others: others
            .filter(|(_, other)| *other >= share - NEARLY_AS_WELL)
            .collect(),
    })
}

fn repeats(share: f64) -> Option<Remark> {
    match share {
        share if share >= MOSTLY_REPEATS => Some(Remark::Repeats(share)),
        share if share <= HARDLY_REPEATS => Some(Remark::DoesNotRepeat(share)),
        _ => None,
    }
}

/// The fewest neighbouring parts that together hold `least` of the misfit, each above 1 beyond chance; `None` where that
/// is no more than their due.
fn shortest_run(parts: &[Share], least: f64) -> Option<&[Share]> {
    let above = |part: &Share| part.interval.map_or(part.error_over_noise, |i| i.low) > 1.0;
    let run = (1..parts.len())
        .flat_map(|length| parts.windows(length))
        .filter(|run| share(run) >= least && run.iter().all(above))
        .min_by(|a, b| {
            let size = a.len().cmp(&b.len());
            size.then(share(b).total_cmp(&share(a)))
        })?;
    (share(run) >= MORE_THAN_DUE * of_data(run, parts)).then_some(run)
}

fn share(run: &[Share]) -> f64 {
    run.iter().map(|part| part.share_of_excess).sum()
}

/// Share of the aspect's samples.
fn of_data(run: &[Share], parts: &[Share]) -> f64 {
    let samples = |parts: &[Share]| parts.iter().map(|part| part.samples as f64).sum::<f64>();
    samples(run) / samples(parts).max(1.0)
}
