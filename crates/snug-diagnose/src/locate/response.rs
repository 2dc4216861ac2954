//! How the motion answers the torque over frequency, as measured and as simulated.
//!
//! Both go through the same estimate ([`Transfer`]): where they differ the model is wrong, not the estimate. Pulses begin at rest and
//! are weighed from their beginning on, so that what is still moving at the window's end leaks nothing; records without an onset are
//! cut into overlapping stretches as Welch does. Frequencies are told as far as most of them are coherent. A model that is not linear
//! has the response that fits best under this torque (Pintelon and Schoukens, System Identification, 2nd edition, chapter 3).

use super::residual::Residuals;
use crate::locate::thresholds::{COHERENT, STRETCHES};
use snug_campaign::{FrequencyResponse, Interval, Response};
use snug_signal::{Taper, Transfer, TransferLine};

/// `None` where nothing is coherent, not even at low frequencies.
pub fn response(residuals: &Residuals<'_>) -> Option<FrequencyResponse> {
    let quantity = residuals.quantity;
    let records: Vec<[&[f64]; 3]> = (residuals.all.iter())
        .filter_map(|one| {
            let measured = one.seen.tightening.motion.get(quantity)?;
            let simulated = one.seen.simulated.get(quantity)?;
            let torque_nm = one.seen.tightening.torque_nm.get(..measured.len())?;
            Some([torque_nm, measured, simulated])
        })
        .collect();
    let shortest = records
        .iter()
        .map(|[_, measured, _]| measured.len())
        .min()?;
    let begin_at_rest = (residuals.all.iter()).all(|one| one.seen.tightening.onset.is_some());
    let (taper, length) = match begin_at_rest {
        true => (Taper::Falling, shortest),
        false => (Taper::Hann, stretch(shortest, records.len())),
    };
    let mut both = [(); 2].map(|()| Transfer::of_length(length, taper));
    for [torque_nm, measured, simulated] in &records {
        let last = match begin_at_rest {
            true => 0,
            false => measured.len() - length,
        };
        for start in (0..=last).step_by((length / 2).max(1)) {
            let these = start..start + length;
            both[0].add(&torque_nm[these.clone()], &measured[these.clone()]);
            both[1].add(&torque_nm[these.clone()], &simulated[these]);
        }
    }
    let interval_s = residuals.all.first()?.seen.tightening.time_base.interval_s;
    let [measured, simulated] = both.map(|one| one.lines());
    let last = last_coherent(&measured)?;
    let pairs: Vec<(&TransferLine, &TransferLine)> = (measured[..=last].iter())
        .zip(&simulated)
        .filter(|(measured, simulated)| {
            measured.response.norm() > 0.0 && simulated.response.norm() > 0.0
        })
        .collect();
    Some(FrequencyResponse {
        quantity,
        frequency_hz: pairs
            .iter()
            .map(|(line, _)| line.cycles / interval_s)
            .collect(),
        measured: pairs.iter().map(|(line, _)| told(line)).collect(),
        simulated: pairs.iter().map(|(_, line)| told(line)).collect(),
        gain_interval: pairs.iter().map(|(line, _)| interval(line)).collect(),
        coherence: pairs.iter().map(|(line, _)| line.coherence).collect(),
        resolution_hz: 1.0 / (length as f64 * interval_s),
    })
    .filter(|response| response.frequency_hz.len() > 1)
}

/// The last frequency up to which most are coherent.
fn last_coherent(measured: &[TransferLine]) -> Option<usize> {
    let mut coherent = 0;
    let mut last = None;
    for (at, line) in measured.iter().enumerate() {
        let is_coherent = line.is_coherent() && line.coherence > Some(COHERENT);
        coherent += usize::from(is_coherent);
        if is_coherent && 2 * coherent > at {
            last = Some(at);
        }
    }
    last
}

/// Samples of one stretch, so that all records of so many samples together have enough that overlap by half.
fn stretch(samples: usize, records: usize) -> usize {
    let of_each = STRETCHES.div_ceil(records.max(1));
    (2 * samples / (of_each + 1)).clamp(1, samples)
}

fn told(line: &TransferLine) -> Response {
    Response {
        gain: line.response.norm(),
        phase_rad: line.response.arg(),
    }
}

fn interval(line: &TransferLine) -> Option<Interval> {
    let (gain, factor) = (line.response.norm(), line.factor_95()?);
    Some(Interval {
        low: gain / factor,
        high: gain * factor,
    })
}
