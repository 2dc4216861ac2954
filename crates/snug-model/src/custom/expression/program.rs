//! An expression compiled to instructions, evaluated over any kind of number.

use super::name::{Function, Variable};
use super::tree::{Binary, Tree};
use crate::law::Instant;
use crate::numeric::lanewise::{Lanewise, Task};
use crate::numeric::number::Number;

/// Intermediate results a program may keep at a time.
pub const MAXIMUM_TEMPORARIES: usize = 16;

/// An expression compiled to a list of instructions over a few numbered temporaries.
///
/// Instructions name their operands instead of pushing them, so that numbers with many partial derivatives are not
/// copied about.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    instructions: Vec<Instruction>,
    result: Operand,
    temporaries: usize,
}

/// What an expression's variables stand for.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a, N: Number> {
    /// The instant at which the law acts.
    pub at: &'a Instant<N>,
    /// α \[rad/s²\]; known to the sensor only.
    pub acceleration_rad_per_s2: Option<N>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Operand {
    Constant(f64),
    Variable(Variable),
    Parameter(usize),
    Temporary(usize),
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Instruction {
    operation: Operation,
    to: usize,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Operation {
    Add(Operand, Operand),
    Subtract(Operand, Operand),
    Multiply(Operand, Operand),
    Divide(Operand, Operand),
    Shift(Operand, f64),
    Scale(Operand, f64),
    WholePower(Operand, i32),
    RealPower(Operand, f64),
    Power(Operand, Operand),
    Call(Function, Operand, Operand),
}

impl Program {
    /// Nothing when more than [`MAXIMUM_TEMPORARIES`] intermediate results are needed at a time.
    pub fn new(tree: &Tree) -> Option<Self> {
        let mut program = Self {
            instructions: Vec::new(),
            result: Operand::Constant(0.0),
            temporaries: 0,
        };
        program.result = program.place(tree, 0)?;
        Some(program)
    }

    /// Adds what works `tree` out, with temporaries from `free` on, and says where the result is.
    fn place(&mut self, tree: &Tree, free: usize) -> Option<Operand> {
        let operation = match tree {
            &Tree::Constant(value) => return Some(Operand::Constant(value)),
            &Tree::Variable(variable) => return Some(Operand::Variable(variable)),
            &Tree::Parameter(index) => return Some(Operand::Parameter(index)),
            Tree::Binary(operator, left, right) => {
                let (left, right) = self.pair(left, right, free)?;
                operation(*operator, left, right)
            }
            Tree::Call(function, first, None) => {
                let first = self.place(first, free)?;
                Operation::Call(*function, first, first)
            }
            Tree::Call(function, first, Some(second)) => {
                let (first, second) = self.pair(first, second, free)?;
                Operation::Call(*function, first, second)
            }
        };
        if free >= MAXIMUM_TEMPORARIES {
            return None;
        }
        self.temporaries = self.temporaries.max(free + 1);
        self.instructions.push(Instruction {
            operation,
            to: free,
        });
        Some(Operand::Temporary(free))
    }

    fn pair(&mut self, first: &Tree, second: &Tree, free: usize) -> Option<(Operand, Operand)> {
        let first = self.place(first, free)?;
        let next = free + usize::from(matches!(first, Operand::Temporary(_)));
        Some((first, self.place(second, next)?))
    }

    /// Whether the value depends on `variable`.
    pub fn uses(&self, variable: Variable) -> bool {
        self.reads(Operand::Variable(variable))
    }

    /// Whether the value depends on parameter number `index`.
    pub fn uses_parameter(&self, index: usize) -> bool {
        self.reads(Operand::Parameter(index))
    }

    fn reads(&self, wanted: Operand) -> bool {
        self.result == wanted
            || self
                .instructions
                .iter()
                .any(|instruction| match instruction.operation {
                    Operation::Add(a, b)
                    | Operation::Subtract(a, b)
                    | Operation::Multiply(a, b)
                    | Operation::Divide(a, b)
                    | Operation::Power(a, b)
                    | Operation::Call(_, a, b) => a == wanted || b == wanted,
                    Operation::Shift(a, _)
                    | Operation::Scale(a, _)
                    | Operation::WholePower(a, _)
                    | Operation::RealPower(a, _) => a == wanted,
                })
    }

    /// The value for parameters `p` in given surroundings.
    ///
    /// Out of line: within the equations of motion it would cost every effect registers, used or not.
    #[inline(never)]
    pub fn evaluate<N: Number>(&self, p: &[N], around: &Surroundings<N>) -> N {
        let run = Run {
            program: self,
            p,
            around,
        };
        around.at.lever_arm_m.vectorize(run)
    }

    #[inline(always)]
    fn run<N: Number, const T: usize>(&self, p: &[N], around: &Surroundings<N>) -> N {
        let mut kept = [around.at.x_m.constant(0.0); T];
        for instruction in &self.instructions {
            let from = Operands {
                p,
                around,
                kept: &kept,
            };
            let value = match instruction.operation {
                Operation::Add(a, b) => from.get(a) + from.get(b),
                Operation::Subtract(a, b) => from.get(a) - from.get(b),
                Operation::Multiply(a, b) => from.get(a) * from.get(b),
                Operation::Divide(a, b) => from.get(a) / from.get(b),
                Operation::Shift(a, by) => from.get(a) + by,
                Operation::Scale(a, by) => from.get(a) * by,
                Operation::WholePower(a, exponent) => from.get(a).power(exponent),
                Operation::RealPower(a, exponent) => from.get(a).real_power(exponent),
                Operation::Power(a, b) => from.get(a).power_of(from.get(b)),
                Operation::Call(function, a, b) => function.of(from.get(a), from.get(b)),
            };
            kept[instruction.to] = value;
        }
        let from = Operands {
            p,
            around,
            kept: &kept,
        };
        from.get(self.result)
    }
}

/// One evaluation.
struct Run<'a, N: Number> {
    program: &'a Program,
    p: &'a [N],
    around: &'a Surroundings<'a, N>,
}

impl<N: Number> Task for Run<'_, N> {
    type Output = N;
    #[inline(always)]
    fn run(self) -> N {
        let Self { program, p, around } = self;
        match program.temporaries {
            0..=2 => program.run::<N, 2>(p, around),
            3 | 4 => program.run::<N, 4>(p, around),
            _ => program.run::<N, MAXIMUM_TEMPORARIES>(p, around),
        }
    }
}

/// The cheapest operation that works `left operator right` out.
fn operation(operator: Binary, left: Operand, right: Operand) -> Operation {
    use Operand::Constant;
    match (operator, left, right) {
        (Binary::Add, Constant(by), a) | (Binary::Add, a, Constant(by)) => Operation::Shift(a, by),
        (Binary::Add, a, b) => Operation::Add(a, b),
        (Binary::Subtract, a, Constant(by)) => Operation::Shift(a, -by),
        (Binary::Subtract, a, b) => Operation::Subtract(a, b),
        (Binary::Multiply, Constant(by), a) | (Binary::Multiply, a, Constant(by)) => {
            Operation::Scale(a, by)
        }
        (Binary::Multiply, a, b) => Operation::Multiply(a, b),
        (Binary::Divide, a, b) => Operation::Divide(a, b),
        (Binary::Power, a, Constant(exponent)) => {
            let whole = exponent as i32;
            if f64::from(whole) == exponent {
                Operation::WholePower(a, whole)
            } else {
                Operation::RealPower(a, exponent)
            }
        }
        (Binary::Power, a, b) => Operation::Power(a, b),
    }
}

/// What operands stand for at one instruction.
struct Operands<'a, N: Number> {
    p: &'a [N],
    around: &'a Surroundings<'a, N>,
    kept: &'a [N],
}

impl<N: Number> Operands<'_, N> {
    #[inline(always)]
    fn get(&self, operand: Operand) -> N {
        let at = self.around.at;
        match operand {
            Operand::Temporary(index) => self.kept[index],
            Operand::Parameter(index) => self.p[index],
            Operand::Constant(value) => at.x_m.constant(value),
            Operand::Variable(variable) => match variable {
                Variable::X => at.x_m,
                Variable::V => at.v_m_per_s,
                Variable::Torque => at.torque_nm,
                Variable::Time => N::from(at.since_onset_s),
                Variable::Theta => at.x_m.times(at.lever_arm_m.constant(1.0) / at.lever_arm_m),
                Variable::Omega => at
                    .v_m_per_s
                    .times(at.lever_arm_m.constant(1.0) / at.lever_arm_m),
                Variable::Lever => N::from(at.lever_arm_m),
                Variable::Acceleration => self
                    .around
                    .acceleration_rad_per_s2
                    .expect("only what the sensor adds may name the acceleration"),
            },
        }
    }
}
