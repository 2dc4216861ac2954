//! Where a fit of a pooled model may begin.

use super::{PooledModel, Start};
use crate::pooled::parameter_place::first_parameter;
use snug_model::{BASE_PARAMETERS, Effect, Law, Model, Scope};

impl PooledModel<'_> {
    /// Where the parameters begin by themselves: the study's values, the effects' usual starts.
    pub fn usual_start(&self) -> Start {
        let value = |model: &Model, index: usize| model.parameters()[index].value;
        let own = |model: &Model| self.own.iter().map(|&index| value(model, index)).collect();
        Start {
            own: self.models.iter().map(own).collect(),
            shared: self.usual_shared(),
        }
    }

    /// What is shared as the first tightening that has it begins.
    fn usual_shared(&self) -> Vec<f64> {
        let has = |place: usize| self.shared_of.iter().position(|own| own.contains(&place));
        (self.shared.iter().enumerate())
            .map(|(place, size)| {
                let model = &self.models[has(place).unwrap_or(0)];
                model.parameters()[size.index].value
            })
            .collect()
    }

    /// What all share, as a model has it.
    fn shared_values(&self, model: &Model) -> Vec<f64> {
        let values = self
            .shared
            .iter()
            .map(|size| model.parameters()[size.index].value);
        values.collect()
    }

    /// Where the parameters begin by themselves, one start for each record where all share mass, damping and stiffness, else another
    /// from where each ends by itself: what one of them asks for may be far from what the others do.
    pub fn usual_starts(&self) -> Vec<Start> {
        let usual = self.usual_start();
        if self.models.len() == 1 {
            return vec![usual];
        }
        if !self.cases.are_of_one_machine() {
            let alone = self.each_alone(&usual);
            return vec![usual, alone];
        }
        (self.models.iter())
            .map(|model| Start {
                own: usual.own.clone(),
                shared: self.shared_values(model),
            })
            .collect()
    }

    /// From `start`, each member's own parameters where its fit by itself ends.
    fn each_alone(&self, start: &Start) -> Start {
        let members: Vec<usize> = (0..self.models.len()).collect();
        let ends = self.fit_alone(&members, &start.own, &start.shared);
        let own = (ends.into_iter().zip(&start.own))
            .map(|(end, start)| end.map_or_else(|| start.clone(), |(own, _)| own));
        Start {
            own: own.collect(),
            shared: start.shared.clone(),
        }
    }

    /// The sizes of `start` with the study's own mass, damping and stiffness as they usually begin.
    pub fn with_base_afresh(&self, start: &Start) -> Start {
        let Start { own, mut shared } = self.usual_start();
        for ((to, from), size) in shared.iter_mut().zip(&start.shared).zip(&self.shared) {
            if size.index >= BASE_PARAMETERS.len() {
                *to = *from;
            }
        }
        Start { own, shared }
    }

    /// The `start` with one effect's parameters at `values`.
    pub fn with_effect(&self, mut start: Start, effect: Effect, values: &[f64]) -> Start {
        let first = first_parameter(&self.effects, effect);
        let specs = effect.description().parameters;
        for (offset, (&value, spec)) in values.iter().zip(specs).enumerate() {
            let index = first + offset;
            match spec.scope {
                Scope::Shared => {
                    let sizes = self.shared.iter().zip(&mut start.shared);
                    let own = sizes.filter(|(size, _)| size.index == index);
                    own.for_each(|(_, size)| *size = value);
                }
                Scope::PerTightening => {
                    if let Some(column) = self.own.iter().position(|&i| i == index) {
                        start.own.iter_mut().for_each(|own| own[column] = value);
                    }
                }
            }
        }
        start
    }

    /// The same with these values of the parameters of these names.
    pub fn with_named(&self, start: &Start, named: &[(String, f64)]) -> Start {
        let value = |index: usize| {
            let name = &self.models[0].parameters()[index].name;
            let found = named.iter().find(|(known, _)| known == name);
            found.map(|(_, value)| *value)
        };
        let mut start = start.clone();
        for own in &mut start.own {
            for (to, &index) in own.iter_mut().zip(&self.own) {
                *to = value(index).unwrap_or(*to);
            }
        }
        for (to, size) in start.shared.iter_mut().zip(&self.shared) {
            *to = value(size.index).unwrap_or(*to);
        }
        start
    }
}
