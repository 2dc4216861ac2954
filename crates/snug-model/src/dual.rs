use crate::Number;
use std::array;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// A value with its partial derivatives with respect to `P` parameters (forward differentiation, exact to rounding).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<const P: usize> {
    /// f.
    pub value: f64,
    /// ∂f/∂p_j.
    pub partials: [f64; P],
}

impl<const P: usize> Dual<P> {
    /// The parameter number `index` itself, at `value`.
    pub fn parameter(value: f64, index: usize) -> Self {
        let mut dual = Self::from(value);
        dual.partials[index] = 1.0;
        dual
    }
}

impl<const P: usize> From<f64> for Dual<P> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self {
            value,
            partials: [0.0; P],
        }
    }
}

impl<const P: usize> Add for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            partials: array::from_fn(|j| self.partials[j] + other.partials[j]),
        }
    }
}

impl<const P: usize> Sub for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            partials: array::from_fn(|j| self.partials[j] - other.partials[j]),
        }
    }
}

impl<const P: usize> Mul for Dual<P> {
    type Output = Self;
    #[inline(always)]
    #[allow(clippy::suspicious_arithmetic_impl, reason = "the product rule adds")]
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            partials: array::from_fn(|j| {
                self.partials[j] * other.value + self.value * other.partials[j]
            }),
        }
    }
}

impl<const P: usize> Div for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let inverse = 1.0 / other.value;
        let value = self.value * inverse;
        Self {
            value,
            partials: array::from_fn(|j| (self.partials[j] - value * other.partials[j]) * inverse),
        }
    }
}

impl<const P: usize> Neg for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl<const P: usize> AddAssign for Dual<P> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const P: usize> Add<f64> for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self {
            value: self.value + other,
            ..self
        }
    }
}

impl<const P: usize> Sub<f64> for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        Self {
            value: self.value - other,
            ..self
        }
    }
}

impl<const P: usize> Mul<f64> for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        Self {
            value: self.value * other,
            partials: self.partials.map(|partial| partial * other),
        }
    }
}

impl<const P: usize> Number for Dual<P> {
    #[inline(always)]
    fn value(self) -> f64 {
        self.value
    }
    #[inline(always)]
    fn chain(self, value: f64, slope: f64) -> Self {
        Self {
            value,
            partials: self.partials.map(|partial| partial * slope),
        }
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
