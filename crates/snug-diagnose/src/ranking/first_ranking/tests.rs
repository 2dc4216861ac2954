//! What candidates promise for a machine whose friction is known.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::data::cases::Tally;
use crate::ranking::applicability::candidates;
use crate::tests::made_up::machine_with_friction;

#[test]
fn dry_friction_promises_most_and_knows_its_size() {
    let cases = [machine_with_friction(15.0)];
    let names = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];
    let current = Fitted::made_up(&[], &[1.0], 3000).unweighted();
    let current = current.with_own(&names, vec![vec![0.4, 1.9, 30.0]], 0);
    let all = candidates(&cases, &current, &[]).unwrap();
    let tally = Tally::default();
    let promises = first_ranking(Cases::new(&cases, &tally), &current, &all);
    let first = &promises[0];
    let is_friction = |promise: &&Promise| promise.effect.name() == "coulomb_friction";
    let friction = promises.iter().find(is_friction).unwrap();
    assert!(
        friction.share > 0.9 && first.share - friction.share < 0.05,
        "{promises:?}"
    );
    assert!((friction.own[0] - 15.0).abs() < 0.5, "{friction:?}");
    for (found, truth) in friction.base.iter().zip([0.4, 1.9, 30.0]) {
        assert!((found - truth).abs() < 0.03 * truth, "{friction:?}");
    }
    // What is not linear in its size is not tried: a gap, a delay.
    for name in ["backlash", "torque_delay"] {
        assert!(promises.iter().all(|promise| promise.effect.name() != name));
    }
}

/// A model with friction that is a third too large, and beside it an offset that is not there.
#[test]
fn what_is_in_the_model_is_told_by_how_much_it_is_off() {
    let cases = [machine_with_friction(15.0)];
    let model = &cases[0].model;
    let friction = model.scale().effect(Effect::CoulombFriction, model.rig());
    let friction = friction.unwrap();
    let names = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];
    let current = Fitted::made_up(&[friction], &[1.0], 3000).unweighted();
    let current = (current.with_own(&names, vec![vec![0.4, 1.9, 30.0]], 0))
        .with_shared(("fc_n", 3, 20.0), &[(0.0, 1.0)]);
    let tally = Tally::default();
    let offset = [Effect::TorqueOffset];
    let promises = first_ranking(Cases::new(&cases, &tally), &current, &offset);
    let [(effect, times)] = promises[0].times[..] else {
        panic!("{promises:?}")
    };
    assert_eq!(effect, friction);
    assert!((times - 0.75).abs() < 0.02, "{promises:?}");
}

/// Somebody holds the tool: nothing is promised, and nothing is spent.
#[test]
fn a_hand_is_promised_nothing() {
    let cases = [crate::tests::made_up::exact(0, &[], &[])];
    let current = Fitted::made_up(&[], &[1.0], 250);
    let own = vec![crate::tests::made_up::hand(0).to_vec()];
    let current = current.with_own(&["m", "c", "k"], own, 0);
    let tally = Tally::default();
    let promises = first_ranking(
        Cases::new(&cases, &tally),
        &current,
        &[Effect::CoulombFriction],
    );
    assert!(promises.is_empty());
}
