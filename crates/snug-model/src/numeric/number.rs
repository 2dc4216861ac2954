//! The arithmetic that laws are written in, over plain numbers and over those that carry derivatives.

use crate::numeric::arithmetic::Arithmetic;
use crate::numeric::elementary::{exponential_function, hyperbolic_tangent, sine_and_cosine};
use crate::numeric::lanewise::Lanewise;

/// What a physical law may compute with: real numbers, or a [`Dual`](crate::Dual) that carries partial derivatives along;
/// of one tightening, or of several side by side.
///
/// A law written once over `N: Number` gives its value and, with the same lines, its sensitivities. It may not branch on
/// a value, since that differs from lane to lane: [`Number::select`] takes one of two.
pub trait Number: Arithmetic + From<Self::Real> {
    /// What value and derivatives consist of.
    type Real: Real;

    /// A known number of this kind.
    fn constant(self, value: f64) -> Self;
    /// The value without its derivatives.
    fn value(self) -> Self::Real;
    /// A function of this number, given the function's value and slope at [`Number::value`].
    fn chain(self, value: Self::Real, slope: Self::Real) -> Self;
    /// A function of several numbers, given its value and its slopes along them.
    fn chain_of<const K: usize>(
        numbers: &[Self; K],
        value: Self::Real,
        slopes: &[Self::Real; K],
    ) -> Self;
    /// `yes` where the condition holds, else `no`.
    fn select(condition: <Self::Real as Lanewise>::Mask, yes: Self, no: Self) -> Self;
    /// This number and a known one.
    fn plus(self, known: Self::Real) -> Self;
    /// This number times a known one.
    fn times(self, known: Self::Real) -> Self;

    /// This number as one that depends on nothing but parameter number `COLUMN`.
    fn of_one<const COLUMN: usize>(self) -> OfOne<Self::Real>;
    /// This number times one that depends on parameter number `COLUMN` only.
    fn times_one<const COLUMN: usize>(self, one: OfOne<Self::Real>) -> Self;
    /// This number and one that depends on parameter number `COLUMN` only.
    fn plus_one<const COLUMN: usize>(self, one: OfOne<Self::Real>) -> Self;

    /// Hyperbolic tangent.
    #[inline(always)]
    fn tanh(self) -> Self {
        let tanh = hyperbolic_tangent(self.value());
        self.chain(tanh, -(tanh * tanh) + 1.0)
    }
    /// Absolute value; the slope at 0 is taken as 0.
    #[inline(always)]
    fn abs(self) -> Self {
        let value = self.value();
        self.chain(value.magnitude(), value.sign_of())
    }
    /// Square root; the infinite slope at 0 is taken as 0.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value().root();
        let (half, zero) = (root.constant(0.5), root.constant(0.0));
        self.chain(
            root,
            Lanewise::choose(root.is_positive(), half / root, zero),
        )
    }
    /// Exponential function.
    #[inline(always)]
    fn exp(self) -> Self {
        let power = exponential_function(self.value());
        self.chain(power, power)
    }
    /// Sine and cosine of an angle \[rad\].
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = sine_and_cosine(self.value());
        (self.chain(sine, cosine), self.chain(cosine, -sine))
    }
    /// Sine of an angle \[rad\].
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine of an angle \[rad\].
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Tangent of an angle \[rad\].
    fn tan(self) -> Self {
        let tangent = self.value().each(f64::tan);
        self.chain(tangent, tangent * tangent + 1.0)
    }
    /// Angle \[rad\] whose tangent this is.
    fn atan(self) -> Self {
        let value = self.value();
        let slope = value.constant(1.0) / (value * value + 1.0);
        self.chain(value.each(f64::atan), slope)
    }
    /// Natural logarithm.
    fn log(self) -> Self {
        let value = self.value();
        self.chain(value.each(f64::ln), value.constant(1.0) / value)
    }
    /// −1, 0 or 1; the slope is taken as 0 everywhere.
    #[inline(always)]
    fn sign(self) -> Self {
        Self::from(self.value().sign_of())
    }
    /// 1 above 0, else 0; the slope is taken as 0 everywhere.
    #[inline(always)]
    fn step(self) -> Self {
        let value = self.value();
        let (one, zero) = (value.constant(1.0), value.constant(0.0));
        Self::from(Lanewise::choose(value.is_positive(), one, zero))
    }
    /// This number to a whole power.
    #[inline(always)]
    fn power(self, exponent: i32) -> Self {
        let value = self.value();
        let (below, whole) = match exponent {
            2 => (value, value * value),
            3 => (value * value, value * value * value),
            _ => (
                whole_power(value, exponent - 1),
                whole_power(value, exponent),
            ),
        };
        self.chain(whole, below * f64::from(exponent))
    }
    /// This number, not negative, to a real power; an infinite slope at 0 is taken as 0.
    fn real_power(self, exponent: f64) -> Self {
        let value = self.value();
        let (power, slope) = real_power(value, value.constant(exponent));
        self.chain(power, slope)
    }
    /// This number, not negative, to the power of another.
    fn power_of(self, exponent: Self) -> Self {
        let value = self.value();
        let (power, slope) = real_power(value, exponent.value());
        let by_exponent = Lanewise::choose(
            power.is_positive(),
            power * value.each(f64::ln),
            power.constant(0.0),
        );
        Self::chain_of(&[self, exponent], power, &[slope, by_exponent])
    }
    /// This number, no further than `most`, not negative, from 0.
    #[inline(always)]
    fn no_further_than(self, most: Self) -> Self {
        let is_above = self.value().is_above(most.value());
        let is_below = (-self.value()).is_above(most.value());
        Self::select(is_above, most, Self::select(is_below, -most, self))
    }
    /// u² (3 − 2u) between 0 and 1; 0 before and 1 after.
    #[inline(always)]
    fn smooth_step(self) -> Self {
        let u = self.value().within(0.0, 1.0);
        let rest = -u + 1.0;
        self.chain(u * u * (u * -2.0 + 3.0), u * rest * 6.0)
    }
}

/// Numbers without derivatives: one (`f64`), or one of every tightening that stands side by side with others in a vector
/// register.
pub trait Real: Lanewise + Number<Real = Self> {}

impl Real for f64 {}

/// A number that depends on one parameter only: to compute with it spares the zeros among its derivatives.
#[derive(Debug, Clone, Copy)]
pub struct OfOne<R> {
    /// The value.
    pub value: R,
    /// Its derivative with respect to that parameter.
    pub slope: R,
}

impl<R: Real> OfOne<R> {
    /// Times a known number.
    #[inline(always)]
    pub fn times(self, known: R) -> Self {
        Self {
            value: self.value * known,
            slope: self.slope * known,
        }
    }
}

/// By repeated squaring.
#[inline(always)]
fn whole_power<R: Real>(value: R, exponent: i32) -> R {
    let one = value.constant(1.0);
    let (mut power, mut square, mut left) = (one, value, exponent.unsigned_abs());
    while left > 0 {
        if left & 1 == 1 {
            power = power * square;
        }
        square = square * square;
        left >>= 1;
    }
    if exponent < 0 { one / power } else { power }
}

/// Value and slope of a power of a number that is not negative; an infinite slope at 0 is taken as 0.
fn real_power<R: Real>(value: R, exponent: R) -> (R, R) {
    let raised = |to: R| value.lane_by_lane(|lane| value.lanes()[lane].powf(to.lanes()[lane]));
    let (zero, one) = (value.constant(0.0), value.constant(1.0));
    let slope = exponent * raised(exponent - 1.0);
    let at_zero = Lanewise::choose(one.is_above(exponent), zero, slope);
    (
        raised(exponent),
        Lanewise::choose(value.is_positive(), slope, at_zero),
    )
}

impl Number for f64 {
    type Real = Self;
    #[inline(always)]
    fn constant(self, value: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn value(self) -> f64 {
        self
    }
    #[inline(always)]
    fn chain(self, value: f64, _slope: f64) -> Self {
        value
    }
    #[inline(always)]
    fn chain_of<const K: usize>(_numbers: &[Self; K], value: f64, _slopes: &[f64; K]) -> Self {
        value
    }
    #[inline(always)]
    fn select(condition: bool, yes: Self, no: Self) -> Self {
        if condition { yes } else { no }
    }
    #[inline(always)]
    fn plus(self, known: f64) -> Self {
        self + known
    }
    #[inline(always)]
    fn times(self, known: f64) -> Self {
        self * known
    }
    #[inline(always)]
    fn of_one<const COLUMN: usize>(self) -> OfOne<f64> {
        OfOne {
            value: self,
            slope: 0.0,
        }
    }
    #[inline(always)]
    fn times_one<const COLUMN: usize>(self, one: OfOne<f64>) -> Self {
        self * one.value
    }
    #[inline(always)]
    fn plus_one<const COLUMN: usize>(self, one: OfOne<f64>) -> Self {
        self + one.value
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::dual::Dual;

    #[test]
    fn functions_have_the_slopes_of_calculus() {
        type Function = fn(Dual<1>) -> Dual<1>;
        let cases: [(Function, f64); 5] = [
            (Number::sqrt, 0.5 / 0.3_f64.sqrt()),
            (Number::exp, 0.3_f64.exp()),
            (Number::sin, 0.3_f64.cos()),
            (Number::tanh, 1.0 / 0.3_f64.cosh().powi(2)),
            (Number::smooth_step, 6.0 * 0.3 * 0.7),
        ];
        for (index, (function, slope)) in cases.into_iter().enumerate() {
            let found = function(Dual::parameter(0.3, 0)).partials[0];
            assert!((found - slope).abs() < 1e-14, "function {index}: {found}");
        }
    }
}
