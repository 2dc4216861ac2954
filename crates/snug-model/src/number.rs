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
    /// Square root of a positive number.
    fn sqrt(self) -> Self {
        let root = self.value().sqrt();
        self.chain(root, 0.5 / root)
    }
    /// Exponential function.
    fn exp(self) -> Self {
        let power = self.value().exp();
        self.chain(power, power)
    }
    /// Sine of an angle \[rad\].
    fn sin(self) -> Self {
        let (sine, cosine) = self.value().sin_cos();
        self.chain(sine, cosine)
    }
    /// u² (3 − 2u) between 0 and 1; 0 before and 1 after.
    fn smooth_step(self) -> Self {
        let u = self.value().clamp(0.0, 1.0);
        self.chain(u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u))
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
