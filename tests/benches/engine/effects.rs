//! Every effect of the catalogue: one fit of one tightening, one of many by themselves, and its share of a pooled fit.

use crate::bare_loop;
use crate::base::{fit, fit_all, fitting};
use crate::campaign::{Campaign, START, record};
use crate::measure::{Clock, Times, race};
use crate::table::{Reference, section, times_the};
use snug_campaign::Quantity;
use snug_diagnose::fit_together;
use snug_identify::FitTask;
use snug_model::Effect;
use snug_synthetic::HiddenEffect;
use std::borrow::Cow;
use std::hint::black_box;

/// Tightenings that hide the effect.
const MANY: usize = 24;
/// How strongly they hide it.
const STRENGTH: f64 = 0.3;

pub fn fill(_is_long: bool) {
    section(&format!(
        "Catalogue: m, c, k and one effect from the whitened acceleration, 3000 samples, {MANY} tightenings: one after the other, side by side, and pooled, where they share the effect; one core"
    ));
    let pool = one_core();
    for &effect in Effect::ALL {
        let name = effect.name();
        let hidden = HiddenEffect::from_name(name).map(|hidden| (hidden, STRENGTH));
        let cases =
            Campaign::hiding(&hidden.map_or_else(|_| Vec::new(), |one| vec![one]), MANY).cases();
        pool.install(|| row(name, effect, &cases));
    }
}

fn row(name: &str, effect: Effect, cases: &[FitTask<'_>]) {
    let with: Vec<FitTask<'_>> = (cases.iter())
        .filter_map(|case| with_effect(case, effect))
        .collect();
    let with: Vec<&FitTask<'_>> = with.iter().collect();
    let settings = fitting(Quantity::Acceleration);
    let [bare, alone, side_by_side, pooled] = race(
        Clock::Core,
        [
            (cases.len(), &mut || {
                for case in cases {
                    black_box(bare_loop::fit(&record(case), START));
                }
            }),
            (with.len().max(1), &mut || {
                for case in &with {
                    black_box(fit(case, &settings));
                }
            }),
            (with.len().max(1), &mut || {
                black_box(fit_all(&with, &settings));
            }),
            (cases.len(), &mut || {
                black_box(fit_together(cases, &[effect]).expect("the benchmark's own data"));
            }),
        ],
    );
    let against = |times: &Times, what: &str| {
        let reference = Reference {
            name: "the bare scalar loop",
            times: &bare,
        };
        times_the(&reference, times, &format!("{name}, {what}"));
    };
    against(&alone, "one by itself");
    against(&side_by_side, "one of many side by side");
    against(&pooled, "pooled, per tightening");
}

/// The same tightening, the effect in its model.
fn with_effect<'a>(case: &'a FitTask<'_>, effect: Effect) -> Option<FitTask<'a>> {
    let model = case.model.with_effect(effect).ok()?;
    Some(FitTask {
        model: Cow::Owned(model),
        ..case.lent()
    })
}

/// What runs in parallel elsewhere runs on one core here.
pub fn one_core() -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("one thread can be started")
}
