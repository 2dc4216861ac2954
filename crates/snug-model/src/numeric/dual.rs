//! Numbers that carry partial derivatives: every law gets its sensitivities from them.

use crate::numeric::number::{Number, OfOne, Real};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// A value with its partial derivatives with respect to `P` parameters (forward differentiation, exact to rounding).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<const P: usize, R = f64> {
    /// f.
    pub value: R,
    /// ∂f/∂p_j.
    pub partials: [R; P],
}

impl<const P: usize, R: Real> Dual<P, R> {
    /// The parameter number `index` itself, at `value`.
    pub fn parameter(value: R, index: usize) -> Self {
        let mut dual = Self::from(value);
        dual.partials[index] = value.constant(1.0);
        dual
    }

    /// Each partial derivative by itself.
    #[inline(always)]
    fn with(value: R, mut partial: impl FnMut(usize) -> R) -> Self {
        // A loop, not `array::from_fn`: only what is inlined into the vector code uses its registers.
        let (mut partials, mut j) = ([value; P], 0);
        while j < P {
            partials[j] = partial(j);
            j += 1;
        }
        Self { value, partials }
    }
}

impl<const P: usize, R: Real> From<R> for Dual<P, R> {
    #[inline(always)]
    fn from(value: R) -> Self {
        Self {
            value,
            partials: [value.constant(0.0); P],
        }
    }
}

impl<const P: usize, R: Real> Add for Dual<P, R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::with(
            self.value + other.value,
            #[inline(always)]
            |j| self.partials[j] + other.partials[j],
        )
    }
}

impl<const P: usize, R: Real> Sub for Dual<P, R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::with(
            self.value - other.value,
            #[inline(always)]
            |j| self.partials[j] - other.partials[j],
        )
    }
}

impl<const P: usize, R: Real> Mul for Dual<P, R> {
    type Output = Self;
    #[inline(always)]
    #[allow(clippy::suspicious_arithmetic_impl, reason = "the product rule adds")]
    fn mul(self, other: Self) -> Self {
        Self::with(
            self.value * other.value,
            #[inline(always)]
            |j| self.partials[j] * other.value + self.value * other.partials[j],
        )
    }
}

impl<const P: usize, R: Real> Div for Dual<P, R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let inverse = self.value.constant(1.0) / other.value;
        let value = self.value * inverse;
        Self::with(
            value,
            #[inline(always)]
            |j| (self.partials[j] - value * other.partials[j]) * inverse,
        )
    }
}

impl<const P: usize, R: Real> Neg for Dual<P, R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl<const P: usize, R: Real> AddAssign for Dual<P, R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const P: usize, R: Real> Add<f64> for Dual<P, R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self {
            value: self.value + other,
            ..self
        }
    }
}

impl<const P: usize, R: Real> Sub<f64> for Dual<P, R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        Self {
            value: self.value - other,
            ..self
        }
    }
}

impl<const P: usize, R: Real> Mul<f64> for Dual<P, R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.times(self.value.constant(other))
    }
}

impl<const P: usize, R: Real> Number for Dual<P, R> {
    type Real = R;
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::from(self.value.constant(value))
    }
    #[inline(always)]
    fn value(self) -> R {
        self.value
    }
    #[inline(always)]
    fn chain(self, value: R, slope: R) -> Self {
        Self::with(
            value,
            #[inline(always)]
            |j| self.partials[j] * slope,
        )
    }
    #[inline(always)]
    fn chain_of<const K: usize>(numbers: &[Self; K], value: R, slopes: &[R; K]) -> Self {
        Self::with(
            value,
            #[inline(always)]
            |j| {
                let mut sum = value.constant(0.0);
                for (number, &slope) in numbers.iter().zip(slopes) {
                    sum += slope * number.partials[j];
                }
                sum
            },
        )
    }
    #[inline(always)]
    fn select(condition: R::Mask, yes: Self, no: Self) -> Self {
        Self::with(
            R::choose(condition, yes.value, no.value),
            #[inline(always)]
            |j| R::choose(condition, yes.partials[j], no.partials[j]),
        )
    }
    #[inline(always)]
    fn plus(self, known: R) -> Self {
        Self {
            value: self.value + known,
            ..self
        }
    }
    #[inline(always)]
    fn times(self, known: R) -> Self {
        self.chain(self.value * known, known)
    }
    #[inline(always)]
    fn of_one<const COLUMN: usize>(self) -> OfOne<R> {
        OfOne {
            value: self.value,
            slope: self.partials[COLUMN],
        }
    }
    #[inline(always)]
    fn times_one<const COLUMN: usize>(self, one: OfOne<R>) -> Self {
        let mut product = self.times(one.value);
        product.partials[COLUMN] += self.value * one.slope;
        product
    }
    #[inline(always)]
    fn plus_one<const COLUMN: usize>(self, one: OfOne<R>) -> Self {
        let mut sum = self.plus(one.value);
        sum.partials[COLUMN] += one.slope;
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// d/dx of tanh(x²)/(x − 3) + |−x| at 0.7, by hand: u = x², f' = (2x(1−tanh²u))/(x−3) − tanh(u)/(x−3)² + 1.
    #[test]
    fn quotient_chain_and_absolute_value_follow_the_rules_of_calculus() {
        let x = Dual::<2>::parameter(0.7, 1);
        let f = (x * x).tanh() / (x - 3.0) + (-x).abs();
        let tanh = 0.49_f64.tanh();
        let expected = 1.4 * (1.0 - tanh * tanh) / -2.3 - tanh / (2.3 * 2.3) + 1.0;
        assert!((f.partials[1] - expected).abs() < 1e-15);
        assert_eq!(f.partials[0], 0.0, "not a function of parameter 0");
        assert!((f.value - (tanh / -2.3 + 0.7)).abs() < 1e-15);
    }
}
