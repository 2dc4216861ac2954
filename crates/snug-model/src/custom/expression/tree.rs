//! An expression as the parser builds it, before it is compiled.

use super::name::{Function, Variable};
use crate::numeric::lanewise::Lanewise;
use crate::numeric::number::Number;

/// An expression as it was read, constant parts already worked out.
#[derive(Debug, Clone, PartialEq)]
pub enum Tree {
    Constant(f64),
    Variable(Variable),
    Parameter(usize),
    Binary(Binary, Box<Self>, Box<Self>),
    Call(Function, Box<Self>),
}

/// An operator between two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Min,
    Max,
}

impl Binary {
    /// What a function of two arguments is between them; `None` of a function of one.
    pub fn of_function(function: Function) -> Option<Self> {
        match function {
            Function::Min => Some(Self::Min),
            Function::Max => Some(Self::Max),
            _ => None,
        }
    }

    #[inline(always)]
    pub fn of<N: Number>(self, a: N, b: N) -> N {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Power => a.power_of(b),
            Self::Min => N::select(a.value().is_above(b.value()), b, a),
            Self::Max => N::select(b.value().is_above(a.value()), b, a),
        }
    }
}

impl Tree {
    pub fn binary(operator: Binary, left: Self, right: Self) -> Self {
        match (operator, &left, &right) {
            (_, &Self::Constant(a), &Self::Constant(b)) => Self::Constant(operator.of(a, b)),
            (Binary::Power, _, &Self::Constant(0.0)) => Self::Constant(1.0),
            (Binary::Power, _, &Self::Constant(1.0)) => left,
            _ => Self::Binary(operator, Box::new(left), Box::new(right)),
        }
    }

    pub fn negative(of: Self) -> Self {
        Self::binary(Binary::Multiply, Self::Constant(-1.0), of)
    }

    pub fn call(function: Function, argument: Self) -> Self {
        match argument {
            Self::Constant(a) => Self::Constant(function.of(a)),
            _ => Self::Call(function, Box::new(argument)),
        }
    }
}
