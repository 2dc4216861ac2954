//! The few candidates that are worth a line on the screen.

use super::{Page, not_yet_added, shortened};
use snug_campaign::words::chance::share_with_error;
use snug_campaign::words::effect_name::label;
use snug_campaign::words::number::p_value;
use snug_campaign::{Diagnosis, Doubt, RankedEffect, Verdict};

/// Candidates shown; the report lists all. Behind the very first, neither terms in no catalogue nor what could be chance.
const CANDIDATES: usize = 8;
const FIRST: usize = 3;

/// The best candidates, and what their columns mean.
pub fn ranking(page: &mut Page, diagnosis: &Diagnosis) {
    if diagnosis.ranking.is_empty() || diagnosis.verdict == Verdict::NotFitted {
        return;
    }
    let candidates: Vec<(usize, &RankedEffect)> = diagnosis
        .ranking
        .iter()
        .enumerate()
        .filter(|(place, candidate)| *place < FIRST || !candidate.unlisted && candidate.supported)
        .take(CANDIDATES)
        .collect();
    let shown = candidates.len();
    let is_complete = match diagnosis.verdict {
        Verdict::Adequate => true,
        Verdict::UnlistedEffect => {
            diagnosis.unlisted.is_some() && not_yet_added(diagnosis).is_none()
        }
        _ => false,
    };
    let what = match (is_complete, diagnosis.added.is_empty()) {
        (true, _) => "What else was tried",
        (_, true) => "What could be missing",
        (_, false) => "What could still be missing",
    };
    page.heading(&format!(
        "{what}: the best {shown} of {} candidates",
        diagnosis.ranking.len()
    ));
    if diagnosis.verdict == Verdict::Adequate {
        page.paragraph(
            "  ",
            "Nothing more is justified: shares of the little that is left, and does not repeat, say little.",
        );
    }
    page.paragraph(
        "  ",
        "removes: share of the misfit that it takes away in data its size was not fitted to; \
         chance: how often (1 = always) chance alone would put something so strong at the top.",
    );
    page.line(&format!(
        "  {:<27} {:>12} {:>8}  {}",
        "effect",
        "removes",
        "chance",
        if is_wide(page) {
            "size [95 % interval]"
        } else {
            ""
        }
    ));
    for (place, candidate) in candidates {
        row(page, candidate);
        if place == 0 && !candidate.twins.is_empty() {
            let twins = diagnosis.names(&candidate.twins);
            page.paragraph("      cannot be told from ", &twins);
        }
    }
    let unlisted = diagnosis
        .ranking
        .iter()
        .filter(|candidate| candidate.unlisted)
        .count();
    if unlisted > 0 {
        page.paragraph(
            "  ",
            &format!("{unlisted} of the candidates are simple forces that are in no catalogue (named by their formula); report.html has them all."),
        );
    }
}

/// Columns from which on sizes stand beside the chance; below it on a line of their own.
const WIDE: usize = 90;

fn is_wide(page: &Page) -> bool {
    page.width >= WIDE
}

fn row(page: &mut Page, candidate: &RankedEffect) {
    let name = label(&candidate.effect, candidate.expression.as_ref());
    let gain = share_with_error(candidate.heldout_gain, candidate.heldout_gain_error);
    let lead = format!(
        "  {:<27} {gain:>12} {:>8}  ",
        shortened(&name, 27),
        p_value(Some(candidate.p_family))
    );
    let mut sizes: Vec<String> = candidate
        .parameters
        .iter()
        .map(|one| one.size().to_string())
        .collect();
    if candidate.doubt() == Some(Doubt::NotSettled) {
        sizes.push("the fit did not settle".into());
    }
    if is_wide(page) {
        return page.paragraph(&lead, &sizes.join("; "));
    }
    page.line(&lead);
    page.paragraph("      ", &sizes.join("; "));
}
