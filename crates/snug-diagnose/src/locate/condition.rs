//! The misfit per participant, strategy, joint, pace and target torque.

use super::Seen;
use super::aspect::{Part, View, sums};
use super::residual::Residuals;

/// What stands for a condition that the file does not state.
const UNSTATED: &str = "not stated";

/// One view a condition; `None` for a condition that no tightening states.
pub fn views(residuals: &Residuals<'_>) -> Vec<Option<View>> {
    let words = |seen: &Seen<'_>| seen.tightening.conditions.clone();
    let target = |seen: &Seen<'_>| {
        let target = seen.tightening.target_torque_nm;
        (target.is_finite() && target != 0.0).then(|| (target, format!("{target} Nm")))
    };
    // Words sort among themselves; the number only orders numbers.
    let word = |word: Option<String>| word.map(|word| (0.0, word));
    vec![
        view(residuals, "participant", |one| word(words(one).participant)),
        view(residuals, "strategy", |one| word(words(one).strategy)),
        view(residuals, "joint", |one| word(words(one).joint)),
        view(residuals, "pace_per_min", |one| {
            words(one)
                .pace_per_min
                .map(|pace| (pace, format!("{pace} per min")))
        }),
        view(residuals, "target_torque_nm", target),
    ]
}

fn view(
    residuals: &Residuals<'_>,
    aspect: &'static str,
    level_of: impl Fn(&Seen<'_>) -> Option<(f64, String)>,
) -> Option<View> {
    let own: Vec<Option<(f64, String)>> = residuals
        .all
        .iter()
        .map(|one| level_of(&one.seen))
        .collect();
    let mut levels: Vec<(f64, String)> = own.iter().flatten().cloned().collect();
    levels.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.cmp(&b.1)));
    levels.dedup();
    if levels.is_empty() {
        return None;
    }
    let unstated = levels.len();
    let sums = residuals
        .all
        .iter()
        .zip(&own)
        .map(|(one, own)| {
            let level = own
                .as_ref()
                .and_then(|own| levels.iter().position(|level| level == own));
            sums(one, unstated + 1, |_| Some(level.unwrap_or(unstated)))
        })
        .collect();
    let parts = levels
        .into_iter()
        .map(|(_, name)| name)
        .chain([UNSTATED.to_owned()])
        .map(|name| Part {
            name,
            from: None,
            to: None,
        })
        .collect();
    Some(View {
        aspect,
        parts,
        sums,
    })
}
