//! What a simulation asks of effects at every stage of every step.

use crate::effect::{Deflection, Instant, Law};
use crate::effects::Effect;

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

pub(crate) const HOOKS: [Hook; 7] = [
    Hook::Torque,
    Hook::Support,
    Hook::Deflection,
    Hook::Stiffening,
    Hook::Force,
    Hook::Limit,
    Hook::Moving,
];

/// The hooks that one effect answers.
#[derive(Debug, Clone, Copy)]
pub struct AnsweredHooks([bool; HOOKS.len()]);

impl AnsweredHooks {
    /// Asks once at rest: whether a law answers a hook depends on the law alone.
    pub fn of(law: Effect) -> Self {
        let description = law.description();
        let p: Vec<f64> = (description.parameters.iter())
            .map(|spec| spec.starts[0])
            .collect();
        let own = &vec![0.0; description.states.len()][..];
        let at = Instant {
            torque_nm: 0.0,
            x_m: 0.0,
            v_m_per_s: 0.0,
            since_onset_s: 0.0,
            lever_arm_m: 1.0,
        };
        let still = Deflection {
            x_m: 0.0,
            v_m_per_s: 0.0,
        };
        Self(HOOKS.map(|hook| match hook {
            Hook::Torque => law.torque(&p, &at).is_some(),
            Hook::Support => law.support(&p, own).is_some(),
            Hook::Deflection => law.deflection(&p, still).is_some(),
            Hook::Stiffening => law.stiffening(&p, &at).is_some(),
            Hook::Force => law.force(&p, &at, own).is_some(),
            Hook::Limit => law.limit(&p, 0.0).is_some(),
            Hook::Moving => !own.is_empty(),
        }))
    }

    /// Whether the effect answers `hook`.
    pub fn to(&self, hook: Hook) -> bool {
        self.0[hook as usize]
    }
}

impl Effect {
    /// Whether it lets the grip come and go, as play does: the hand's spring and damper act only on what is left of the
    /// deflection, and the acceleration jumps where contact begins and ends.
    pub fn has_unilateral_contact(self) -> bool {
        AnsweredHooks::of(self).to(Hook::Deflection)
    }
}
