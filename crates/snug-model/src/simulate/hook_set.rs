//! Which effects act where, sorted once per simulation.

use crate::assembly::layout::Part;
use crate::effects::Effect;
use crate::law::{AnsweredHooks, hooks};
use crate::numeric::lanewise::{Lanewise, Task};
use crate::numeric::number::Number;
use std::ops::Range;

/// One effect with what is its own.
#[derive(Debug)]
pub struct HookedEffect<'a, N> {
    law: Effect,
    p: &'a [N],
    states: Range<usize>,
}

/// Declares the set of effects for each hook that is asked at every stage.
macro_rules! declare_hook_set {
    (asked_at_every_stage { $($(#[$doc:meta])* fn $hook:ident $arguments:tt -> $Answer:ty;)+ } $($asked_less:tt)+) => {
        /// The effects of one simulation, each hook that is asked at every stage with those that answer it.
        ///
        /// Most effects answer one of these hooks; to ask the others, and to hear nothing, would cost as much as the physics.
        pub struct HookSet<'a, N> {
            $(pub $hook: Vec<HookedEffect<'a, N>>,)+
        }

        impl<'a, N: Number> HookSet<'a, N> {
            /// The effects `parts`, with what is theirs of all parameters `p`.
            pub fn new(parts: &[Part], p: &'a [N]) -> Self {
                Self {
                    $($hook: HookedEffect::of(parts, p, |answered| answered.$hook),)+
                }
            }
        }
    };
}
hooks!(declare_hook_set);

impl<'a, N: Number> HookSet<'a, N> {
    /// The same for a motion that is simulated: what holds as dry friction is no force of its own.
    pub fn with_dry_friction(parts: &[Part], p: &'a [N]) -> Self {
        Self {
            force: HookedEffect::of(parts, p, |answered| {
                answered.force && !answered.dry_friction_n
            }),
            ..Self::new(parts, p)
        }
    }
}

impl<'a, N: Number> HookedEffect<'a, N> {
    /// Those of the effects `parts` that answer what is asked.
    fn of(parts: &[Part], p: &'a [N], answers: fn(&AnsweredHooks) -> bool) -> Vec<Self> {
        let answering = parts.iter().filter(|part| answers(&part.answered));
        answering
            .map(|part| Self {
                law: part.effect,
                p: &p[part.parameters.clone()],
                states: part.states.clone(),
            })
            .collect()
    }

    /// Has `ask` ask the law, with its own parameters and the places of its states among those of all.
    ///
    /// Numbers side by side that carry derivatives ask out of line: in line, what every law of the catalogue needs is worked
    /// out before it is known which law is asked, and they, which do not fit into the registers anyway, would pay most for it.
    #[inline(always)]
    pub fn ask(&self, ask: impl FnOnce(Effect, &[N], Range<usize>)) {
        let is_plain = size_of::<N>() == size_of::<N::Real>();
        if N::Real::LANES == 1 || is_plain {
            ask(self.law, self.p, self.states.clone());
        } else {
            out_of_line(Ask(self, ask));
        }
    }
}

struct Ask<'a, 'p, N, F>(&'a HookedEffect<'p, N>, F);

impl<N: Number, F: FnOnce(Effect, &[N], Range<usize>)> Task for Ask<'_, '_, N, F> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        (self.1)(self.0.law, self.0.p, self.0.states.clone());
    }
}

#[inline(never)]
fn out_of_line<N: Number>(ask: Ask<'_, '_, N, impl FnOnce(Effect, &[N], Range<usize>)>) {
    ask.0.p[0].value().vectorize(ask);
}
