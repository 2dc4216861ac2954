//! A start from the data alone, in any unit: the base model's frequency response, fitted to all lines of the spectra.
//!
//! With Y the transform of the measured angle (p = 0), velocity (p = 1) or acceleration (p = 2), T that of the torque,
//! s = iω, and a polynomial in s for how the record begins and ends (Pintelon and Schoukens 2012, ch. 6),
//!
//! ```text
//! ((I_n + m l²) s² + c l² s + k l²) Y(s) = sᵖ T(s) + b₀ + b₁ s + b₂ s²
//! ```
//!
//! is linear in m, c, k and b. Divided by what stands before Y at the values found before (Sanathanan and Koerner 1963), its
//! error becomes the output's. Line 0 takes no part, so a constant error of either channel does not matter. Nothing in it has
//! a size: other units of a channel or of time give the same fit in these units.

use crate::multistart::thresholds::{LEAST_SHARE, SPECTRAL_ROUNDS};
use crate::task::FitTask;
use snug_campaign::Quantity;
use snug_least_squares::matrix::{SymmetricMatrix, dot};
use snug_model::BASE_PARAMETERS;
use snug_signal::{Complex, spectrum};
use std::f64::consts::TAU;

/// What m, c, k the spectra of some records have in common, and what they explain.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectralStart {
    /// m, c, k \[kg, kg/s, N/m\]; what the spectra do not show is a thousandth of what they do, never 0, and no mass is too small to be
    /// simulated at the interval of the samples.
    pub values: [f64; BASE],
    /// Share of the measured power about the mean that the linear model leaves \[–\].
    pub unexplained: f64,
    /// Angle about its mean of the model under the measured torque, root mean square \[rad\].
    pub angle_rad: f64,
    /// Angle over angular velocity, or that over angular acceleration where it is less \[s\].
    pub time_s: f64,
}

const BASE: usize = BASE_PARAMETERS.len();
/// b₀, b₁, b₂.
const ENDS: usize = 3;

/// Fits the base model to the spectra of all records; `None` where nothing moves, where the fitted output was not measured, or
/// where no m, c, k of 0 or more explain anything.
pub fn spectral_start(tasks: &[FitTask<'_>]) -> Option<SpectralStart> {
    let records: Vec<Record> = tasks.iter().map(Record::of).collect::<Option<_>>()?;
    let first = tasks.first()?;
    let parameters = &first.model.parameters()[..BASE];
    let rig = first.model.rig();
    let square = rig.lever_arm_m * rig.lever_arm_m;
    let frequency = mean_frequency(&records)?;
    // By what power of the mean frequency each of the three is multiplied, so that all are of one kind.
    let unit = |power: i32| square * frequency.powi(power);
    let units = [unit(2), unit(1), unit(0)];
    let mut known = [rig.known_inertia_kg_m2 * frequency * frequency, 0.0, 0.0];
    for (index, parameter) in parameters.iter().enumerate() {
        if parameter.fixed {
            known[index] += units[index] * parameter.value;
        }
    }
    let free: Vec<usize> = (0..BASE).filter(|&i| !parameters[i].fixed).collect();
    let mut best: Option<Response> = None;
    // First weights: as if mass, damping or stiffness were all there is.
    for alone in 0..BASE {
        let mut before = [0.0; BASE];
        before[alone] = 1.0;
        for round in 0..SPECTRAL_ROUNDS {
            let equations = Equations::of(&records, frequency, &known, &before);
            let left = equations.left(&std::array::from_fn(|i| before[i] - known[i]));
            let is_better = best.as_ref().is_none_or(|best| left < best.left);
            if round > 0 && left.is_finite() && is_better {
                best = Some(Response {
                    total: before,
                    left,
                    power: equations.power,
                });
            }
            let Some(found) = equations.solution(&free) else {
                break;
            };
            let total = std::array::from_fn(|i| known[i] + found[i]);
            if total == before || total == [0.0; BASE] {
                break;
            }
            before = total;
        }
    }
    let Response { total, left, power } = best?;
    let (angle_rad, time_s) = motion(&records, frequency, &total)?;
    let shown = LEAST_SHARE * total.iter().sum::<f64>();
    let least = [
        shown.max(simulable(&total, frequency * longest_interval_s(tasks)) - known[0]),
        shown,
        shown,
    ];
    Some(SpectralStart {
        values: std::array::from_fn(|i| match parameters[i].fixed {
            true => parameters[i].value,
            false => (total[i] - known[i]).max(least[i]) / units[i],
        }),
        unexplained: (left / power).clamp(0.0, 1.0),
        angle_rad,
        time_s,
    })
}

/// The inertia, in multiples of the mean frequency like `total`, with which damping and stiffness are slow enough to be followed in steps
/// of so many `radians` of that frequency: half a step to lose the speed, or a step to swing by two radians.
fn simulable(total: &[f64; BASE], radians: f64) -> f64 {
    let (by_damping, by_stiffness) = (total[1] * radians / 2.0, total[2] * radians * radians / 4.0);
    by_damping.max(by_stiffness)
}

fn longest_interval_s(tasks: &[FitTask<'_>]) -> f64 {
    let intervals = tasks
        .iter()
        .map(|task| task.tightening.time_base.interval_s);
    intervals.fold(0.0, f64::max)
}

/// The best of the responses so far: what stands before Y in multiples of the mean frequency, what it leaves of which power.
struct Response {
    total: [f64; BASE],
    left: f64,
    power: f64,
}

/// The lines of one record's spectra.
struct Record {
    /// ω, T and Y of every line but the first.
    lines: Vec<(f64, Complex<f64>, Complex<f64>)>,
    samples: usize,
    /// p.
    order: i32,
}

impl Record {
    fn of(task: &FitTask<'_>) -> Option<Self> {
        let measured = task.measured();
        let torque_nm = &task.tightening.torque_nm;
        let samples = measured.len();
        let is_still = measured.windows(2).all(|pair| pair[0] == pair[1]);
        if samples != torque_nm.len() || samples < 2 * (BASE + ENDS) || is_still {
            return None;
        }
        let duration_s = samples as f64 * task.tightening.time_base.interval_s;
        let spectra = spectrum(torque_nm).into_iter().zip(spectrum(measured));
        let lines = spectra.enumerate().skip(1);
        Some(Self {
            lines: lines
                .map(|(k, (torque, output))| (TAU * k as f64 / duration_s, torque, output))
                .collect(),
            samples,
            order: Self::order_of(task.quantity()),
        })
    }

    /// How often the angle is differentiated in it.
    fn order_of(quantity: Quantity) -> i32 {
        match quantity {
            Quantity::Displacement => 0,
            Quantity::Velocity => 1,
            Quantity::Acceleration => 2,
        }
    }
}

/// Of the output's power \[rad/s\]; `None` where nothing moves.
fn mean_frequency(records: &[Record]) -> Option<f64> {
    let lines = || records.iter().flat_map(|record| &record.lines);
    let power: f64 = lines().map(|(_, _, y)| y.norm_sqr()).sum();
    let moment: f64 = lines().map(|(w, _, y)| w * y.norm_sqr()).sum();
    Some(moment / power).filter(|frequency| frequency.is_finite() && *frequency > 0.0)
}

/// What stands before Y at s.
fn before_y(total: &[f64; BASE], s: Complex<f64>) -> Complex<f64> {
    (s * total[0] + total[1]) * s + total[2]
}

/// The normal equations of all records, how each begins and ends eliminated.
struct Equations {
    matrix: SymmetricMatrix,
    right: [f64; BASE],
    /// Of the right-hand side by itself.
    squares: f64,
    /// Σ |Y|².
    power: f64,
}

impl Equations {
    /// Weighted by one over what stands before Y with `weights`.
    fn of(records: &[Record], frequency: f64, known: &[f64; BASE], weights: &[f64; BASE]) -> Self {
        let mut all = Self {
            matrix: SymmetricMatrix::zero(BASE),
            right: [0.0; BASE],
            squares: 0.0,
            power: 0.0,
        };
        for record in records {
            all.add(record, frequency, known, weights);
        }
        all
    }

    fn add(&mut self, record: &Record, frequency: f64, known: &[f64; BASE], weights: &[f64; BASE]) {
        const ALL: usize = BASE + ENDS + 1;
        let mut products = [[0.0; ALL]; ALL];
        for &(w, torque, output) in &record.lines {
            let s = Complex::new(0.0, w / frequency);
            let weight = before_y(weights, s).inv();
            let y = output * weight;
            let right = torque * s.powi(record.order) * frequency.powi(record.order) * weight
                - before_y(known, s) * y;
            let row = [
                s * s * y,
                s * y,
                y,
                weight,
                s * weight,
                s * s * weight,
                right,
            ];
            for (i, a) in row.iter().enumerate() {
                for (j, b) in row.iter().enumerate().take(i + 1) {
                    products[i][j] += a.re * b.re + a.im * b.im;
                }
            }
            self.power += output.norm_sqr();
        }
        let product = |i: usize, j: usize| products[i.max(j)][i.min(j)];
        let ends = BASE..BASE + ENDS;
        let entries = ends.clone().flat_map(|i| ends.clone().map(move |j| (i, j)));
        let of_ends = SymmetricMatrix::new(ENDS, entries.map(|(i, j)| product(i, j)).collect());
        let column = |i: usize| -> Vec<f64> { ends.clone().map(|j| product(i, j)).collect() };
        let explained: Vec<Vec<f64>> = (0..BASE)
            .chain([ALL - 1])
            .map(|i| (of_ends.solve_scaled(&column(i))).unwrap_or_else(|| vec![0.0; ENDS]))
            .collect();
        let rest =
            |i: usize, j: usize, of_j: usize| product(i, j) - dot(&column(i), &explained[of_j]);
        for i in 0..BASE {
            for j in 0..BASE {
                let sum = self.matrix.at(i, j) + rest(i, j, j);
                self.matrix.set(i, j, sum);
            }
            self.right[i] += rest(i, ALL - 1, BASE);
        }
        self.squares += rest(ALL - 1, ALL - 1, BASE);
    }

    /// What these values leave of the right-hand side, squared and summed: of the output, where the weights are theirs.
    fn left(&self, values: &[f64; BASE]) -> f64 {
        let left = self.squares - 2.0 * dot(values, &self.right) + self.matrix.quadratic(values);
        left.max(0.0)
    }

    /// The values of 0 or more that leave least, 0 where they are not free; of so few, every choice of those at 0 is tried.
    fn solution(&self, free: &[usize]) -> Option<[f64; BASE]> {
        let choices = (1..1_usize << free.len()).filter_map(|choice| {
            let chosen: Vec<usize> = (0..free.len())
                .filter(|bit| choice >> bit & 1 == 1)
                .map(|bit| free[bit])
                .collect();
            let entries = chosen
                .iter()
                .flat_map(|&i| chosen.iter().map(move |&j| (i, j)));
            let matrix = SymmetricMatrix::new(
                chosen.len(),
                entries.map(|(i, j)| self.matrix.at(i, j)).collect(),
            );
            let right: Vec<f64> = chosen.iter().map(|&i| self.right[i]).collect();
            let mut values = [0.0; BASE];
            for (&i, value) in chosen.iter().zip(matrix.solve_scaled(&right)?) {
                values[i] = value;
            }
            values.iter().all(|value| *value >= 0.0).then_some(values)
        });
        choices.min_by(|a, b| self.left(a).total_cmp(&self.left(b)))
    }
}

/// How large the model's angle is under the measured torque, and how fast: root mean squares.
fn motion(records: &[Record], frequency: f64, total: &[f64; BASE]) -> Option<(f64, f64)> {
    let (mut angle, mut speed, mut change, mut samples) = (0.0, 0.0, 0.0, 0.0);
    for record in records {
        let n = record.samples as f64;
        for &(w, torque, _) in &record.lines {
            let s = Complex::new(0.0, w / frequency);
            let power = 2.0 / n * (torque / before_y(total, s)).norm_sqr();
            angle += power;
            speed += w * w * power;
            change += w.powi(4) * power;
        }
        samples += n;
    }
    let time_s = f64::min(f64::sqrt(angle / speed), f64::sqrt(speed / change));
    let angle_rad = f64::sqrt(angle / samples);
    let sane = |size: f64| size.is_finite() && size > 0.0;
    (sane(angle_rad) && sane(time_s)).then_some((angle_rad, time_s))
}

#[cfg(test)]
mod tests;
