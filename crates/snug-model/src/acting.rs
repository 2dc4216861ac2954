//! Which effects act where, sorted once per simulation.

use crate::assembly::{MAXIMUM_STATES, Part};
use crate::effect::{Deflection, Instant, Law};
use crate::{Effect, Number};
use std::ops::Range;

/// One effect with what is its own.
#[derive(Debug)]
pub struct Actor<'a, N> {
    pub law: Effect,
    pub p: &'a [N],
    states: Range<usize>,
}

/// The hooks of [`Law`] that are asked at every stage of every step.
#[derive(Debug, Clone, Copy)]
pub enum Hook {
    Torque,
    Support,
    Deflection,
    Stiffening,
    Force,
    Limit,
    /// Rates, of effects with states.
    Moving,
}

const HOOKS: [Hook; 7] = [
    Hook::Torque,
    Hook::Support,
    Hook::Deflection,
    Hook::Stiffening,
    Hook::Force,
    Hook::Limit,
    Hook::Moving,
];

/// The effects of one simulation, each hook with those that answer it.
///
/// Most effects answer one hook of seven; to ask the others, and to hear nothing, would cost as much as the physics.
pub struct Acting<'a, N>([Vec<Actor<'a, N>>; HOOKS.len()]);

impl<'a, N: Number> Acting<'a, N> {
    /// The effects `parts`, with what is theirs of all parameters `p`.
    pub fn new(parts: &[Part], p: &'a [N]) -> Self {
        Self(HOOKS.map(|hook| {
            let all = parts.iter().map(|part| Actor {
                law: part.effect,
                p: &p[part.parameters.clone()],
                states: part.states.clone(),
            });
            all.filter(|actor| actor.answers(hook)).collect()
        }))
    }

    /// Those that answer `hook`.
    #[inline(always)]
    pub fn on(&self, hook: Hook) -> &[Actor<'a, N>] {
        &self.0[hook as usize]
    }
}

impl<N: Number> Actor<'_, N> {
    /// Its own states of all.
    ///
    /// A motion without states of effects is never looked up by number, so that it can stay in registers.
    #[inline(always)]
    pub fn own<'s, const S: usize>(&self, states: &'s [N; S]) -> &'s [N] {
        if S > 2 {
            &states[self.states.clone()]
        } else {
            &[]
        }
    }

    /// Its own states' rates of all.
    #[inline(always)]
    pub fn own_mut<'s>(&self, rates: &'s mut [N]) -> &'s mut [N] {
        &mut rates[self.states.clone()]
    }

    /// Asks once at rest: whether a law answers a hook never depends on the state.
    fn answers(&self, hook: Hook) -> bool {
        let zero = N::from(0.0);
        let states = [zero; MAXIMUM_STATES];
        let (law, p, own) = (self.law, self.p, self.own(&states));
        let at = Instant {
            torque_nm: zero,
            x_m: zero,
            v_m_per_s: zero,
            since_onset_s: 0.0,
            lever_arm_m: 1.0,
        };
        let still = Deflection {
            x_m: zero,
            v_m_per_s: zero,
        };
        match hook {
            Hook::Torque => law.torque(p, &at).is_some(),
            Hook::Support => law.support(p, own).is_some(),
            Hook::Deflection => law.deflection(p, still).is_some(),
            Hook::Stiffening => law.stiffening(p, &at).is_some(),
            Hook::Force => law.force(p, &at, own).is_some(),
            Hook::Limit => law.limit(p, zero).is_some(),
            Hook::Moving => !own.is_empty(),
        }
    }
}
