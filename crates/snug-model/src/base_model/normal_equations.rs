//! The base model's normal equations, accumulated in one sweep over the samples without storing a sensitivity.
//!
//! With the derivatives of [`exact`](crate::base_model::exact) the residual is r = y − b1 g⁽ⁱ⁾ and, the factor b1² l² left out until
//! the end, its derivatives by m, c, k are z⁽ⁱ⁺²⁾, z⁽ⁱ⁺¹⁾, z⁽ⁱ⁾, with i = 0 for the displacement, 1 for the velocity, 2 for the
//! acceleration. Ten inner products of these four are all that a Gauss–Newton step needs; three plain sums more go
//! almost for nothing through the adders beside them and spare the covariance a sweep of its own.

use crate::base_model::sweep::{BLOCK, Lane, Sweep};
use crate::numeric::lanewise::Task;
use crate::numeric::number::Real;
use snug_campaign::Quantity;

/// Cost, gradient and curvature of ½‖r‖² over m, c, k.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct NormalEquations {
    /// ‖r‖², in the square of the residual's unit.
    pub squares: f64,
    /// Jᵀr, in that unit per unit of m \[kg\], c \[kg/s\] and k \[N/m\].
    pub gradient: [f64; 3],
    /// JᵀJ, in that unit per unit of two of them.
    pub matrix: [[f64; 3]; 3],
    /// Jᵀ1: what an error that is the same in every sample does to the gradient, in the residual's unit per unit of m, c and k.
    pub sums: [f64; 3],
}

impl<R: Real> Sweep<'_, R> {
    /// The normal equations of every lane at its own m, c, k.
    pub fn run(&mut self, values: &[[f64; 3]]) -> Vec<NormalEquations> {
        let mut found = vec![NormalEquations::default(); R::LANES];
        self.sum(values, 1, |lane, so_far| found[lane] = so_far);
        found
    }

    /// The gradient Jᵀr of every lane, stretch by stretch: the samples in about `stretches` parts of equal length.
    pub fn scores(&mut self, values: &[[f64; 3]], stretches: usize) -> Vec<Vec<[f64; 3]>> {
        let mut before = vec![[0.0; 3]; R::LANES];
        let mut scores = vec![Vec::new(); R::LANES];
        self.sum(values, stretches, |lane, so_far| {
            let (now, before) = (so_far.gradient, &mut before[lane]);
            scores[lane].push(std::array::from_fn(|i| now[i] - before[i]));
            *before = now;
        });
        scores
    }

    /// Hands what has been summed up to the end of each stretch of each lane to `read`.
    fn sum(
        &mut self,
        values: &[[f64; 3]],
        stretches: usize,
        read: impl FnMut(usize, NormalEquations),
    ) {
        let stretch = |lane: &Lane| lane.samples.div_ceil(stretches).max(1);
        let stretches = self.lanes.iter().map(stretch).collect();
        self.zero.vectorize(Run {
            sweep: self,
            values,
            stretches,
            read,
        });
        self.all_have_arrived();
    }
}

/// One run over the samples of all lanes.
struct Run<'a, 'r, R, F> {
    sweep: &'a mut Sweep<'r, R>,
    /// m, c, k, lane by lane.
    values: &'a [[f64; 3]],
    /// Samples of one stretch, lane by lane.
    stretches: Vec<usize>,
    /// Gets a lane's number and what has been summed up to the end of each of its stretches.
    read: F,
}

impl<R: Real, F: FnMut(usize, NormalEquations)> Task for Run<'_, '_, R, F> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        match self.sweep.quantity {
            Quantity::Displacement => self.sum::<0>(),
            Quantity::Velocity => self.sum::<1>(),
            Quantity::Acceleration => self.sum::<2>(),
        }
    }
}

impl<R: Real, F: FnMut(usize, NormalEquations)> Run<'_, '_, R, F> {
    #[inline(always)]
    fn sum<const DOTS: usize>(mut self) {
        let zero = self.sweep.zero;
        let mut states = self.sweep.begin(self.values);
        let mut sums = [zero; 13];
        let mut from = 0;
        let lasts: Vec<usize> = self.sweep.lanes.iter().map(|lane| lane.samples).collect();
        // The next sample at which the sums of a lane are read; the others go on.
        let next = |lane: usize, from: usize| {
            let stretch = self.stretches[lane];
            ((from / stretch + 1) * stretch).min(lasts[lane])
        };
        while let Some(end) = (0..R::LANES)
            .map(|lane| next(lane, from))
            .filter(|&end| end > from)
            .min()
        {
            let mut block = [[zero; 4]; BLOCK];
            for begin in (from..end).step_by(BLOCK) {
                let block = &mut block[..BLOCK.min(end - begin)];
                let mut rows = block.iter_mut();
                self.sweep.walk::<DOTS, DOTS>(
                    &mut states,
                    begin..begin + rows.len(),
                    #[inline(always)]
                    |row| {
                        if let Some(kept) = rows.next() {
                            *kept = row;
                        }
                    },
                );
                add(&mut sums, block);
            }
            for lane in (0..R::LANES).filter(|&lane| next(lane, from) == end) {
                let square = self.sweep.lanes[lane].square_m2;
                (self.read)(
                    lane,
                    read(states.inverse_inertia(lane), &sums, lane, square),
                );
            }
            from = end;
        }
    }
}

/// Adds the products of some samples' r and its derivatives by m, c, k.
#[inline(always)]
fn add<R: Real>(sums: &mut [R; 13], block: &[[R; 4]]) {
    let mut s = *sums;
    for &[r, m, c, k] in block {
        s[0] += r * r;
        s[1] += m * r;
        s[2] += c * r;
        s[3] += k * r;
        s[4] += m * m;
        s[5] += m * c;
        s[6] += m * k;
        s[7] += c * c;
        s[8] += c * k;
        s[9] += k * k;
        s[10] += m;
        s[11] += c;
        s[12] += k;
    }
    *sums = s;
}

/// One lane's sums with the factor b1² l² of every sensitivity, which was left out of them.
fn read<R: Real>(inverse: f64, sums: &[R; 13], lane: usize, square: f64) -> NormalEquations {
    let factor = inverse * inverse * square;
    let once = |index: usize| factor * sums[index].lanes()[lane];
    let twice = |index: usize| factor * once(index);
    NormalEquations {
        squares: sums[0].lanes()[lane],
        gradient: [once(1), once(2), once(3)],
        matrix: [
            [twice(4), twice(5), twice(6)],
            [twice(5), twice(7), twice(8)],
            [twice(6), twice(8), twice(9)],
        ],
        sums: [once(10), once(11), once(12)],
    }
}
