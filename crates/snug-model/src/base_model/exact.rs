//! The base model's response, exact between samples, with its sensitivities.
//!
//! With b1 = 1/I, b2 = k l²/I, b3 = c l²/I the angle is θ = b1 g, where g″ + b3 g′ + b2 g = T. A second pair of states,
//! z″ + b3 z′ + b2 z = g, gives every sensitivity: ∂θ/∂K = −b1² z, ∂θ/∂C = −b1² z′, ∂θ/∂I = −b1² z″. So four states carry
//! the response and all three derivatives; higher derivatives follow from the two equations themselves.

use crate::assembly::inputs::SimulationInputs;
use crate::numeric::matrix_exponential::exponential;
use crate::numeric::number::Real;

/// The base model in the form the recursion uses.
#[derive(Debug, Clone, Copy)]
pub struct Oscillator<R> {
    /// I = I_n + m l² \[kg m²\].
    pub inertia_kg_m2: R,
    /// C = c l² \[Nm s/rad\].
    pub damping_nm_s_per_rad: R,
    /// K = k l² \[Nm/rad\].
    pub stiffness_nm_per_rad: R,
}

/// θ, ω, α at one sample and, per quantity, ∂/∂I, ∂/∂C, ∂/∂K.
#[derive(Debug, Clone, Copy)]
pub struct Response<R> {
    /// θ \[rad\], ω \[rad/s\], α \[rad/s²\].
    pub motion: [R; 3],
    /// Rows θ, ω, α; columns I, C, K.
    pub sensitivity: [[R; 3]; 3],
}

/// x_{k+1} = A x_k + B0 u_k + B1 (u_{k+1} − u_k) for x = (g, g′, z, z′).
#[derive(Debug, Clone, Copy)]
pub struct Recursion<R> {
    /// e^(A h) of the pair (g, g′), and of (z, z′) by itself.
    own: [[R; 2]; 2],
    /// What (g, g′) adds to (z, z′).
    coupling: [[R; 2]; 2],
    constant: [R; 4],
    ramp: [R; 4],
}

/// h (√b2 + b3) up to which the Taylor series is summed as it is: its 13th term is then below 0.25¹³/13! < 1e−17.
const SHORT: f64 = 0.25;
/// Terms of that series.
const TERMS: u32 = 12;

impl<R: Real> Recursion<R> {
    /// Over `interval_s` from one grid point to the next; `held` inputs stay, others go straight.
    #[inline(always)]
    pub fn new(constants: &Constants<R>, interval_s: R, held: impl Fn(usize) -> bool) -> Self {
        let h = interval_s;
        // States g, g′, z, z′, then the input and its step over one interval.
        let mut columns = [
            series(constants, h, 0),
            series(constants, h, 1),
            series(constants, h, 4),
            series(constants, h, 5),
        ];
        let rate = h * (constants.b2.magnitude().root() + constants.b3.magnitude());
        for lane in 0..R::LANES {
            // Sampled so coarsely, or so stiff, that the series needs scaling; what is no number ends here, too.
            if rate.lanes()[lane] > SHORT {
                let [h, b2, b3] = [h, constants.b2, constants.b3].map(|r| r.lanes()[lane]);
                let exact = exponential(&generator(h, b2, b3));
                for (column, place) in columns.iter_mut().zip([0, 1, 4, 5]) {
                    for (row, entry) in column.iter_mut().enumerate() {
                        entry.lanes_mut()[lane] = exact[row][place];
                    }
                }
            }
            if held(lane) {
                columns[3]
                    .iter_mut()
                    .for_each(|entry| entry.lanes_mut()[lane] = 0.0);
            }
        }
        let [first, second, constant, ramp] = columns;
        Self {
            own: [[first[0], second[0]], [first[1], second[1]]],
            coupling: [[first[2], second[2]], [first[3], second[3]]],
            constant,
            ramp,
        }
    }

    /// That of one lane.
    pub fn lane(&self, lane: usize) -> Recursion<f64> {
        let pair = |row: [R; 2]| row.map(|entry| entry.lanes()[lane]);
        Recursion {
            own: self.own.map(pair),
            coupling: self.coupling.map(pair),
            constant: self.constant.map(|entry| entry.lanes()[lane]),
            ramp: self.ramp.map(|entry| entry.lanes()[lane]),
        }
    }

    #[inline(always)]
    fn drive(&self, row: usize, u: R, du: R) -> R {
        self.constant[row] * u + self.ramp[row] * du
    }

    /// The states at the next grid point.
    #[inline(always)]
    pub fn step(&self, x: [R; 4], u: R, next: R) -> [R; 4] {
        let du = next - u;
        let (a, e) = (&self.own, &self.coupling);
        [
            a[0][0] * x[0] + a[0][1] * x[1] + self.drive(0, u, du),
            a[1][0] * x[0] + a[1][1] * x[1] + self.drive(1, u, du),
            e[0][0] * x[0]
                + e[0][1] * x[1]
                + a[0][0] * x[2]
                + a[0][1] * x[3]
                + self.drive(2, u, du),
            e[1][0] * x[0]
                + e[1][1] * x[1]
                + a[1][0] * x[2]
                + a[1][1] * x[3]
                + self.drive(3, u, du),
        ]
    }
}

/// A h of (g, g′, z, z′, u, Δu), where Δu is the input's step over one interval.
fn generator(h: f64, b2: f64, b3: f64) -> [[f64; 6]; 6] {
    [
        [0.0, h, 0.0, 0.0, 0.0, 0.0],
        [-b2 * h, -b3 * h, 0.0, 0.0, h, 0.0],
        [0.0, 0.0, 0.0, h, 0.0, 0.0],
        [h, 0.0, -b2 * h, -b3 * h, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        [0.0; 6],
    ]
}

/// The first four rows of one column of e^(A h), by applying A h to it again and again: its few entries at a time cost
/// far less than products of whole matrices.
#[inline(always)]
fn series<R: Real>(constants: &Constants<R>, h: R, column: usize) -> [R; 4] {
    let (b2, b3) = (constants.b2, constants.b3);
    let mut term = [h.constant(0.0); 6];
    term[column] = h.constant(1.0);
    let mut sum = [term[0], term[1], term[2], term[3]];
    for order in 1..=TERMS {
        let share = h * (1.0 / f64::from(order));
        let [g, dg, z, dz, u, du] = term;
        term = [
            share * dg,
            share * (u - b2 * g - b3 * dg),
            share * dz,
            share * (g - b2 * z - b3 * dz),
            du * (1.0 / f64::from(order)),
            h.constant(0.0),
        ];
        for (sum, term) in sum.iter_mut().zip(term) {
            *sum += term;
        }
    }
    sum
}

/// Runs the oscillator from rest and hands every sample's response to `sample(index, response)`.
#[inline(always)]
pub fn respond<R: Real>(
    oscillator: &Oscillator<R>,
    inputs: &SimulationInputs<'_, R>,
    mut sample: impl FnMut(usize, &Response<R>),
) {
    let constants = Constants::new(oscillator);
    let recursion = Recursion::new(&constants, inputs.interval_s, |_| inputs.held);
    let grid = inputs.torque_nm();
    let mut x = [inputs.zero; 4];
    let mut index = 0;
    for (point, &u) in grid.iter().enumerate() {
        if point == index * inputs.substeps {
            sample(index, &constants.response(x, u));
            index += 1;
        }
        if let Some(&next) = grid.get(point + 1) {
            x = recursion.step(x, u, next);
        }
    }
}

/// The constants of the two equations.
#[derive(Debug, Clone, Copy)]
pub struct Constants<R> {
    /// b1 = 1/I.
    inverse: R,
    /// K/I.
    b2: R,
    /// C/I.
    b3: R,
}

/// g and z with their derivatives at one sample: θ = b1 g, ∂θ/∂I = −b1² z″, ∂θ/∂C = −b1² z′, ∂θ/∂K = −b1² z; every
/// dot on θ is one more on the right.
#[derive(Debug, Clone, Copy)]
pub struct Derivatives<R> {
    /// g, g′, g″.
    pub g: [R; 3],
    /// z to z⁗.
    pub z: [R; 5],
}

impl<R: Real> Constants<R> {
    /// Of this oscillator.
    #[inline(always)]
    pub fn new(oscillator: &Oscillator<R>) -> Self {
        let inverse = oscillator.inertia_kg_m2.constant(1.0) / oscillator.inertia_kg_m2;
        Self {
            inverse,
            b2: oscillator.stiffness_nm_per_rad * inverse,
            b3: oscillator.damping_nm_s_per_rad * inverse,
        }
    }

    /// b1.
    #[inline(always)]
    pub fn inverse(&self) -> R {
        self.inverse
    }

    /// All derivatives from the states at one sample and the torque there.
    #[inline(always)]
    pub fn derivatives(&self, [g, dg, z, dz]: [R; 4], u: R) -> Derivatives<R> {
        let Self { b2, b3, .. } = *self;
        let d2g = u - b3 * dg - b2 * g;
        let d2z = g - b3 * dz - b2 * z;
        let d3z = dg - b3 * d2z - b2 * dz;
        let d4z = d2g - b3 * d3z - b2 * d2z;
        Derivatives {
            g: [g, dg, d2g],
            z: [z, dz, d2z, d3z, d4z],
        }
    }

    /// Output and sensitivities from the states at one sample.
    #[inline(always)]
    fn response(&self, x: [R; 4], u: R) -> Response<R> {
        let b1 = self.inverse;
        let Derivatives { g, z } = self.derivatives(x, u);
        let scale = -(b1 * b1);
        Response {
            motion: [b1 * g[0], b1 * g[1], b1 * g[2]],
            sensitivity: [
                [scale * z[2], scale * z[1], scale * z[0]],
                [scale * z[3], scale * z[2], scale * z[1]],
                [scale * z[4], scale * z[3], scale * z[2]],
            ],
        }
    }
}
