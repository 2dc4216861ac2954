//! A start near the optimum: the equation of motion, integrated twice, is linear in m, c, k.
//!
//! From rest, with θ the measured angle and T the torque,
//!
//! ```text
//! l² (m θ + c ∫θ + k ∬θ) = ∬T − I_n θ
//! ```
//!
//! One regression over the samples is off by a per cent or so, because the noise is in θ on the left as well. A fit from
//! there takes about half the sweeps of one from anywhere.

use crate::multistart::thresholds::SCORED;
use crate::task::FitTask;
use snug_campaign::{Parameter, ParameterSource, Quantity};
use snug_least_squares::Linearization;
use snug_least_squares::matrix::{entries_at, submatrix_at};
use snug_model::{BASE_PARAMETERS, Input, with_processor_instructions};

/// Values of the free parameters among m, c, k, as if no effect acted; `None` when a start was stated, without a measured
/// displacement, when the simulation does not begin at rest, or when the regression has no sensible answer.
pub(crate) fn integral_start(task: &FitTask<'_>) -> Option<Vec<f64>> {
    let (model, input, tightening) = (&*task.model, &*task.input, &*task.tightening);
    let parameters = &model.parameters()[..BASE_PARAMETERS.len()];
    let is_default = |p: &Parameter| p.fixed || p.source == ParameterSource::Default;
    let angle_rad = tightening.motion.get(Quantity::Displacement)?;
    if input.is_restarted() || !parameters.iter().all(is_default) {
        return None;
    }
    let is_free = |&index: &usize| !parameters[index].fixed;
    let free: Vec<usize> = (0..parameters.len()).filter(is_free).collect();
    let rig = model.rig();
    let square = rig.lever_arm_m * rig.lever_arm_m;
    let known = |index: usize| match parameters[index].fixed {
        true => parameters[index].value,
        false => 0.0,
    };
    let [m, c, k] = [known(0), known(1), known(2)];
    let sums = with_processor_instructions(
        #[inline(always)]
        || {
            Sums::over(
                angle_rad,
                input,
                #[inline(always)]
                |[angle, once, twice], drive| {
                    let known = m * angle + c * once + k * twice;
                    drive - rig.known_inertia_kg_m2 * angle - square * known
                },
            )
        },
    );
    let mut regression = Linearization::new(free.len());
    let gradient = sums.right.map(|right| -square * right);
    let matrix = (sums.products).map(|row| row.map(|product| square * square * product));
    let (gradient, matrix) = (entries_at(&gradient, &free), submatrix_at(&matrix, &free));
    (regression.set_normal_equations(0.0, &gradient, &matrix)).ok()?;
    let values = regression.minimizer();
    let is_sensible = |value: &f64| value.is_finite() && *value > 0.0;
    values.iter().all(is_sensible).then_some(values)
}

/// A signal's integral and the integral of that, both trapezoids.
struct Integrals {
    interval_s: f64,
    latest: f64,
    once: f64,
    twice: f64,
}

impl Integrals {
    /// At the signal's first sample.
    fn new(first: f64, interval_s: f64) -> Self {
        Self {
            interval_s,
            latest: first,
            once: 0.0,
            twice: 0.0,
        }
    }

    /// After the next samples a_1 … a_n, all at once, since they do not have to wait for each other then:
    ///
    /// ```text
    /// ∫ grows by h (a_0/2 + a_1 + … + a_n/2)
    /// ∬ grows by h n ∫ + h² ((n/2 − 1/4) a_0 + (n−1) a_1 + (n−2) a_2 + … + a_{n−1} + a_n/4)
    /// ```
    #[inline(always)]
    fn advance(&mut self, next: [f64; SCORED]) {
        const N: f64 = SCORED as f64;
        let last = next[SCORED - 1];
        let [plain, weighted] = sums(&next);
        let h = self.interval_s;
        let once = h * (plain + 0.5 * (self.latest - last));
        let twice = h * h * (weighted + (0.5 * N - 0.25) * self.latest + 0.25 * last);
        self.twice += h * N * self.once + twice;
        self.once += once;
        self.latest = last;
    }
}

/// Σ a_j and Σ (n − j) a_j of a_1 … a_n: in eight parts, which share a vector register, and those in pairs, so that no
/// addition waits for many others.
#[inline(always)]
fn sums(next: &[f64; SCORED]) -> [f64; 2] {
    const PARTS: usize = 8;
    let mut parts = [[0.0; PARTS]; 2];
    for (begin, stretch) in next.as_chunks::<PARTS>().0.iter().enumerate() {
        for (part, a) in stretch.iter().enumerate() {
            parts[0][part] += a;
            parts[1][part] += (SCORED - 1 - begin * PARTS - part) as f64 * a;
        }
    }
    parts.map(|[a, b, c, d, e, f, g, h]| ((a + e) + (c + g)) + ((b + f) + (d + h)))
}

/// Inner products of (θ, ∫θ, ∬θ) with each other and with the right-hand side.
#[derive(Default)]
struct Sums {
    products: [[f64; 3]; 3],
    right: [f64; 3],
}

impl Sums {
    /// `right` gives the right-hand side from (θ, ∫θ, ∬θ) and ∬T.
    #[inline(always)]
    fn over(angle_rad: &[f64], input: &Input, right: impl Fn([f64; 3], f64) -> f64) -> Self {
        let (substeps, torque_nm) = (input.substeps(), input.grid_nm());
        let interval_s = input.grid_interval_s() * substeps as f64;
        let mut sums = Self::default();
        let (Some((&first, angles)), Some(&first_torque)) =
            (angle_rad.split_first(), torque_nm.first())
        else {
            return sums;
        };
        let mut angle = Integrals::new(first, interval_s);
        let mut torque = Integrals::new(first_torque, interval_s);
        let torques = torque_nm[1..].chunks_exact(SCORED * substeps);
        for (angles, torques) in angles.as_chunks().0.iter().zip(torques) {
            angle.advance(*angles);
            torque.advance(std::array::from_fn(|j| torques[(j + 1) * substeps - 1]));
            let motion = [angle.latest, angle.once, angle.twice];
            sums.add(motion, right(motion, torque.twice));
        }
        sums
    }

    #[inline(always)]
    fn add(&mut self, motion: [f64; 3], right: f64) {
        for i in 0..3 {
            self.right[i] += motion[i] * right;
            for j in 0..3 {
                self.products[i][j] += motion[i] * motion[j];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_of_many_samples_at_once_are_trapezoids() {
        let signal: Vec<f64> = (0..=2 * SCORED).map(|i| (0.7 * i as f64).cos()).collect();
        let h = 0.1;
        let mut found = Integrals::new(signal[0], h);
        let (mut once, mut twice) = (0.0, 0.0);
        for (block, next) in signal[1..].as_chunks().0.iter().enumerate() {
            found.advance(*next);
            for pair in signal[block * SCORED..=(block + 1) * SCORED].windows(2) {
                let ahead = once + 0.5 * h * (pair[0] + pair[1]);
                twice += 0.5 * h * (once + ahead);
                once = ahead;
            }
            assert!((found.once - once).abs() < 1e-14 && (found.twice - twice).abs() < 1e-14);
        }
    }
}
