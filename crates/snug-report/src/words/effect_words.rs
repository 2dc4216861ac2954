//! Sizes of effects and sentences about them, set in type.

use crate::words::number::missing;
use crate::words::quantity;
use maud::{Markup, html};
use snug_campaign::words::effect_name::raised;
use snug_campaign::{CampaignResult, EffectParameter};

/// Value, interval and unit of an effect's parameter.
pub fn size(parameter: &EffectParameter) -> Markup {
    if !parameter.value.is_finite() {
        return missing("the size could not be estimated");
    }
    let size = parameter.size();
    html! {
        span.amount { (size.value) @if !size.unit.is_empty() { "\u{a0}" (size.unit) } }
        @match size.interval {
            Some(interval) => { " " span.interval { (interval) @if !size.unit.is_empty() { "\u{a0}" (size.unit) } } }
            None => { " " span.interval title="at the end of what a fit may reach, or not determined by the data" { "no interval" } }
        }
        @if let Some(own) = size.own { " " span.own { (own) } }
    }
}

/// A sentence with its `commands` set as code and its units raised; an expression keeps its signs.
pub fn sentence(text: impl ToString) -> Markup {
    let text = text.to_string();
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_in_a_sentence_are_raised_beside_an_expression() {
        let told = sentence("a force p*x^2*v with p 3 N s/m^3: 1 and `improve`").into_string();
        assert_eq!(
            told,
            "a force p*x^2*v with p 3 N s/m³: 1 and <code>improve</code>"
        );
    }
}
