//! Which tightening is meant.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Which tightening: the file and the 1-based number within it.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TighteningId {
    /// File name without its folder.
    pub file: String,
    /// 1-based number within the file.
    pub number: u32,
}

impl fmt::Display for TighteningId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} #{}", self.file, self.number)
    }
}
