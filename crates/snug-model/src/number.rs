use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// What a physical law may compute with: `f64`, or a [`Dual`](crate::Dual) that carries partial derivatives along.
///
/// A law written once over `N: Number` gives its value and, with the same lines, its sensitivities.
pub trait Number:
    Copy
    + From<f64>
    + Add<Output = Self>
    + Add<f64, Output = Self>
    + Sub<Output = Self>
    + Sub<f64, Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
{
    /// The value without its derivatives.
    fn value(self) -> f64;
    /// A function of this number, given the function's value and slope at [`Number::value`].
    fn chain(self, value: f64, slope: f64) -> Self;

    /// Hyperbolic tangent.
    fn tanh(self) -> Self {
        let tanh = self.value().tanh();
        self.chain(tanh, 1.0 - tanh * tanh)
    }
    /// Absolute value; the slope at 0 is taken as 0.
    fn abs(self) -> Self {
        let value = self.value();
        let slope = if value == 0.0 { 0.0 } else { value.signum() };
        self.chain(value.abs(), slope)
    }
}

impl Number for f64 {
    #[inline(always)]
    fn value(self) -> f64 {
        self
    }
    #[inline(always)]
    fn chain(self, value: f64, _slope: f64) -> Self {
        value
    }
}
