//! Linear least squares with instruments and with signs that physics knows.
//!
//! y = X p, where X is as noisy as y: the columns of the same record some places before and after share the motion with X and not
//! the noise, so that they serve as instruments Z (two-stage least squares):
//!
//! ```text
//! p = argmin ‖P_Z (y − X p)‖²,  P_Z = Z (Zᵀ Z)⁻¹ Zᵀ
//! ```
//!
//! Source: Söderström and Stoica 1983; Young 2011.

use crate::equation_error::thresholds::NEW;
use snug_least_squares::matrix::{add_scaled, dot};
use snug_least_squares::{
    Constraints, DenseResidual, EvaluationError, Linearization, Residual, Settings, solve,
};

/// One unknown of a regression.
#[derive(Debug, Clone)]
pub struct Column {
    /// Its column, record by record, in a unit of its own.
    pub of_records: Vec<Vec<f64>>,
    /// Whether it is free of noise, and so its own instrument.
    pub is_exact: bool,
    /// Whether its size is never below 0.
    pub is_one_sided: bool,
}

/// What is regressed on what.
#[derive(Debug, Clone)]
pub struct Regression<'a> {
    /// The left-hand side, record by record, in a unit of its own.
    pub left: &'a [Vec<f64>],
    /// The unknowns.
    pub columns: &'a [Column],
    /// Places by which two entries of each record are apart that share no noise.
    pub apart: &'a [usize],
}

impl Regression<'_> {
    /// The sizes; `None` where the places are too few for instruments or tell nothing.
    pub fn sizes(&self) -> Option<Vec<f64>> {
        let (y, x, z) = self.stacked();
        let count = x.len();
        if y.len() <= z.len() || count == 0 {
            return None;
        }
        let units: Option<Vec<f64>> = x.iter().chain([&y]).map(|column| unit(column)).collect();
        let units = units?;
        let (of_y, units) = (units[count], &units[..count]);
        let basis = orthonormal(z);
        let seen = |column: &[f64], unit: f64| -> Vec<f64> {
            basis.iter().map(|one| dot(one, column) / unit).collect()
        };
        let columns = x.iter().zip(units);
        let columns = columns.map(|(column, &unit)| seen(column, unit));
        let problem = Projected {
            columns: columns.collect(),
            right: seen(&y, of_y),
        };
        let found = self.bounded(problem)?;
        Some(
            (found.iter().zip(units))
                .map(|(size, unit)| size * of_y / unit)
                .collect(),
        )
    }

    /// y, the columns of X and those of Z, of the places that have neighbours far enough away.
    fn stacked(&self) -> (Vec<f64>, Vec<Vec<f64>>, Vec<Vec<f64>>) {
        let inner = |record: usize| {
            let (count, apart) = (self.left[record].len(), self.apart[record]);
            apart..count.saturating_sub(apart).max(apart)
        };
        let records = 0..self.left.len();
        let shifted = |of: &[Vec<f64>], by: isize| -> Vec<f64> {
            let of_record = |record: usize| {
                let shift = by * self.apart[record] as isize;
                inner(record).map(move |place| (record, place.saturating_add_signed(shift)))
            };
            let places = records.clone().flat_map(of_record);
            places.map(|(record, place)| of[record][place]).collect()
        };
        let z = self.columns.iter().flat_map(|column| {
            let shifts: &[isize] = if column.is_exact { &[0] } else { &[-1, 1] };
            shifts.iter().map(|&by| shifted(&column.of_records, by))
        });
        let x = self
            .columns
            .iter()
            .map(|column| shifted(&column.of_records, 0));
        (shifted(self.left, 0), x.collect(), z.collect())
    }

    /// The minimiser in units of the columns' own sizes; 0 along what is not determined.
    fn bounded(&self, mut problem: Projected) -> Option<Vec<f64>> {
        let count = self.columns.len();
        let mut linear = Linearization::new(count);
        let mut residual: Vec<f64> = problem.right.iter().map(|value| -value).collect();
        let mut jacobian = problem.columns.concat();
        linear.set_jacobian(&mut residual, &mut jacobian).ok()?;
        let mut found = linear.minimizer();
        let is_one_sided = || self.columns.iter().map(|column| column.is_one_sided);
        let mut signs = found.iter().zip(is_one_sided());
        if signs.any(|(size, is_one_sided)| is_one_sided && *size < 0.0) {
            let mut set = Constraints::new(count);
            for (index, _) in is_one_sided().enumerate().filter(|(_, bounded)| *bounded) {
                set.bound(index, 0.0, f64::INFINITY, "size");
            }
            set.clamp(&mut found);
            let mut problem = DenseResidual::new(&mut problem);
            found = solve(&mut problem, &found, &set, &Settings::default())
                .ok()?
                .values;
        }
        found.iter().all(|size| size.is_finite()).then_some(found)
    }

    /// Σ (y − X p)² over all places.
    pub fn left_over(&self, sizes: &[f64]) -> f64 {
        let of_record = |record: usize| -> f64 {
            let rest = self.rest(sizes, record);
            rest.map(|rest| rest.powi(2)).sum()
        };
        (0..self.left.len()).map(of_record).sum()
    }

    /// y − X p along a record, in the unit of the left-hand side.
    pub fn rest<'a>(&'a self, sizes: &'a [f64], record: usize) -> impl Iterator<Item = f64> + 'a {
        let rows = self.left[record].iter().enumerate();
        rows.map(move |(place, y)| {
            let columns = self.columns.iter().zip(sizes);
            let told: f64 = columns
                .map(|(column, size)| size * column.of_records[record][place])
                .sum();
            y - told
        })
    }
}

/// Length of a column; `None` where it is nothing or not finite.
fn unit(column: &[f64]) -> Option<f64> {
    Some(dot(column, column).sqrt()).filter(|unit| unit.is_finite() && *unit > 0.0)
}

/// What these columns span, orthonormal (Gram–Schmidt, twice, so that what is left of nearly dependent ones is right).
fn orthonormal(columns: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut column in columns {
        let length = dot(&column, &column).sqrt();
        for _ in 0..2 {
            for known in &basis {
                let along = dot(known, &column);
                add_scaled(&mut column, -along, known);
            }
        }
        let rest = dot(&column, &column).sqrt();
        if rest > NEW * length {
            column.iter_mut().for_each(|value| *value /= rest);
            basis.push(column);
        }
    }
    basis
}

/// X p − y as the instruments see it.
struct Projected {
    columns: Vec<Vec<f64>>,
    right: Vec<f64>,
}

impl Residual for &mut Projected {
    fn residual_count(&self) -> usize {
        self.right.len()
    }

    fn parameter_count(&self) -> usize {
        self.columns.len()
    }

    fn evaluate(
        &mut self,
        p: &[f64],
        residual: &mut [f64],
        jacobian: Option<&mut [f64]>,
    ) -> Result<(), EvaluationError> {
        for (left, right) in residual.iter_mut().zip(&self.right) {
            *left = -right;
        }
        for (column, size) in self.columns.iter().zip(p) {
            add_scaled(residual, *size, column);
        }
        if let Some(jacobian) = jacobian {
            jacobian.copy_from_slice(&self.columns.concat());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Between −½ and ½, without any pattern in k.
    fn noise(k: f64, phase: f64) -> f64 {
        let v = (k * 12.9898 + phase).sin() * 437.58;
        v - v.floor() - 0.5
    }

    /// y = 3 a + 0.7 b − 0.2 c of two records; b and c are known with noise.
    fn records() -> (Vec<Vec<f64>>, [Vec<Vec<f64>>; 3]) {
        let (mut left, mut columns) = (Vec::new(), [const { Vec::new() }; 3]);
        for (count, phase) in [(300_u32, 0.0), (220, 1.3)] {
            let each = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
                (0..count).map(|k| f(f64::from(k))).collect()
            };
            let a = |k: f64| (0.21 * k + phase).sin() + 0.4 * (0.07 * k).cos();
            let b = |k: f64| (0.13 * k + phase).cos();
            let c = |k: f64| (0.05 * k * (1.0 + 0.002 * k)).sin();
            left.push(each(&|k| {
                3.0 * a(k) + 0.7 * b(k) - 0.2 * c(k) + 0.3 * noise(k, 5.0 + phase)
            }));
            columns[0].push(each(&a));
            columns[1].push(each(&|k| b(k) + 0.4 * noise(k, 1.0 + phase)));
            columns[2].push(each(&|k| c(k) + 0.4 * noise(k, 2.0 + phase)));
        }
        (left, columns)
    }

    /// The same arrays in NumPy 2.4: `lstsq` of QᵀX and Qᵀy with Q of the instruments' QR factors, and SciPy 1.17's `lsq_linear`
    /// of the same with bounds of 0.
    #[test]
    fn sizes_are_those_of_numpy_and_scipy() {
        let (left, columns) = records();
        for (apart, is_one_sided, expected) in [
            (0, false, [3.011684403566, 0.687762410193, -0.18682154564]),
            (7, false, [3.014412420616, 0.705229500955, -0.189668902847]),
            (0, true, [3.028539691651, 0.7067878981517, 0.0]),
            (7, true, [3.038516537956, 0.7219003785727, 0.0]),
        ] {
            let columns = columns.clone().map(|of_records| Column {
                of_records,
                is_exact: false,
                is_one_sided,
            });
            let mut columns = columns.to_vec();
            columns[0].is_exact = true;
            let regression = Regression {
                left: &left,
                columns: &columns,
                apart: &[apart; 2],
            };
            let sizes = regression.sizes().unwrap();
            for (found, expected) in sizes.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-6, "{sizes:?}");
            }
            if (apart, is_one_sided) == (7, false) {
                assert!((regression.left_over(&sizes) - 7.11921032669).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn too_few_places_for_instruments_say_nothing() {
        let columns = [Column {
            of_records: vec![vec![1.0, 2.0, 3.0]],
            is_exact: false,
            is_one_sided: false,
        }];
        let left = [vec![2.0, 4.0, 6.0]];
        let regression = |apart: usize| Regression {
            left: &left,
            columns: &columns,
            apart: if apart == 0 { &[0] } else { &[2] },
        };
        assert!(regression(2).sizes().is_none());
        assert!((regression(0).sizes().unwrap()[0] - 2.0).abs() < 1e-12);
    }
}
