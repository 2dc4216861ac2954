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
        let tanh = tanh(self.value());
        self.chain(tanh, 1.0 - tanh * tanh)
    }
    /// Absolute value; the slope at 0 is taken as 0.
    fn abs(self) -> Self {
        let value = self.value();
        let slope = if value == 0.0 { 0.0 } else { value.signum() };
        self.chain(value.abs(), slope)
    }
    /// Square root; the infinite slope at 0 is taken as 0.
    fn sqrt(self) -> Self {
        let root = self.value().sqrt();
        self.chain(root, if root == 0.0 { 0.0 } else { 0.5 / root })
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
    /// Cosine of an angle \[rad\].
    fn cos(self) -> Self {
        let (sine, cosine) = self.value().sin_cos();
        self.chain(cosine, -sine)
    }
    /// Tangent of an angle \[rad\].
    fn tan(self) -> Self {
        let tangent = self.value().tan();
        self.chain(tangent, 1.0 + tangent * tangent)
    }
    /// Angle \[rad\] whose tangent this is.
    fn atan(self) -> Self {
        let value = self.value();
        self.chain(value.atan(), 1.0 / (1.0 + value * value))
    }
    /// Natural logarithm.
    fn log(self) -> Self {
        let value = self.value();
        self.chain(value.ln(), 1.0 / value)
    }
    /// −1, 0 or 1; the slope is taken as 0 everywhere.
    fn sign(self) -> Self {
        let value = self.value();
        self.chain(if value == 0.0 { 0.0 } else { value.signum() }, 0.0)
    }
    /// 1 above 0, else 0; the slope is taken as 0 everywhere.
    fn step(self) -> Self {
        self.chain(f64::from(u8::from(self.value() > 0.0)), 0.0)
    }
    /// This number to a whole power.
    fn power(self, exponent: i32) -> Self {
        let value = self.value();
        let (below, whole) = match exponent {
            2 => (value, value * value),
            3 => (value * value, value * value * value),
            _ => (value.powi(exponent - 1), value.powi(exponent)),
        };
        self.chain(whole, f64::from(exponent) * below)
    }
    /// This number, not negative, to a real power; an infinite slope at 0 is taken as 0.
    fn real_power(self, exponent: f64) -> Self {
        let value = self.value();
        let slope = exponent * value.powf(exponent - 1.0);
        let slope = if value == 0.0 && slope.is_infinite() {
            0.0
        } else {
            slope
        };
        self.chain(value.powf(exponent), slope)
    }
    /// This number, not negative, to the power of another.
    fn power_of(self, exponent: Self) -> Self {
        let power = self.real_power(exponent.value());
        let by_exponent = if power.value() == 0.0 {
            0.0
        } else {
            power.value() * self.value().ln()
        };
        power + exponent.chain(0.0, by_exponent)
    }
    /// u² (3 − 2u) between 0 and 1; 0 before and 1 after.
    fn smooth_step(self) -> Self {
        let u = self.value().clamp(0.0, 1.0);
        self.chain(u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u))
    }
}

/// Hyperbolic tangent to 1e−14 of its value, in half the time of the standard library's.
///
/// 1 − 2/(e^2x + 1) loses digits near 0; there the series serves, whose first left-out term is below 4e−15 x.
/// Kept out of line: within the equations of motion it would cost every effect registers, used or not.
#[inline(never)]
fn tanh(x: f64) -> f64 {
    const SERIES_BELOW: f64 = 0.1;
    const ONE_FROM: f64 = 20.0;
    let size = x.abs();
    if size >= ONE_FROM {
        1.0_f64.copysign(x)
    } else if size < SERIES_BELOW {
        let s = x * x;
        let tail = 62.0 / 2835.0 - s * (1382.0 / 155_925.0);
        let inner = 2.0 / 15.0 - s * (17.0 / 315.0 - s * tail);
        x * (1.0 - s * (1.0 / 3.0 - s * inner))
    } else {
        (1.0 - 2.0 / ((2.0 * size).exp() + 1.0)).copysign(x)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hyperbolic_tangent_agrees_with_the_standard_library() {
        for step in -60_000..=60_000 {
            let x = f64::from(step) * 5e-4 + 1e-7;
            let error = (tanh(x) - x.tanh()).abs();
            assert!(error <= 1e-14 * x.tanh().abs(), "{x}: {error:e}");
        }
        assert_eq!(tanh(0.0), 0.0);
        assert!(tanh(f64::NAN).is_nan());
    }

    #[test]
    fn functions_have_the_slopes_of_calculus() {
        type Function = fn(crate::Dual<1>) -> crate::Dual<1>;
        let cases: [(Function, f64); 5] = [
            (Number::sqrt, 0.5 / 0.3_f64.sqrt()),
            (Number::exp, 0.3_f64.exp()),
            (Number::sin, 0.3_f64.cos()),
            (Number::tanh, 1.0 / 0.3_f64.cosh().powi(2)),
            (Number::smooth_step, 6.0 * 0.3 * 0.7),
        ];
        for (index, (function, slope)) in cases.into_iter().enumerate() {
            let found = function(crate::Dual::parameter(0.3, 0)).partials[0];
            assert!((found - slope).abs() < 1e-14, "function {index}: {found}");
        }
    }
}
