//! Whether a rig changes while it is measured: as it warms up, empties or wears, one of its numbers goes from one value at the beginning of
//! recordings to another at their end, and no model whose numbers stay follows it.

use crate::data::cases::Cases;
use crate::library::named;
use crate::pooled::equation::{PlainEquation, values};
use crate::pooled::fitted::Fitted;
use crate::selection::thresholds::MOST;
use crate::verdict::thresholds::{ABOVE_ALL, CHANGES};
use snug_campaign::words::changes::{Changes, Changing};
use snug_identify::{Change, FitTask};
use snug_model::{BASE_PARAMETERS, Effect};
use std::iter::successors;

const OF_BASE: [Changing; BASE_PARAMETERS.len()] =
    [Changing::Mass, Changing::Damping, Changing::Stiffness];

/// Whether a change takes so much that beside it no law whose numbers stay is worth a search.
pub(crate) fn are_above_all(changes: &Changes) -> bool {
    changes.taken > ABOVE_ALL
}

/// What a `plain` regression with the effects of the last of these models that it can follow, dry friction and an offset says of that;
/// `None` where nothing changes that takes most of what it leaves, in averages made wider `most` times or less.
pub(crate) fn changes(
    plain: &PlainEquation<'_>,
    cases: Cases<'_>,
    models: &[Fitted],
    most: usize,
) -> Option<Changes> {
    let mut models = models.iter().rev();
    let (effects, change) = models.find_map(|fitted| change(plain, cases, fitted, most))?;
    let (from, to) = (change.from, change.to);
    let is_one = change.taken > MOST && (to - from).abs() > CHANGES * from.abs().max(to.abs());
    let what = match change.index.checked_sub(BASE_PARAMETERS.len()) {
        None => OF_BASE[change.index].clone(),
        Some(place) => Changing::Size(named(effects[place])),
    };
    tracing::debug!(
        index = change.index,
        from,
        to,
        taken = change.taken,
        at = change.at,
        recordings = ?change.recordings,
        "what changes along the recordings"
    );
    let some = change.recordings.len() < cases.len();
    let names = change.recordings.iter().map(|&place| name(&cases, place));
    is_one.then(|| Changes {
        what,
        times: to / from,
        taken: change.taken,
        after: change.at.map(|at| 0.5 * (1.0 + at)),
        only_in: names.filter(|_| some).collect(),
    })
}

/// A recording by its file, and by its number where that holds several.
pub(crate) fn name(cases: &[FitTask<'_>], place: usize) -> String {
    let id = &cases[place].tightening.id;
    let files = cases.iter().map(|case| &case.tightening.id.file);
    match files.filter(|file| **file == id.file).count() {
        1 => id.file.clone(),
        _ => id.to_string(),
    }
}

/// What changes most, and the effects among which it was looked for; `None` where the regression cannot follow the model. Averages that
/// tell a model's numbers best may leave more noise than the change takes: it is looked for in wider ones, too.
fn change(
    plain: &PlainEquation<'_>,
    cases: Cases<'_>,
    fitted: &Fitted,
    most: usize,
) -> Option<(Vec<Effect>, Change)> {
    let at = values(cases, fitted)?;
    let found = |plain: &PlainEquation<'_>| {
        let terms = plain.with_plain_terms(&fitted.effects, &at)?;
        let (effects, terms): (Vec<Effect>, Vec<_>) = terms.into_iter().unzip();
        let left = plain.equation.squares_left(&fitted.effects, &at)?;
        let change = plain.equation.change(&terms, left)?;
        Some((effects, change))
    };
    // One term more for the change.
    let terms = fitted.effects.len() + Effect::PLAIN.len() + 1;
    let wider = successors(plain.wider(terms), |plain| plain.wider(terms)).take(most);
    let found = found(plain)
        .into_iter()
        .chain(wider.filter_map(|wider| found(&wider)));
    found.max_by(|(_, a), (_, b)| a.taken.total_cmp(&b.taken))
}
