//! The tool already moves when the window begins: θ(0) = θ0, ω(0) = ω0.
//!
//! Excited by itself; decays with the hand–arm's own time constant. Source: preceding tightening, posture.

use crate::numeric::number::Number;
use crate::effect::{Description, Kind, Law, ParameterSpec, Scope};

pub struct InitialMotion;

impl Law for InitialMotion {
    fn description(&self) -> &'static Description {
        &Description {
            name: "initial_motion",
            kind: Kind::Measurement,
            summary: "The tool is not at rest when the window begins.",
            equation: "theta(0) = theta0, omega(0) = omega0",
            parameters: &[
                ParameterSpec {
                    name: "theta0_rad",
                    meaning: "angle at the start",
                    unit: "rad",
                    starts: &[0.0],
                    minimum: -0.2,
                    maximum: 0.2,
                    limits: (-1.0, 1.0),
                    scope: Scope::PerTightening,
                },
                ParameterSpec {
                    name: "omega0_rad_per_s",
                    meaning: "speed at the start",
                    unit: "rad/s",
                    starts: &[0.0],
                    minimum: -5.0,
                    maximum: 5.0,
                    limits: (-50.0, 50.0),
                    scope: Scope::PerTightening,
                },
            ],
            states: &[],
            twins: &["acceleration_bias"],
            excited_by: "nothing: it is there at the start",
            shows_as: "a free, decaying oscillation from the first sample on, before the pulse",
            check: "Hold the tool still for a second before each start, and check that the window begins before the pulse does.",
            source: "initial conditions",
        }
    }

    #[inline(always)]
    fn initial<N: Number>(&self, p: &[N]) -> Option<(N, N)> {
        Some((p[0], p[1]))
    }
}
