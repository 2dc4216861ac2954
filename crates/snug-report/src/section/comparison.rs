//! Tables of the misfit in units, in percent and in multiples of the noise, for all tightenings together and for each.

use super::{Render, Section, headings};
use crate::words::number::{plain, sortable};
use crate::words::quantity;
use maud::{Markup, html};
use snug_campaign::words::effect_name::unit_text;
use snug_campaign::{CampaignResult, Comparison, Diagnosis, Misfit, TighteningMisfit};

/// Model against measurement, pooled and tightening by tightening.
pub const SECTION: Section = Section {
    anchor: "comparison",
    short_title: "Comparison",
    title: "Model against measurement",
    render: Render::Diagnosed(render),
};

/// Rows of the table of tightenings; `verdict.json` holds all.
const MOST_ROWS: usize = 400;

fn render(diagnosis: &Diagnosis, _: &CampaignResult) -> Option<Markup> {
    let comparison = &diagnosis.comparison;
    if comparison.pooled.is_empty() && comparison.tightenings.is_empty() {
        return None;
    }
    Some(html! {
        p { "How far the study's own model is from the measurement: the error in units (root mean square and largest), in percent \
            of the signal, and as a multiple of the noise where the noise is known. Force means F2 − F3, the force from the \
            measured less that from the simulated acceleration." }
        @if !comparison.pooled.is_empty() { (pooled(comparison)) }
        @if !comparison.tightenings.is_empty() { (each(comparison)) }
    })
}

fn pooled(comparison: &Comparison) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="All tightenings together" { table {
            caption { "All tightenings together" }
            (headings(&["quantity", "rms error", "largest error", "error [% of the signal]", "fit [%]", "error over noise [×]"]))
            tbody { @for misfit in &comparison.pooled { tr {
                th scope="row" { (quantity::capitalised(&misfit.quantity)) }
                td { (with_unit(misfit.rms, misfit)) }
                td { (with_unit(misfit.largest, misfit)) }
                td { (plain(misfit.relative_percent, 3, "the measurement is zero")) }
                td { (plain(misfit.fit_percent, 4, "the measurement does not vary")) }
                td { (plain(misfit.over_noise, 4, "the noise of this quantity is not known")) }
            } } }
        } }
    }
}

fn with_unit(value: f64, misfit: &Misfit) -> Markup {
    html! {
        (plain(Some(value), 3, "not finite"))
        @if value.is_finite() { "\u{a0}" (unit_text(&misfit.unit)) }
    }
}

fn each(comparison: &Comparison) -> Markup {
    let count = comparison.tightenings.len();
    // The columns follow the pooled quantities, or the first tightening's.
    let columns = if comparison.pooled.is_empty() {
        &comparison.tightenings[0].misfits
    } else {
        &comparison.pooled
    };
    html! {
        details {
            summary {
                "Each tightening, worst first"
                @if count > MOST_ROWS { " (the worst " (MOST_ROWS) " of " (count) "; verdict.json holds all)" }
            }
            div.scroll.tall tabindex="0" role="region" aria-label="Each tightening, worst first" { table.sortable data-sortable="" {
                thead { tr {
                    th.words scope="col" { "tightening" }
                    @for column in columns {
                        th scope="col" { (column.quantity) " rms [" (unit_text(&column.unit)) "]" }
                        th scope="col" { (column.quantity) " fit [%]" }
                        @if column.over_noise.is_some() { th scope="col" { (column.quantity) " error over noise [×]" } }
                    }
                } }
                tbody { @for tightening in comparison.tightenings.iter().take(MOST_ROWS) { (row(tightening, columns)) } }
            } }
        }
    }
}

fn row(tightening: &TighteningMisfit, columns: &[Misfit]) -> Markup {
    let why = "could not be compared";
    html! { tr {
        th scope="row" { (tightening.id) }
        @for column in columns {
            @let misfit = tightening.misfits.iter().find(|misfit| misfit.quantity == column.quantity);
            (sortable(misfit.map(|misfit| misfit.rms), 3, why))
            (sortable(misfit.and_then(|misfit| misfit.fit_percent), 4, why))
            @if column.over_noise.is_some() { (sortable(misfit.and_then(|misfit| misfit.over_noise), 4, why)) }
        }
    } }
}
