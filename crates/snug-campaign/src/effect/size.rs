//! How large an effect is: its parameters, and their sizes where groups of tightenings differ.

use crate::tightening::factor::Factor;
use serde::{Deserialize, Serialize};

/// A parameter of an effect, estimated from all tightenings together; numbers in its unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EffectParameter {
    /// Name with unit suffix.
    pub name: String,
    /// What it is, in a few words, as its effect says it; empty where nothing says it.
    #[serde(default)]
    pub meaning: String,
    /// Unit as people write it.
    pub unit: String,
    /// Estimate; of a parameter that every tightening has of its own, the mean.
    pub value: f64,
    /// Lower end of its 95 % interval.
    pub low: Option<f64>,
    /// Upper end of its 95 % interval.
    pub high: Option<f64>,
    /// Standard error; `None` where the estimate lies on a bound.
    pub standard_error: Option<f64>,
    /// True when every tightening has its own.
    pub per_tightening: bool,
    /// Standard deviation between tightenings, of a parameter that every tightening has of its own.
    pub spread: Option<f64>,
    /// Smallest plausible value.
    pub minimum: f64,
    /// Largest plausible value.
    pub maximum: f64,
    /// The size of each group, of a parameter that differs from group to group; `value` is their mean then, `spread` the standard
    /// deviation between them beyond their own errors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by_group: Option<GroupSizes>,
}

impl EffectParameter {
    /// Whether its value lies where one expects it.
    pub fn is_plausible(&self) -> bool {
        (self.minimum..=self.maximum).contains(&self.value)
    }

    /// The same with every number multiplied by `factor`, as in another unit.
    pub(crate) fn times(&self, factor: f64) -> Self {
        let scaled = |value: Option<f64>| value.map(|value| value * factor);
        Self {
            value: self.value * factor,
            low: scaled(self.low),
            high: scaled(self.high),
            standard_error: scaled(self.standard_error),
            spread: scaled(self.spread),
            minimum: self.minimum * factor,
            maximum: self.maximum * factor,
            by_group: self.by_group.as_ref().map(|sizes| sizes.times(factor)),
            ..self.clone()
        }
    }
}

/// The sizes of a parameter that differs between groups of tightenings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GroupSizes {
    /// What groups them.
    pub factor: Factor,
    /// In the order of the groups.
    pub groups: Vec<GroupSize>,
    /// Where it changes at a number or place: between which the later size begins, at 95 %.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub change: Option<ChangePoint>,
}

impl GroupSizes {
    /// Every group's size multiplied by `factor`.
    fn times(&self, factor: f64) -> Self {
        let scaled = |value: Option<f64>| value.map(|value| value * factor);
        let group = |one: &GroupSize| GroupSize {
            value: one.value * factor,
            shrunk: one.shrunk * factor,
            standard_error: scaled(one.standard_error),
            low: scaled(one.low),
            high: scaled(one.high),
            ..one.clone()
        };
        Self {
            groups: self.groups.iter().map(group).collect(),
            ..self.clone()
        }
    }
}

/// Where a size changes: the 95 % interval of the first tightening that has the later one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChangePoint {
    /// It may be this one: a number within the file, or file and number.
    pub first: String,
    /// Or one of those up to this one.
    pub last: String,
}

/// The size of one group; numbers in the parameter's unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GroupSize {
    /// Which group, for example `TP3`.
    pub group: String,
    /// Its tightenings.
    pub tightenings: usize,
    /// Its own estimate.
    pub value: f64,
    /// Its standard error.
    pub standard_error: Option<f64>,
    /// The same, shrunk towards the mean of all groups as far as its error asks.
    pub shrunk: f64,
    /// Lower end of its own 95 % interval.
    pub low: Option<f64>,
    /// Upper end of its own 95 % interval; `None` beside a lower one where it has none.
    pub high: Option<f64>,
    /// Whether the effect is there: told from nothing, with one false discovery in two hundred over the groups.
    pub present: bool,
}

impl GroupSize {
    /// Whether its interval has no upper end: the larger such a size, as of a mass that hardly moves, the less there is of the effect, and
    /// this may be nothing.
    pub fn is_without_end(&self) -> bool {
        self.low.is_some() && self.high.is_none()
    }
}

/// How tightenings share the sizes of an effect: `shared`, `per tightening`, `per participant` and so on, or `before and from
/// number 13 on`.
pub fn sharing(parameters: &[EffectParameter]) -> String {
    let factor = parameters.iter().find_map(|one| one.by_group.as_ref());
    match factor {
        Some(sizes) => sizes.factor.sharing(),
        None if parameters.iter().any(|one| one.per_tightening) => "per tightening".to_owned(),
        None => "shared".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_single_tools_are_told_in_another_unit_too() {
        let tool = GroupSize {
            group: "tool 2".into(),
            tightenings: 4,
            value: 2.0,
            standard_error: Some(0.1),
            shrunk: 1.9,
            low: Some(1.8),
            high: Some(2.2),
            present: true,
        };
        let sizes = GroupSizes {
            factor: Factor::File,
            groups: vec![tool],
            change: None,
        };
        let told = &sizes.times(0.5).groups[0];
        assert_eq!((told.value, told.shrunk), (1.0, 0.95));
        assert_eq!((told.low, told.high), (Some(0.9), Some(1.1)));
        assert_eq!((told.standard_error, told.tightenings), (Some(0.05), 4));
    }
}
