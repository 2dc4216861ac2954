//! Why a statistic cannot be computed.

use crate::Sample;

/// Why a statistic could not be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StatisticsError {
    /// A sample holds fewer values than the method needs (an empty one holds none).
    #[error("{sample} holds {found} values; {method} needs at least {required}")]
    TooFew {
        /// Which sample.
        sample: Sample,
        /// The method that was asked for.
        method: &'static str,
        /// Smallest number of values it works with.
        required: usize,
        /// Number of values given.
        found: usize,
    },
    /// A sample holds more values than the method's approximation is valid for.
    #[error("{sample} holds {found} values; {method} is valid up to {limit}")]
    TooMany {
        /// Which sample.
        sample: Sample,
        /// The method that was asked for.
        method: &'static str,
        /// Largest number of values it is valid for.
        limit: usize,
        /// Number of values given.
        found: usize,
    },
    /// A value is NaN, infinite, or so large that its square would overflow (beyond 1e150).
    #[error("{sample}: value {index} is {value}, not a number that can be squared")]
    NotFinite {
        /// Which sample.
        sample: Sample,
        /// Position in the sample, counted from 0.
        index: usize,
        /// The value found.
        value: f64,
    },
    /// All values are the same where the method divides by their spread.
    #[error("{sample} does not vary, and {method} divides by its spread")]
    ZeroVariance {
        /// Which sample.
        sample: Sample,
        /// The method that was asked for.
        method: &'static str,
    },
    /// There are too few groups, clusters or levels.
    #[error("{method} needs at least {required} {what}; {found} given")]
    TooFewGroups {
        /// The method that was asked for.
        method: &'static str,
        /// What is counted: groups, clusters, levels.
        what: &'static str,
        /// Smallest number it works with.
        required: usize,
        /// Number given.
        found: usize,
    },
    /// Two arguments that run in step have different lengths.
    #[error("`{left}` has {left_length} entries, `{right}` has {right_length}")]
    LengthMismatch {
        /// The first argument.
        left: &'static str,
        /// Its length.
        left_length: usize,
        /// The second argument.
        right: &'static str,
        /// Its length.
        right_length: usize,
    },
    /// An argument lies outside what is allowed.
    #[error("`{argument}` is {value}; allowed: {allowed}")]
    OutOfRange {
        /// The argument.
        argument: &'static str,
        /// The value given.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// A column of the design matrix is a linear combination of the columns before it.
    #[error("column `{column}` of the design is determined by the columns before it")]
    RankDeficient {
        /// Name of the first such column.
        column: String,
    },
    /// A term of that name is not in the design.
    #[error("the design has no term `{term}`")]
    UnknownTerm {
        /// The name asked for.
        term: String,
    },
    /// A term of that name is in the design already.
    #[error("the design has a term `{term}` already")]
    DuplicateTerm {
        /// The name given twice.
        term: String,
    },
    /// Too few rows are left over after the coefficients.
    #[error("{rows} rows in {clusters} clusters leave no {what} for {columns} coefficients")]
    NoFreedomLeft {
        /// What is lacking.
        what: &'static str,
        /// Rows of the design.
        rows: usize,
        /// Clusters among them.
        clusters: usize,
        /// Columns of the design.
        columns: usize,
    },
    /// The variance within the clusters is nil beside the variance between them.
    #[error("rows of one cluster do not differ beyond the model (variance ratio above {limit:e})")]
    VarianceRatioUnbounded {
        /// Largest ratio between/within that is searched.
        limit: f64,
    },
    /// A covariance of contrasts cannot be inverted: a contrast is zero or repeats another.
    #[error(
        "the {contrasts} contrasts are linearly dependent or not estimable from {clusters} clusters"
    )]
    DependentContrasts {
        /// Number of contrasts given.
        contrasts: usize,
        /// Number of clusters.
        clusters: usize,
    },
}

/// Result of this crate's functions.
pub type Result<T, E = StatisticsError> = std::result::Result<T, E>;
