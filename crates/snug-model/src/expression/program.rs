use super::name::{Function, Variable};
use super::tree::{Binary, Tree};
use crate::Number;
use crate::effect::Instant;

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
pub struct Surroundings<'a, N> {
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
        match self.temporaries {
            0..=2 => self.run::<N, 2>(p, around),
            3 | 4 => self.run::<N, 4>(p, around),
            _ => self.run::<N, MAXIMUM_TEMPORARIES>(p, around),
        }
    }

    #[inline(always)]
    fn run<N: Number, const T: usize>(&self, p: &[N], around: &Surroundings<N>) -> N {
        let mut kept = [N::from(0.0); T];
        for instruction in &self.instructions {
            let of = |operand| fetch(operand, p, around, &kept);
            let value = match instruction.operation {
                Operation::Add(a, b) => of(a) + of(b),
                Operation::Subtract(a, b) => of(a) - of(b),
                Operation::Multiply(a, b) => of(a) * of(b),
                Operation::Divide(a, b) => of(a) / of(b),
                Operation::Shift(a, by) => of(a) + by,
                Operation::Scale(a, by) => of(a) * by,
                Operation::WholePower(a, exponent) => of(a).power(exponent),
                Operation::RealPower(a, exponent) => of(a).real_power(exponent),
                Operation::Power(a, b) => of(a).power_of(of(b)),
                Operation::Call(function, a, b) => function.of(of(a), of(b)),
            };
            kept[instruction.to] = value;
        }
        fetch(self.result, p, around, &kept)
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

#[inline(always)]
fn fetch<N: Number>(operand: Operand, p: &[N], around: &Surroundings<N>, kept: &[N]) -> N {
    let at = around.at;
    match operand {
        Operand::Temporary(index) => kept[index],
        Operand::Parameter(index) => p[index],
        Operand::Constant(value) => N::from(value),
        Operand::Variable(variable) => match variable {
            Variable::X => at.x_m,
            Variable::V => at.v_m_per_s,
            Variable::Torque => at.torque_nm,
            Variable::Time => N::from(at.since_onset_s),
            Variable::Theta => at.x_m * (1.0 / at.lever_arm_m),
            Variable::Omega => at.v_m_per_s * (1.0 / at.lever_arm_m),
            Variable::Lever => N::from(at.lever_arm_m),
            Variable::Acceleration => around
                .acceleration_rad_per_s2
                .expect("only what the sensor adds may name the acceleration"),
        },
    }
}
