//! Laws that a study writes itself, such as `p*x^2*v`: read, simplified and compiled once, evaluated at every step.

mod name;
mod parser;
mod program;
mod token;
mod tree;

pub use name::Variable;
pub use program::{Program, Surroundings};

/// What is wrong with an expression, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// Character at which it shows, counted from 1.
    pub position: usize,
    /// What stands there.
    pub found: String,
    /// What may stand there.
    pub allowed: String,
}

/// Compiles `text`, in which `parameters` (in this order) and `variables` are known by name.
pub fn compile(text: &str, parameters: &[&str], variables: &[Variable]) -> Result<Program, Fault> {
    let tree = parser::parse(text, parameters, variables)?;
    Program::new(&tree).ok_or_else(|| Fault {
        position: 1,
        found: "an expression that needs too many intermediate results".to_owned(),
        allowed: format!("at most {} at a time", program::MAXIMUM_TEMPORARIES),
    })
}

/// Whether the language of expressions uses `name` for something else than a parameter.
pub fn is_reserved(name: &str) -> bool {
    Variable::named(name).is_some()
        || name::Function::named(name).is_some()
        || name::constant(name).is_some()
}

/// Whether `name` can be written in an expression: a letter, then letters, digits and underscores.
pub fn is_name(name: &str) -> bool {
    name.starts_with(|first: char| first.is_ascii_alphabetic())
        && name
            .chars()
            .all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
}

#[cfg(test)]
mod tests;
