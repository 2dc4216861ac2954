//! Names of effects and their units as people write them.

/// Effects that a sentence names, of those that data cannot tell from one another; the ranking names all. Chosen.
const MOST_NAMED: usize = 3;

/// What is not written as it is named: people's names, and others.
const WRITTEN: [(&str, &str); 6] = [
    ("ac coupling", "AC coupling"),
    ("bouc wen", "Bouc–Wen"),
    ("co contraction", "co-contraction"),
    ("coulomb", "Coulomb"),
    ("maxwell", "Maxwell"),
    ("stribeck", "Stribeck"),
];

/// `cubic_stiffness` as `cubic stiffness`, `coulomb_friction` as `Coulomb friction`; an expression stays as it is.
pub fn effect_name(name: &str) -> String {
    if name.contains(['*', '^', '(', '+', '/']) {
        return name.into();
    }
    (WRITTEN.iter()).fold(name.replace('_', " "), |name, (plain, written)| {
        name.replace(plain, written)
    })
}

/// An effect as commands and files name it; a term that is in no catalogue by what it is, `force p*x^2*v`.
pub fn label(effect: &str, expression: Option<&String>) -> String {
    expression.map_or_else(
        || effect.to_owned(),
        |expression| format!("force {expression}"),
    )
}

/// An effect as people say it; a term that is in no catalogue by what it is.
pub fn called(effect: &str, expression: Option<&String>) -> String {
    effect_name(&label(effect, expression))
}

/// An effect as a sentence names it.
#[derive(Debug, Clone, PartialEq)]
pub struct Named {
    /// Its name in the catalogue, or of a term that is in none.
    pub effect: String,
    /// The expression of such a term.
    pub expression: Option<String>,
    /// What such a term is, in words.
    pub says: Option<&'static str>,
    /// What these data cannot tell from it.
    pub twins: Vec<Named>,
}

impl Named {
    /// An effect by itself: its name, and its expression if it is in no catalogue.
    pub fn alone(effect: String, expression: Option<String>) -> Self {
        Self {
            effect,
            expression,
            says: None,
            twins: Vec::new(),
        }
    }

    /// Whether it is in no catalogue.
    pub fn is_unlisted(&self) -> bool {
        self.expression.is_some()
    }

    /// `co-contraction`, or `a force p*x^2*v`.
    pub fn spoken(&self) -> String {
        match &self.expression {
            Some(expression) => format!("a force {expression}"),
            None => effect_name(&self.effect),
        }
    }

    /// With what these data cannot tell from it; a term that stands alone is put into words.
    pub fn with_twins(&self) -> String {
        match (self.twins.as_slice(), self.says) {
            ([], None) => self.spoken(),
            ([], Some(words)) => format!("{} ({words})", self.spoken()),
            (twins, _) => {
                let names = std::iter::once(self).chain(twins).map(Self::spoken);
                let mut names: Vec<String> = names.collect();
                if names.len() > MOST_NAMED {
                    let others = names.split_off(MOST_NAMED - 1).len();
                    names.push(format!("one of {others} others"));
                }
                format!("{} (these data cannot tell which)", names.join(" or "))
            }
        }
    }
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
    fn of_many_that_cannot_be_told_apart_a_sentence_names_two() {
        let alone = |name: &str| Named::alone(name.to_owned(), None);
        let with = |twins: &[&str]| {
            let twins = twins.iter().map(|name| alone(name)).collect();
            let one = Named {
                twins,
                ..alone("grip_slip")
            };
            one.with_twins()
        };
        let cannot_tell = "(these data cannot tell which)";
        assert_eq!(
            with(&["bouc_wen", "backlash"]),
            format!("grip slip or Bouc–Wen or backlash {cannot_tell}")
        );
        assert_eq!(
            with(&["bouc_wen", "backlash", "second_mass"]),
            format!("grip slip or Bouc–Wen or one of 2 others {cannot_tell}")
        );
    }

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
