//! What is watched of a fit: how much is left over, m, c, k, and the size of each effect.

use crate::error::PlantError;
use crate::functions::results::model;
use snug_campaign::words::effect_name::effect_name;
use snug_model::BASE_PARAMETERS;
use snug_study::Study;

/// A quantity that is watched.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Its column in the results.
    pub column: String,
    /// What people call it.
    pub name: String,
    /// Its unit as people write it; empty for none.
    pub unit: String,
    /// The effect whose size it is; `None` for m, c, k and the error.
    pub effect: Option<String>,
}

/// Those of a study, the error first.
#[derive(Debug, Clone)]
pub struct Quantities(pub Vec<Quantity>);

/// The column that says how much a fit leaves.
pub const ERROR: &str = "error_over_noise";

impl Quantities {
    pub fn of(study: &Study) -> Result<Self, PlantError> {
        let mut found = vec![Quantity {
            column: ERROR.to_owned(),
            name: "error over noise".to_owned(),
            unit: String::new(),
            effect: None,
        }];
        let whole = model(study)?;
        let owners = owners(study)?;
        for (index, parameter) in whole.parameters().iter().enumerate() {
            if parameter.fixed {
                continue;
            }
            let effect = owners.get(index).cloned().flatten();
            let name = match index < BASE_PARAMETERS.len() {
                true => ["mass", "damping", "stiffness"][index].to_owned(),
                false => without_unit(&parameter.name),
            };
            found.push(Quantity {
                column: parameter.name.clone(),
                name: match &effect {
                    Some(effect) if effect_name(effect) != name => {
                        format!("{}: {name}", effect_name(effect))
                    }
                    _ => name,
                },
                unit: parameter.unit.clone(),
                effect,
            });
        }
        Ok(Self(found))
    }

    pub fn named(&self, column: &str) -> Option<&Quantity> {
        self.0.iter().find(|quantity| quantity.column == column)
    }
}

/// The effect of every parameter, in the model's order: an effect's stand behind those of the effects before it.
fn owners(study: &Study) -> Result<Vec<Option<String>>, PlantError> {
    let mut owners: Vec<Option<String>> = vec![None; BASE_PARAMETERS.len()];
    let mut growing = study.clone();
    growing.model.parameters.clear();
    for count in 1..=study.model.effects.len() {
        growing.model.effects = study.model.effects[..count].to_vec();
        let parameters = model(&growing)?.parameters().len();
        owners.resize(parameters, Some(study.model.effects[count - 1].clone()));
    }
    Ok(owners)
}

/// `gap_m` as `gap`: what stands behind the last word that is no unit.
fn without_unit(column: &str) -> String {
    const UNITS: [&str; 17] = [
        "m",
        "s",
        "n",
        "nm",
        "kg",
        "rad",
        "hz",
        "n_per_m",
        "kg_per_s",
        "kg_per_m",
        "n_per_m2",
        "n_per_m3",
        "rad_per_s",
        "rad_per_s2",
        "per_rad",
        "per_nm",
        "ratio",
    ];
    let endings = UNITS
        .iter()
        .filter_map(|unit| column.strip_suffix(&format!("_{unit}")));
    let shortest = endings.min_by_key(|rest| rest.len());
    shortest.unwrap_or(column).replace('_', " ")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn every_size_is_its_effect_s() {
        let mut study = Study::default();
        study.model.effects = ["backlash", "maxwell_branch", "coulomb_friction"]
            .map(str::to_owned)
            .to_vec();
        let found = Quantities::of(&study).unwrap();
        let effects: Vec<Option<&str>> = found.0.iter().map(|one| one.effect.as_deref()).collect();
        assert_eq!(effects[..4], [None; 4]);
        let of = |name: &str| effects.iter().filter(|one| **one == Some(name)).count();
        assert_eq!(
            (of("backlash"), of("maxwell_branch"), of("coulomb_friction")),
            (1, 2, 1)
        );
        assert_eq!(found.0[4].effect.as_deref(), Some("backlash"));
        assert!(found.named("mass_kg").is_some());
    }
}
