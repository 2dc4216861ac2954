//! Where a size changes, as far as the data say: the first tightening that may be the first with the later size.
//!
//! Moving a tightening with gradient g and curvature S from size α₁ to α₂, δ = α₂ − α₁ away, changes its squared residual by
//! 2 gᵀδ + δᵀSδ. A place is within the 95 % interval where the sum of these up to it stays below −2 ln(1 − √0.95) = 7.35 times the
//! mean squared residual: the likelihood of a place falls off on both sides, each with chance e^{−x/2} of x (Siegmund 1988).

use crate::pooled::fitted::Fitted;
use crate::pooled::thresholds::CHANGE_POINT;
use snug_campaign::{ChangePoint, Factor, TighteningId};
use snug_identify::FitTask;

/// The interval of the change by `factor` between the two sizes at `places`; `None` where they differ otherwise.
pub(super) fn change_point(
    cases: &[FitTask<'_>],
    fitted: &Fitted,
    factor: &Factor,
    places: &[usize],
) -> Option<ChangePoint> {
    let &[before, after] = places else {
        return None;
    };
    let of_number = |number: u32| TighteningId {
        file: String::new(),
        number,
    };
    let at = match factor {
        Factor::FromNumber(number) => of_number(*number),
        Factor::Since(id) => id.clone(),
        _ => return None,
    };
    let step = fitted.shared[after] - fitted.shared[before];
    let key = |id: &TighteningId| match factor {
        Factor::FromNumber(_) => of_number(id.number),
        _ => id.clone(),
    };
    let costs = costs(cases, fitted, [before, after], step, &key)?;
    let here = costs.partition_point(|(place, _)| *place < at);
    let most = CHANGE_POINT * fitted.scale();
    let (mut first, mut last) = (here, here);
    let mut sum = 0.0;
    // The change comes earlier: those just before it have the later size already.
    for place in (1..here).rev() {
        sum += costs[place].1;
        if sum < most {
            first = place;
        }
    }
    sum = 0.0;
    for (place, (_, cost)) in costs.iter().enumerate().take(costs.len() - 1).skip(here) {
        sum += cost;
        if sum < most {
            last = place + 1;
        }
    }
    let named = |place: usize| match &costs[place].0 {
        id if id.file.is_empty() => id.number.to_string(),
        id => id.to_string(),
    };
    Some(ChangePoint {
        first: named(first),
        last: named(last.min(costs.len() - 1)),
    })
}

/// What the squared residual grows by when the tightenings at a place have the other size, place by place in their order.
fn costs(
    cases: &[FitTask<'_>],
    fitted: &Fitted,
    [before, after]: [usize; 2],
    step: f64,
    key: &dyn Fn(&TighteningId) -> TighteningId,
) -> Option<Vec<(TighteningId, f64)>> {
    let mut costs: Vec<(TighteningId, f64)> = Vec::new();
    let mut order: Vec<usize> = (0..cases.len()).collect();
    order.sort_by_key(|&member| key(&cases[member].tightening.id));
    for member in order {
        let own = fitted.shared_of(member);
        let (at, step) = match own.iter().position(|&place| place == before) {
            Some(at) => (at, step),
            None => (own.iter().position(|&place| place == after)?, -step),
        };
        let (gradient, curvature) = fitted.of_one_size(member, at);
        let cost = 2.0 * gradient * step + curvature * step * step;
        let id = key(&cases[member].tightening.id);
        match costs.last_mut().filter(|(last, _)| *last == id) {
            Some((_, sum)) => *sum += cost,
            None => costs.push((id, cost)),
        }
    }
    Some(costs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pooled::sharing::{SharedSize, Sharing};
    use crate::tests::made_up::exact;
    use snug_model::Effect::CubicStiffness;

    /// Eight tightenings in a row, of which each says its size to ±1: 0 up to number 4, `later` from then on.
    fn changes(later: f64) -> ChangePoint {
        let cases: Vec<FitTask> = (0..8).map(|number| exact(number, &[], &[])).collect();
        let numbers: Vec<u32> = cases.iter().map(|one| one.tightening.id.number).collect();
        let factor = Factor::FromNumber(numbers[4]);
        let mut fitted = Fitted::made_up(&[CubicStiffness], &[1.0; 8], 1)
            .with_shared(("k3_n_per_m3", 3, 0.0), &[(1.0, 0.0); 8]);
        let size = |member: usize| SharedSize {
            index: 3,
            level: factor.level(&cases[member].tightening),
        };
        fitted.shared_sizes = vec![size(0), size(7)];
        fitted.shared_of = (0..8)
            .map(|member| vec![usize::from(member >= 4)])
            .collect();
        fitted.shared = vec![0.0, later];
        fitted.sharing = Sharing::default().with(CubicStiffness, Some(factor.clone()));
        change_point(&cases, &fitted, &factor, &[0, 1]).expect("it changes")
    }

    /// A step of 3 errors costs 9 for a single tightening on the wrong side, more than 7.35; one of 2 costs 4, two of them 8.
    #[test]
    fn a_clear_step_has_one_place_a_faint_one_several() {
        let clear = changes(3.0);
        assert_eq!((clear.first.as_str(), clear.last.as_str()), ("5", "5"));
        let faint = changes(2.0);
        assert_eq!((faint.first.as_str(), faint.last.as_str()), ("4", "6"));
    }
}
