use crate::assembly::Part;
use crate::effect::{Instant, Law, LoggedTorque};
use crate::{Input, Number};

/// The torque that acts on the joint, from the one that is logged.
#[derive(Debug)]
pub struct ActingTorque<'a, N> {
    input: &'a Input,
    /// Absent when the one that is logged acts.
    logged: Option<LoggedTorque<N>>,
}

impl<'a, N: Number> ActingTorque<'a, N> {
    /// What the effects `parts` say about how it is logged, summed; `p` are all parameters.
    pub fn new(parts: &[Part], p: &[N], input: &'a Input) -> Self {
        Self {
            input,
            logged: parts
                .iter()
                .filter_map(|part| part.effect.logged_torque(&p[part.parameters.clone()]))
                .reduce(|sum, more| LoggedTorque {
                    delay_s: sum.delay_s + more.delay_s,
                    lag_s: sum.lag_s + more.lag_s,
                    offset_nm: sum.offset_nm + more.offset_nm,
                }),
        }
    }

    /// Torque at grid point number `point` of the input \[Nm\].
    #[inline(always)]
    pub fn at(&self, point: usize) -> N {
        let Some(logged) = &self.logged else {
            return N::from(self.input.grid()[point]);
        };
        let then_s = point as f64 * self.input.grid_interval_s() - logged.delay_s.value();
        let (torque, slope) = self.input.at(then_s);
        let (rate, change) = self.input.slope_at(then_s);
        logged.delay_s.chain(torque, -slope) + logged.lag_s * logged.delay_s.chain(rate, -change)
            - logged.offset_nm
    }
}

/// The instant with what the effects `parts` add to the torque at it, each on top of the same torque.
pub fn with_added_torque<N: Number>(parts: &[Part], p: &[N], at: Instant<N>) -> Instant<N> {
    let added = parts
        .iter()
        .filter_map(|part| part.effect.torque(&p[part.parameters.clone()], &at))
        .reduce(|sum, more| sum + more);
    Instant {
        torque_nm: added.map_or(at.torque_nm, |added| at.torque_nm + added),
        ..at
    }
}
