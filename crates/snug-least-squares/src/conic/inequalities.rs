//! The single convex inequalities of a set of constraints, the inequalities, in scaled coordinates z.

use crate::conic::constraints::{Bound, Constraints};
use crate::matrix::{dot, norm};

/// One convex inequality g(z) ≤ 0.
#[derive(Debug, Clone)]
pub enum Inequality {
    /// normal · z − limit, with a unit normal.
    Plane { normal: Vec<f64>, limit: f64 },
    /// ‖(w, u − v)‖ − (u + v), which is w² ≤ 4 u v with u, v ≥ 0.
    Cone(Cone),
}

/// Rows (u + v, u − v, w), each constant + slope · z; u and v are balanced to similar size.
#[derive(Debug, Clone)]
pub struct Cone {
    pub constants: [f64; 3],
    pub slopes: [Vec<f64>; 3],
}

impl Inequality {
    /// g(z).
    pub fn value(&self, z: &[f64]) -> f64 {
        match self {
            Inequality::Plane { normal, limit } => dot(normal, z) - limit,
            Inequality::Cone(cone) => {
                let [sum, difference, w] = cone.rows(z);
                difference.hypot(w) - sum
            }
        }
    }

    /// Writes ∇g(z). At the tip of a cone, where there is none, the axis' downward slope.
    pub fn gradient(&self, z: &[f64], gradient: &mut [f64]) {
        match self {
            Inequality::Plane { normal, .. } => gradient.copy_from_slice(normal),
            Inequality::Cone(cone) => {
                let [_, difference, w] = cone.rows(z);
                let length = difference.hypot(w);
                let (a, b) = match length {
                    0.0 => (0.0, 0.0),
                    _ => (difference / length, w / length),
                };
                for (index, slope) in gradient.iter_mut().enumerate() {
                    *slope = a * cone.slopes[1][index] + b * cone.slopes[2][index]
                        - cone.slopes[0][index];
                }
            }
        }
    }

    /// A smooth function that vanishes where g does, with its gradient: g itself, or w² + (u − v)² − (u + v)² for a cone.
    /// Newton's method likes it better than g, whose curvature is unbounded near the tip.
    pub fn equation(&self, z: &[f64], gradient: &mut [f64]) -> f64 {
        let Inequality::Cone(cone) = self else {
            self.gradient(z, gradient);
            return self.value(z);
        };
        let [sum, difference, w] = cone.rows(z);
        for (index, slope) in gradient.iter_mut().enumerate() {
            let [s, d, w_slope] = [0, 1, 2].map(|row| cone.slopes[row][index]);
            *slope = 2.0 * (w * w_slope + difference * d - sum * s);
        }
        w * w + difference * difference - sum * sum
    }

    /// Adds weight · ∇² of that function.
    pub fn add_curvature(&self, weight: f64, matrix: &mut [f64]) {
        let Inequality::Cone(cone) = self else { return };
        let [sum, difference, w] = &cone.slopes;
        let n = w.len();
        for column in 0..n {
            for row in 0..n {
                let square = w[row] * w[column] + difference[row] * difference[column];
                matrix[column * n + row] += 2.0 * weight * (square - sum[row] * sum[column]);
            }
        }
    }

    /// What a multiplier of that function must be multiplied with to become one of g, on the inequality.
    pub fn multiplier_ratio(&self, z: &[f64]) -> f64 {
        match self {
            Inequality::Plane { .. } => 1.0,
            Inequality::Cone(cone) => 2.0 * cone.rows(z)[0],
        }
    }

    /// g(z)/‖∇g(z)‖: how far z is outside, to first order.
    pub fn distance(&self, z: &[f64], scratch: &mut [f64]) -> f64 {
        self.gradient(z, scratch);
        self.value(z) / norm(scratch).max(f64::MIN_POSITIVE)
    }
}

impl Cone {
    fn rows(&self, z: &[f64]) -> [f64; 3] {
        [0, 1, 2].map(|row| self.constants[row] + dot(&self.slopes[row], z))
    }
}

/// The inequalities of `constraints` around `parameters`, in coordinates z with p = parameters + unit ∘ z.
pub fn inequalities(
    constraints: &Constraints,
    parameters: &[f64],
    unit: &[f64],
) -> Vec<Option<Inequality>> {
    let n = parameters.len();
    let mut inequalities = Vec::with_capacity(constraints.inequality_count());
    for (index, bound) in constraints.bounds.iter().enumerate() {
        for (sign, limit) in [(-1.0, bound.minimum), (1.0, bound.maximum)] {
            inequalities.push(limit.is_finite().then(|| {
                let mut normal = vec![0.0; n];
                normal[index] = sign;
                Inequality::Plane {
                    normal,
                    limit: sign * (limit - parameters[index]) / unit[index],
                }
            }));
        }
    }
    let scaled = |coefficients: &[f64]| -> Vec<f64> {
        coefficients.iter().zip(unit).map(|(a, u)| a * u).collect()
    };
    for row in &constraints.linear {
        let mut normal = scaled(&row.coefficients);
        let length = norm(&normal).max(f64::MIN_POSITIVE);
        normal.iter_mut().for_each(|value| *value /= length);
        let limit = (row.limit - dot(&row.coefficients, parameters)) / length;
        inequalities.push(Some(Inequality::Plane { normal, limit }));
    }
    for cone in &constraints.cones {
        let affine = [&cone.u, &cone.v, &cone.w];
        let values = affine.map(|a| a.at(parameters));
        let slopes = affine.map(|a| scaled(&a.coefficients));
        inequalities.push(Some(Inequality::Cone(balanced(values, slopes))));
    }
    inequalities
}

/// Scales u by s and v by 1/s so that both are of the same size, then everything so that this size is 1.
fn balanced(values: [f64; 3], slopes: [Vec<f64>; 3]) -> Cone {
    let size = |row: usize| {
        let reach = norm(&slopes[row]);
        let size = values[row].abs().max(1e-6 * reach);
        if size > 0.0 { size } else { 1.0 }
    };
    let (u_size, v_size) = (size(0), size(1));
    let (fu, fv, fw) = (1.0 / u_size, 1.0 / v_size, 1.0 / (u_size * v_size).sqrt());
    let combine = |sign: f64| -> Vec<f64> {
        let pairs = slopes[0].iter().zip(&slopes[1]);
        pairs.map(|(u, v)| fu * u + sign * fv * v).collect()
    };
    let (u, v) = (fu * values[0], fv * values[1]);
    Cone {
        constants: [u + v, u - v, fw * values[2]],
        slopes: [
            combine(1.0),
            combine(-1.0),
            slopes[2].iter().map(|w| fw * w).collect(),
        ],
    }
}

impl Constraints {
    /// The bound or linear limit an inequality stands for is finite.
    pub fn is_finite(&self, inequality: usize) -> bool {
        match self.bounds.get(inequality / 2) {
            Some(bound) => self.limit(bound, inequality).is_finite(),
            None => true,
        }
    }

    fn limit(&self, bound: &Bound, inequality: usize) -> f64 {
        if inequality.is_multiple_of(2) {
            bound.minimum
        } else {
            bound.maximum
        }
    }

    /// Puts p exactly on the bound that an active inequality stands for.
    pub fn settle(&self, inequality: usize, parameters: &mut [f64]) {
        if let Some(bound) = self.bounds.get(inequality / 2) {
            parameters[inequality / 2] = self.limit(bound, inequality);
        }
    }

    /// What a change of g by 1 means in natural units: parameter, linear form, relative size of a cone.
    pub fn inequality_size(&self, inequality: usize, unit: &[f64]) -> f64 {
        let bounds = 2 * self.bounds.len();
        if inequality < bounds {
            return unit[inequality / 2];
        }
        self.linear.get(inequality - bounds).map_or(1.0, |row| {
            let scaled = row.coefficients.iter().zip(unit).map(|(a, u)| a * u);
            norm(&scaled.collect::<Vec<_>>())
        })
    }

    /// ∇g of one finite inequality with respect to the parameters.
    pub fn inequality_normal(&self, inequality: usize, parameters: &[f64]) -> Vec<f64> {
        let n = parameters.len();
        let mut normal = vec![0.0; n];
        let around = inequalities(self, parameters, &vec![1.0; n]);
        if let Some(inequality) = &around[inequality] {
            inequality.gradient(&vec![0.0; n], &mut normal);
        }
        normal
    }
}
