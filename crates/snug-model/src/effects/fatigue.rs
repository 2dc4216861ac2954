//! The arm tires: m, c, k of tightening number n are m0 (1 + s_m n), c0 (1 + s_c n), k0 (1 + s_k n).
//!
//! Within one tightening m, c, k are free, so nothing of it shows there: it is no law of motion but a trend of what was
//! identified, over the tightening's number in its file. A negative slope is an arm that gives way. Excited by many
//! tightenings in a row. In the residual of one tightening it leaves nothing; the fitted m, c, k drift.
//!
//! Valid for: many tightenings in a row by the same person, few enough that the trend stays straight and 1 + s n positive.
//!
//! Source: muscle stiffness falls and posture sags as muscles tire.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope};

const fn slope(name: &'static str, meaning: &'static str) -> ParameterSpec {
    ParameterSpec {
        name,
        meaning,
        unit: "1/tightening",
        starts: &[0.0],
        minimum: -0.1,
        maximum: 0.1,
        limits: (-0.1, 0.1),
        vanishes_at: Some(0.0),
        scope: Scope::Shared,
    }
}

/// What people read about it.
pub const DESCRIPTION: Description = Description {
    name: "fatigue",
    kind: Kind::Trend,
    acts_on: ActsOn::Anything,
    summary: "The arm tires: mass, damping and stiffness drift from one tightening to the next.",
    equation: "m (1 + s_m n), c (1 + s_c n), k (1 + s_k n),  n: the tightening's number",
    parameters: &[
        slope("mass_slope_per_tightening", "growth of the mass"),
        slope("damping_slope_per_tightening", "growth of the damping"),
        slope("stiffness_slope_per_tightening", "growth of the stiffness"),
    ],
    states: &[],
    twins: &[],
    excited_by: "many tightenings in a row by the same person",
    shows_as: "no misfit within a tightening; the fitted mass, damping and stiffness drift with its number",
    check: "Repeat the first tightenings after a rest: values that come back to where they began show fatigue, values that stay show learning or a changed setup.",
    on_machine: Some(OnMachine {
        summary: Some(
            "The rig changes with time: mass, damping and stiffness drift from one recording to the next.",
        ),
        shows_as: Some(
            "no misfit within a recording; the fitted mass, damping and stiffness drift with its number",
        ),
        check: "Repeat the first recordings after a pause: values that come back to where they began show warming, values that stay show wear or a changed setup.",
    }),
    valid_for: "tightenings in a row by the same person, few enough that the trend stays straight and 1 + s n positive",
    source: "Enoka and Duchateau 2008, Muscle fatigue: what, why and how it influences muscle function, Journal of Physiology 586",
};
