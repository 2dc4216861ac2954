//! How well the parameters of the others predict what is kept for validation: in a free run, and restarted.

use super::{Render, Section, headings};
use crate::words::number::{missing, plain, significant};
use maud::{Markup, html};
use snug_campaign::{CampaignResult, Prediction, RestartedPrediction, TighteningId, Validation};

/// Predicted and measured, where something was kept for validation.
pub const SECTION: Section = Section {
    anchor: "validation",
    short_title: "Validation",
    title: "How well it predicts what took no part in the fit",
    render: Render::Sometimes(render),
};

fn render(result: &CampaignResult) -> Option<Markup> {
    let per_rad = result.units.output_per_rad;
    let kept: Vec<(&TighteningId, Validation)> = (result.tightenings.iter())
        .filter_map(|one| Some((&one.id, one.validation?.times(per_rad))))
        .collect();
    if kept.is_empty() {
        return None;
    }
    let unit = result.units.motion_called(&result.fitted_output);
    let residual = format!("residual [{unit}]");
    Some(html! {
        p { "These took no part in the fit: the " (result.fitted_output) " was simulated with the parameters of the others. A free run, \
            from the first sample to the last, accumulates every error; restarted from the measured motion every so often, the model is \
            judged by what it predicts over that time. The residual is its root mean square." }
        div.scroll tabindex="0" role="region" aria-label="Predictions of what took no part in the fit" { table {
            (headings(&["kept for validation", "free run: fit [%]", &residual, "restarted: fit [%]", &residual, "every [s]"]))
            tbody { @for (id, one) in &kept { tr {
                th scope="row" { (id) }
                (prediction(&one.free_run))
                (restarted(one.restarted.as_ref()))
            } } }
        } }
    })
}

fn prediction(of: &Prediction) -> Markup {
    html! {
        td { (plain(of.fit_percent, 3, "the measured output does not change")) }
        td { (plain(of.rms, 4, "nothing of it is scored")) }
    }
}

fn restarted(of: Option<&RestartedPrediction>) -> Markup {
    let none = "the motion is not measured beside it, or too fast for its sampling";
    match of {
        Some(of) => html! { (prediction(&of.prediction)) td { (significant(of.every_s, 3)) } },
        None => html! { @for _ in 0..3 { td { (missing(none)) } } },
    }
}
