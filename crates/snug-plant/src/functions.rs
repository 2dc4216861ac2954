//! Snug's functions inside the engine: what a row, a group and a sum of rows answer, the same on every machine that has them.

pub(crate) mod block;
pub(crate) mod fit;
mod outcome;
pub(crate) mod question;
pub(crate) mod results;
pub(crate) mod sum;

use datafusion::logical_expr::ScalarUDF;

/// Functions of single rows.
pub(crate) fn scalar_functions() -> [ScalarUDF; 3] {
    [
        fit::function(),
        block::block_function(),
        block::group_function(),
    ]
}
