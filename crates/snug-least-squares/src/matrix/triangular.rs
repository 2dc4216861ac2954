//! Dense kernels on column-major arrays.

use crate::matrix::thresholds::LONG;
use pulp::Arch;

/// Σ aᵢ bᵢ with four partial sums, always in the same order.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let tail: f64 = (a4.remainder().iter().zip(b4.remainder()))
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in a4.zip(b4) {
        for lane in 0..4 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + tail
}

/// The entries of `values` at `indices`.
pub fn entries_at<const N: usize>(values: &[f64; N], indices: &[usize]) -> Vec<f64> {
    indices.iter().map(|&index| values[index]).collect()
}

/// The rows and columns of a symmetric `matrix` at `indices`.
pub fn submatrix_at<const N: usize>(matrix: &[[f64; N]; N], indices: &[usize]) -> Vec<f64> {
    let rows = indices.iter().map(|&index| &matrix[index]);
    rows.flat_map(|row| entries_at(row, indices)).collect()
}

/// Σ aᵢ bᵢ of long signals, in the same order on every processor.
pub fn inner_product(a: &[f64], b: &[f64]) -> f64 {
    on_this_processor(
        #[inline(always)]
        || long_dot(a, b),
    )
}

/// Σ aᵢ bᵢ of long columns: with as many partial sums as keep wide registers busy, always in the same order.
#[inline(always)]
fn long_dot(a: &[f64], b: &[f64]) -> f64 {
    const SUMS: usize = 16;
    let mut sums = [0.0; SUMS];
    let (a_chunks, b_chunks) = (a.chunks_exact(SUMS), b.chunks_exact(SUMS));
    let tail = (a_chunks.remainder().iter().zip(b_chunks.remainder()))
        .fold(0.0, |sum, (x, y)| sum + x * y);
    for (x, y) in a_chunks.zip(b_chunks) {
        for lane in 0..SUMS {
            sums[lane] += x[lane] * y[lane];
        }
    }
    sums.iter().fold(tail, |whole, sum| whole + sum)
}

/// ‖a‖₂.
pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// y += s x.
#[inline(always)]
pub fn add_scaled(y: &mut [f64], s: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += s * x;
    }
}

/// Reduces the rows × columns `matrix` to upper-triangular form by Householder reflections (Golub & Van Loan,
/// Matrix Computations, 5.2.1), applying them to `right` as well. R stands in the upper triangle afterwards, Qᵀ·right in
/// `right`; what was below the diagonal is meaningless.
pub fn triangularize(matrix: &mut [f64], right: &mut [f64], rows: usize, columns: usize) {
    if rows < LONG {
        return reflect(matrix, right, rows, columns, dot);
    }
    on_this_processor(
        #[inline(always)]
        || reflect(matrix, right, rows, columns, long_dot),
    );
}

#[inline(always)]
fn reflect(
    matrix: &mut [f64],
    right: &mut [f64],
    rows: usize,
    columns: usize,
    dot: impl Fn(&[f64], &[f64]) -> f64,
) {
    for k in 0..columns.min(rows) {
        let (head, tail) = matrix.split_at_mut((k + 1) * rows);
        let pivot = &mut head[k * rows + k..];
        let length = dot(pivot, pivot).sqrt();
        if length == 0.0 {
            continue;
        }
        let diagonal = if pivot[0] > 0.0 { -length } else { length };
        pivot[0] -= diagonal;
        // ‖v‖² = 2 ‖x‖ (‖x‖ + |x₀|) without cancellation.
        let beta = 1.0 / (length * pivot[0].abs());
        for column in tail.chunks_exact_mut(rows) {
            let projection = beta * dot(pivot, &column[k..]);
            add_scaled(&mut column[k..], -projection, pivot);
        }
        let projection = beta * dot(pivot, &right[k..]);
        add_scaled(&mut right[k..], -projection, pivot);
        pivot[0] = diagonal;
    }
}

/// y = R x for the upper triangle of an n × n matrix stored with `stride` rows.
pub fn upper_times(factor: &[f64], n: usize, x: &[f64], y: &mut [f64]) {
    y.fill(0.0);
    for (column, &value) in x.iter().enumerate() {
        add_scaled(
            &mut y[..=column],
            value,
            &factor[column * n..column * n + column + 1],
        );
    }
}

/// y = Rᵀ x.
pub fn upper_transposed_times(factor: &[f64], n: usize, x: &[f64], y: &mut [f64]) {
    for (column, y) in y.iter_mut().enumerate() {
        *y = dot(&factor[column * n..column * n + column + 1], &x[..=column]);
    }
}

/// Solves R x = x in place for an upper triangle stored with `stride` rows; rows with a zero pivot give zero.
pub fn solve_upper(factor: &[f64], stride: usize, x: &mut [f64]) {
    for row in (0..x.len()).rev() {
        let column = &factor[row * stride..];
        x[row] = if column[row] == 0.0 {
            0.0
        } else {
            x[row] / column[row]
        };
        let (above, rest) = x.split_at_mut(row);
        add_scaled(above, -rest[0], &column[..row]);
    }
}

/// Solves Rᵀ x = x in place; columns with a zero pivot give zero.
pub fn solve_upper_transposed(factor: &[f64], stride: usize, x: &mut [f64]) {
    for row in 0..x.len() {
        let column = &factor[row * stride..=row * stride + row];
        let known = dot(&column[..row], &x[..row]);
        x[row] = match column[row] {
            0.0 => 0.0,
            pivot => (x[row] - known) / pivot,
        };
    }
}

/// Does `work` compiled for the processor at hand, whose wide registers loops over slices then use by themselves.
///
/// What computes in it must be marked `#[inline(always)]`, closures included.
fn on_this_processor<T>(work: impl FnOnce() -> T) -> T {
    Arch::new().dispatch(work)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangularized_system_has_the_least_squares_solution() {
        // 4 a + 6 b = 16 and 6 a + 14 b = 34 are the normal equations of these four points: a = 1, b = 2.
        let mut matrix = vec![1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 2.0, 3.0];
        let mut right = vec![2.0, 1.0, 6.0, 7.0];
        triangularize(&mut matrix, &mut right, 4, 2);
        let mut x = [right[0], right[1]];
        solve_upper(&matrix, 4, &mut x);
        assert!(
            (x[0] - 1.0).abs() < 1e-14 && (x[1] - 2.0).abs() < 1e-14,
            "{x:?}"
        );
    }

    #[test]
    fn zero_columns_and_short_systems_do_not_divide_by_zero() {
        let mut matrix = vec![0.0, 0.0, 3.0, 4.0];
        let mut right = vec![5.0, 10.0];
        triangularize(&mut matrix, &mut right, 2, 2);
        assert!(matrix.iter().chain(&right).all(|value| value.is_finite()));
        let mut single = vec![2.0, 3.0];
        triangularize(&mut single, &mut [1.0], 1, 2);
        assert_eq!(single, [-2.0, -3.0]);
    }
}
