//! A cell's number, with decimal point or comma.

use serde::{Deserialize, Serialize};

/// How decimals are written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Decimal {
    /// With a point, or with a comma where there is no point.
    #[default]
    Auto,
    /// With a point only.
    Point,
    /// With a comma only; points between thousands are passed over.
    Comma,
}

impl Decimal {
    /// The number that a cell holds.
    pub(crate) fn parse(self, cell: &str) -> Option<f64> {
        let cell = cell.trim_matches([' ', '\t', '"']);
        match self {
            Self::Point => cell.parse().ok(),
            Self::Comma => cell.replace('.', "").replace(',', ".").parse().ok(),
            Self::Auto => cell
                .parse()
                .ok()
                .or_else(|| cell.replacen(',', ".", 1).parse().ok()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_commas_and_neither() {
        for (decimal, cell, number) in [
            (Decimal::Auto, " -1.5e-3 ", Some(-1.5e-3)),
            (Decimal::Auto, "1,5", Some(1.5)),
            (Decimal::Auto, "1.234,5", None),
            (Decimal::Auto, "", None),
            (Decimal::Auto, "off", None),
            (Decimal::Point, "1,5", None),
            (Decimal::Comma, "1.234,5", Some(1234.5)),
            (Decimal::Comma, "-0,25E1", Some(-2.5)),
        ] {
            assert_eq!(decimal.parse(cell), number, "{decimal:?} {cell:?}");
        }
        assert!(Decimal::Auto.parse("NaN").is_some_and(f64::is_nan));
    }
}
