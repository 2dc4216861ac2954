use crate::Number;
use crate::effect::Kinematics;

/// Repeats on the simulated displacement what preprocessing did to the measured one: its value at one sample is taken off
/// the whole signal.
///
/// ```text
/// y(t) = sensed(t) − (sensed(t0) − true(t0))
/// ```
///
/// Only what the sensors add is zeroed there, so that a model without sensor effects stays as it is. Samples before t0
/// wait until it is known.
#[derive(Debug)]
pub struct Zeroed<N> {
    zero_at: usize,
    /// What the sensors add at t0 \[rad\], once known.
    added: Option<N>,
    waiting: Vec<Kinematics<N>>,
}

impl<N: Number> Zeroed<N> {
    /// Zeroed at sample `zero_at`.
    pub fn new(zero_at: usize) -> Self {
        Self {
            zero_at,
            added: None,
            waiting: Vec::with_capacity(zero_at + 1),
        }
    }

    /// The next sample, which is number `index`: true displacement \[rad\] and sensed motion; hands on what can be.
    pub fn sample(
        &mut self,
        index: usize,
        true_rad: N,
        sensed: Kinematics<N>,
        mut hand_on: impl FnMut(usize, &Kinematics<N>),
    ) {
        let without = |seen: Kinematics<N>, added: N| Kinematics {
            displacement_rad: seen.displacement_rad - added,
            ..seen
        };
        if let Some(added) = self.added {
            return hand_on(index, &without(sensed, added));
        }
        self.waiting.push(sensed);
        if index == self.zero_at {
            let added = sensed.displacement_rad - true_rad;
            for (earlier, seen) in self.waiting.drain(..).enumerate() {
                hand_on(earlier, &without(seen, added));
            }
            self.added = Some(added);
        }
    }
}
