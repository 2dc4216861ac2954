//! The variables and functions that an expression may name.

use crate::numeric::number::Number;

/// A quantity of the motion that an expression may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// Grip displacement \[m\].
    X,
    /// Grip velocity \[m/s\].
    V,
    /// Torque that acts \[Nm\].
    Torque,
    /// Time since the pulse began \[s\].
    Time,
    /// Angle \[rad\].
    Theta,
    /// Angular velocity \[rad/s\].
    Omega,
    /// Lever arm \[m\].
    Lever,
    /// True angular acceleration \[rad/s²\].
    Acceleration,
}

impl Variable {
    /// Every variable; the last one is known to the sensor only.
    pub const ALL: [Self; 8] = [
        Self::X,
        Self::V,
        Self::Torque,
        Self::Time,
        Self::Theta,
        Self::Omega,
        Self::Lever,
        Self::Acceleration,
    ];

    /// As expressions write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::V => "v",
            Self::Torque => "T",
            Self::Time => "t",
            Self::Theta => "theta",
            Self::Omega => "omega",
            Self::Lever => "l",
            Self::Acceleration => "a",
        }
    }

    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|known| known.name() == name)
    }
}

/// A function of one or two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Function {
    Abs,
    Sign,
    Sqrt,
    Exp,
    Log,
    Sin,
    Cos,
    Tan,
    Tanh,
    Atan,
    Step,
    SmoothStep,
    Min,
    Max,
}

impl Function {
    pub const ALL: [Self; 14] = [
        Self::Abs,
        Self::Sign,
        Self::Sqrt,
        Self::Exp,
        Self::Log,
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Tanh,
        Self::Atan,
        Self::Step,
        Self::SmoothStep,
        Self::Min,
        Self::Max,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Abs => "abs",
            Self::Sign => "sign",
            Self::Sqrt => "sqrt",
            Self::Exp => "exp",
            Self::Log => "log",
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Tanh => "tanh",
            Self::Atan => "atan",
            Self::Step => "step",
            Self::SmoothStep => "smooth_step",
            Self::Min => "min",
            Self::Max => "max",
        }
    }

    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|known| known.name() == name)
    }

    /// Its value for one argument.
    #[inline(always)]
    pub fn of<N: Number>(self, argument: N) -> N {
        match self {
            Self::Abs => argument.abs(),
            Self::Sign => argument.sign(),
            Self::Sqrt => argument.sqrt(),
            Self::Exp => argument.exp(),
            Self::Log => argument.log(),
            Self::Sin => argument.sin(),
            Self::Cos => argument.cos(),
            Self::Tan => argument.tan(),
            Self::Tanh => argument.tanh(),
            Self::Atan => argument.atan(),
            Self::Step => argument.step(),
            Self::SmoothStep => argument.smooth_step(),
            Self::Min | Self::Max => argument,
        }
    }
}

/// The constant called `name`.
pub fn constant(name: &str) -> Option<f64> {
    (name == "pi").then_some(std::f64::consts::PI)
}
