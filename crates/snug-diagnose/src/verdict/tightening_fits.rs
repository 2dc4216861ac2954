//! What a fitted model makes of every tightening: estimates and motion.

use crate::error::DiagnoseError;
use crate::locate::Seen;
use crate::pooled::fitted::Fitted;
use crate::pooled::sizes::held;
use snug_campaign::{Estimate, Motion};
use snug_identify::{FitTask, identify_all, in_batches};
use snug_model::Model;
use std::borrow::Cow;

/// Motion and estimate of every tightening under one fitted model.
pub(crate) struct TighteningFits<'a> {
    cases: &'a [FitTask<'a>],
    simulated: Vec<Motion>,
    estimates: Vec<Estimate>,
}

impl<'a> TighteningFits<'a> {
    /// Identifies every tightening with the shared parameters held where all tightenings together put them.
    pub fn of(cases: &'a [FitTask<'a>], fitted: &Fitted) -> Result<Self, DiagnoseError> {
        let models = held_models(cases, fitted);
        let tasks: Vec<FitTask<'_>> = (cases.iter().zip(&models))
            .map(|(case, model)| case.with_model(model))
            .collect();
        let fits = in_batches(&tasks, fits)?;
        let (estimates, simulated) = fits.into_iter().unzip();
        Ok(Self {
            cases,
            simulated,
            estimates,
        })
    }

    /// Measurement, motion and estimate of each.
    pub fn seen(&self) -> Vec<Seen<'_>> {
        self.cases
            .iter()
            .zip(&self.simulated)
            .zip(&self.estimates)
            .map(|((case, simulated), estimate)| Seen {
                tightening: &case.tightening,
                simulated,
                estimate,
                unscored: case.unscored(),
            })
            .collect()
    }
}

/// The model of each with everything but its own parameters held where all tightenings together put it.
pub(crate) fn held_models<'a>(cases: &'a [FitTask<'a>], fitted: &Fitted) -> Vec<Cow<'a, Model>> {
    let errors = fitted.shared_errors();
    (cases.iter().enumerate())
        .map(|(member, case)| {
            let held = held(case, fitted, member, errors.as_deref());
            held.map_or(Cow::Borrowed(&*case.model), Cow::Owned)
        })
        .collect()
}

/// Estimates and motions.
fn fits(tasks: &[FitTask<'_>]) -> Result<Vec<(Estimate, Motion)>, DiagnoseError> {
    (identify_all(tasks).into_iter().zip(tasks))
        .map(|(estimate, task)| {
            let estimate = estimate?;
            let values: Vec<f64> = estimate.parameters.iter().map(|p| p.value).collect();
            let motion = task.model.simulate(&values, &task.input)?;
            Ok((estimate, motion))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::cases::{Cases, Tally};
    use crate::pooled::fit::fit_sharing;
    use crate::pooled::sharing::Sharing;
    use crate::tests::made_up::{WHOLE, exact};
    use snug_campaign::{Factor, Quantity};
    use snug_model::Effect::CoulombFriction;

    /// Twenty tightenings, more than are identified together, of two people of whom the second alone has friction.
    #[test]
    fn each_has_the_size_of_its_own_group() {
        let cases: Vec<FitTask<'_>> = (0..20)
            .map(|number| {
                let (who, friction_n) = if number < 10 {
                    ("TP1", 0.0)
                } else {
                    ("TP2", 5.0)
                };
                let mut case = exact(number % 6, &[CoulombFriction], &[friction_n]);
                case.tightening.to_mut().conditions.participant = Some(who.to_owned());
                case
            })
            .collect();
        let tally = Tally::default();
        let sharing = Sharing::default().with(CoulombFriction, Some(Factor::Participant));
        let cases_in = Cases::new(&cases, &tally);
        let fitted = fit_sharing(cases_in, &[CoulombFriction], &sharing, None, WHOLE)
            .expect("it can be fitted");
        let fits = TighteningFits::of(&cases, &fitted).expect("each can be fitted");
        for seen in fits.seen() {
            let of = |motion: &Motion| motion.get(Quantity::Acceleration).map(<[f64]>::to_vec);
            let (measured, simulated) = (of(&seen.tightening.motion), of(seen.simulated));
            let pairs = measured.iter().flatten().zip(simulated.iter().flatten());
            let largest = pairs.map(|(y, s)| (y - s).abs()).fold(0.0, f64::max);
            assert!(largest < 1e-3, "{largest}");
        }
    }

    /// Whatever the study has its fits begin from: where all tightenings together put a tightening is a place to begin.
    #[test]
    fn each_fits_no_worse_than_all_together() {
        let mut cases: Vec<FitTask<'_>> = (0..4)
            .map(|number| exact(number, &[CoulombFriction], &[5.0]))
            .collect();
        let tally = Tally::default();
        let sharing = Sharing::default();
        let fitted = {
            let cases = Cases::new(&cases, &tally);
            fit_sharing(cases, &[CoulombFriction], &sharing, None, WHOLE)
        };
        let fitted = fitted.expect("it can be fitted");
        for case in &mut cases {
            let [mass, damping, stiffness, ..] = case.model.to_mut().parameters_mut() else {
                panic!("a model has m, c, k")
            };
            (mass.value, damping.value, stiffness.value) = (900.0, 1e-3, 1e6);
        }
        for (member, model) in held_models(&cases, &fitted).iter().enumerate() {
            let own: Vec<f64> = model.parameters()[..3].iter().map(|p| p.value).collect();
            assert_eq!(own, fitted.own[member]);
        }
        let fits = TighteningFits::of(&cases, &fitted).expect("each can be fitted");
        for (seen, all) in fits.seen().iter().zip(&fitted.own) {
            for (one, together) in seen.estimate.parameters.iter().zip(all) {
                assert!(
                    (one.value / together - 1.0).abs() < 1e-3,
                    "{one:?} {together}"
                );
            }
        }
    }
}
