//! A value with its derivatives with respect to up to nine parameters (forward differentiation).

use std::ops::{Add, Div, Mul, Neg, Sub};

pub const MOST_PARAMETERS: usize = 11;

#[derive(Debug, Clone, Copy)]
pub struct Dual {
    pub value: f64,
    pub slopes: [f64; MOST_PARAMETERS],
}

impl Dual {
    pub fn constant(value: f64) -> Self {
        let slopes = [0.0; MOST_PARAMETERS];
        Self { value, slopes }
    }

    pub fn variable(value: f64, index: usize) -> Self {
        let mut variable = Self::constant(value);
        variable.slopes[index] = 1.0;
        variable
    }

    fn chain(self, value: f64, slope: f64) -> Self {
        let slopes = self.slopes.map(|own| slope * own);
        Self { value, slopes }
    }

    pub fn exp(self) -> Self {
        self.chain(self.value.exp(), self.value.exp())
    }

    pub fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }

    pub fn sin(self) -> Self {
        self.chain(self.value.sin(), self.value.cos())
    }

    pub fn atan(self) -> Self {
        self.chain(self.value.atan(), 1.0 / (1.0 + self.value * self.value))
    }

    pub fn ln(self) -> Self {
        self.chain(self.value.ln(), 1.0 / self.value)
    }

    pub fn square(self) -> Self {
        self * self
    }

    /// A positive number to a power that depends on the parameters.
    pub fn power(self, exponent: Dual) -> Self {
        (self.ln() * exponent)
            .exp()
            .with_value(self.value.powf(exponent.value))
    }

    fn with_value(self, value: f64) -> Self {
        Self { value, ..self }
    }
}

impl From<f64> for Dual {
    fn from(value: f64) -> Self {
        Dual::constant(value)
    }
}

impl Neg for Dual {
    type Output = Dual;
    fn neg(self) -> Dual {
        self.chain(-self.value, -1.0)
    }
}

fn combine(a: Dual, b: Dual, value: f64, by_a: f64, by_b: f64) -> Dual {
    let mut slopes = [0.0; MOST_PARAMETERS];
    for (slope, (a, b)) in slopes.iter_mut().zip(a.slopes.iter().zip(&b.slopes)) {
        *slope = by_a * a + by_b * b;
    }
    Dual { value, slopes }
}

macro_rules! operator {
    ($name:ident, $function:ident, |$a:ident, $b:ident| $value:expr, $by_a:expr, $by_b:expr) => {
        impl $name for Dual {
            type Output = Dual;
            fn $function(self, other: Dual) -> Dual {
                let ($a, $b) = (self.value, other.value);
                combine(self, other, $value, $by_a, $by_b)
            }
        }
        impl $name<f64> for Dual {
            type Output = Dual;
            fn $function(self, other: f64) -> Dual {
                self.$function(Dual::constant(other))
            }
        }
        impl $name<Dual> for f64 {
            type Output = Dual;
            fn $function(self, other: Dual) -> Dual {
                Dual::constant(self).$function(other)
            }
        }
    };
}

operator!(Add, add, |a, b| a + b, 1.0, 1.0);
operator!(Sub, sub, |a, b| a - b, 1.0, -1.0);
operator!(Mul, mul, |a, b| a * b, b, a);
operator!(Div, div, |a, b| a / b, 1.0 / b, -a / (b * b));
