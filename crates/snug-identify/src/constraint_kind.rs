//! What must hold of m, c and k, as a study names it and as the solver takes it.

use serde::{Deserialize, Serialize};
use snug_least_squares::{Affine, Constraints};
use snug_model::Model;

/// What keeps a strict inequality strict in floating point, in the parameter's own unit on a hand and as much more or less on a
/// rig of another scale. Chosen.
const STRICT: f64 = 1e-9;

/// A constraint a study can ask for on m, c, k.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum ConstraintKind {
    /// m > 0, c > 0, k > 0, each as far as it is free.
    Positive,
    /// Tool and hand–arm together are lightly damped: (c l²)² < 4 k l² (I_n + m l²). Asks nothing of a model whose
    /// stiffness is fixed at 0: without a spring nothing oscillates.
    LightlyDamped,
    /// The motion decays: I_n + m l² > 0, c > 0, k > 0, with m of either sign.
    Stable,
}

/// The convex set of a model's free parameters: their bounds and the constraints asked for.
pub fn convex_set(model: &Model, kinds: &[ConstraintKind]) -> Constraints {
    let parameters = model.parameters();
    let free = model.free();
    let column = |parameter: usize| free.iter().position(|&index| index == parameter);
    let mut set = Constraints::new(free.len());
    for (column, &index) in free.iter().enumerate() {
        let parameter = &parameters[index];
        set.bound(
            column,
            parameter.minimum,
            parameter.maximum,
            &parameter.name,
        );
    }
    let rig = model.rig();
    let square = rig.lever_arm_m * rig.lever_arm_m;
    let strict = |index: usize| STRICT * model.scale().times_hand(&parameters[index].unit, rig);
    // factor · parameter + constant over the free parameters.
    let affine = |parameter: usize, factor: f64, constant: f64| match column(parameter) {
        Some(column) => Affine::term(free.len(), column, factor, constant),
        None => Affine::constant(free.len(), constant + factor * parameters[parameter].value),
    };
    for kind in kinds {
        match kind {
            ConstraintKind::Positive => {
                for (index, parameter) in parameters.iter().enumerate().take(3) {
                    if let Some(column) = column(index) {
                        set.bound(column, strict(index), f64::INFINITY, &parameter.name);
                    }
                }
            }
            ConstraintKind::Stable => {
                for (index, minimum) in [(0, -rig.known_inertia_kg_m2 / square), (1, 0.0), (2, 0.0)]
                {
                    if let Some(column) = column(index) {
                        set.bound(
                            column,
                            minimum + strict(index),
                            f64::INFINITY,
                            &parameters[index].name,
                        );
                    }
                }
            }
            ConstraintKind::LightlyDamped if parameters[2].fixed && parameters[2].value == 0.0 => {}
            ConstraintKind::LightlyDamped => {
                let stiffness = affine(2, square, 0.0);
                let inertia = affine(0, square, rig.known_inertia_kg_m2);
                set.rotated_cone("light_damping", stiffness, inertia, affine(1, square, 0.0));
            }
        }
    }
    set
}
