//! Which numbers of a tightening tables and tests are about, in which order, and where each is found.

use snug_campaign::TighteningResult;

/// Names of the reported quantities: every free parameter and the natural frequency of the hand–arm.
pub fn names(tightenings: &[&TighteningResult]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for estimate in tightenings.iter().filter_map(|t| t.estimate.as_ref()) {
        for parameter in estimate.parameters.iter().filter(|p| !p.fixed) {
            if !names.contains(&parameter.name) {
                names.push(parameter.name.clone());
            }
        }
    }
    let base = names.len().min(3);
    names.insert(base, NATURAL_FREQUENCY.to_owned());
    names
}

/// √(k/m)/2π, the thesis' f_n.
const NATURAL_FREQUENCY: &str = "natural_frequency_hz";

/// The value of quantity `name` for one tightening, when it has a finite one.
pub fn value(tightening: &TighteningResult, name: &str) -> Option<f64> {
    let value = if name == NATURAL_FREQUENCY {
        tightening.measures.natural_frequency_hz
    } else {
        tightening.estimate.as_ref().and_then(|e| e.value(name))
    };
    value.filter(|value| value.is_finite())
}
