//! A rung of the error ladder: what a fitted model leaves, in the sample and in what was held out.

use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::held;
use snug_campaign::{RankedEffect, Rung};
use snug_identify::FitTask;
use std::collections::BTreeSet;

/// All of a rung but what only an evaluation of the whole study can tell; `ranking` is what was ranked beside it.
pub(crate) fn rung(cases: &[FitTask<'_>], fitted: &Fitted, ranking: Vec<RankedEffect>) -> Rung {
    let squares = fitted.squares();
    let target = |cluster: usize| {
        let target = cases[fitted.members[cluster]].tightening.target_torque_nm;
        if target.is_finite() {
            target.round() as usize
        } else {
            0
        }
    };
    let names: Vec<Option<&String>> = {
        let all = cases
            .iter()
            .map(|case| case.tightening.conditions.participant.as_ref());
        all.collect()
    };
    let person = |cluster: usize| {
        let own = names[fitted.members[cluster]];
        names.iter().position(|name| *name == own).unwrap_or(0)
    };
    let relative =
        |heldout: Vec<f64>| fitted.error() * (heldout.iter().sum::<f64>() / squares).sqrt();
    let several = |group: &dyn Fn(usize) -> usize| {
        let groups: BTreeSet<usize> = (0..fitted.blocks.len()).map(group).collect();
        groups.len() > 1
    };
    let weighted = fitted.is_weighted;
    Rung {
        effects: fitted
            .effects
            .iter()
            .map(|effect| effect.name().to_owned())
            .collect(),
        error_over_noise: weighted.then(|| fitted.error()),
        heldout_error_over_noise: weighted.then(|| relative(fitted.heldout(&|cluster| cluster))),
        heldout_target_error_over_noise: (weighted && several(&target))
            .then(|| relative(fitted.heldout(&target))),
        heldout_participant_error_over_noise: (weighted && several(&person))
            .then(|| relative(fitted.heldout(&person))),
        rms_fitted_output: rms_residual(cases, fitted),
        rms_displacement_rad: None,
        fit_percent_median: None,
        selected_fraction: f64::NAN,
        ranking,
    }
}

/// Root mean square of what counts of measured − simulated of the compared output, in its unit; see [`FitTask::left`].
fn rms_residual(cases: &[FitTask<'_>], fitted: &Fitted) -> f64 {
    let (mut squares, mut count) = (0.0, 0_usize);
    for (member, case) in cases.iter().enumerate() {
        let Some(model) = held(case, fitted, member, None) else {
            continue;
        };
        let values: Vec<f64> = model.parameters().iter().map(|p| p.value).collect();
        let simulated = case
            .simulated(&model, &values)
            .expect("the input of a case is as long as what was measured");
        let left = case.left(&simulated);
        squares += left.iter().map(|r| r * r).sum::<f64>();
        count += left.len();
    }
    (squares / count.max(1) as f64).sqrt()
}
