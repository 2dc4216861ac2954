//! What stands out, in plain words.
//!
//! A part stands out when the low end of its error's interval lies above the whole campaign's error (for stretches of
//! time and frequency: above the noise) and its share of the misfit is well above its share of the data.

use super::force_shape::Followed;
use super::residual::Residuals;
use snug_campaign::{Aspect, Share};

/// Share of the misfit that counts as most of it.
const MOST: f64 = 0.6;
/// Share of the misfit from which on a shape of the force is told.
const RESEMBLES: f64 = 0.5;
/// Share of the misfit from which on the force is said to have that shape.
const FOLLOWS: f64 = 0.8;
/// A part with less of the misfit is not worth a sentence.
const WORTH: f64 = 0.2;
/// Share of the misfit over share of the data that is more than its due.
const MORE_THAN_DUE: f64 = 1.5;
/// Errors over noise up to this are told as nothing but noise.
const QUIET: f64 = 1.05;
/// Repeatable shares above and below which it is said.
const REPEATS: f64 = 0.7;
const DOES_NOT_REPEAT: f64 = 0.25;
/// Shapes of the missing force whose shares differ by less are told together.
const NEARLY_AS_WELL: f64 = 0.1;

pub fn remarks(
    residuals: &Residuals<'_>,
    aspects: &[Aspect],
    followed: &Followed,
    repeatable_share: Option<f64>,
) -> Vec<String> {
    if !residuals.beyond_noise {
        return vec![format!(
            "Nothing stands out: the error is {:.2} times the measured noise, which is what noise alone gives.",
            residuals.error_over_noise
        )];
    }
    let told = Told { residuals };
    let mut remarks: Vec<String> = aspects
        .iter()
        .filter_map(|aspect| match aspect.aspect.as_str() {
            "time_since_onset_s" => told.time(&aspect.parts),
            "phase" => told.phase(&aspect.parts),
            "frequency_hz" => told.frequency(&aspect.parts),
            "amplitude_rad" => told.amplitude(&aspect.parts),
            "participant" => told.condition(&aspect.parts, "Participant "),
            "strategy" => told.condition(&aspect.parts, "Strategy "),
            "joint" => told.condition(&aspect.parts, "Joint "),
            "pace_per_min" => told.condition(&aspect.parts, "The pace of "),
            "target_torque_nm" => told.condition(&aspect.parts, "The target of "),
            _ => None,
        })
        .collect();
    remarks.extend(follows(&followed.shapes));
    remarks.extend(repeatable_share.and_then(repeats));
    if remarks.is_empty() {
        remarks.push(
            "Nothing stands out: the misfit is spread over time, frequency and conditions."
                .to_owned(),
        );
    }
    remarks
}

struct Told<'a> {
    residuals: &'a Residuals<'a>,
}

impl Told<'_> {
    /// How large an error is, in words that hold with and without a known noise.
    fn times(&self, error: f64) -> String {
        if self.residuals.noise_known {
            format!("{error:.1} times the noise")
        } else {
            format!("{error:.1} times the average error")
        }
    }

    fn time(&self, parts: &[Share]) -> Option<String> {
        let run = shortest_run(parts, MOST)?;
        let (from, to) = (run[0].from?, run[run.len() - 1].to?);
        let where_to = if self.residuals.has_onset {
            "after the pulse began"
        } else {
            "into the recording"
        };
        let (from, to, unit) = if to < 1.0 {
            (from * 1e3, to * 1e3, "ms")
        } else {
            (from, to, "s")
        };
        let (from, to) = (super::grid::tidy(from), super::grid::tidy(to));
        Some(format!(
            "Most of the misfit ({}) lies {from} to {to} {unit} {where_to}.",
            percent(share(run))
        ))
    }

    fn phase(&self, parts: &[Share]) -> Option<String> {
        let part = self.outstanding(parts)?;
        let name = match part.part.as_str() {
            "before onset" => "time before the pulse",
            "rise" => "rise of the torque",
            "peak" => "torque's peak",
            "release" => "release",
            "rebound" => "rebound",
            _ => "rest after the rebound",
        };
        Some(format!(
            "The {name} holds {} of the misfit in {} of the time: the error there is {}.",
            percent(part.share_of_excess),
            percent(of_data(std::slice::from_ref(part), parts)),
            self.times(part.error_over_noise),
        ))
    }

    fn frequency(&self, parts: &[Share]) -> Option<String> {
        let run = shortest_run(parts, MOST)?;
        let (from, to) = (run[0].from?, run[run.len() - 1].to?);
        let band = if from == 0.0 {
            format!("below {to} Hz")
        } else {
            format!("between {from} and {to} Hz")
        };
        let mut told = format!("Most of the misfit ({}) lies {band}", percent(share(run)));
        let quiet_from = parts
            .iter()
            .rposition(|part| {
                let above = part.interval.is_some_and(|interval| interval.low > 1.0);
                above && part.error_over_noise > QUIET
            })
            .and_then(|last| parts.get(last + 1)?.from);
        if let Some(quiet_from) = quiet_from.filter(|_| self.residuals.noise_known) {
            told.push_str(&format!(
                "; above {quiet_from} Hz there is nothing but noise"
            ));
        }
        told.push('.');
        Some(told)
    }

    /// Smallest against largest angles, where both hold enough to compare.
    fn amplitude(&self, parts: &[Share]) -> Option<String> {
        let mut judged = parts.iter().filter(|part| part.interval.is_some());
        let (small, large) = (judged.next()?, judged.next_back()?);
        let (low, high) = (small.interval?, large.interval?);
        let (small_to, large_from) = (small.to?, large.from?);
        let compared = format!(
            "{} below {small_to} rad, {} above {large_from} rad",
            self.times(small.error_over_noise),
            self.times(large.error_over_noise)
        );
        if high.low > low.high {
            Some(format!("The misfit grows with the angle: {compared}."))
        } else if low.low > high.high {
            Some(format!(
                "The misfit is largest at small angles: {compared}."
            ))
        } else {
            None
        }
    }

    fn condition(&self, parts: &[Share], what: &str) -> Option<String> {
        let part = self.outstanding(parts)?;
        Some(format!(
            "{what}{} carries {} of the misfit with {} of the data.",
            part.part,
            percent(part.share_of_excess),
            percent(of_data(std::slice::from_ref(part), parts)),
        ))
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

/// What the missing force follows, where one shape explains most of it; with others that do so nearly as well.
fn follows(shapes: &[(&str, f64)]) -> Option<String> {
    let (best, share) = shapes.first().filter(|(_, share)| *share >= RESEMBLES)?;
    let described = percent(*share);
    if *share < FOLLOWS {
        return Some(format!(
            "No simple function of displacement and velocity describes the missing force: the best, {best}, leaves {} of the misfit.",
            percent(1.0 - share)
        ));
    }
    let others: Vec<String> = shapes[1..]
        .iter()
        .filter(|(_, other)| *other >= share - NEARLY_AS_WELL)
        .map(|(shape, other)| format!("{shape} ({})", percent(*other)))
        .collect();
    let mut told =
        format!("The missing force follows {best}: that describes {described} of the misfit");
    if !others.is_empty() {
        told.push_str(&format!("; nearly as well: {}", others.join("; ")));
    }
    told.push('.');
    Some(told)
}

fn repeats(share: f64) -> Option<String> {
    if share >= REPEATS {
        Some(format!(
            "{} of the misfit can be predicted from the other tightenings: a missing effect can explain it.",
            percent(share)
        ))
    } else if share <= DOES_NOT_REPEAT {
        Some(format!(
            "Only {} of the misfit can be predicted from the other tightenings: most of it is different each time, or is no simple function of time, displacement and velocity.",
            percent(share)
        ))
    } else {
        None
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

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}
