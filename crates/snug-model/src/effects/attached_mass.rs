//! A mass of its own hangs on what is driven, by a spring and a damper: a load on a shaft or a belt, a pendulum under a crane, a liquid in a tank.
//!
//! ```text
//! F + m_a (ω² d + 2 ζ ω (v − v_a)),   d' = v − v_a,  v_a' = ω² d + 2 ζ ω (v − v_a),   ω = 2π f
//! ```
//!
//! d is by how much its spring is stretched, f and ζ frequency and damping ratio with which it swings where what is driven is held. F has the
//! sign of the base model; m_a = 0 is the base model. It moves along as the motion begins. Excited by motion near f. In the residual it rings
//! at f √(1 + m_a/m); at f itself what is driven hardly moves (antiresonance), to slower motion it is a mass m_a more.
//!
//! Valid for: one such mass, small swings, driven and measured at the same place; linear, any amplitude.
//!
//! Source: dynamic vibration absorber (Den Hartog, Mechanical Vibrations); two-inertia drive.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{ExcitedBy, Instant, Law, Resonance};
use crate::numeric::number::Number;
use crate::resonance::{DAMPING_RATIO, FREQUENCY};
use std::f64::consts::TAU;

state! {
    summary: "A second mass hangs on what is driven by a spring: a load behind a shaft or belt, or one that swings.",
    equation: "F + m_a (w^2 d + 2 zeta w (v - v_a)),  dd/dt = v - v_a,  dv_a/dt = w^2 d + 2 zeta w (v - v_a),  w = 2 pi f",
}

pub(super) struct AttachedMass;

impl Law for AttachedMass {
    fn description(&self) -> &'static Description {
        &Description {
            name: "attached_mass",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "attached_kg",
                    meaning: "mass that hangs on it",
                    unit: "kg",
                    starts: &[0.5],
                    minimum: 0.0,
                    maximum: 20.0,
                    limits: (0.0, 1e3),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "attached_hz",
                    meaning: "frequency with which that swings alone",
                    ..FREQUENCY
                },
                ParameterSpec {
                    name: "attached_zeta",
                    meaning: "damping ratio with which that swings",
                    ..DAMPING_RATIO
                },
            ],
            states: &["attached_stretch_m", "attached_m_per_s"],
            twins: &["second_mode", "second_mass"],
            excited_by: "motion with power near the frequency with which it swings: steps, sweeps, noise",
            shows_as: "a frequency at which what is driven hardly moves, and ringing above it",
            check: "Take the load off, or clamp it to what is driven, and repeat: the ringing goes and the mass is another.",
            on_machine: None,
            valid_for: "one mass on a spring and a damper, driven and measured at the same place; small swings of a pendulum, else any amplitude",
            source: "Den Hartog 1956, Mechanical Vibrations, McGraw-Hill",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, own: &[N]) -> Option<N> {
        Some(p[0] * pull_m_per_s2(p, at, own))
    }

    #[inline(always)]
    fn rates<N: Number>(
        &self,
        p: &[N],
        at: &Instant<N>,
        own: &[N],
        _hand_n: N,
        rates: &mut [N],
    ) -> Option<()> {
        rates[0] = at.v_m_per_s - own[1];
        rates[1] = pull_m_per_s2(p, at, own);
        Some(())
    }

    #[inline(always)]
    fn begins<N: Number>(&self, _p: &[N], at: &Instant<N>, begun: &mut [N]) -> Option<()> {
        begun[1] = at.v_m_per_s;
        Some(())
    }

    fn resonance(&self) -> Option<Resonance> {
        Some(Resonance {
            size: 0,
            frequency: 1,
            damping: 2,
            excited_by: ExcitedBy::Motion,
        })
    }
}

/// What pulls the mass along, per kilogram of it: ω² d + 2 ζ ω (v − v_a).
#[inline(always)]
fn pull_m_per_s2<N: Number>(p: &[N], at: &Instant<N>, own: &[N]) -> N {
    let omega = p[1] * TAU;
    omega * (omega * own[0] + p[2] * (at.v_m_per_s - own[1]) * 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn spring_and_damper_pull_it_along_and_hold_what_is_driven_back() {
        let (p, own) = ([1.5, 4.0, 0.1], [1e-3, 0.2]);
        let (at, omega) = (trial::at(0.0, 0.7), TAU * 4.0);
        let pull = omega * omega * 1e-3 + 2.0 * 0.1 * omega * 0.5;
        let mut rates = [0.0; 2];
        AttachedMass.rates(&p, &at, &own, 5.0, &mut rates);
        trial::assert_near(rates[0], 0.5);
        trial::assert_near(rates[1], pull);
        let force = AttachedMass.force(&p, &at, &own).expect("it acts");
        trial::assert_near(force, 1.5 * pull);
    }

    #[test]
    fn it_moves_along_as_the_motion_begins() {
        let mut own = [0.0; 2];
        AttachedMass.begins(&[1.5, 4.0, 0.1], &trial::at(0.2, 0.7), &mut own);
        assert_eq!(own, [0.0, 0.7]);
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::AttachedMass, 1e-8);
    }
}
