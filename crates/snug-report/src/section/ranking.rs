//! Every candidate with size, gain and chance; terms in no catalogue are folded away unless they lead or are chosen.

mod earlier;

use super::{Render, Section};
use crate::figure::{Axis, Bar, Figure, Mark, Segment, captioned, legend};
use crate::words::effect_words::{parameter_name, sentence, sizes};
use crate::words::number::{p_value, plain, short, significant};
use maud::{Markup, html};
use snug_campaign::words::chance::{by_chance, share_with_error};
use snug_campaign::words::effect_name::called;
use snug_campaign::{CampaignResult, Diagnosis, Doubt, RankedEffect, Verdict};

/// What could be missing, best first.
pub const SECTION: Section = Section {
    anchor: "ranking",
    short_title: "Candidates",
    title: "What could be missing",
    render: Render::Diagnosed(render),
};

/// Height of a candidate's row \[px\]. Chosen.
const ROW: f64 = 21.0;
/// Candidates that are always shown. Chosen.
const ALWAYS: usize = 3;
/// Most that are shown without unfolding. Chosen.
const MOST: usize = 10;

fn render(diagnosis: &Diagnosis, result: &CampaignResult) -> Option<Markup> {
    let earlier = earlier::render(diagnosis, result);
    if diagnosis.ranking.is_empty() {
        return earlier;
    }
    let (shown, rest) = parted(&diagnosis.ranking, |candidate| {
        is_chosen(diagnosis, candidate)
    });
    let model = if diagnosis.added.is_empty() {
        "the model"
    } else {
        "the model with the effects above"
    };
    Some(html! {
        @if let Some(earlier) = earlier {
            (earlier)
            h3 { "Beside the final model" }
        }
        p { "Every candidate was added to " (model) " in turn and judged on data that its size was not fitted to. \
            The bar is the share of the misfit that it takes away there; the thin line is one standard error to either side. \
            Below zero, it does harm." }
        @if diagnosis.verdict == Verdict::NotFitted {
            p { strong { "No model was found that fits" } ": shares of what such a one leaves say nothing of what is missing." }
        }
        @if diagnosis.verdict == Verdict::Adequate {
            p { strong { "Nothing more is justified" } ": the misfit that is left to share out is little or does not repeat, and large shares \
                of it say little." }
        }
        (figure(&shown))
        p { "A candidate is believed when chance alone would do as well in fewer than " (short(100.0 * diagnosis.level))
            " of 100 cases (p below " (diagnosis.level) "); that already allows for the number of candidates. Open a row for what it is, how it shows and what to check." }
        (entries(&shown, &rest, diagnosis, result, |_| None))
    })
}

/// The rows of the candidates, the rest folded away; `became` says of one what became of it, where that is known.
fn entries(
    shown: &[&RankedEffect],
    rest: &[&RankedEffect],
    diagnosis: &Diagnosis,
    result: &CampaignResult,
    became: impl Fn(&RankedEffect) -> Option<String>,
) -> Markup {
    let unlisted = rest.iter().filter(|candidate| candidate.unlisted).count();
    // Twins are a question of the first only.
    let twins = |place| match place {
        0 => diagnosis.names(&shown[0].twins),
        _ => String::new(),
    };
    html! {
        div.candidates { @for (place, candidate) in shown.iter().enumerate() {
            (entry(candidate, &twins(place), became(candidate), result))
        } }
        @if !rest.is_empty() {
            details {
                summary {
                    (rest.len()) " more were tried"
                    @if unlisted > 0 { "; terms that are in no catalogue among them: " (unlisted) }
                }
                div.candidates { @for candidate in rest { (entry(candidate, "", became(candidate), result)) } }
            }
        }
    }
}

/// Whether it is the unlisted term that the verdict names.
fn is_chosen(diagnosis: &Diagnosis, candidate: &RankedEffect) -> bool {
    let named = format!("\"{}\"", candidate.effect);
    let term = diagnosis.unlisted.as_ref();
    candidate.unlisted && term.is_some_and(|term| term.ron.contains(&named))
}

/// The candidates worth a look, and the rest: an unlisted term is shown only among the very first or when it is chosen.
fn parted(
    ranking: &[RankedEffect],
    is_chosen: impl Fn(&RankedEffect) -> bool,
) -> (Vec<&RankedEffect>, Vec<&RankedEffect>) {
    let (mut shown, mut rest) = (Vec::new(), Vec::new());
    for (place, candidate) in ranking.iter().enumerate() {
        let worth = !candidate.unlisted && candidate.supported && shown.len() < MOST;
        if place < ALWAYS || worth || is_chosen(candidate) {
            shown.push(candidate);
        } else {
            rest.push(candidate);
        }
    }
    (shown, rest)
}

fn class(candidate: &RankedEffect) -> &'static str {
    match (candidate.supported, candidate.unlisted) {
        (true, true) => "c-rejected",
        (true, false) => "c-selected",
        (false, _) => "c-faint",
    }
}

fn label(candidate: &RankedEffect) -> String {
    called(&candidate.effect, candidate.expression.as_ref())
}

/// Colours of the bars and what they stand for.
const LAYERS: [(&str, &str); 3] = [
    ("c-selected", "beyond chance"),
    ("c-rejected", "beyond chance, in no catalogue"),
    ("c-faint", "could be chance"),
];

fn figure(ranking: &[&RankedEffect]) -> Markup {
    let (low, high) = scale(ranking.iter().flat_map(|candidate| ends(candidate)));
    let placed = || ranking.iter().enumerate();
    let of_layer = |layer: &str| -> Vec<Bar> {
        placed()
            .filter(|(_, candidate)| class(candidate) == layer)
            .map(|(row, candidate)| bar(row, candidate, (low, high)))
            .collect()
    };
    let bars = LAYERS.map(|(layer, _)| Mark::Bars(layer, of_layer(layer)));
    let whiskers = Mark::Segments(
        "c-whisker",
        placed()
            .map(|(row, candidate)| whisker(row, candidate, (low, high)))
            .collect(),
    );
    let labels: Vec<(String, bool)> = ranking.iter().map(|one| (label(one), false)).collect();
    let figure = Figure {
        description: "Share of the misfit that each candidate removes in held-out tightenings"
            .into(),
        width: 760.0,
        height: 56.0 + ROW * ranking.len().max(2) as f64,
        x: Axis::linear(
            "misfit removed in held-out tightenings [%]",
            low,
            1.03 * high,
            6,
        ),
        y: Axis::rows(&labels),
        marks: bars.into_iter().chain([whiskers]).collect(),
    };
    let used: Vec<(&str, &str)> = LAYERS
        .into_iter()
        .filter(|(layer, _)| ranking.iter().any(|candidate| class(candidate) == *layer))
        .collect();
    captioned(
        "Candidates, best first",
        html! { (figure.svg()) (legend(&used)) },
        None,
    )
}

/// Both ends of a candidate's standard error \[%\].
fn ends(candidate: &RankedEffect) -> [f64; 2] {
    [-1.0, 1.0].map(|side| 100.0 * (candidate.heldout_gain + side * candidate.heldout_gain_error))
}

/// Both ends of the scale of these values \[%\]. What goes beyond is cut off, so that it does not press the rest together.
fn scale(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values
        .filter(|end| end.is_finite())
        .fold((0.0_f64, 5.0_f64), |(low, high), end| {
            (low.min(end.max(-50.0)), high.max(end.min(110.0)))
        })
}

fn whisker(row: usize, candidate: &RankedEffect, (low, high): (f64, f64)) -> Segment {
    let [from, to] = ends(candidate).map(|end| end.clamp(low, high));
    Segment {
        x: (from, to),
        y: (-(row as f64), -(row as f64)),
    }
}

fn bar(row: usize, candidate: &RankedEffect, (low, high): (f64, f64)) -> Bar {
    let gain = (100.0 * candidate.heldout_gain).clamp(low, high);
    Bar {
        x: (gain.min(0.0), gain.max(0.0)),
        y: (-(row as f64) - 0.32, -(row as f64) + 0.32),
        title: format!(
            "{}: removes {} of the misfit; {}",
            label(candidate),
            share_with_error(candidate.heldout_gain, candidate.heldout_gain_error),
            by_chance(candidate.p_family)
        ),
    }
}

/// What speaks against a candidate, whatever it explains.
fn against(candidate: &RankedEffect) -> Option<&'static str> {
    Some(match candidate.doubt()? {
        Doubt::NotSettled => "fit did not settle",
        Doubt::ImplausibleSize => "size not plausible",
    })
}

/// A row of the candidates, with what these data cannot tell from it and what became of it.
fn entry(
    candidate: &RankedEffect,
    twins: &str,
    became: Option<String>,
    result: &CampaignResult,
) -> Markup {
    html! {
        details.candidate {
            summary {
                span.name.strong[candidate.supported] { (label(candidate)) }
                " " span.gain { (share_with_error(candidate.heldout_gain, candidate.heldout_gain_error)) }
                " " span.chance { "p " (p_value(Some(candidate.p_family))) }
                " " span.sizes { (sizes(&candidate.parameters, result)) }
                @if !twins.is_empty() { " " span.tag.twins { "not to be told from " (twins) } }
                @if let Some(became) = &became { " " span.tag.became { (became) } }
                @if candidate.unlisted { " " span.tag.unlisted { "in no catalogue" } }
                @if let Some(against) = against(candidate) { " " span.tag.implausible { (against) } }
            }
            (evidence(candidate, twins, result))
        }
    }
}

fn evidence(candidate: &RankedEffect, twins: &str, result: &CampaignResult) -> Markup {
    html! {
        ul { @for line in &candidate.explanation { li { (sentence(line)) } } }
        ul.note {
            li { "Kind: " (candidate.kind) "." }
            li { "How sure: " (by_chance(candidate.p_family)) ", over all candidates together." }
            li { "Error over noise with it: " (plain(candidate.error_over_noise, 4, "the noise is not known")) " (1.0 = nothing but noise)." }
            @if candidate.behind_first > 0.0 {
                li { "The first candidate explains more by " (significant(candidate.behind_first, 2)) " standard deviations over tightenings." }
            }
            @if !twins.is_empty() {
                li { "These data cannot tell it from " (twins) "." }
            }
            @if let Some(against) = against(candidate) {
                li { "What speaks against it: " (against) "." }
            }
            @for parameter in &candidate.parameters {
                li { (parameter_name(&parameter.meaning, &parameter.name, result)) ": plausible from " (significant(parameter.minimum, 3)) " to " (significant(parameter.maximum, 3)) " " (snug_campaign::words::effect_name::unit_text(&parameter.unit)) "." }
            }
        }
    }
}
