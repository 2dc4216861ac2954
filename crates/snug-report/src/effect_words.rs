//! Effects, their sizes and the evidence for them, in words for people who know nutrunners and not statistics.

use crate::effect_name::{raised, unit_text};
use crate::number::{fixed, missing, rounded, significant};
use crate::quantity;
use maud::{Markup, html};
use snug_campaign::{CampaignResult, EffectParameter, Interval};

/// Family-wise p below which an effect is supported.
pub const LEVEL: f64 = 0.05;

/// Value, interval and unit of an effect's parameter.
pub fn size(parameter: &EffectParameter) -> Markup {
    if !parameter.value.is_finite() {
        return missing("the size could not be estimated");
    }
    let interval = parameter
        .low
        .zip(parameter.high)
        // An interval without width says that the data do not determine the value.
        .filter(|(low, high)| high - low > 1e-6 * parameter.value.abs())
        .map(|(low, high)| Interval { low, high });
    let shown = rounded(parameter.value, interval);
    let unit = unit_text(&parameter.unit);
    html! {
        span.amount { (shown.value) @if !unit.is_empty() { "\u{a0}" (unit) } }
        @match shown.interval {
            Some(interval) => { " " span.interval { (interval) @if !unit.is_empty() { "\u{a0}" (unit) } } }
            None => { " " span.interval title="at the end of what a fit may reach, or not determined by the data" { "no interval" } }
        }
        @if parameter.per_tightening {
            " " span.own {
                "on average; every tightening has its own"
                @if let Some(spread) = parameter.spread { ", spread " (significant(spread, 2)) "\u{a0}" (unit) }
            }
        }
    }
}

/// A sentence with its `commands` set as code and its units raised; an expression keeps its signs.
pub fn sentence(text: &str) -> Markup {
    let words: Vec<String> = text
        .split(' ')
        .map(|word| match word.contains('*') {
            true => word.to_owned(),
            false => raised(word),
        })
        .collect();
    html! {
        @for (place, part) in words.join(" ").split('`').enumerate() {
            @if place % 2 == 1 { code { (part) } } @else { (part) }
        }
    }
}

/// Every parameter with its name and size.
pub fn sizes(parameters: &[EffectParameter], result: &CampaignResult) -> Markup {
    html! {
        @for parameter in parameters {
            span.size { (parameter_name(&parameter.meaning, &parameter.name, result)) " " (size(parameter)) }
        }
    }
}

/// What a parameter of an effect is called: as its effect says it, else by its own name.
pub fn parameter_name(meaning: &str, name: &str, result: &CampaignResult) -> String {
    if meaning.is_empty() {
        quantity::name(name, result).words
    } else {
        meaning.to_owned()
    }
}

/// How often chance alone would do as well: `once in 1000 cases`.
pub fn by_chance(p: f64) -> String {
    if !p.is_finite() {
        return "it is not known how often chance would do as well".into();
    }
    if p < 0.001 {
        return "chance alone does as well in fewer than 1 of 1000 cases".into();
    }
    if p >= 0.1 {
        return format!(
            "chance alone does as well in {} of 100 cases",
            fixed(100.0 * p, 0)
        );
    }
    format!(
        "chance alone does as well in 1 of {} cases",
        fixed((1.0 / p).round(), 0)
    )
}

/// A standard error from which on a share says nothing: what is shared out is then within the noise.
pub const UNSURE: f64 = 0.5;

/// A share 0..1 with its standard error, in percent; in words where the error leaves nothing of it.
pub fn share_with_error(share: f64, error: f64) -> String {
    if !share.is_finite() || !error.is_finite() || error >= UNSURE {
        return "nothing sure".into();
    }
    let decimals = if error < 0.005 { 1 } else { 0 };
    // Few tightenings leave the misfit itself uncertain; more than all of it cannot be removed.
    let share = share.min(1.0);
    format!(
        "{}\u{a0}±\u{a0}{}\u{a0}%",
        fixed(100.0 * share, decimals),
        fixed((100.0 * error).max(0.1), decimals)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chance_is_said_in_cases() {
        assert_eq!(
            by_chance(0.001),
            "chance alone does as well in 1 of 1000 cases"
        );
        assert_eq!(
            by_chance(0.43),
            "chance alone does as well in 43 of 100 cases"
        );
        assert!(by_chance(0.0).ends_with("fewer than 1 of 1000 cases"));
        assert!(by_chance(f64::NAN).contains("not known"));
    }

    #[test]
    fn units_in_a_sentence_are_raised_beside_an_expression() {
        let told = sentence("a force p*x^2*v with p 3 N s/m^3: 1 and `improve`").into_string();
        assert_eq!(
            told,
            "a force p*x^2*v with p 3 N s/m³: 1 and <code>improve</code>"
        );
    }

    #[test]
    fn a_share_that_its_error_swallows_is_no_percentage() {
        assert_eq!(share_with_error(1.73, 0.4), "100\u{a0}±\u{a0}40\u{a0}%");
        assert_eq!(share_with_error(0.72, 6.17), "nothing sure");
        assert_eq!(share_with_error(0.83, 0.04), "83\u{a0}±\u{a0}4\u{a0}%");
        assert_eq!(
            share_with_error(0.991, 0.003),
            "99.1\u{a0}±\u{a0}0.3\u{a0}%"
        );
    }
}
