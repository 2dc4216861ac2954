//! What an effect that is not in the model would leave in the residual of one tightening.

use super::cases::LiveCases;
use super::fit::LiveFit;
use crate::data::cases::{Cases, Tally};
use crate::data::simulation::Asked;
use crate::error::DiagnoseError;
use crate::pooled::model::PooledModel;
use crate::ranking::score_test::{Control, Scorer};
use crate::ranking::sensitivity::Column;
use snug_least_squares::matrix::{SymmetricMatrix, inner_product as dot};
use snug_model::Effect;

impl LiveCases {
    /// What of the residual of tightening number `member` under `fit` an effect would take, to first order: its push of the output in
    /// the size that all tightenings together predict, less what the model's own parameters can imitate of it. In the SI unit of
    /// the compared output, a value for each sample of the window; `None` where no tightening says anything of its size.
    ///
    /// # Errors
    /// What the model refuses.
    ///
    /// # Panics
    /// Where there is no such tightening.
    pub fn signature(
        &self,
        fit: &LiveFit,
        member: usize,
        effect: Effect,
    ) -> Result<Option<Vec<f64>>, DiagnoseError> {
        let tally = Tally::default();
        let (cases, current) = (self.counted(&tally), &fit.fitted);
        let pooled = PooledModel::shared_by(cases, &current.effects, &current.sharing)?;
        let scorer = Scorer::new(&pooled, current, self.clusters, Control::default());
        let columns = scorer.score(&[effect])?.columns;
        let best =
            (columns.iter()).max_by(|a, b| a.predicted_gain().total_cmp(&b.predicted_gain()));
        let place = current.members.iter().position(|&of| of == member);
        let Some((column, times)) = best.and_then(|best| Some((best, predicted(best, place?)?)))
        else {
            return Ok(None);
        };
        let one = [self.cases[member].lent()];
        let with = PooledModel::new(
            Cases::new(&one, &tally),
            &[current.effects.as_slice(), &[effect]].concat(),
        )?;
        let without = PooledModel::new(Cases::new(&one, &tally), &current.effects)?;
        let values = pooled.values(member, &current.own[member], &current.shared);
        let asked = [Asked {
            member: 0,
            input: &one[0].input,
            values: &values,
        }];
        let plain = without.outputs(&asked);
        let mut push = column.signatures(&with, &asked, &plain).swap_remove(0);
        if let Some(follows) = scorer.shared_that_follow(column) {
            for (place, &size) in pooled.shared_of[member].iter().enumerate() {
                let share = (pooled.shares.as_ref()).map_or(1.0, |all| all[member][place]);
                let of_one = without.derivatives(&asked, pooled.shared[size].index);
                take(&mut push, share * follows[size], &of_one[0]);
            }
        }
        push.iter_mut().for_each(|value| *value *= times);
        let own = match scorer.is_joint() {
            true => pooled.own.clone(),
            false => pooled.order(),
        };
        without_imitation(&without, &asked, &own, &mut push);
        Ok(Some(push))
    }
}

/// By what a column's signature is to be multiplied in the tightening whose cluster is number `place`.
fn predicted(column: &Column, place: usize) -> Option<f64> {
    let (score, information) = match column.is_own() {
        true => (column.scores[place], column.variances[place]),
        false => (column.scores.iter().sum(), column.information),
    };
    let times = score / information;
    (information > 0.0 && times.is_finite() && column.may_be(times)).then_some(times)
}

/// Takes out of `push` what the parameters `own` can imitate of it: the nearest combination of their sensitivities, near counting in
/// multiples of the noise.
fn without_imitation(
    model: &PooledModel<'_>,
    asked: &[Asked<'_>; 1],
    own: &[usize],
    push: &mut [f64],
) {
    let sensitivities: Vec<Vec<f64>> = (own.iter())
        .map(|&index| model.derivatives(asked, index).swap_remove(0))
        .collect();
    let weighted: Vec<Vec<f64>> = (sensitivities.iter())
        .map(|one| model.weigh_signal(0, one))
        .collect();
    let target = model.weigh_signal(0, push);
    let mut normal = SymmetricMatrix::zero(own.len());
    for (i, one) in weighted.iter().enumerate() {
        for (j, other) in weighted.iter().enumerate() {
            normal.set(i, j, dot(one, other));
        }
    }
    let right: Vec<f64> = weighted.iter().map(|one| dot(one, &target)).collect();
    let Some(parts) = normal.solve_scaled(&right) else {
        return;
    };
    for (&part, sensitivity) in parts.iter().zip(&sensitivities) {
        take(push, part, sensitivity);
    }
}

fn take(from: &mut [f64], times: f64, what: &[f64]) {
    for (value, what) in from.iter_mut().zip(what) {
        *value -= times * what;
    }
}
