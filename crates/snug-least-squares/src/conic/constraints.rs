//! The convex set that parameters stay in: bounds, linear inequalities and rotated second-order cones, each with a name.

use crate::conic::thresholds::NO_VIOLATION;
use crate::error::SolveError;
use crate::matrix::dot;

/// An affine function of the parameters, constant + coefficients · p.
#[derive(Debug, Clone, PartialEq)]
pub struct Affine {
    /// Value at p = 0.
    pub constant: f64,
    /// One factor per parameter.
    pub coefficients: Vec<f64>,
}

impl Affine {
    /// The same value everywhere.
    pub fn constant(parameter_count: usize, value: f64) -> Self {
        Self {
            constant: value,
            coefficients: vec![0.0; parameter_count],
        }
    }

    /// factor · p\[parameter\] + constant.
    pub fn term(parameter_count: usize, parameter: usize, factor: f64, constant: f64) -> Self {
        let mut affine = Self::constant(parameter_count, constant);
        affine.coefficients[parameter] = factor;
        affine
    }

    /// Value at p.
    pub fn at(&self, parameters: &[f64]) -> f64 {
        self.constant + dot(&self.coefficients, parameters)
    }

    /// Sum of the magnitudes of its terms at p: what its rounding is relative to.
    fn magnitude(&self, parameters: &[f64]) -> f64 {
        let terms = self.coefficients.iter().zip(parameters);
        self.constant.abs() + terms.map(|(a, p)| (a * p).abs()).sum::<f64>()
    }
}

/// Minimum and maximum of one parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    pub name: String,
    pub minimum: f64,
    pub maximum: f64,
}

/// coefficients · p ≤ limit.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearInequality {
    pub name: String,
    pub coefficients: Vec<f64>,
    pub limit: f64,
}

/// w² ≤ 4 u v with u, v ≥ 0; w already carries the margin.
#[derive(Debug, Clone, PartialEq)]
pub struct RotatedCone {
    pub name: String,
    pub u: Affine,
    pub v: Affine,
    pub w: Affine,
}

/// A convex set of parameter values: bounds, linear inequalities and rotated second-order cones.
///
/// ```
/// use snug_least_squares::{Affine, Constraints};
/// // Mass, damping and stiffness at least zero, and lightly damped: (c l²)² < 4 k l² (I_n + m l²).
/// let (l2, tool_inertia_kg_m2) = (0.33_f64.powi(2), 0.275);
/// let mut set = Constraints::new(3);
/// for (index, name) in ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"].iter().enumerate() {
///     set.bound(index, 0.0, f64::INFINITY, *name);
/// }
/// let stiffness = Affine::term(3, 2, l2, 0.0);
/// let inertia = Affine::term(3, 0, l2, tool_inertia_kg_m2);
/// set.rotated_cone("light_damping", stiffness, inertia, Affine::term(3, 1, l2, 0.0));
/// assert!(set.contains(&[1.76, 38.26, 1837.27]));
/// assert!(!set.contains(&[1.76, 380.0, 1837.27]));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Constraints {
    pub(crate) bounds: Vec<Bound>,
    pub(crate) linear: Vec<LinearInequality>,
    pub(crate) cones: Vec<RotatedCone>,
}

impl Constraints {
    /// A rotated cone is kept strict by this relative margin: (w (1 + margin))² ≤ 4 u v.
    pub const STRICT_MARGIN: f64 = 1e-6;

    /// No constraint on `parameter_count` parameters.
    pub fn new(parameter_count: usize) -> Self {
        let free = |index| Bound {
            name: format!("parameter {index}"),
            minimum: f64::NEG_INFINITY,
            maximum: f64::INFINITY,
        };
        Self {
            bounds: (0..parameter_count).map(free).collect(),
            linear: Vec::new(),
            cones: Vec::new(),
        }
    }

    /// Minimum and maximum of one parameter; infinite where there is none.
    pub fn bounds_of(&self, parameter: usize) -> (f64, f64) {
        let bound = &self.bounds[parameter];
        (bound.minimum, bound.maximum)
    }

    /// Number of parameters.
    pub fn parameter_count(&self) -> usize {
        self.bounds.len()
    }

    /// minimum ≤ p\[parameter\] ≤ maximum, besides what was asked before; an infinite limit is none.
    ///
    /// The constraint is called `name minimum` or `name maximum` when it is active. Estimates satisfy it exactly.
    pub fn bound(
        &mut self,
        parameter: usize,
        minimum: f64,
        maximum: f64,
        name: impl Into<String>,
    ) -> &mut Self {
        let bound = &mut self.bounds[parameter];
        bound.name = name.into();
        bound.minimum = bound.minimum.max(minimum);
        bound.maximum = bound.maximum.min(maximum);
        self
    }

    /// coefficients · p ≤ limit, kept to rounding.
    pub fn linear(
        &mut self,
        name: impl Into<String>,
        coefficients: &[f64],
        limit: f64,
    ) -> &mut Self {
        self.linear.push(LinearInequality {
            name: name.into(),
            coefficients: coefficients.to_vec(),
            limit,
        });
        self
    }

    /// w² < 4 u v with u, v ≥ 0, kept strict by [`Constraints::STRICT_MARGIN`].
    pub fn rotated_cone(
        &mut self,
        name: impl Into<String>,
        u: Affine,
        v: Affine,
        mut w: Affine,
    ) -> &mut Self {
        let strict = 1.0 + Self::STRICT_MARGIN;
        w.constant *= strict;
        w.coefficients.iter_mut().for_each(|value| *value *= strict);
        self.cones.push(RotatedCone {
            name: name.into(),
            u,
            v,
            w,
        });
        self
    }

    /// Whether p satisfies every constraint, bounds exactly and the others to 1e-12 of their terms.
    pub fn contains(&self, parameters: &[f64]) -> bool {
        let bounds = self.bounds.iter().zip(parameters);
        bounds
            .into_iter()
            .all(|(bound, p)| (bound.minimum..=bound.maximum).contains(p))
            && self.linear.iter().all(|row| row.holds(parameters))
            && self.cones.iter().all(|cone| cone.holds(parameters))
    }

    /// Moves p to the nearest bound where it is outside.
    pub fn clamp(&self, parameters: &mut [f64]) {
        for (bound, p) in self.bounds.iter().zip(parameters) {
            *p = p.max(bound.minimum).min(bound.maximum);
        }
    }

    /// Number of single inequalities ("inequalities"): two per parameter, then linear ones, then cones.
    pub fn inequality_count(&self) -> usize {
        2 * self.bounds.len() + self.linear.len() + self.cones.len()
    }

    /// What to call an inequality in a result.
    pub fn inequality_name(&self, inequality: usize) -> String {
        let bounds = 2 * self.bounds.len();
        if inequality < bounds {
            let side = ["minimum", "maximum"][inequality % 2];
            return format!("{} {side}", self.bounds[inequality / 2].name);
        }
        let rest = inequality - bounds;
        match self.linear.get(rest) {
            Some(row) => row.name.clone(),
            None => self.cones[rest - self.linear.len()].name.clone(),
        }
    }

    /// Refuses a minimum above its maximum and a set over another number of parameters.
    pub fn check(&self, parameter_count: usize) -> Result<(), SolveError> {
        let dimension = |what, found| SolveError::Dimension {
            what,
            expected: parameter_count,
            found,
        };
        if self.bounds.len() != parameter_count {
            return Err(dimension("the set of constraints", self.bounds.len()));
        }
        for bound in &self.bounds {
            if bound.minimum > bound.maximum {
                return Err(SolveError::EmptyBounds {
                    name: bound.name.clone(),
                    minimum: bound.minimum,
                    maximum: bound.maximum,
                });
            }
        }
        let rows = self.linear.iter().map(|row| row.coefficients.len());
        let cones = (self.cones.iter()).flat_map(|cone| [&cone.u, &cone.v, &cone.w]);
        match (rows.chain(cones.map(|affine| affine.coefficients.len())))
            .find(|&found| found != parameter_count)
        {
            Some(found) => Err(dimension("a constraint", found)),
            None => Ok(()),
        }
    }
}

impl LinearInequality {
    fn holds(&self, parameters: &[f64]) -> bool {
        let terms = self.coefficients.iter().zip(parameters);
        let magnitude: f64 = terms.map(|(a, p)| (a * p).abs()).sum();
        dot(&self.coefficients, parameters) - self.limit
            <= NO_VIOLATION * (magnitude + self.limit.abs())
    }
}

impl RotatedCone {
    fn holds(&self, parameters: &[f64]) -> bool {
        let [u, v, w] = [&self.u, &self.v, &self.w].map(|affine| affine.at(parameters));
        let [u_size, v_size, w_size] =
            [&self.u, &self.v, &self.w].map(|affine| NO_VIOLATION * affine.magnitude(parameters));
        u >= -u_size
            && v >= -v_size
            && w.abs() <= 2.0 * ((u + u_size).max(0.0) * (v + v_size).max(0.0)).sqrt() + w_size
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn cone() -> Constraints {
        let mut set = Constraints::new(3);
        let [u, v, w] = [0, 1, 2].map(|index| Affine::term(3, index, 1.0, 0.0));
        set.rotated_cone("cone", u, v, w);
        set
    }

    #[test]
    fn the_cone_is_strict_by_its_margin() {
        let set = cone();
        assert!(set.contains(&[1.0, 4.0, 4.0 * (1.0 - 1.1e-6)]));
        assert!(!set.contains(&[1.0, 4.0, 4.0 * (1.0 - 0.9e-6)]));
        assert!(
            !set.contains(&[-1.0, -4.0, 0.0]),
            "both factors negative is outside"
        );
        assert!(set.contains(&[0.0, 0.0, 0.0]));
    }

    #[test]
    fn faces_have_names_in_order() {
        let mut set = cone();
        set.bound(1, 0.0, 5.0, "v").linear("sum", &[1.0; 3], 9.0);
        let names: Vec<_> = (0..set.inequality_count())
            .map(|inequality| set.inequality_name(inequality))
            .collect();
        assert_eq!(names[2..4], ["v minimum", "v maximum"]);
        assert_eq!(names[6..], ["sum", "cone"]);
    }

    #[test]
    fn impossible_sets_are_refused() {
        let mut set = Constraints::new(1);
        set.bound(0, 0.0, 3.0, "m").bound(0, 4.0, 9.0, "m");
        assert!(matches!(set.check(1), Err(SolveError::EmptyBounds { .. })));
        assert!(matches!(cone().check(2), Err(SolveError::Dimension { .. })));
    }
}
