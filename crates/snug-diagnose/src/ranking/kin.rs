//! Which effects are shapes of one another.

use snug_model::{Effect, Law};

/// Whether `simple` is what `rich` is easily taken for, and has fewer sizes, shapes and states to do it with: dry friction for a
/// friction that comes with the way, or goes with the speed.
pub(crate) fn is_simpler(simple: Effect, rich: Effect) -> bool {
    let numbers = |effect: Effect| {
        let description = effect.description();
        description.parameters.len() + description.states.len()
    };
    rich.description().twins.contains(&simple.name()) && numbers(simple) < numbers(rich)
}

/// Whether either is a simpler one of the other.
pub(crate) fn are_kin(one: Effect, other: Effect) -> bool {
    is_simpler(one, other) || is_simpler(other, one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use snug_model::Effect::{
        BoucWen, CoulombFriction, CubicStiffness, ExponentialStiffness, MaxwellBranch,
        QuadraticDamping, StribeckFriction,
    };

    #[test]
    fn a_law_of_fewer_numbers_is_the_simpler_of_what_it_is_taken_for() {
        assert!(is_simpler(CoulombFriction, BoucWen));
        assert!(is_simpler(CoulombFriction, StribeckFriction));
        assert!(is_simpler(CubicStiffness, ExponentialStiffness));
        assert!(are_kin(BoucWen, CoulombFriction));
    }

    #[test]
    fn of_as_many_numbers_or_of_another_shape_none_is_simpler() {
        for (one, other) in [
            (QuadraticDamping, CoulombFriction),
            (MaxwellBranch, BoucWen),
            (CoulombFriction, CubicStiffness),
            (CoulombFriction, CoulombFriction),
        ] {
            assert!(!are_kin(one, other), "{} {}", one.name(), other.name());
        }
    }
}
