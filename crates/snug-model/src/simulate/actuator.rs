//! A drive that follows its command through a first-order lag, no faster than it can, and what it gives within every step.

use crate::numeric::lanewise::Lanewise;
use crate::numeric::number::Number;
use crate::simulate::first_order::left_after;

/// What a drive gives within a step of the integration \[Nm\]: as the step begins, at its middle and as it ends.
pub type Within<N> = [N; 3];

/// A drive that gives q of the torque u that it is told: τ q' + q = u.
///
/// Over a step of length h from q, in which u goes straight from u to u + r, it is exactly
///
/// ```text
/// q(s) = u + r s/h − w + (q − u + w) exp(−s/τ)          w = r τ/h
/// ```
///
/// The value as the step begins is the one with which Simpson's rule, and so a Runge–Kutta step, has the exact impulse of the step: q
/// itself where τ is many steps, and u, as without a lag, as τ → 0.
///
/// One that changes by no more than R a second goes from q no further than R s by the time s.
#[derive(Debug)]
pub struct Actuator<N> {
    /// τ/h.
    ratio: N,
    /// What is left of a deviation by each of [`Within`].
    left: Within<N>,
    /// R h, if there is such a limit.
    most: Option<N>,
}

impl<N: Number> Actuator<N> {
    /// Time constant \[s\] and length of a step \[s\].
    pub fn new(tau_s: N, step_s: N::Real) -> Self {
        let one = step_s.constant(1.0);
        let ratio = tau_s.times(one / step_s);
        let (half, whole) = (left_after(0.5, ratio), left_after(1.0, ratio));
        let mean = ratio * (-whole + 1.0);
        Self {
            ratio,
            left: [mean * 6.0 - half * 4.0 - whole, half, whole],
            most: None,
        }
    }

    /// The same, what it gives changing by no more than `rate` \[Nm/s\]; a step is as long as in [`Actuator::new`] \[s\].
    pub fn no_faster_than(self, rate: N, step_s: N::Real) -> Self {
        Self {
            most: Some(rate.times(step_s)),
            ..self
        }
    }

    /// What it gives of a command of `told` that rises by `rise` within the step; `before` is what it gave up to there.
    #[inline(always)]
    pub fn within(&self, before: N, told: N, rise: N) -> Within<N> {
        let behind = rise * self.ratio;
        let follows = told - behind;
        let deviation = before - follows;
        let given = [
            follows + deviation * self.left[0],
            follows + rise * 0.5 + deviation * self.left[1],
            follows + rise + deviation * self.left[2],
        ];
        match self.most {
            Some(most) => no_further(before, given, most),
            None => given,
        }
    }
}

/// From `before` to where it would end as `given`, no further than `most` within the step.
///
/// Where it would jump to d from there, it takes z = d/(R h) of the step. The value as the step begins has again the step's exact impulse,
/// d − z d/2, of the jump as far as there is one: it is d (1 − 3 z) where it arrives in the first half, d (5 − 3 z − 2/z) in the second, and
/// nothing where it does not arrive.
#[inline(always)]
fn no_further<N: Number>(before: N, given: Within<N>, most: N) -> Within<N> {
    let [begins, middle, ends] = [given[0] - before, given[1] - before, given[2] - before];
    let taken = ends.abs() / most;
    let (early, late) = (
        taken * -3.0 + 1.0,
        taken * -3.0 + 5.0 - taken.constant(2.0) / taken,
    );
    let is_late = taken.value().is_above(taken.value().constant(0.5));
    let never = taken.value().is_above(taken.value().constant(1.0));
    let share = N::select(is_late, late, early);
    let share = N::select(never, taken.constant(0.0), share);
    [
        before + begins * share,
        before + middle.no_further_than(most * 0.5),
        before + ends.no_further_than(most),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Impulse of a step by Simpson's rule.
    fn impulse([begins, middle, ends]: Within<f64>) -> f64 {
        (begins + 4.0 * middle + ends) / 6.0
    }

    #[test]
    fn without_a_lag_it_gives_what_it_is_told() {
        let given = Actuator::new(0.0, 1e-3).within(-4.0, 2.0, 1.0);
        assert_eq!(given, [2.0, 2.5, 3.0]);
    }

    /// From 3 towards 1: 1 + 2 exp(−t/τ), of which the mean over h is 1 + 2 τ/h (1 − exp(−h/τ)).
    #[test]
    fn a_held_command_is_approached_exponentially_with_its_exact_impulse() {
        let h = 1e-3;
        for tau_s in [1e-4, 1e-3, 2e-2] {
            let given = Actuator::new(tau_s, h).within(3.0, 1.0, 0.0);
            let after = |t: f64| 1.0 + 2.0 * (-t / tau_s).exp();
            assert!((given[1] - after(0.5 * h)).abs() < 1e-12, "{given:?}");
            assert!((given[2] - after(h)).abs() < 1e-12, "{given:?}");
            let mean = 1.0 + 2.0 * tau_s / h * (1.0 - (-h / tau_s).exp());
            assert!((impulse(given) - mean).abs() < 1e-12, "{given:?}");
        }
        let slow = Actuator::new(2e-2, h).within(3.0, 1.0, 0.0);
        assert!((slow[0] - 3.0).abs() < 1e-6, "{slow:?}");
    }

    /// A ramp that has gone on for long is followed τ behind.
    #[test]
    fn a_ramp_is_followed_a_time_constant_behind() {
        let (tau_s, h) = (5e-3, 1e-3);
        let behind = |t: f64| 7.0 * (t - tau_s);
        let given = Actuator::new(tau_s, h).within(behind(0.0), 0.0, 7.0 * h);
        for (found, t) in given.into_iter().zip([0.0, 0.5 * h, h]) {
            assert!((found - behind(t)).abs() < 1e-12, "{given:?}");
        }
    }
}
