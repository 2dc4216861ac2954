//! The misfit over the phases of a tightening.
//!
//! Each phase begins where the one before it ends, T_max being the window's largest torque and θ_max the largest
//! simulated |θ|:
//!
//! | phase | ends |
//! | --- | --- |
//! | before onset | at the onset |
//! | rise | when T first reaches 0.9 T_max |
//! | peak | when T was last at 0.9 T_max or more |
//! | release | when T has fallen below 0.1 T_max and the tool has reached its farthest point |
//! | rebound | when \|θ\| was last 0.1 θ_max or more |
//! | rest | with the window |

use super::Seen;
use super::aspect::{Part, View, sums};
use super::residual::Residuals;
use rayon::prelude::*;

/// In order.
pub const PHASES: [&str; 6] = ["before onset", "rise", "peak", "release", "rebound", "rest"];

/// Where each phase but the last ends (sample index, exclusive); `None` without onset, torque or displacement.
pub fn ends(seen: &Seen<'_>) -> Option<[usize; 5]> {
    let onset = seen.tightening.onset?;
    let torque = &seen.tightening.torque_nm;
    let peak_nm = torque.iter().copied().reduce(f64::max)?;
    let angle = seen.simulated.displacement_rad.as_deref()?;
    let (farthest, largest) = angle
        .iter()
        .map(|angle| angle.abs())
        .enumerate()
        .reduce(|best, one| if one.1 > best.1 { one } else { best })?;
    if peak_nm <= 0.0 || largest <= 0.0 {
        return None;
    }
    let high = |torque: &f64| *torque >= 0.9 * peak_nm;
    let rise = torque.iter().position(high)?.max(onset);
    let peak = (torque.iter().rposition(high)? + 1).max(rise);
    let fallen = torque[peak.min(torque.len())..]
        .iter()
        .position(|torque| *torque < 0.1 * peak_nm)
        .map_or(torque.len(), |after| peak + after);
    let release = fallen.max(farthest);
    let rebound = angle
        .iter()
        .rposition(|angle| angle.abs() >= 0.1 * largest)?
        + 1;
    Some([onset, rise, peak, release, rebound.max(release)])
}

/// One part a phase.
pub fn view(residuals: &Residuals<'_>) -> Option<View> {
    let sums: Vec<_> = residuals
        .all
        .par_iter()
        .map(|one| {
            let ends = ends(&one.seen);
            sums(one, PHASES.len(), |index| {
                let ends = ends.as_ref()?;
                Some(ends.iter().filter(|&&end| index >= end).count())
            })
        })
        .collect();
    let any = sums.iter().flatten().any(|sum| sum.count > 0.0);
    let parts = PHASES
        .iter()
        .map(|name| Part {
            name: (*name).to_owned(),
            from: None,
            to: None,
        })
        .collect();
    any.then_some(View {
        aspect: "phase",
        parts,
        sums,
    })
}
