//! Whether the size of an effect differs between joints, strategies, paces, targets and people: the comparisons that are made of mass,
//! damping and stiffness, made of every tightening's own size.
//!
//! A tightening with gradient g and curvature S of its size, its own parameters free to follow, asks for the size α − g/S (one Newton
//! step). Conditions are tested with a random intercept for every person (restricted maximum likelihood), people by Welch's analysis of
//! variance; p is adjusted over all comparisons of one model (Benjamini and Hochberg).

use crate::library::is_unlisted;
use crate::pooled::fitted::Fitted;
use crate::pooled::groups::nothing::Nothing;
use crate::pooled::parameter_place::first_parameter;
use crate::pooled::sharing::Groups;
use snug_campaign::{AddedEffect, Factor, SizeComparison};
use snug_identify::FitTask;
use snug_model::{Effect, Law};
use snug_statistics::clustered::{Design, fit_random_intercept};
use snug_statistics::k_sample::welch_anova;
use snug_statistics::multiplicity::benjamini_hochberg;
use snug_statistics::{Result, TestResult};

/// The one term of every design here.
const TERM: &str = "factor";

/// Puts beside every effect of the model what comparisons of its size say.
pub(crate) fn compare_sizes(cases: &[FitTask<'_>], fitted: &Fitted, added: &mut [AddedEffect]) {
    if fitted.are_stretches() {
        return;
    }
    for one in added.iter_mut() {
        let effect = (fitted.effects.iter()).find(|effect| named(**effect, &one.effect));
        if let Some(&effect) = effect.filter(|effect| !is_unlisted(**effect)) {
            one.comparisons = of_effect(cases, fitted, effect);
        }
    }
    let all: Vec<f64> = (added.iter().flat_map(|one| &one.comparisons))
        .map(|comparison| comparison.p)
        .collect();
    let adjusted = benjamini_hochberg(&all).unwrap_or(all);
    let comparisons = added.iter_mut().flat_map(|one| &mut one.comparisons);
    for (comparison, p) in comparisons.zip(adjusted) {
        comparison.p_adjusted = p;
    }
}

fn named(effect: Effect, name: &str) -> bool {
    effect.name() == name
}

fn of_effect(cases: &[FitTask<'_>], fitted: &Fitted, effect: Effect) -> Vec<SizeComparison> {
    let index = first_parameter(&fitted.effects, effect);
    let spec = effect.description().parameters.first();
    let nothing = spec.map_or(Nothing::At(0.0), |spec| {
        Nothing::of(spec.vanishes_at, spec.limits)
    });
    let sizes: Vec<Option<f64>> = (0..cases.len())
        .map(|member| own_size(fitted, member, index, nothing))
        .collect();
    let factors = [
        Factor::Joint,
        Factor::Strategy,
        Factor::Pace,
        Factor::TargetTorque,
        Factor::Participant,
    ];
    let people = Groups::of(cases, &Factor::Participant);
    let compared = factors.into_iter().filter_map(|factor| {
        let groups = Groups::of(cases, &factor).filter(|groups| groups.levels.len() > 1)?;
        let known: Vec<usize> = (0..cases.len())
            .filter(|&member| sizes[member].is_some())
            .collect();
        let values: Vec<f64> = known.iter().filter_map(|&member| sizes[member]).collect();
        let levels: Vec<usize> = known.iter().map(|&member| groups.of[member]).collect();
        let who: Vec<usize> = (known.iter())
            .map(|&member| people.as_ref().map_or(member, |people| people.of[member]))
            .collect();
        let (method, test) = match factor {
            Factor::Participant => ("welch_anova", between(&values, &levels)),
            _ => ("mixed_model", under(&values, &levels, &who)),
        };
        let test = test.ok().filter(|test| test.p.is_finite())?;
        Some(SizeComparison {
            factor,
            method: method.to_owned(),
            statistic_name: test.statistic_name.to_owned(),
            statistic: test.statistic,
            degrees_of_freedom: test.degrees_of_freedom,
            p: test.p,
            p_adjusted: test.p,
        })
    });
    compared.collect()
}

/// The size that one tightening asks for, or its reciprocal where it is the less the larger it is; `None` where it says nothing of it,
/// or no tightening shares it.
fn own_size(fitted: &Fitted, member: usize, index: usize, nothing: Nothing) -> Option<f64> {
    let part = (fitted.parts(member, None).into_iter()).find(|part| part.index == index)?;
    let (gradient, curvature) = fitted.of_parameter(member, index)?;
    let step = -gradient / curvature;
    Some(match nothing {
        Nothing::At(_) => part.value + step,
        // d(1/s) = −ds/s².
        Nothing::Beyond => 1.0 / part.value - step / (part.value * part.value),
    })
}

/// Of groups of people.
fn between(values: &[f64], levels: &[usize]) -> Result<TestResult> {
    let count = levels.iter().max().map_or(0, |most| most + 1);
    let mut groups = vec![Vec::new(); count];
    for (&value, &level) in values.iter().zip(levels) {
        groups[level].push(value);
    }
    welch_anova(&groups)
}

/// Of conditions, people differing in level.
fn under(values: &[f64], levels: &[usize], who: &[usize]) -> Result<TestResult> {
    let design = Design::intercept(values.len()).factor(TERM, levels)?;
    fit_random_intercept(&design, who, values)?.test_term(TERM)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::{close, exact};
    use snug_model::Effect::CubicStiffness;

    /// Twelve tightenings of three people under two joints that ask for these sizes, each to ±1, with one size of 2 for all.
    fn compared(size: impl Fn(usize, usize) -> f64) -> Vec<SizeComparison> {
        let mut cases: Vec<FitTask> = (0..12).map(|number| exact(number, &[], &[])).collect();
        let mut evidence = Vec::new();
        for (number, case) in cases.iter_mut().enumerate() {
            let (person, joint) = (number % 3, number / 3 % 2);
            let conditions = &mut case.tightening.to_mut().conditions;
            conditions.participant = Some(format!("TP{person}"));
            conditions.joint = Some(["Soft", "Hard"][joint].to_owned());
            evidence.push((1.0, 2.0 - size(person, joint) - 0.1 * (number % 5) as f64));
        }
        let fitted = Fitted::made_up(&[CubicStiffness], &[1.0; 12], 1)
            .with_shared(("k3_n_per_m3", 3, 2.0), &evidence);
        of_effect(&cases, &fitted, CubicStiffness)
    }

    fn p(of: &[SizeComparison], factor: &Factor) -> f64 {
        let mut all = of.iter();
        all.find(|one| one.factor == *factor)
            .expect("it is compared")
            .p
    }

    #[test]
    fn sizes_that_differ_by_joint_are_told_apart_by_joint_alone() {
        let found = compared(|_, joint| 2.0 + 3.0 * joint as f64);
        assert!(p(&found, &Factor::Joint) < 1e-4, "{found:?}");
        assert!(p(&found, &Factor::Participant) > 0.05, "{found:?}");
    }

    #[test]
    fn sizes_that_differ_between_people_are_no_matter_of_joints() {
        let found = compared(|person, _| 2.0 + 3.0 * person as f64);
        assert!(p(&found, &Factor::Participant) < 1e-3, "{found:?}");
        assert!(p(&found, &Factor::Joint) > 0.05, "{found:?}");
    }

    #[test]
    fn a_tightening_asks_for_its_own_size() {
        let fitted = Fitted::made_up(&[CubicStiffness], &[1.0; 2], 1)
            .with_shared(("k3_n_per_m3", 3, 2.0), &[(4.0, 2.0), (0.0, 0.0)]);
        close(
            own_size(&fitted, 0, 3, Nothing::At(0.0)).expect("it says so"),
            1.5,
            1e-12,
        );
        assert_eq!(own_size(&fitted, 1, 3, Nothing::At(0.0)), None);
        let of_mass = own_size(&fitted, 0, 3, Nothing::Beyond).expect("it says so");
        close(of_mass, 0.5 + 0.5 / 4.0, 1e-12);
    }
}
