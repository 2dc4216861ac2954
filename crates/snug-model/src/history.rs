use crate::Number;

/// The displacement as it was, noted at every grid point: what a delayed law looks back on.
///
/// Cubic Hermite between grid points; before the first, at rest at the first displacement.
#[derive(Debug)]
pub struct History<N> {
    interval_s: f64,
    /// x \[m\] and v \[m/s\] times the interval \[m\].
    noted: Vec<[N; 2]>,
}

impl<N: Number> History<N> {
    /// Nothing noted yet; notes will be `interval_s` apart.
    pub fn new(interval_s: f64) -> Self {
        Self {
            interval_s,
            noted: Vec::new(),
        }
    }

    /// Notes displacement and velocity at the next grid point.
    pub fn note(&mut self, x_m: N, v_m_per_s: N) {
        self.noted.push([x_m, v_m_per_s * self.interval_s]);
    }

    /// x \[m\] at `time_s` − `delay_s`; the last note where that is later.
    pub fn x_m(&self, time_s: f64, delay_s: N) -> N {
        let position = -delay_s * (1.0 / self.interval_s) + time_s / self.interval_s;
        let whole = position.value().max(0.0) as usize;
        let Some(&[here, here_slope]) = self.noted.get(whole) else {
            return self.noted.last().map_or(N::from(0.0), |&[x, _]| x);
        };
        let (Some(&[next, next_slope]), true) =
            (self.noted.get(whole + 1), position.value() >= 0.0)
        else {
            return here;
        };
        let u = position - whole as f64;
        let rest = -u + 1.0;
        let (u2, rest2) = (u * u, rest * rest);
        here * (rest2 * (u * 2.0 + 1.0))
            + next * (u2 * (rest * 2.0 + 1.0))
            + here_slope * (u * rest2)
            + -(next_slope * (u2 * rest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dual;

    /// x(t) = 1 + 2t − 3t² + t³/2: found exactly, and ∂x(t − τ)/∂τ = −v(t − τ).
    #[test]
    fn a_cubic_is_looked_up_exactly_with_its_slope() {
        let x = |t: f64| 1.0 + 2.0 * t - 3.0 * t * t + 0.5 * t * t * t;
        let v = |t: f64| 2.0 - 6.0 * t + 1.5 * t * t;
        let mut history = History::<Dual<1>>::new(0.25);
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
