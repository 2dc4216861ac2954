//! What one tightening has of the sizes that are shared.

use crate::pooled::fitted::Fitted;

/// What a tightening has of a model's parameter that is not its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Part {
    /// Which of the model's parameters.
    pub index: usize,
    pub value: f64,
    pub standard_error: Option<f64>,
}

impl Fitted {
    /// What one tightening has of the shared parameters, known as well as `errors` of the shared sizes say.
    pub fn parts(&self, member: usize, errors: Option<&[f64]>) -> Vec<Part> {
        let mut parts: Vec<Part> = Vec::new();
        for (at, &place) in self.shared_of(member).iter().enumerate() {
            let share = self.shares.as_ref().map_or(1.0, |all| all[member][at]);
            let part = Part {
                index: self.shared_sizes()[place].index,
                value: share * self.shared[place],
                standard_error: errors.map(|errors| share * errors[place]),
            };
            match parts.last_mut().filter(|last| last.index == part.index) {
                Some(last) => {
                    last.value += part.value;
                    // As if both ends were known independently: between them that is too much rather than too little.
                    last.standard_error = (last.standard_error.zip(part.standard_error))
                        .map(|(one, other)| one.hypot(other));
                }
                None => parts.push(part),
            }
        }
        parts
    }
}
