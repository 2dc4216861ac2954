//! What dry friction makes of a step: it slows, stops, holds and lets go.

use crate::numeric::lanewise::Lanewise;
use crate::numeric::number::Number;

/// One step of v' = a − A sgn v, at rest as long as |a| ≤ A, with a the acceleration by all else and A by what dry friction holds with, both
/// constant over the step.
///
/// The motion is slowed until it stops, if it does within the step, and from then on rests or goes back. The mean of what friction does,
///
/// ```text
/// a − (v₁ − v₀)/h
/// ```
///
/// is what a step of any method takes as a constant. A rest is exact: nothing creeps, as it would where friction turns over a little speed.
#[derive(Debug, Clone, Copy)]
pub struct Slowed<N: Number> {
    /// By how much friction slows it over the step, on average \[m/s²\].
    pub mean_m_per_s2: N,
    /// How much further it goes than with that mean throughout \[m\].
    pub further_m: N,
    /// Velocity as the step ends \[m/s\].
    pub ends_m_per_s: N,
    /// 1 where it rests as the step ends, else 0.
    pub rests: N::Real,
    /// 1 where it rests all the step, else 0.
    pub stays: N::Real,
    /// 1 where it slides on and keeps half its speed at least, else 0.
    pub slides_on: N::Real,
}

impl<N: Number> Slowed<N> {
    /// `v_m_per_s` as the step of `h_s` begins, a `pushed_m_per_s2` and A `held_m_per_s2`, not negative.
    #[inline(always)]
    pub fn over(v_m_per_s: N, pushed_m_per_s2: N, held_m_per_s2: N, h_s: N::Real) -> Self {
        let zero = N::from(h_s.constant(0.0));
        let way = way(v_m_per_s, pushed_m_per_s2);
        let (speed, along) = (v_m_per_s.times(way), pushed_m_per_s2.times(way));
        let sliding = along - held_m_per_s2;
        let slid = speed + sliding.times(h_s);
        let slides = slid.value().is_positive();
        // It stops after −speed/sliding; where it slides on, that is not asked for.
        let slows = (-sliding.value()).is_positive();
        let stops_s = N::select(slows, -speed / sliding, zero);
        let left_s = (-stops_s).plus(h_s);
        let back = along + held_m_per_s2;
        let goes_back = (-back.value()).is_positive();
        let after_stop = N::select(goes_back, back * left_s, zero);
        let ends = N::select(slides, slid, after_stop);
        let further = (speed * left_s + after_stop * stops_s) * -0.5;
        let (yes, no) = (h_s.constant(1.0), h_s.constant(0.0));
        let keeps_half = slid.value() - speed.value() * h_s.constant(0.5);
        let moves = speed.value().is_positive();
        let slides_on = Lanewise::choose(keeps_half.is_positive(), yes, no);
        let rests = Lanewise::choose(slides, no, Lanewise::choose(goes_back, no, yes));
        let stays = Lanewise::choose(moves, no, rests);
        Self {
            mean_m_per_s2: (along - (ends - speed).times(h_s.constant(1.0) / h_s)).times(way),
            further_m: N::select(slides, zero, further).times(way),
            ends_m_per_s: ends.times(way),
            rests,
            stays,
            slides_on: Lanewise::choose(moves, slides_on, no),
        }
    }

    /// What is known of the step before it is made, from what accelerates it at first: all of it where it slides on, elsewhere nothing yet.
    #[inline(always)]
    pub fn foreseen(self) -> Self {
        let (slides_on, zero) = (
            self.slides_on.is_positive(),
            self.mean_m_per_s2.constant(0.0),
        );
        Self {
            mean_m_per_s2: N::select(slides_on, self.mean_m_per_s2, zero),
            ..self
        }
    }

    /// Whether it slides on in every lane, so that nothing is to be learned from a second turn.
    #[inline(always)]
    pub fn is_foreseen(&self) -> bool {
        self.slides_on.lanes().iter().all(|&one| one > 0.0)
    }

    /// Itself where it slides on, so that no lane depends on those beside it, else what is `learned`.
    #[inline(always)]
    pub fn or(self, learned: Self) -> Self {
        let foreseen = self.slides_on.is_positive();
        let zero = self.slides_on.constant(0.0);
        Self {
            mean_m_per_s2: N::select(foreseen, self.mean_m_per_s2, learned.mean_m_per_s2),
            further_m: N::select(foreseen, N::from(zero), learned.further_m),
            ends_m_per_s: N::select(foreseen, self.ends_m_per_s, learned.ends_m_per_s),
            rests: Lanewise::choose(foreseen, zero, learned.rests),
            stays: Lanewise::choose(foreseen, zero, learned.stays),
            slides_on: self.slides_on,
        }
    }

    /// Displacement and velocity in the end of a step from `x_m`, of which a method that took the mean has found `after`.
    #[inline(always)]
    pub fn ended(&self, x_m: N, after: (N, N)) -> (N, N) {
        let (x_after, v_after) = after;
        let zero = x_m.constant(0.0);
        (
            N::select(self.stays.is_positive(), x_m, x_after + self.further_m),
            N::select(self.rests.is_positive(), zero, v_after),
        )
    }
}

/// What accelerates it at one instant \[m/s²\], of `pushed_m_per_s2` by all else and `held_m_per_s2` by what dry friction holds with.
#[inline(always)]
pub fn at_once<N: Number>(v_m_per_s: N, pushed_m_per_s2: N, held_m_per_s2: N) -> N {
    let way = way(v_m_per_s, pushed_m_per_s2);
    let along = pushed_m_per_s2.times(way) - held_m_per_s2;
    let moves = v_m_per_s.value().magnitude().is_positive();
    let starts = along.value().is_positive();
    let from_rest = N::select(starts, along, along.constant(0.0));
    N::select(moves, along, from_rest).times(way)
}

/// Which way it goes, or would go from rest: −1 or 1, 0 where nothing pushes.
#[inline(always)]
fn way<N: Number>(v_m_per_s: N, pushed_m_per_s2: N) -> N::Real {
    let v = v_m_per_s.value();
    Lanewise::choose(
        v.magnitude().is_positive(),
        v.sign_of(),
        pushed_m_per_s2.value().sign_of(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const H: f64 = 0.1;

    /// Of 4 m/s² by friction: sliding on, to rest within the step, back after a stop, from rest, and at rest.
    #[test]
    fn a_step_is_the_exact_motion() {
        // v0, a, v1, way of that motion.
        for (v, a, ends, goes) in [
            (1.0, 3.0, 0.9, 0.095),
            (-1.0, -3.0, -0.9, -0.095),
            // It stops after 0.05 s: 0.5 · 0.2 · 0.05.
            (0.2, 0.0, 0.0, 0.005),
            // It stops after 0.02 s and goes back with −10 + 4.
            (
                0.28,
                -10.0,
                -6.0 * 0.08,
                0.5 * 0.28 * 0.02 - 0.5 * 6.0 * 0.0064,
            ),
            (0.0, 5.0, 0.1, 0.005),
            (0.0, -5.0, -0.1, -0.005),
            (0.0, 3.9, 0.0, 0.0),
            (0.0, 0.0, 0.0, 0.0),
        ] {
            let found = Slowed::over(v, a, 4.0, H);
            assert!(
                (found.ends_m_per_s - ends).abs() < 1e-12,
                "{v} {a} {found:?}"
            );
            let mean = a - found.mean_m_per_s2;
            assert!((v + mean * H - ends).abs() < 1e-12, "{v} {a} {found:?}");
            let went = v * H + 0.5 * mean * H * H + found.further_m;
            assert!((went - goes).abs() < 1e-12, "{v} {a} {went}");
            assert_eq!(found.rests > 0.0, ends == 0.0, "{v} {a}");
            assert_eq!(found.stays > 0.0, ends == 0.0 && v == 0.0, "{v} {a}");
            let slides_on = ends * v > 0.5 * v * v;
            assert_eq!(found.slides_on > 0.0, slides_on, "{v} {a}");
            assert_eq!(found.is_foreseen(), slides_on, "{v} {a}");
        }
    }

    #[test]
    fn at_one_instant_it_holds_as_far_as_it_is_pushed() {
        for (v, a, expected) in [
            (1.0, 3.0, -1.0),
            (-1.0, 3.0, 7.0),
            (0.0, 3.0, 0.0),
            (0.0, -6.0, -2.0),
            (0.0, 0.0, 0.0),
        ] {
            assert_eq!(at_once(v, a, 4.0), expected, "{v} {a}");
        }
    }
}
