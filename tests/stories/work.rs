//! How much work fits and a diagnosis are, in counts: what becomes slower without anyone noticing shows here, on any machine.
//!
//! Counts are exact. When one changes, look at `what_it_takes` beside it first: fewer passes or conic programs for the
//! same answer are a gain, more need a reason (a harder case that now converges, a candidate more in the catalogue).
//! Then take over what the failing test prints, and say the reason in the commit.

use crate::coarse;
use snug_campaign::{Quantity, WorkDone};
use snug_diagnose::{DiagnoseSettings, Goal, Question, Watch, examine, fit_together};
use snug_identify::{FitTask, IdentifySettings, identify};
use snug_model::Effect;
use snug_synthetic::{CampaignPlan, HiddenEffect};

/// Eight tightenings with a spring that hardens.
fn cases() -> Vec<FitTask<'static>> {
    let plan = CampaignPlan::of_size(4, 2).hiding(HiddenEffect::CubicStiffness, 0.35);
    let folder = tempfile::tempdir().unwrap();
    let study = coarse::study(plan, 11, folder.path());
    let listing = snug_ingest::list(&study.source, &study.source.path).unwrap();
    let cases = snug_study::cases(&study, &listing.files, usize::MAX).unwrap();
    assert_eq!(cases.len(), 8, "every tightening can be used");
    cases
}

/// Iterations, evaluations and conic programs of all tightenings, each fitted by itself.
fn one_by_one(
    cases: &[FitTask<'_>],
    fitted_output: Quantity,
    effect: Option<Effect>,
) -> [usize; 3] {
    let settings = IdentifySettings {
        fitted_output,
        ..IdentifySettings::default()
    };
    cases.iter().fold([0; 3], |[steps, passes, conic], case| {
        let model = match effect {
            Some(effect) => case.model.with_effect(effect).unwrap(),
            None => case.model.clone().into_owned(),
        };
        let estimate = identify(&model, &case.input, &case.tightening, &settings).unwrap();
        [
            steps + estimate.iterations,
            passes + estimate.evaluations,
            conic + estimate.conic_solves,
        ]
    })
}

fn diagnosed(cases: &[FitTask<'_>], threads: usize) -> WorkDone {
    let question = Question::new(cases, Goal::Diagnose);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    let settings = DiagnoseSettings::default();
    let answer = pool.install(|| examine(&question, &settings, &Watch::new(&|_| ())));
    answer.unwrap().diagnosis.work
}

#[test]
fn a_fit_takes_no_more_passes_than_before() {
    let cases = cases();
    let spring = Some(Effect::CubicStiffness);
    let counted = [
        one_by_one(&cases, Quantity::Displacement, None),
        one_by_one(&cases, Quantity::Acceleration, None),
        one_by_one(&cases, Quantity::Acceleration, spring),
    ];
    // Iterations, passes, conic programs.
    let what_it_takes = [[26, 34, 0], [35, 43, 0], [48, 56, 0]];
    assert_eq!(counted, what_it_takes, "see the head of this file");
}

#[test]
fn a_pooled_fit_takes_no_more_passes_than_before() {
    let cases = cases();
    let counted = [&[][..], &[Effect::CubicStiffness]]
        .map(|effects| fit_together(&cases, effects).unwrap().work);
    let what_it_takes =
        [(6, 56, 0), (6, 56, 0)].map(|(steps, linearizations, conic_solves)| WorkDone {
            pooled_fits: 1,
            steps,
            linearizations,
            conic_solves,
            ..WorkDone::default()
        });
    assert_eq!(counted, what_it_takes, "see the head of this file");
}

#[test]
fn a_diagnosis_takes_no_more_work_than_before_and_the_same_for_any_threads() {
    let cases = cases();
    let counted = diagnosed(&cases, 1);
    assert_eq!(counted, diagnosed(&cases, 3), "work depends on the threads");
    let what_it_takes = WorkDone {
        rankings: 1,
        signatures: 824,
        pooled_fits: 169,
        steps: 1609,
        linearizations: 13468,
        conic_solves: 173,
    };
    assert_eq!(counted, what_it_takes, "see the head of this file");
}
