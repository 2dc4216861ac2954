//! Play in the grip: the hand's spring and damper act only beyond a gap g, on the deflection d(x) that is left.
//!
//! ```text
//! d(x) = x + ½ (√((x − g)² + s²) − √((x + g)² + s²)),  F = k d + c v ∂d/∂x,  s² = (1 µm)² + (v · 0.025 ms)²
//! ```
//!
//! This is x ∓ g beyond the gap and 0 within. The damper sets in with a jump there; its corner is rounded over what the
//! tool moves in a quarter of a sample, so that the response can be differentiated and yet hardly a sample sees the
//! rounding; on a rig of another scale over as much more or less. g = 0 is the base model exactly. F has the sign of the base model. Excited by any motion; relatively strongest
//! in weak pulses. In the residual it shows at the first onset and at every passage through rest.
//!
//! Valid for: play that is the same to both sides of rest, gaps far above 1 µm, records at some 10 kHz, whose quarter of a
//! sample the rounding is.
//!
//! Source: dead zone with contact damping.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Corner, Deflection, Law};
use crate::numeric::number::Number;

state! {
    summary: "The tool moves freely through a gap before the hand's spring and damper act.",
    equation: "spring and damper act on x beyond +-g",
}

pub(super) struct Backlash;

impl Law for Backlash {
    fn description(&self) -> &'static Description {
        &Description {
            name: "backlash",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "gap_m",
                meaning: "gap to either side",
                unit: "m",
                starts: &[0.0005, 1.3e-5, 4e-5, 0.00012, 0.0015, 0.004],
                minimum: 0.0,
                maximum: 0.005,
                limits: (0.0, 0.05),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["co_contraction"],
            excited_by: "any motion; relatively strongest in weak pulses",
            shows_as: "misfit at the onset and at every passage through rest, where the tool moves as if free",
            check: "With the tool off, rock the handle and look for free play between tool, reaction bar, mounting and palm.",
            on_machine: Some(OnMachine {
                summary: Some(
                    "The moving part runs freely through a gap before the spring and damper act.",
                ),
                shows_as: None,
                check: "With the power off, rock the moving part and feel for free play in gears, couplings, keys and mounting.",
            }),
            valid_for: "play of the same size to both sides of rest, gaps far above 1 um, records at some 10 kHz",
            source: "Nordin and Gutman 2002, Controlling mechanical systems with backlash – a survey, Automatica 38",
        }
    }

    #[inline(always)]
    fn deflection<N: Number>(
        &self,
        p: &[N],
        between: Deflection<N>,
        corner: &Corner<N::Real>,
    ) -> Option<Deflection<N>> {
        let travelled = between.v_m_per_s.times(corner.time_s);
        let rounding = (travelled * travelled).plus(corner.length_m * corner.length_m);
        let (above, below) = (between.x_m - p[0], between.x_m + p[0]);
        let from_above = (above * above + rounding).sqrt();
        let from_below = (below * below + rounding).sqrt();
        let slope = (above / from_above - below / from_below) * 0.5 + 1.0;
        Some(Deflection {
            x_m: between.x_m + (from_above - from_below) * 0.5,
            v_m_per_s: between.v_m_per_s * slope,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    fn left(gap_m: f64, x_m: f64) -> (f64, f64) {
        let between = Deflection {
            x_m,
            v_m_per_s: 0.1,
        };
        let corner = Corner {
            length_m: 1e-6,
            time_s: 2.5e-5,
        };
        let left = Backlash.deflection(&[gap_m], between, &corner);
        let left = left.expect("play changes the deflection");
        (left.x_m, left.v_m_per_s)
    }

    #[test]
    fn nothing_is_left_within_the_gap_and_all_but_the_gap_beyond() {
        for (gap_m, x_m, expected) in [
            (0.001, 0.003, (0.002, 0.1)),
            (0.001, -0.003, (-0.002, 0.1)),
            (0.001, 0.0002, (0.0, 0.0)),
            (0.0, 0.003, (0.003, 0.1)),
        ] {
            let found = left(gap_m, x_m);
            assert!((found.0 - expected.0).abs() < 1e-8, "{found:?}");
            assert!((found.1 - expected.1).abs() < 1e-6, "{found:?}");
        }
    }

    /// The damper sets in with a jump of c v (10 N at the first contact) in the middle of a step. What Runge and Kutta's
    /// weights make of it is up to a third of the step off, h c v l / 3 I = 2e-4 rad/s, as is ω from then on.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::Backlash, 5e-5);
    }
}
