//! Names of effects and their units as people write them.

use snug_campaign::Diagnosis;

/// `cubic_stiffness` as `cubic stiffness`; an expression stays as it is.
pub fn effect_name(name: &str) -> String {
    if name.contains(['*', '^', '(', '+', '/']) {
        name.into()
    } else {
        name.replace('_', " ")
    }
}

/// An effect by its name; a term that is in no catalogue by what it is, `force p*x^2*v`.
pub fn called(effect: &str, expression: Option<&String>) -> String {
    expression.map_or_else(
        || effect_name(effect),
        |expression| format!("force {expression}"),
    )
}

/// The same of one that the diagnosis knows.
pub fn called_in(diagnosis: &Diagnosis, effect: &str) -> String {
    called(effect, diagnosis.expression(effect))
}

/// Effects that the diagnosis knows as a sentence lists them.
pub fn names_in(diagnosis: &Diagnosis, effects: &[String]) -> String {
    let names = effects.iter().map(|effect| called_in(diagnosis, effect));
    names.collect::<Vec<_>>().join(", ")
}

/// `N/m^3` as `N/m³`; nothing for a pure number.
pub fn unit_text(unit: &str) -> String {
    match unit {
        "1" => String::new(),
        unit => raised(unit),
    }
}

/// Powers as raised marks.
pub fn raised(text: &str) -> String {
    let marks = [("^2", "²"), ("^3", "³"), ("^4", "⁴"), ("^5", "⁵")];
    marks.iter().fold(text.to_owned(), |text, (plain, mark)| {
        text.replace(plain, mark)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_raised_and_pure_numbers_have_none() {
        assert_eq!(unit_text("N s^2/m^2"), "N s²/m²");
        assert_eq!(unit_text("1"), "");
    }

    #[test]
    fn expressions_keep_their_signs() {
        assert_eq!(effect_name("cubic_stiffness"), "cubic stiffness");
        assert_eq!(effect_name("p_1*x^2*v"), "p_1*x^2*v");
    }
}
