use crate::Number;
use crate::effect::Kinematics;

/// Repeats on the simulated displacement what preprocessing did to the measured one: its value at one sample is taken off
/// the whole signal.
///
/// ```text
/// y(t) = sensed(t) − sensed(t0)
/// ```
///
/// Only a model with sensor effects is asked for this: the original program, whose model has none, compares its own
/// displacement as it is. A bias can put t0, the first minimum, well into the pulse. Samples before t0 wait until it is
/// known.
#[derive(Debug)]
pub struct Zeroed<N> {
    zero_at: usize,
    /// The displacement at t0 \[rad\], once known.
    zero: Option<N>,
    waiting: Vec<Kinematics<N>>,
}

impl<N: Number> Zeroed<N> {
    /// Zeroed at sample `zero_at`.
    pub fn new(zero_at: usize) -> Self {
        Self {
            zero_at,
            zero: None,
            waiting: Vec::with_capacity(zero_at + 1),
        }
    }

    /// The next sample, which is number `index`; hands on what can be.
    pub fn sample(
        &mut self,
        index: usize,
        sensed: Kinematics<N>,
        mut hand_on: impl FnMut(usize, &Kinematics<N>),
    ) {
        let without = |seen: Kinematics<N>, zero: N| Kinematics {
            displacement_rad: seen.displacement_rad - zero,
            ..seen
        };
        if let Some(zero) = self.zero {
            return hand_on(index, &without(sensed, zero));
        }
        self.waiting.push(sensed);
        if index == self.zero_at {
            let zero = sensed.displacement_rad;
            for (earlier, seen) in self.waiting.drain(..).enumerate() {
                hand_on(earlier, &without(seen, zero));
            }
            self.zero = Some(zero);
        }
    }
}
