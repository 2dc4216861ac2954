//! Which effects are shapes of one another.

use crate::library::is_special_case;
use snug_model::{Effect, Law};

/// Whether `simple` is what `rich` is easily taken for, and has fewer sizes, shapes and states to do it with: dry friction for a
/// friction that comes with the way, or goes with the speed; one offset of all recordings for a load that each has of its own; one stop for two.
pub(crate) fn is_simpler(simple: Effect, rich: Effect) -> bool {
    let numbers = |effect: Effect| {
        let description = effect.description();
        description.parameters.len() + description.states.len()
    };
    let is_taken_for = rich.description().twins.contains(&simple.name());
    (is_taken_for && numbers(simple) < numbers(rich))
        || is_of_all(simple, rich)
        || is_special_case(simple, rich)
}

/// Whether `shared` is what `own` is where it is the same in all recordings.
pub(crate) fn is_of_all(shared: Effect, own: Effect) -> bool {
    own.of_all() == Some(shared.name())
}

/// Whether either is a simpler one of the other.
pub(crate) fn are_kin(one: Effect, other: Effect) -> bool {
    is_simpler(one, other) || is_simpler(other, one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::made_up::term;
    use snug_model::Effect::{
        BoucWen, ConstantLoad, CoulombFriction, CubicStiffness, ExponentialStiffness,
        MaxwellBranch, QuadraticDamping, StribeckFriction, TorqueOffset,
    };

    #[test]
    fn a_law_of_fewer_numbers_is_the_simpler_of_what_it_is_taken_for() {
        assert!(is_simpler(CoulombFriction, BoucWen));
        assert!(is_simpler(CoulombFriction, StribeckFriction));
        assert!(is_simpler(CubicStiffness, ExponentialStiffness));
        assert!(are_kin(BoucWen, CoulombFriction));
        assert!(is_simpler(TorqueOffset, ConstantLoad) && !is_simpler(ConstantLoad, TorqueOffset));
        let [one, two] = ["end_stop_law", "uneven_slack_spring_law"].map(term);
        assert!(is_simpler(one, two) && !is_simpler(two, one));
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
