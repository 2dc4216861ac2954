//! Against exact enumeration: 3 variables (u, w, v) ≥ 0 with w² ≤ 4 u v.

#![allow(clippy::unwrap_used)]

use crate::conic::constraints::{Affine, Constraints};
use crate::conic::inequalities::inequalities;
use crate::conic::program::ConicProgram;
use crate::matrix::dot;
use crate::solver::fit::Work;

/// A small generator of repeatable numbers in (−1, 1) (Knuth's MMIX congruence).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = (self.0.wrapping_mul(6364136223846793005)).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// ½ xᵀ P x + qᵀ x.
struct Quadratic {
    p: [[f64; 3]; 3],
    q: [f64; 3],
}

impl Quadratic {
    fn random(numbers: &mut Numbers) -> Self {
        let root: [[f64; 3]; 4] = std::array::from_fn(|_| std::array::from_fn(|_| numbers.next()));
        let scale: [f64; 3] = std::array::from_fn(|_| 10.0_f64.powf(numbers.next()));
        let entry = |i: usize, j: usize| {
            let inner: f64 = root.iter().map(|row| row[i] * row[j]).sum();
            (inner + if i == j { 1e-3 } else { 0.0 }) * scale[i] * scale[j]
        };
        Self {
            p: std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))),
            q: std::array::from_fn(|i| numbers.next() * scale[i]),
        }
    }

    fn times(&self, x: [f64; 3]) -> [f64; 3] {
        self.p.map(|row| dot(&row, &x))
    }

    fn at(&self, x: [f64; 3]) -> f64 {
        0.5 * dot(&x, &self.times(x)) + dot(&self.q, &x)
    }

    /// Unconstrained minimum over the coordinates in `kept`, the others zero (Cramer's rule).
    fn face_minimum(&self, kept: [bool; 3]) -> [f64; 3] {
        let entry = |i: usize, j: usize| match kept[i] && kept[j] {
            true => self.p[i][j],
            false => f64::from(i == j),
        };
        let right = |i: usize| if kept[i] { -self.q[i] } else { 0.0 };
        let determinant = |column: Option<usize>| {
            let a = |i: usize, j: usize| {
                if Some(j) == column {
                    right(i)
                } else {
                    entry(i, j)
                }
            };
            a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1))
                - a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0))
                + a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0))
        };
        std::array::from_fn(|i| determinant(Some(i)) / determinant(None))
    }

    /// Minima along the rays of the cone's surface, (cos² t, sin 2t, sin² t): one angle, found by bisection.
    fn surface_minima(&self) -> Vec<[f64; 3]> {
        let ray = |t: f64| [t.cos().powi(2), (2.0 * t).sin(), t.sin().powi(2)];
        let turn = |t: f64| [-(2.0 * t).sin(), 2.0 * (2.0 * t).cos(), (2.0 * t).sin()];
        let slope = |t: f64| {
            let (e, de) = (ray(t), turn(t));
            let (h, dh) = (dot(&self.q, &e), dot(&self.q, &de));
            let (g, dg) = (dot(&e, &self.times(e)), 2.0 * dot(&de, &self.times(e)));
            2.0 * dh * g - h * dg
        };
        let at = |t: f64| {
            let e = ray(t);
            let length = (-dot(&self.q, &e) / dot(&e, &self.times(e))).max(0.0);
            e.map(|value| length * value)
        };
        let steps = 400;
        let angle = |step: usize| step as f64 / steps as f64 * std::f64::consts::FRAC_PI_2;
        let mut minima = vec![at(angle(0)), at(angle(steps))];
        for step in 0..steps {
            let (mut low, mut high) = (angle(step), angle(step + 1));
            let sign = slope(low);
            if sign * slope(high) > 0.0 {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if sign * slope(middle) > 0.0 {
                    low = middle
                } else {
                    high = middle
                }
            }
            minima.push(at(0.5 * (low + high)));
        }
        minima
    }

    fn exact_minimum(&self) -> [f64; 3] {
        let is_inside = |x: &[f64; 3]| {
            x.iter().all(|&value| value >= 0.0) && x[1] * x[1] <= 4.0 * x[0] * x[2] * (1.0 + 1e-12)
        };
        let flat = [
            [true, true, true],
            [true, false, true],
            [true, false, false],
            [false, false, true],
        ];
        let mut candidates: Vec<[f64; 3]> = flat.map(|kept| self.face_minimum(kept)).to_vec();
        candidates.extend(self.surface_minima());
        candidates.push([0.0; 3]);
        let inside = candidates.into_iter().filter(is_inside);
        inside
            .min_by(|a, b| self.at(*a).total_cmp(&self.at(*b)))
            .unwrap()
    }
}

fn positive_cone() -> Constraints {
    let strict = 1.0 + Constraints::STRICT_MARGIN;
    let mut set = Constraints::new(3);
    for index in 0..3 {
        set.bound(index, 0.0, f64::INFINITY, "x");
    }
    let [u, v] = [0, 2].map(|index| Affine::term(3, index, 1.0, 0.0));
    set.rotated_cone("cone", u, v, Affine::term(3, 1, 1.0 / strict, 0.0));
    set
}

#[test]
fn ten_thousand_random_programs_have_the_exact_solution() {
    let mut numbers = Numbers(1);
    let set = positive_cone();
    let (mut worst, mut constrained, mut work) = (0.0_f64, 0, Work::default());
    for case in 0..10_000 {
        let quadratic = Quadratic::random(&mut numbers);
        let exact = quadratic.exact_minimum();
        // From a point inside the cone, as in a fit: x = origin + z.
        let (u, v) = (0.1 + numbers.next().abs(), 0.1 + numbers.next().abs());
        let origin = [u, numbers.next().abs() * 2.0 * (u * v).sqrt(), v];
        let moved = quadratic.times(origin);
        let program = ConicProgram {
            hessian: quadratic.p.concat(),
            gradient: (0..3).map(|i| quadratic.q[i] + moved[i]).collect(),
            inequalities: inequalities(&set, &origin, &[1.0; 3]),
        };
        let minimum = quadratic.face_minimum([true; 3]);
        let free: Vec<f64> = (0..3).map(|i| minimum[i] - origin[i]).collect();
        let found = match set.contains(&minimum) {
            true => minimum,
            false => {
                constrained += 1;
                let solution = program.solve(&free, &[], &mut work).unwrap();
                std::array::from_fn(|i| origin[i] + solution.z[i])
            }
        };
        let error = (0..3)
            .map(|i| (found[i] - exact[i]).abs())
            .fold(0.0, f64::max);
        let size = 1.0 + exact.iter().copied().fold(0.0, f64::max);
        if exact == [0.0; 3] {
            // The tip has no tangent to polish on: interior-point accuracy remains.
            assert!(error <= 1e-6, "case {case}: {found:?} at the tip");
        } else {
            worst = worst.max(error / size);
            assert!(error <= 1e-9 * size, "case {case}: {found:?} {exact:?}");
        }
    }
    assert!(
        constrained > 8000,
        "most cases must need the conic step: {constrained}"
    );
    assert!(worst < 1e-11, "worst error {worst:.1e}, {work:?}");
}
