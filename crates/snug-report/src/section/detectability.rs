//! Limits of a diagnosis: how often it raises a false alarm, and from which size on an absent effect would show.

use super::{Render, Section, headings};
use crate::words::effect_words::{parameter_name, sentence};
use crate::words::number::{percent, percent_interval, significant};
use maud::{Markup, html};
use snug_campaign::words::effect_name::{effect_name, unit_text};
use snug_campaign::words::statement::in_some_groups;
use snug_campaign::{CampaignResult, Detectability, Diagnosis, Interval, NegativeControl};

/// What would have been found, and how often something is found where nothing is.
pub const SECTION: Section = Section {
    anchor: "detectability",
    short_title: "How sure",
    title: "How far to trust this",
    render: Render::Diagnosed(render),
};

fn render(diagnosis: &Diagnosis, result: &CampaignResult) -> Option<Markup> {
    if diagnosis.control.is_none() && diagnosis.detectability.is_empty() {
        return None;
    }
    Some(html! {
        @if let Some(control) = &diagnosis.control { (false_alarms(control)) }
        @if !diagnosis.detectability.is_empty() { (absent(&diagnosis.detectability, result)) }
    })
}

fn false_alarms(control: &NegativeControl) -> Markup {
    let rate = control.false_alarms as f64 / control.campaigns.max(1) as f64;
    let interval = Interval {
        low: control.rate_low,
        high: control.rate_high,
    };
    html! {
        h3 { "False alarms" }
        p { "Campaigns were simulated from the accepted model with noise like the measured, so that nothing was missing in them, \
            and ranked in the same way. An effect was called missing in " strong { (control.false_alarms) " of " (control.campaigns) }
            ", which is " (percent(rate)) " (95 % interval " (percent_interval(interval)) "); meant are " (percent(control.nominal_rate)) "." }
        @if control.rate_low > control.nominal_rate {
            p.attention { "That is more than meant: read the verdict with care." }
        }
    }
}

fn absent(list: &[Detectability], result: &CampaignResult) -> Markup {
    html! {
        h3 { "What was not found is absent or smaller than this" }
        p { "Each effect was put into these data to see from which size on it would be found 95 times in 100. Beside it stands the \
            largest size that is physically plausible: where the first is much smaller, the effect can be ruled out for practical purposes." }
        div.scroll tabindex="0" role="region" aria-label="What would have been found" { table {
            (headings(&["effect", "absent or smaller than", "largest plausible"]))
            tbody { @for row in list { tr {
                th scope="row" { (effect_name(&row.effect)) " " span.interval { (parameter_name(&row.meaning, &row.parameter, result)) } }
                td {
                    @match row.smallest_detectable.filter(|size| size.is_finite()) {
                        Some(size) => {
                            (amount(size, &row.unit))
                            @if let Some(some) = &row.in_some_groups {
                                " " span.interval { (sentence(in_some_groups(some, &row.unit))) }
                            }
                        },
                        None => span.interval { (sentence(&row.statement)) },
                    }
                }
                td { (amount(row.largest_plausible, &row.unit)) }
            } } }
        } }
    }
}

fn amount(size: f64, unit: &str) -> Markup {
    html! { span.amount { (significant(size, 3)) "\u{a0}" (unit_text(unit)) } }
}
