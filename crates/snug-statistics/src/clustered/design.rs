//! Observations with their levels and clusters, as a design matrix.

use std::fmt::Display;
use std::ops::Range;

use crate::sample::{check_finite, check_lengths};
use crate::{Result, StatisticsError};

/// Design matrix of a linear model, built term by term; its first column is the intercept.
///
/// Factors are treatment-coded: one 0/1 column per level but the first in sort order, so a
/// coefficient is a level's difference from that reference level.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    rows: usize,
    columns: Vec<Vec<f64>>,
    names: Vec<String>,
    terms: Vec<(String, Range<usize>)>,
}

impl Design {
    /// The design that holds the intercept only.
    #[must_use]
    pub fn intercept(rows: usize) -> Self {
        let name = "intercept".to_owned();
        Self {
            rows,
            columns: vec![vec![1.0; rows]],
            names: vec![name.clone()],
            terms: vec![(name, 0..1)],
        }
    }

    /// Adds a numeric column.
    ///
    /// # Errors
    /// [`StatisticsError::LengthMismatch`], [`StatisticsError::NotFinite`],
    /// [`StatisticsError::DuplicateTerm`].
    pub fn covariate(self, name: &str, values: &[f64]) -> Result<Self> {
        check_lengths(("design", self.rows), ("values", values.len()))?;
        check_finite("values", values)?;
        self.with_term(name, vec![(name.to_owned(), values.to_vec())])
    }

    /// Adds a factor with one label per row; columns are named `name[level]`.
    ///
    /// # Errors
    /// [`StatisticsError::LengthMismatch`], [`StatisticsError::TooFewGroups`] below two levels,
    /// [`StatisticsError::DuplicateTerm`].
    pub fn factor<L: Ord + Display>(self, name: &str, labels: &[L]) -> Result<Self> {
        check_lengths(("design", self.rows), ("labels", labels.len()))?;
        let mut levels: Vec<&L> = labels.iter().collect();
        levels.sort();
        levels.dedup();
        if levels.len() < 2 {
            return Err(StatisticsError::TooFewGroups {
                method: "factor",
                what: "levels",
                required: 2,
                found: levels.len(),
            });
        }
        let column = |level: &&L| {
            let indicator = |label: &L| if label == *level { 1.0 } else { 0.0 };
            (
                format!("{name}[{level}]"),
                labels.iter().map(indicator).collect(),
            )
        };
        let columns = levels[1..].iter().map(column).collect();
        self.with_term(name, columns)
    }

    fn with_term(mut self, name: &str, columns: Vec<(String, Vec<f64>)>) -> Result<Self> {
        if self.terms.iter().any(|(term, _)| term == name) {
            return Err(StatisticsError::DuplicateTerm {
                term: name.to_owned(),
            });
        }
        let start = self.columns.len();
        for (name, values) in columns {
            self.names.push(name);
            self.columns.push(values);
        }
        self.terms
            .push((name.to_owned(), start..self.columns.len()));
        Ok(self)
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Names of the columns.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The columns, each of length [`Self::rows`].
    #[must_use]
    pub fn columns(&self) -> &[Vec<f64>] {
        &self.columns
    }

    /// Positions of a term's columns.
    ///
    /// # Errors
    /// [`StatisticsError::UnknownTerm`].
    pub fn term(&self, name: &str) -> Result<Range<usize>> {
        self.terms
            .iter()
            .find(|(term, _)| term == name)
            .map(|(_, columns)| columns.clone())
            .ok_or_else(|| StatisticsError::UnknownTerm {
                term: name.to_owned(),
            })
    }

    /// The contrasts that are all zero when a term has no effect: one unit row per column.
    pub(super) fn term_contrasts(&self, name: &str) -> Result<Vec<Vec<f64>>> {
        let unit = |column: usize| {
            let mut row = vec![0.0; self.columns.len()];
            row[column] = 1.0;
            row
        };
        Ok(self.term(name)?.map(unit).collect())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn factors_are_coded_against_their_first_level() {
        let design = Design::intercept(4)
            .factor("joint", &["soft", "hard", "soft", "hard"])
            .unwrap()
            .covariate("pace", &[8.0, 8.0, 12.0, 12.0])
            .unwrap();
        assert_eq!(design.names(), ["intercept", "joint[soft]", "pace"]);
        assert_eq!(design.columns()[1], [1.0, 0.0, 1.0, 0.0]);
        assert_eq!(design.columns()[2], [8.0, 8.0, 12.0, 12.0]);
        assert_eq!(design.term("pace").unwrap(), 2..3);
    }

    #[test]
    fn wrong_terms_are_named() {
        let design = Design::intercept(2);
        let one = design.clone().factor("joint", &["soft", "soft"]);
        assert!(matches!(
            one,
            Err(StatisticsError::TooFewGroups { found: 1, .. })
        ));
        let short = design.clone().covariate("pace", &[1.0]);
        assert!(matches!(short, Err(StatisticsError::LengthMismatch { .. })));
        let twice = design.clone().covariate("intercept", &[1.0, 2.0]);
        assert!(matches!(twice, Err(StatisticsError::DuplicateTerm { .. })));
        assert!(matches!(
            design.term("pace"),
            Err(StatisticsError::UnknownTerm { .. })
        ));
    }
}
