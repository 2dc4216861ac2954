//! What the final model gained, tightening by tightening: curves to zoom into, or still ones where no script runs.

use super::tightening_figures::noise_band;
use super::{Render, Section};
use crate::curves::traces_json::{Example, Panel, before_after_panels, before_and_after};
use crate::curves::{Curves, STILL_POINTS, embedded};
use crate::words::number::significant;
use maud::{Markup, PreEscaped, html};
use serde_json::{Value, json};
use snug_campaign::{CampaignResult, Diagnosis, Quantity, TighteningId};

/// Tightenings with the study's own model and with the final one.
pub const SECTION: Section = Section {
    anchor: "before-after",
    short_title: "Before and after",
    title: "What the final model gains, tightening by tightening",
    render: Render::Diagnosed(render),
};

fn render(diagnosis: &Diagnosis, result: &CampaignResult) -> Option<Markup> {
    let mut examples = before_and_after(result);
    let place = |example: &Example| place(diagnosis, &result.tightenings[example.tightening].id);
    examples.sort_by_key(place);
    let panels = panels(diagnosis, result, &examples);
    let first = examples.first().filter(|_| !panels.is_empty())?;
    let title = |example: &Example| title(diagnosis, result, example.tightening);
    let data = json!({
        "panels": panels.iter().map(Panel::json).collect::<Vec<_>>(),
        "examples": examples.iter().map(|one| example_json(one, &panels, result, title(one))).collect::<Vec<_>>(),
    });
    Some(html! {
        p { "The same measurement with the model before (" em { "study's own" } ") and after (" em { "final model" } "), "
            (examples.len()) " of " (result.tightenings.len()) " tightenings, first the one that the study's own model misses most." }
        p.help.scripted { "Choose a tightening; point at a curve to read values; drag across to zoom, double-click to see all again; n and p \
            step through the tightenings." }
        div.viewer data-viewer="showcase-data" {
            div.chooser.scripted {
                button type="button" data-step="-1" aria-label="previous tightening, before and after" { "‹" }
                label { span.hidden { "tightening, before and after" }
                    select data-choice="" {
                        @for (number, example) in examples.iter().enumerate() {
                            option value=(number) { (title(example)) }
                        }
                    }
                }
                button type="button" data-step="1" aria-label="next tightening, before and after" { "›" }
            }
            p.current data-current="" aria-live="polite" { (title(first)) }
            div.figures {
                @for panel in &panels { (still(panel, first, result)) }
            }
        }
        script type="application/json" id="showcase-data" { (PreEscaped(embedded(&data))) }
    })
}

/// Where it stands in the comparison, worst first.
fn place(diagnosis: &Diagnosis, id: &TighteningId) -> usize {
    let mut compared = diagnosis.comparison.tightenings.iter();
    compared.position(|one| one.id == *id).unwrap_or(usize::MAX)
}

/// Which one, and what became of its error.
fn title(diagnosis: &Diagnosis, result: &CampaignResult, tightening: usize) -> String {
    let tightening = &result.tightenings[tightening];
    let mut compared = diagnosis.comparison.tightenings.iter();
    let before = compared
        .find(|one| one.id == tightening.id)
        .and_then(|one| one.misfits.iter().find_map(|misfit| misfit.over_noise));
    match (before, tightening.measures.error_over_noise) {
        (Some(before), Some(after)) if before.is_finite() && after.is_finite() => format!(
            "{} · error {} → {} × noise",
            tightening.id,
            significant(before, 3),
            significant(after, 3)
        ),
        _ => tightening.id.to_string(),
    }
}

fn panels(diagnosis: &Diagnosis, result: &CampaignResult, examples: &[Example]) -> Vec<Panel> {
    let is_compared = |quantity: &Quantity| diagnosis.compared_output.contains(quantity.name());
    let is_noise_of = |quantity: Quantity| {
        let mut noises = result
            .tightenings
            .iter()
            .filter_map(|one| one.noise.as_ref());
        noises.any(|noise| noise.quantity == quantity)
    };
    Quantity::ALL
        .into_iter()
        // Velocity is drawn only where it is what is compared.
        .filter(|quantity| *quantity != Quantity::Velocity || is_compared(quantity))
        .flat_map(|quantity| {
            let has_noise = is_compared(&quantity) && is_noise_of(quantity);
            before_after_panels(&result.units, quantity, has_noise)
        })
        .filter(|panel| {
            examples
                .iter()
                .any(|one| one.signals(panel).iter().all(Option::is_some))
        })
        .collect()
}

fn example_json(
    example: &Example,
    panels: &[Panel],
    result: &CampaignResult,
    title: String,
) -> Value {
    let mut value = example.json(panels);
    value["heading"] = json!(title);
    value["noise"] = json!(noise_band(&result.tightenings[example.tightening], result));
    value
}

/// A panel without JavaScript: the first example.
fn still(panel: &Panel, example: &Example, result: &CampaignResult) -> Markup {
    let example = example.coarser(STILL_POINTS);
    let tightening = &result.tightenings[example.tightening];
    let noise = noise_band(tightening, result);
    panel.still(Curves {
        description: format!("{} of {}", panel.title, tightening.id),
        times: example.times().collect(),
        time_unit: example.time_unit().0,
        values: example.signals(panel),
        noise,
        noise_title: noise.map_or_else(String::new, |noise| {
            format!("95 % of the noise: ±{}", significant(noise, 2))
        }),
    })
}
