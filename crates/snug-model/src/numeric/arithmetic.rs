//! The operations that plain numbers and those that carry derivatives have in common.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Numbers that can be added, multiplied and divided, also with one that is the same in every lane.
pub trait Arithmetic:
    Copy
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
}

impl<T> Arithmetic for T where
    T: Copy
        + Add<Output = T>
        + Add<f64, Output = T>
        + Sub<Output = T>
        + Sub<f64, Output = T>
        + Mul<Output = T>
        + Mul<f64, Output = T>
        + Div<Output = T>
        + Neg<Output = T>
        + AddAssign
{
}
