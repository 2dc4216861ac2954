//! The columns of a fit: what the function answers for a study, and how results are laid out.

use crate::error::PlantError;
use crate::storage::schema::{Kind, field, identity, schema};
use arrow::datatypes::{Field, Fields, SchemaRef};
use snug_campaign::Rig;
use snug_model::Model;
use snug_study::Study;

/// What a fit says beside its parameters, in the order in which it says it.
const OUTCOME: &[(&str, Kind, &str)] = &[
    (
        "status",
        Kind::Text,
        "how the fit ended: converged, converged_at_constraint, iteration_limit, stalled, not_identifiable or failed; null where there was none",
    ),
    (
        "failure",
        Kind::Text,
        "why there was no fit; null where there was",
    ),
    (
        "selected",
        Kind::Flag,
        "whether nothing speaks against the tightening",
    ),
    (
        "reasons",
        Kind::Texts,
        "what speaks against it; empty where nothing does",
    ),
    (
        "active_constraints",
        Kind::Texts,
        "constraints that the optimum lies on",
    ),
    (
        "error_over_noise",
        Kind::Number,
        "root mean square of the whitened residual: 1 is nothing left but noise",
    ),
    (
        "fit_percent",
        Kind::Number,
        "100 (1 - |y - s| / |y - mean y|) of the displacement [%]",
    ),
    ("natural_frequency_hz", Kind::Number, "of the hand-arm [Hz]"),
    (
        "natural_frequency_hz_low",
        Kind::Number,
        "lower end of its 95 % interval [Hz]",
    ),
    (
        "natural_frequency_hz_high",
        Kind::Number,
        "upper end of its 95 % interval [Hz]",
    ),
    (
        "damping_ratio",
        Kind::Number,
        "of tool and hand-arm together",
    ),
    ("rank", Kind::Count, "numerical rank of the sensitivities"),
    (
        "condition",
        Kind::Number,
        "condition number of the column-scaled sensitivities",
    ),
    ("iterations", Kind::Count, "Gauss-Newton iterations"),
];

/// What stands behind a parameter's name for its standard error and the ends of its interval.
const BESIDE: [(&str, &str); 3] = [
    ("_standard_error", "standard error"),
    ("_low", "lower end of the 95 % interval"),
    ("_high", "upper end of the 95 % interval"),
];

/// The model of a study, on its rig with nothing on it: names of parameters do not depend on the inertia.
pub(crate) fn model(study: &Study) -> Result<Model, PlantError> {
    let rig = Rig {
        lever_arm_m: study.preprocess.rig.lever_arm_m,
        known_inertia_kg_m2: 0.0,
    };
    let made = study.model.model(rig);
    made.map_err(|source| snug_study::StudyError::from(source).into())
}

/// What the function answers.
pub(crate) fn outcome(study: &Study) -> Result<Fields, PlantError> {
    let mut fields: Vec<Field> = Vec::new();
    for parameter in model(study)?.parameters() {
        let told = format!("[{}]", parameter.unit);
        fields.push(field(&parameter.name, Kind::Number, true, &told));
        for (ending, what) in BESIDE {
            let told = format!("{what} [{}]", parameter.unit);
            let name = format!("{}{ending}", parameter.name);
            fields.push(field(&name, Kind::Number, true, &told));
        }
    }
    let rest = OUTCOME
        .iter()
        .map(|(name, kind, told)| field(name, *kind, true, told));
    fields.extend(rest);
    Ok(fields.into())
}

/// The table `results` of a study.
pub(crate) fn results(study: &Study) -> Result<SchemaRef, PlantError> {
    let outcome = outcome(study)?;
    let fitted = outcome.iter().map(|field| field.as_ref().clone());
    Ok(schema("results", identity().chain(fitted)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_stands_in_the_documentation() {
        let readme = include_str!("../../README.md");
        for (name, ..) in OUTCOME {
            assert!(readme.contains(&format!("`{name}`")), "{name}");
        }
        for (ending, _) in BESIDE {
            assert!(readme.contains(&format!("`{ending}`")), "{ending}");
        }
    }
}
