//! The grip can only hold so much: the whole hand force F becomes F_max tanh(F / F_max).
//!
//! Parameter: f_max_n \[N\], 10 to 300; F_max without limit is the base model, and what is lost grows as 1/F_max². Excited by
//! large forces: high targets. In the residual it stands around the largest force, where the hand gives way and the tool goes
//! further. Source: limit of friction in the grip, smoothed.

use crate::numeric::number::Number;
use crate::effect::{Description, Kind, Law, ParameterSpec, Scope};

pub struct GripSlip;

impl Law for GripSlip {
    fn description(&self) -> &'static Description {
        &Description {
            name: "grip_slip",
            kind: Kind::Mechanical,
            summary: "The grip slips: the hand's force cannot exceed a limit.",
            equation: "F_max tanh(F / F_max)",
            parameters: &[ParameterSpec {
                name: "f_max_n",
                meaning: "force at which the grip slips",
                unit: "N",
                starts: &[150.0, 60.0, 280.0],
                minimum: 10.0,
                maximum: 300.0,
                limits: (3.0, 1000.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["coulomb_friction", "cubic_stiffness"],
            excited_by: "large forces: high target torque, weak grip",
            shows_as: "misfit where the force is largest: the tool goes further than the spring would let it",
            check: "Mark handle and glove with a line and look after a high-torque tightening whether it has moved; repeat with a firmer grip.",
            source: "limit of friction, smoothed",
        }
    }

    #[inline(always)]
    fn limit<N: Number>(&self, p: &[N], force_n: N) -> Option<N> {
        Some(p[0] * (force_n / p[0]).tanh())
    }
}
