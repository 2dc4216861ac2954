//! Terms that are in no catalogue, to describe what no effect of it explains: the simplest polynomials in x and v and a
//! few shapes the field knows.

use crate::DiagnoseError;
use snug_model::{CustomEffect, CustomEffectSettings, CustomParameterSettings, Effect, Place};

/// One candidate: name, expression of force \[N\] and unit of its factor p.
struct Term {
    name: &'static str,
    expression: &'static str,
    unit: &'static str,
}

const TERMS: &[Term] = &[
    Term {
        name: "x_v_law",
        expression: "p*x*v",
        unit: "N s/m^2",
    },
    Term {
        name: "x2_v_law",
        expression: "p*x^2*v",
        unit: "N s/m^3",
    },
    Term {
        name: "abs_x_v_law",
        expression: "p*abs(x)*v",
        unit: "N s/m^2",
    },
    Term {
        name: "x_v2_law",
        expression: "p*x*v^2",
        unit: "N s^2/m^3",
    },
    Term {
        name: "x_v_abs_v_law",
        expression: "p*x*v*abs(v)",
        unit: "N s^2/m^3",
    },
    Term {
        name: "v2_law",
        expression: "p*v^2",
        unit: "N s^2/m^2",
    },
    Term {
        name: "v3_law",
        expression: "p*v^3",
        unit: "N s^3/m^3",
    },
    Term {
        name: "sqrt_v_law",
        expression: "p*v/sqrt(abs(v)+0.001)",
        unit: "N s^0.5/m^0.5",
    },
    Term {
        name: "stribeck_law",
        expression: "p*tanh(v/0.01)*exp(-(v/0.05)^2)",
        unit: "N",
    },
    Term {
        name: "x4_law",
        expression: "p*x^4",
        unit: "N/m^4",
    },
    Term {
        name: "x5_law",
        expression: "p*x^5",
        unit: "N/m^5",
    },
    Term {
        name: "abs_x_x_law",
        expression: "p*x*abs(x)",
        unit: "N/m^2",
    },
    Term {
        name: "abs_x_friction_law",
        expression: "p*abs(x)*tanh(v/0.01)",
        unit: "N/m",
    },
    Term {
        name: "x_abs_v_law",
        expression: "p*x*abs(v)",
        unit: "N s/m^2",
    },
    Term {
        name: "torque_v_law",
        expression: "p*T*v",
        unit: "s/m^2",
    },
    Term {
        name: "sine_law",
        expression: "p*sin(theta)",
        unit: "N",
    },
];

/// Every term as an effect.
pub(crate) fn terms() -> Result<Vec<Effect>, DiagnoseError> {
    TERMS
        .iter()
        .map(|term| Ok(CustomEffect::intern(&settings(term))?))
        .collect()
}

/// How a study declares the term called `name`.
pub(crate) fn declaration(name: &str) -> Option<CustomEffectSettings> {
    TERMS.iter().find(|term| term.name == name).map(settings)
}

fn settings(term: &Term) -> CustomEffectSettings {
    CustomEffectSettings {
        name: term.name.to_owned(),
        place: Place::Force,
        expression: term.expression.to_owned(),
        parameters: vec![CustomParameterSettings {
            name: "p".to_owned(),
            unit: term.unit.to_owned(),
            ..CustomParameterSettings::default()
        }],
    }
}

/// Whether an effect is one of these terms.
pub(crate) fn is_unlisted(effect: Effect) -> bool {
    TERMS.iter().any(|term| term.name == effect.name())
}
