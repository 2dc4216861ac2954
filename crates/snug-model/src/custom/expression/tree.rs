//! An expression as the parser builds it, before it is compiled.

use super::name::{Function, Variable};
use crate::numeric::number::Number;

/// An expression as it was read, constant parts already worked out.
#[derive(Debug, Clone, PartialEq)]
pub enum Tree {
    Constant(f64),
    Variable(Variable),
    Parameter(usize),
    Binary(Binary, Box<Self>, Box<Self>),
    /// Of one argument, or of two.
    Call(Function, Box<Self>, Option<Box<Self>>),
}

/// An operator between two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

impl Tree {
    pub fn binary(operator: Binary, left: Self, right: Self) -> Self {
        match (operator, &left, &right) {
            (_, &Self::Constant(a), &Self::Constant(b)) => Self::Constant(match operator {
                Binary::Add => a + b,
                Binary::Subtract => a - b,
                Binary::Multiply => a * b,
                Binary::Divide => a / b,
                Binary::Power => a.real_power(b),
            }),
            (Binary::Power, _, &Self::Constant(0.0)) => Self::Constant(1.0),
            (Binary::Power, _, &Self::Constant(1.0)) => left,
            _ => Self::Binary(operator, Box::new(left), Box::new(right)),
        }
    }

    pub fn negative(of: Self) -> Self {
        Self::binary(Binary::Multiply, Self::Constant(-1.0), of)
    }

    pub fn call(function: Function, first: Self, second: Option<Self>) -> Self {
        match (&first, &second) {
            (&Self::Constant(a), None) => Self::Constant(function.of(a, a)),
            (&Self::Constant(a), &Some(Self::Constant(b))) => Self::Constant(function.of(a, b)),
            _ => Self::Call(function, Box::new(first), second.map(Box::new)),
        }
    }
}
