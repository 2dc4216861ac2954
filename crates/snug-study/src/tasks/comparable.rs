//! Tightenings that can be judged together: one output, either all against their measured noise or none, and each once.

use crate::tasks::copies::Measured;
use snug_campaign::words::reason::Reason;
use snug_campaign::{Quantity, TighteningId};
use snug_identify::FitTask;
use std::collections::BTreeMap;

/// Tightenings that are judged by one measure.
pub(crate) struct Comparable {
    pub cases: Vec<FitTask<'static>>,
    /// Why others take no part; empty where all do.
    pub reasons: Vec<Reason>,
}

/// Of tightenings that are there more than once the first, and of those the largest group that have the compared output and a known (or
/// unknown) noise in common; of equals, the one whose noise is known.
///
/// A pooled residual has one unit: multiples of the noise, or the output's own. One tightening whose noise could not be
/// measured would take that unit away from all.
pub(crate) fn comparable(cases: Vec<FitTask<'static>>) -> Comparable {
    let (cases, copies) = without_copies(cases);
    let measures: Vec<(Quantity, bool)> = (cases.iter())
        .map(|case| (case.quantity(), case.whitening().is_some()))
        .collect();
    let mut alike: BTreeMap<(Quantity, bool), usize> = BTreeMap::new();
    for &measure in &measures {
        *alike.entry(measure).or_default() += 1;
    }
    let largest = (measures.iter().copied()).max_by_key(|one| (alike[one], one.1));
    let all = cases.len();
    let kept: Vec<FitTask<'static>> = (cases.into_iter().zip(measures))
        .filter_map(|(case, measure)| (Some(measure) == largest).then_some(case))
        .collect();
    let reason = match (largest, all - kept.len()) {
        (None, _) | (_, 0) => None,
        (Some((quantity, has_noise)), left_out) => Some(Reason::LeftOut {
            left_out,
            all,
            quantity: quantity.name(),
            has_noise,
        }),
    };
    Comparable {
        cases: kept,
        reasons: reason.into_iter().chain(copies).collect(),
    }
}

/// A copy is no evidence: it would make every interval narrower and every chance smaller than the measurement deserves.
fn without_copies(cases: Vec<FitTask<'static>>) -> (Vec<FitTask<'static>>, Option<Reason>) {
    let mut measured = Measured::default();
    let mut copies: Vec<(TighteningId, TighteningId)> = Vec::new();
    let mut kept = Vec::with_capacity(cases.len());
    for case in cases {
        let one = &case.tightening;
        match measured.before(&one.id, &one.torque_nm, &one.motion) {
            Some(original) => copies.push((one.id.clone(), original)),
            None => kept.push(case),
        }
    }
    let reason = copies.first().map(|(copy, original)| Reason::Copies {
        left_out: copies.len(),
        first: copy.to_string(),
        of: original.to_string(),
    });
    (kept, reason)
}
