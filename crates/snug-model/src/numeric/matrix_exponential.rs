//! The exponential of a small matrix, for exact steps of linear equations.

/// e^M for a small square matrix, by scaling and squaring of its Taylor series.
///
/// After scaling, ‖M‖₁ ≤ 1/2 and the remainder of sixteen terms is below rounding (0.5¹⁷/17! < 1e−19). Not a number where ‖M‖₁ is
/// not finite.
pub fn exponential<const N: usize>(matrix: &[[f64; N]; N]) -> [[f64; N]; N] {
    const TERMS: usize = 16;
    let norm = (0..N)
        .map(|column| (0..N).map(|row| matrix[row][column].abs()).sum::<f64>())
        .fold(0.0, f64::max);
    let doubled = 2.0 * norm;
    if !doubled.is_finite() {
        return [[f64::NAN; N]; N];
    }
    let squarings = if norm > 0.5 {
        doubled.log2().ceil() as i32
    } else {
        0
    };
    let scale = 0.5_f64.powi(squarings);
    let scaled = matrix.map(|row| row.map(|value| value * scale));
    let identity: [[f64; N]; N] =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let mut sum = identity;
    for term in (1..=TERMS).rev() {
        // Horner: I + M/1 (I + M/2 (I + …))
        let product = multiply(&scaled, &sum);
        sum = std::array::from_fn(|i| {
            std::array::from_fn(|j| identity[i][j] + product[i][j] / term as f64)
        });
    }
    for _ in 0..squarings {
        sum = multiply(&sum, &sum);
    }
    sum
}

fn multiply<const N: usize>(a: &[[f64; N]; N], b: &[[f64; N]; N]) -> [[f64; N]; N] {
    let mut product = [[0.0; N]; N];
    for i in 0..N {
        for k in 0..N {
            for j in 0..N {
                product[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_and_a_shear_have_their_closed_forms() {
        let rotation = exponential(&[[0.0, -7.0], [7.0, 0.0]]);
        assert!((rotation[0][0] - 7.0_f64.cos()).abs() < 1e-14);
        assert!((rotation[1][0] - 7.0_f64.sin()).abs() < 1e-14);
        let shear = exponential(&[[0.0, 3.0, 0.0], [0.0, 0.0, 2.0], [0.0, 0.0, 0.0]]);
        assert!((shear[0][2] - 3.0).abs() < 1e-15, "3·2/2");
    }

    /// It ends, and soon.
    #[test]
    fn a_matrix_without_bounds_has_no_exponential() {
        for size in [f64::INFINITY, f64::NAN, f64::MAX] {
            let found = exponential(&[[size, -size], [size, size]]);
            assert!(found.iter().flatten().all(|value| !value.is_finite()));
        }
    }
}
