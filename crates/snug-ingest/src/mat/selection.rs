//! Some variables of a file, and what is known of the others.

use super::{MatFile, MatFormat, Value, Variable};
use crate::error::IngestError;
use crate::memory::Budget;

/// The variables of a MAT file that were asked for.
#[derive(Debug)]
pub struct MatSelection {
    /// The file's format.
    pub format: MatFormat,
    /// The variables that were asked for and could be read, in file order (7.3: by name).
    pub variables: Vec<Variable>,
    /// The names of all variables in the file, asked for or not.
    pub present: Vec<String>,
    /// The variables that were asked for and could not be read.
    pub unreadable: Vec<UnreadableVariable>,
}

/// A variable that is there, but damaged.
#[derive(Debug)]
pub struct UnreadableVariable {
    /// Its name.
    pub name: String,
    /// What is wrong with it.
    pub reason: IngestError,
}

/// Whether a variable of this name is asked for.
pub(super) type Wanted<'a> = &'a dyn Fn(&str) -> bool;

impl MatSelection {
    pub(super) fn new(format: MatFormat) -> Self {
        Self {
            format,
            variables: Vec::new(),
            present: Vec::new(),
            unreadable: Vec::new(),
        }
    }

    /// Notes that a variable is there; says whether it is `wanted`.
    pub(super) fn note(
        &mut self,
        name: &str,
        wanted: Wanted<'_>,
        budget: &Budget,
    ) -> Result<bool, IngestError> {
        budget.spend("the names of the variables", name.len() as u64)?;
        budget.push(
            "the names of the variables",
            &mut self.present,
            name.to_owned(),
        )?;
        Ok(wanted(name))
    }

    /// Keeps what reading a wanted variable gave.
    ///
    /// # Errors
    /// [`IngestError::OverBudget`], [`IngestError::Read`]: these are not the variable's fault, and the next one would
    /// meet them too.
    pub(super) fn keep(
        &mut self,
        name: String,
        read: Result<Variable, IngestError>,
        budget: &Budget,
    ) -> Result<(), IngestError> {
        match read {
            Ok(variable) => budget.push("the variables", &mut self.variables, variable),
            Err(reason) if reason.is_of_the_file() => Err(reason),
            Err(reason) => budget.push(
                "the variables",
                &mut self.unreadable,
                UnreadableVariable { name, reason },
            ),
        }
    }

    /// As [`MatSelection::keep`], and gives back what only reading took: the `stored` bytes, or all since `before`.
    pub(super) fn keep_stored(
        &mut self,
        name: String,
        read: Result<Variable, IngestError>,
        budget: &Budget,
        before: u64,
        stored: u64,
    ) -> Result<(), IngestError> {
        match &read {
            Ok(_) => budget.give_back(stored),
            Err(_) => budget.back_to(before),
        }
        self.keep(name, read, budget)
    }

    /// Takes the first variable with this exact name out, or why it could not be read.
    pub(crate) fn take(&mut self, name: &str) -> Option<Result<Value, IngestError>> {
        if let Some(index) = self.unreadable.iter().position(|v| v.name == name) {
            return Some(Err(self.unreadable.swap_remove(index).reason));
        }
        let index = self.variables.iter().position(|v| v.name == name)?;
        Some(Ok(self.variables.remove(index).value))
    }

    /// Everything, if nothing is damaged.
    pub(super) fn whole(self) -> Result<MatFile, IngestError> {
        match self.unreadable.into_iter().next() {
            Some(damaged) => Err(damaged.reason),
            None => Ok(MatFile {
                format: self.format,
                variables: self.variables,
            }),
        }
    }
}
