//! The motion so far, at any time between grid points, with the derivative to the delay: for laws that look back.

use crate::numeric::lanewise::Lanewise;
use crate::numeric::number::Number;

/// The displacement as it was, noted at every grid point: what a delayed law looks back on.
///
/// Cubic Hermite between grid points; before the first and after the last, at rest where it was then.
#[derive(Debug)]
pub struct History<N: Number> {
    interval_s: N::Real,
    /// x \[m\] and v \[m/s\] times the interval \[m\].
    noted: Vec<[N; 2]>,
}

impl<N: Number> History<N> {
    /// Nothing noted yet; `notes` will be, `interval_s` apart.
    pub fn new(interval_s: N::Real, notes: usize) -> Self {
        Self {
            interval_s,
            noted: Vec::with_capacity(notes),
        }
    }

    /// Notes displacement and velocity at the next grid point.
    #[inline(always)]
    pub fn note(&mut self, x_m: N, v_m_per_s: N) {
        self.noted.push([x_m, v_m_per_s.times(self.interval_s)]);
    }

    /// x \[m\] at `time_s` − `delay_s`.
    #[inline(always)]
    pub fn x_m(&self, time_s: N::Real, delay_s: N) -> N {
        let zero = time_s.constant(0.0);
        let Some(last) = self.noted.len().checked_sub(1) else {
            return N::from(zero);
        };
        let position = (-delay_s)
            .times(zero.constant(1.0) / self.interval_s)
            .plus(time_s / self.interval_s);
        // Where the past is at rest, the position is known: its slope is cut off with it.
        let early = zero.is_above(position.value());
        let late = position.value().is_above(zero.constant(last as f64));
        let held = N::from(position.value().within(0.0, last as f64));
        let position = N::select(early, held, N::select(late, held, position));
        let whole = zero.lane_by_lane(
            #[inline(always)]
            |lane| {
                let position = position.value().lanes()[lane] as usize;
                position.min(last.saturating_sub(1)) as f64
            },
        );
        let [here, here_slope] = self.noted_at(whole, 0);
        let [next, next_slope] = self.noted_at(whole, 1.min(last));
        let u = position.plus(-whole);
        let rest = -u + 1.0;
        let (u2, rest2) = (u * u, rest * rest);
        here * (rest2 * (u * 2.0 + 1.0))
            + next * (u2 * (rest * 2.0 + 1.0))
            + here_slope * (u * rest2)
            + -(next_slope * (u2 * rest))
    }

    /// The note `further` after number `whole`, which may differ from lane to lane.
    #[inline(always)]
    fn noted_at(&self, whole: N::Real, further: usize) -> [N; 2] {
        let lanes = whole.lanes();
        let first = lanes[0];
        let mut found = self.noted[first as usize + further];
        // As a rule all have the same delay and the same interval.
        if lanes.iter().any(|&other| other != first) {
            for (lane, &own) in lanes.iter().enumerate().skip(1) {
                let own = self.noted[own as usize + further];
                let here = whole.only(lane);
                found = [
                    N::select(here, own[0], found[0]),
                    N::select(here, own[1], found[1]),
                ];
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::dual::Dual;

    /// x(t) = 1 + 2t − 3t² + t³/2: found exactly, and ∂x(t − τ)/∂τ = −v(t − τ).
    #[test]
    fn a_cubic_is_looked_up_exactly_with_its_slope() {
        let x = |t: f64| 1.0 + 2.0 * t - 3.0 * t * t + 0.5 * t * t * t;
        let v = |t: f64| 2.0 - 6.0 * t + 1.5 * t * t;
        let mut history = History::<Dual<1>>::new(0.25, 9);
        for note in 0..9 {
            let t = f64::from(note) * 0.25;
            history.note(x(t).into(), v(t).into());
        }
        for then in [0.0, 0.1, 0.55, 1.3, 1.99] {
            let found = history.x_m(2.0, Dual::parameter(2.0 - then, 0));
            assert!((found.value - x(then)).abs() < 1e-13);
            assert!((found.partials[0] + v(then)).abs() < 1e-12);
        }
        assert_eq!(
            history.x_m(1.0, Dual::from(1.5)).value,
            x(0.0),
            "at rest before"
        );
    }
}
