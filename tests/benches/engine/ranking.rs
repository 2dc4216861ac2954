//! The whole catalogue ranked: what is missing beside the base model.

use crate::bare_loop;
use crate::campaign::{Campaign, START, record};
use crate::measure::{Clock, once, race};
use crate::table::{Reference, left_out, section, times_the};
use snug_diagnose::{DiagnoseSettings, Goal, Question, Watch, examine};
use snug_identify::FitTask;
use std::hint::black_box;

/// Tightenings of the short row and of the long one.
const FEW: usize = 24;
const MANY: usize = 2687;

pub fn fill(is_long: bool) {
    section(
        "Ranking of the whole catalogue, nothing hidden: base model fitted, every effect scored and refitted, negative control, where the model fails; all cores",
    );
    let campaign = Campaign::hiding(&[], FEW);
    let cases = campaign.cases();
    let mut candidates = 0;
    let [bare, ours] = race(
        Clock::Wall,
        [
            (1, &mut || bare_fits(&cases)),
            (1, &mut || candidates = diagnose(&cases)),
        ],
    );
    row(&bare, &ours, &format!("{FEW} tightenings"), candidates);
    if !is_long {
        return left_out(&format!(
            "the same for {MANY} tightenings takes minutes: --long"
        ));
    }
    let campaign = Campaign::hiding(&[], MANY);
    let cases = campaign.cases();
    let bare = once(|| bare_fits(&cases));
    let learnt_from = campaign.usual_cases();
    let ours = once(|| candidates = diagnose(&learnt_from));
    let what = format!(
        "{} of {} tightenings, from which a study learns by itself",
        learnt_from.len(),
        cases.len()
    );
    row(&bare, &ours, &what, candidates);
    let ours = once(|| candidates = diagnose(&cases));
    row(
        &bare,
        &ours,
        &format!("all {} tightenings", cases.len()),
        candidates,
    );
}

fn row(
    bare: &crate::measure::Times,
    ours: &crate::measure::Times,
    tightenings: &str,
    candidates: usize,
) {
    let reference = Reference {
        name: "bare scalar loops",
        times: &bare.scaled(candidates as f64),
    };
    let what = format!(
        "{tightenings}; the reference fits the base model {candidates} times to each, once for each candidate"
    );
    times_the(&reference, ours, &what);
}

/// One base-model fit of each by the bare scalar loop.
pub fn bare_fits(cases: &[FitTask<'_>]) {
    for case in cases {
        black_box(bare_loop::fit(&record(case), START));
    }
}

/// Number of candidates ranked.
fn diagnose(cases: &[FitTask<'_>]) -> usize {
    let question = Question::new(cases, Goal::Diagnose);
    let answer = examine(
        &question,
        &DiagnoseSettings::default(),
        &Watch::new(&|_| ()),
    );
    answer
        .expect("the benchmark's own data")
        .diagnosis
        .ranking
        .len()
}
