//! What was ranked beside every model before the final one: the share that a candidate removed then, and what is left of it once
//! the next effect is in.

use super::{ROW, entries, is_chosen, label, parted, scale};
use crate::figure::{Axis, Bar, Figure, Mark, captioned, legend};
use crate::words::number::percent;
use maud::{Markup, html};
use snug_campaign::words::chance::share_with_error;
use snug_campaign::{Became, CampaignResult, Diagnosis, RankedEffect};

/// Height of the row of a candidate, which has two bars \[px\].
const TWO_BARS: f64 = 1.35 * ROW;

/// Colours of the bars and what they stand for.
const LAYERS: [(&str, &str); 5] = [
    ("c-selected", "taken into the model"),
    ("c-amber", "beyond chance, and still once that is in"),
    ("c-spent", "beyond chance then, no longer once that is in"),
    ("c-faint", "could be chance"),
    ("c-whisker", "what it still removes of the same misfit"),
];

/// A ranking of an earlier rung.
struct Earlier<'a> {
    diagnosis: &'a Diagnosis,
    /// Counted from 0.
    rung: usize,
}

/// Every ranking but the last; `None` where there was none.
pub fn render(diagnosis: &Diagnosis, result: &CampaignResult) -> Option<Markup> {
    let all: Vec<Earlier> = (0..diagnosis.ladder.len())
        .filter(|&rung| !diagnosis.ladder[rung].ranking.is_empty())
        .map(|rung| Earlier { diagnosis, rung })
        .collect();
    (!all.is_empty()).then(|| html! {
        p { "One effect is taken at a time, and a wrong one can stand in for the right one: beside a model that lacks something, many \
            candidates help. Each row has two bars: what the candidate removed of the misfit then, and below it, thin, what it still \
            removes of that same misfit once the one that was taken is in. Grey is what no longer holds." }
        @for one in &all { (one.markup(result)) }
    })
}

impl Earlier<'_> {
    fn markup(&self, result: &CampaignResult) -> Markup {
        let names = self.diagnosis.rung_names();
        let ranking = &self.diagnosis.ladder[self.rung].ranking;
        let (shown, rest) = parted(ranking, |candidate| is_chosen(self.diagnosis, candidate));
        let taken = names
            .get(self.rung + 1)
            .map(|name| name.trim_start_matches("+ "));
        html! {
            h3 {
                @if self.rung == 0 { "Beside " (names[0]) } @else { "Beside the model " (names[self.rung]) }
                @if let Some(taken) = taken { ": " (taken) " was taken" }
            }
            (self.figure(&shown))
            (entries(&shown, &rest, self.diagnosis, result, |candidate| self.became(candidate)))
        }
    }

    fn figure(&self, ranking: &[&RankedEffect]) -> Markup {
        let (low, high) = self.scale(ranking);
        let placed = || ranking.iter().enumerate();
        let then = |layer: &str| -> Vec<Bar> {
            placed()
                .filter(|(_, candidate)| self.class(candidate) == layer)
                .map(|(row, candidate)| self.then(row, candidate, (low, high)))
                .collect()
        };
        let mut marks: Vec<Mark> = LAYERS[..4]
            .iter()
            .map(|(layer, _)| Mark::Bars(layer, then(layer)))
            .collect();
        let still: Vec<Bar> = placed()
            .filter_map(|(row, candidate)| self.still(row, candidate, (low, high)))
            .collect();
        let is_used = |layer: &str| match layer {
            "c-whisker" => !still.is_empty(),
            layer => ranking.iter().any(|one| self.class(one) == layer),
        };
        let used: Vec<(&str, &str)> = LAYERS
            .into_iter()
            .filter(|(layer, _)| is_used(layer))
            .collect();
        marks.push(Mark::Bars("c-whisker", still));
        let labels: Vec<(String, bool)> = ranking.iter().map(|one| (label(one), false)).collect();
        let figure = Figure {
            description: "Share of the misfit that each candidate removed beside this model, and once the next effect is in".into(),
            width: 760.0,
            height: 56.0 + TWO_BARS * ranking.len().max(2) as f64,
            x: Axis::linear("misfit removed in held-out tightenings [%]", low, high, 6),
            y: Axis::rows(&labels),
            marks,
        };
        captioned(
            "Candidates, what was taken first",
            html! { (figure.svg()) (legend(&used)) },
            None,
        )
    }

    /// Both ends of the scale \[%\]: those of the bars.
    fn scale(&self, ranking: &[&RankedEffect]) -> (f64, f64) {
        let shares = ranking.iter().flat_map(|candidate| {
            let still = match self.diagnosis.became(self.rung, &candidate.effect) {
                Became::Ranked { share, .. } => share,
                Became::Added | Became::NotRanked => 0.0,
            };
            [candidate.heldout_gain, still]
        });
        scale(shares.map(|share| 100.0 * share))
    }

    fn class(&self, candidate: &RankedEffect) -> &'static str {
        match self.diagnosis.became(self.rung, &candidate.effect) {
            Became::Added => "c-selected",
            _ if !candidate.supported => "c-faint",
            Became::Ranked {
                supported: true, ..
            } => "c-amber",
            Became::Ranked { .. } | Became::NotRanked => "c-spent",
        }
    }

    /// What it removed then.
    fn then(&self, row: usize, candidate: &RankedEffect, (low, high): (f64, f64)) -> Bar {
        let gain = (100.0 * candidate.heldout_gain).clamp(low, high);
        Bar {
            x: (gain.min(0.0), gain.max(0.0)),
            y: (-(row as f64) - 0.05, -(row as f64) + 0.36),
            title: format!(
                "{}: removed {} of the misfit; {}",
                label(candidate),
                share_with_error(candidate.heldout_gain, candidate.heldout_gain_error),
                self.became(candidate).unwrap_or_default()
            ),
        }
    }

    /// What it still removes of the same misfit; nothing of one that is in the model or was not tried again.
    fn still(&self, row: usize, candidate: &RankedEffect, (low, high): (f64, f64)) -> Option<Bar> {
        let Became::Ranked { share, .. } = self.diagnosis.became(self.rung, &candidate.effect)
        else {
            return None;
        };
        // What removes nothing is a line at zero, so that one sees that it was asked.
        let least = 0.002 * (high - low);
        let gain = (100.0 * share).clamp(low, high);
        Some(Bar {
            x: (gain.min(-least), gain.max(least)),
            y: (-(row as f64) - 0.3, -(row as f64) - 0.12),
            title: self.became(candidate).unwrap_or_default(),
        })
    }

    /// In words; nothing of what was never beyond chance.
    fn became(&self, candidate: &RankedEffect) -> Option<String> {
        let became = self.diagnosis.became(self.rung, &candidate.effect);
        match became {
            Became::Added => Some("taken into the model".into()),
            Became::Ranked { share, supported } if candidate.supported => {
                let share = percent(share.max(0.0));
                Some(match supported {
                    true => format!("still beyond chance then: {share} of this misfit"),
                    false => format!("no longer: {share} of this misfit then"),
                })
            }
            Became::NotRanked if candidate.supported => Some("not tried again".into()),
            Became::Ranked { .. } | Became::NotRanked => None,
        }
    }
}
