//! What a check found.

/// Something that is wrong, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The file to change, from the workspace's folder.
    pub file: String,
    /// What is wrong.
    pub what: String,
    /// What puts it right.
    pub remedy: String,
}

/// What one check found.
#[derive(Debug)]
pub struct Outcome {
    /// Name of the check.
    pub check: &'static str,
    /// What was looked at, in one line.
    pub summary: String,
    /// What the check could not see; fails nothing, but is always said.
    pub gaps: Vec<String>,
    /// What is worth knowing and fails nothing.
    pub notes: Vec<String>,
    /// What is wrong; none when all is well.
    pub problems: Vec<Problem>,
}
