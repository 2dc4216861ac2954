//! Which effects act where, sorted once per simulation.

use crate::assembly::layout::Part;
use crate::effect::{Deflection, Instant, Law};
use crate::effects::Effect;
use crate::hooks::{HOOKS, Hook};
use crate::numeric::number::Number;
use crate::numeric::real::{Real, Task};
use std::ops::Range;

/// One effect with what is its own.
#[derive(Debug)]
pub struct HookedEffect<'a, N> {
    law: Effect,
    p: &'a [N],
    states: Range<usize>,
}

/// The effects of one simulation, each hook with those that answer it.
///
/// Most effects answer one hook of seven; to ask the others, and to hear nothing, would cost as much as the physics.
pub struct HookSet<'a, N>([Vec<HookedEffect<'a, N>>; HOOKS.len()]);

impl<'a, N: Number> HookSet<'a, N> {
    /// The effects `parts`, with what is theirs of all parameters `p`.
    pub fn new(parts: &[Part], p: &'a [N]) -> Self {
        Self(HOOKS.map(|hook| {
            let answering = parts
                .iter()
                .filter(|part| part.answered.to(hook))
                .map(|part| HookedEffect {
                    law: part.effect,
                    p: &p[part.parameters.clone()],
                    states: part.states.clone(),
                });
            answering.collect()
        }))
    }

    /// Those that answer `hook`.
    #[inline(always)]
    pub fn on(&self, hook: Hook) -> &[HookedEffect<'a, N>] {
        &self.0[hook as usize]
    }
}

/// Each asks the law for one thing.
impl<N: Number> HookedEffect<'_, N> {
    #[inline(always)]
    pub fn add_torque(&self, at: &Instant<N>, torque_nm: &mut N) {
        self.ask(
            #[inline(always)]
            |law, p| {
                if let Some(more) = law.torque(p, at) {
                    *torque_nm += more;
                }
            },
        );
    }

    #[inline(always)]
    pub fn subtract_support(&self, own: &[N], seen: &mut Deflection<N>) {
        self.ask(
            #[inline(always)]
            |law, p| {
                if let Some(support) = law.support(p, &own[self.states.clone()]) {
                    seen.x_m = seen.x_m - support.x_m;
                    seen.v_m_per_s = seen.v_m_per_s - support.v_m_per_s;
                }
            },
        );
    }

    #[inline(always)]
    pub fn deflect(&self, seen: &mut Deflection<N>) {
        self.ask(
            #[inline(always)]
            |law, p| {
                if let Some(left) = law.deflection(p, *seen) {
                    *seen = left;
                }
            },
        );
    }

    #[inline(always)]
    pub fn add_stiffening(&self, at: &Instant<N>, x_m: N, stretched_m: &mut N) {
        self.ask(
            #[inline(always)]
            |law, p| {
                if let Some(growth) = law.stiffening(p, at) {
                    *stretched_m += growth * x_m;
                }
            },
        );
    }

    #[inline(always)]
    pub fn add_force(&self, at: &Instant<N>, own: &[N], force_n: &mut N) {
        self.ask(
            #[inline(always)]
            |law, p| {
                if let Some(more) = law.force(p, at, &own[self.states.clone()]) {
                    *force_n += more;
                }
            },
        );
    }

    #[inline(always)]
    pub fn limit(&self, force_n: &mut N) {
        self.ask(
            #[inline(always)]
            |law, p| {
                if let Some(passed_on) = law.limit(p, *force_n) {
                    *force_n = passed_on;
                }
            },
        );
    }

    #[inline(always)]
    pub fn set_rates(&self, at: &Instant<N>, own: &[N], hand_n: N, rates: &mut [N]) {
        self.ask(
            #[inline(always)]
            |law, p| {
                let states = self.states.clone();
                law.rates(p, at, &own[states.clone()], hand_n, &mut rates[states]);
            },
        );
    }

    /// Numbers side by side that carry derivatives ask out of line: in line, what every law of the catalogue needs is worked
    /// out before it is known which law is asked, and they, which do not fit into the registers anyway, would pay most for it.
    #[inline(always)]
    fn ask(&self, hook: impl FnOnce(Effect, &[N])) {
        let is_plain = size_of::<N>() == size_of::<N::Real>();
        if N::Real::LANES == 1 || is_plain {
            hook(self.law, self.p);
        } else {
            out_of_line(Ask(self, hook));
        }
    }
}

struct Ask<'a, 'p, N, F>(&'a HookedEffect<'p, N>, F);

impl<N: Number, F: FnOnce(Effect, &[N])> Task for Ask<'_, '_, N, F> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        (self.1)(self.0.law, self.0.p);
    }
}

#[inline(never)]
fn out_of_line<N: Number>(ask: Ask<'_, '_, N, impl FnOnce(Effect, &[N])>) {
    ask.0.p[0].value().vectorize(ask);
}
