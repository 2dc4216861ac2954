//! Counts a simulated displacement from where preprocessing took the zero of the measured one.

use crate::assembly::inputs::SimulationInputs;
use crate::law::Kinematics;
use crate::numeric::lanewise::Lanewise;
use crate::numeric::number::Number;

/// Repeats on the simulated displacement what preprocessing did to the measured one: its value at one sample is taken off
/// the whole signal.
///
/// ```text
/// y(t) = sensed(t) − sensed(t0)
/// ```
///
/// Only a model with sensor effects is asked for this: the original program, whose model has none, compares its own
/// displacement as it is. A bias can put t0, the first minimum, well into the pulse. Samples before t0 wait until it is
/// known, in every lane.
#[derive(Debug)]
pub struct Zeroed<N: Number> {
    /// t0 of every lane, as a number of samples; −1 where nothing is taken off.
    zero_at: N::Real,
    /// The last of them.
    known_from: usize,
    /// The displacement at t0 \[rad\], as far as it is known.
    zero: N,
    waiting: Vec<Kinematics<N>>,
}

impl<N: Number> Zeroed<N> {
    /// Zeroed where the inputs say; nothing where none of them says.
    pub fn new(inputs: &SimulationInputs<'_, N::Real>) -> Option<Self> {
        let zero_at = |lane: usize| inputs.of_lanes()[lane].zero_at();
        let known_from = (0..inputs.of_lanes().len()).filter_map(zero_at).max()?;
        Some(Self {
            zero_at: inputs
                .zero
                .lane_by_lane(|lane| zero_at(lane).map_or(-1.0, |sample| sample as f64)),
            known_from,
            zero: N::from(inputs.zero),
            waiting: Vec::with_capacity(known_from + 1),
        })
    }

    /// The next sample, which is number `index`; hands on what can be.
    #[inline(always)]
    pub fn sample(
        &mut self,
        index: usize,
        sensed: Kinematics<N>,
        hand_on: &mut impl FnMut(usize, &Kinematics<N>),
    ) {
        if index <= self.known_from {
            let zero_at = self.zero_at;
            let away = (zero_at - index as f64).magnitude();
            let is_there = zero_at.constant(0.5).is_above(away);
            self.zero = N::select(is_there, sensed.displacement_rad, self.zero);
            self.waiting.push(sensed);
        }
        if index > self.known_from {
            hand_on(index, &sensed.less(self.zero));
        } else if index == self.known_from {
            for (earlier, seen) in self.waiting.drain(..).enumerate() {
                hand_on(earlier, &seen.less(self.zero));
            }
        }
    }
}

impl<N: Number> Kinematics<N> {
    /// The same with the displacement counted from `zero` \[rad\].
    #[inline(always)]
    fn less(self, zero: N) -> Self {
        Self {
            displacement_rad: self.displacement_rad - zero,
            ..self
        }
    }
}
