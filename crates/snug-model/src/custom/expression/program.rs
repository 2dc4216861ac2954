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

/// Operands are fetched in one place each: in every kind of operation, they would be in the compiled program once more.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Operation {
    Unary(Unary, Operand),
    Binary(Binary, Operand, Operand),
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Unary {
    Shift(f64),
    Scale(f64),
    WholePower(i32),
    RealPower(f64),
    Call(Function),
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
            Tree::Call(function, argument) => {
                Operation::Unary(Unary::Call(*function), self.place(argument, free)?)
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
                    Operation::Unary(_, a) => a == wanted,
                    Operation::Binary(_, a, b) => a == wanted || b == wanted,
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

    /// The same with room for the intermediate results.
    #[inline(always)]
    fn run<N: Number>(&self, p: &[N], around: &Surroundings<N>, kept: &mut [N]) -> N {
        for instruction in &self.instructions {
            let from = Operands { p, around, kept };
            let value = match instruction.operation {
                Operation::Unary(operation, a) => operation.of(from.get(a)),
                Operation::Binary(operation, a, b) => operation.of(from.get(a), from.get(b)),
            };
            kept[instruction.to] = value;
        }
        Operands { p, around, kept }.get(self.result)
    }
}

impl Unary {
    #[inline(always)]
    fn of<N: Number>(self, a: N) -> N {
        match self {
            Self::Shift(by) => a + by,
            Self::Scale(by) => a * by,
            Self::WholePower(exponent) => a.power(exponent),
            Self::RealPower(exponent) => a.real_power(exponent),
            Self::Call(function) => function.of(a),
        }
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
        // No more room than is needed: to clear it costs as much as a few operations.
        let zero = around.at.x_m.constant(0.0);
        let (mut two, mut four, mut all);
        let kept: &mut [N] = match program.temporaries {
            0..=2 => {
                two = [zero; 2];
                &mut two
            }
            3 | 4 => {
                four = [zero; 4];
                &mut four
            }
            _ => {
                all = [zero; MAXIMUM_TEMPORARIES];
                &mut all
            }
        };
        program.run(p, around, kept)
    }
}

/// The cheapest operation that works `left operator right` out.
fn operation(operator: Binary, left: Operand, right: Operand) -> Operation {
    use Operand::Constant;
    let (unary, a) = match (operator, left, right) {
        (Binary::Add, Constant(by), a) | (Binary::Add, a, Constant(by)) => (Unary::Shift(by), a),
        (Binary::Subtract, a, Constant(by)) => (Unary::Shift(-by), a),
        (Binary::Multiply, Constant(by), a) | (Binary::Multiply, a, Constant(by)) => {
            (Unary::Scale(by), a)
        }
        (Binary::Power, a, Constant(exponent)) => {
            let whole = exponent as i32;
            match f64::from(whole) == exponent {
                true => (Unary::WholePower(whole), a),
                false => (Unary::RealPower(exponent), a),
            }
        }
        (_, a, b) => return Operation::Binary(operator, a, b),
    };
    Operation::Unary(unary, a)
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
