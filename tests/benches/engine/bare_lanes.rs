//! The yardstick for many fits: the bare loop for as many tightenings at once as a vector register holds numbers.
//!
//! Eight with AVX-512, four with AVX2. A lane whose fit is done takes the next tightening, so that none waits for others.

use crate::bare_loop::{Descent, Products, Record, Recursion, recursion};
use pulp::{Arch, Simd, WithSimd};

/// The optimum of every record, all of one length, from `start`.
pub fn fit_all(records: &[Record<'_>], start: [f64; 3]) -> Vec<[f64; 3]> {
    Arch::new().dispatch(FitAll { records, start })
}

struct FitAll<'a> {
    records: &'a [Record<'a>],
    start: [f64; 3],
}

impl WithSimd for FitAll<'_> {
    type Output = Vec<[f64; 3]>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Some(first) = self.records.first() else {
            return Vec::new();
        };
        let (lanes, samples) = (S::F64_LANES, first.torque_nm.len());
        let mut results = vec![[f64::NAN; 3]; self.records.len()];
        // Sample by sample torque and angle of every lane; lanes without a tightening stay at zero.
        let mut torque = vec![0.0; (samples + 1) * lanes];
        let mut angle = vec![0.0; samples * lanes];
        let mut waiting = self.records.iter().enumerate();
        let mut fits: Vec<Option<(usize, Descent)>> = (0..lanes).map(|_| None).collect();
        loop {
            let mut coefficients = vec![0.0; Recursion::SIZE * lanes];
            for (lane, fit) in fits.iter_mut().enumerate() {
                if fit.is_none()
                    && let Some((index, record)) = waiting.next()
                {
                    load(record.torque_nm, &mut torque, lane, lanes);
                    load(record.angle_rad, &mut angle, lane, lanes);
                    *fit = Some((index, Descent::new(record, self.start)));
                }
                if let Some((index, descent)) = fit {
                    let recursion = recursion(descent.trial, self.records[*index].interval_s);
                    let column = coefficients.iter_mut().skip(lane).step_by(lanes);
                    column
                        .zip(recursion.coefficients())
                        .for_each(|(to, from)| *to = from);
                }
            }
            if fits.iter().all(Option::is_none) {
                return results;
            }
            let sums = pass(simd, &torque, &angle, &coefficients);
            let sums: Vec<&[f64]> = sums.chunks_exact(lanes).collect();
            for (lane, fit) in fits.iter_mut().enumerate() {
                let Some((index, descent)) = fit else {
                    continue;
                };
                descent.advance(&products(&sums, lane));
                if descent.is_done {
                    results[*index] = descent.values(&self.records[*index]);
                    *fit = None;
                }
            }
        }
    }
}

/// Puts a signal into its lane; behind the end it keeps its last value.
fn load(signal: &[f64], interleaved: &mut [f64], lane: usize, lanes: usize) {
    let last = signal.last().copied().unwrap_or(0.0);
    let values = signal.iter().copied().chain(std::iter::repeat(last));
    let lane = interleaved.iter_mut().skip(lane).step_by(lanes);
    lane.zip(values).for_each(|(to, from)| *to = from);
}

fn products(sums: &[&[f64]], lane: usize) -> Products {
    Products {
        gg: sums[0][lane],
        gz: sums[1][lane],
        gd: sums[2][lane],
        zz: sums[3][lane],
        zd: sums[4][lane],
        dd: sums[5][lane],
        yg: sums[6][lane],
        yz: sums[7][lane],
        yd: sums[8][lane],
    }
}

/// One run over the samples of all lanes; the nine sums, lane by lane.
#[inline(always)]
fn pass<S: Simd>(simd: S, torque: &[f64], angle: &[f64], coefficients: &[f64]) -> Vec<f64> {
    let (torque, _) = S::as_simd_f64s(torque);
    let (angle, _) = S::as_simd_f64s(angle);
    let (q, _) = S::as_simd_f64s(coefficients);
    let q: [S::f64s; Recursion::SIZE] = std::array::from_fn(|index| q[index]);
    let zero = simd.splat_f64s(0.0);
    let mut sums = [zero; 9];
    let mut x = [zero; 4];
    for (pair, &y) in torque.windows(2).zip(angle) {
        let [g, dg, z, d] = x;
        let factors = [
            (g, g),
            (g, z),
            (g, d),
            (z, z),
            (z, d),
            (d, d),
            (y, g),
            (y, z),
            (y, d),
        ];
        for (sum, (a, b)) in sums.iter_mut().zip(factors) {
            *sum = simd.mul_add_f64s(a, b, *sum);
        }
        let u = pair[0];
        let du = simd.sub_f64s(pair[1], u);
        let driven = |row: usize| {
            let constant = simd.mul_f64s(q[8 + row], u);
            simd.mul_add_f64s(q[12 + row], du, constant)
        };
        let turned = |first: usize, a: S::f64s, b: S::f64s, rest: S::f64s| {
            simd.mul_add_f64s(q[first], a, simd.mul_add_f64s(q[first + 1], b, rest))
        };
        x = [
            turned(0, g, dg, driven(0)),
            turned(2, g, dg, driven(1)),
            turned(0, z, d, turned(4, g, dg, driven(2))),
            turned(2, z, d, turned(6, g, dg, driven(3))),
        ];
    }
    let mut out = vec![0.0; sums.len() * S::F64_LANES];
    let (registers, _) = S::as_mut_simd_f64s(&mut out);
    registers.copy_from_slice(&sums);
    out
}
