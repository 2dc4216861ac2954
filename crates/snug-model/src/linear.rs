//! The base model's response, exact between samples, with its sensitivities.
//!
//! With b1 = 1/I, b2 = k l²/I, b3 = c l²/I the angle is θ = b1 g, where g″ + b3 g′ + b2 g = T. A second pair of states,
//! z″ + b3 z′ + b2 z = g, gives every sensitivity: ∂θ/∂b1 = g, ∂θ/∂b2 = −b1 z, ∂θ/∂b3 = −b1 z′. So four states carry the
//! response and all three derivatives; higher derivatives follow from the two equations themselves.

use crate::Real;
use crate::bench::Bench;
use crate::exponential::exponential;

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
struct Recursion<R> {
    /// e^(A h) of the pair (g, g′), and of (z, z′) by itself.
    own: [[R; 2]; 2],
    /// What (g, g′) adds to (z, z′).
    coupling: [[R; 2]; 2],
    constant: [R; 4],
    ramp: [R; 4],
}

impl<R: Real> Recursion<R> {
    fn new(oscillator: &Oscillator<R>, interval_s: R, held: bool) -> Self {
        let zero = interval_s.constant(0.0);
        let b2 = oscillator.stiffness_nm_per_rad / oscillator.inertia_kg_m2;
        let b3 = oscillator.damping_nm_s_per_rad / oscillator.inertia_kg_m2;
        let lanes = 0..R::LANES;
        let exponentials: Vec<[[f64; 6]; 6]> = lanes
            .map(|lane| {
                let (b2, b3) = (b2.lanes()[lane], b3.lanes()[lane]);
                let h = interval_s.lanes()[lane];
                // States g, g′, z, z′, then the input and its step over one interval.
                exponential(&[
                    [0.0, h, 0.0, 0.0, 0.0, 0.0],
                    [-b2 * h, -b3 * h, 0.0, 0.0, h, 0.0],
                    [0.0, 0.0, 0.0, h, 0.0, 0.0],
                    [h, 0.0, -b2 * h, -b3 * h, 0.0, 0.0],
                    [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
                    [0.0; 6],
                ])
            })
            .collect();
        let e: [[R; 6]; 6] = std::array::from_fn(|row| {
            std::array::from_fn(|column| zero.lane_by_lane(|lane| exponentials[lane][row][column]))
        });
        Self {
            own: [[e[0][0], e[0][1]], [e[1][0], e[1][1]]],
            coupling: [[e[2][0], e[2][1]], [e[3][0], e[3][1]]],
            constant: [e[0][4], e[1][4], e[2][4], e[3][4]],
            ramp: if held {
                [zero; 4]
            } else {
                [e[0][5], e[1][5], e[2][5], e[3][5]]
            },
        }
    }

    #[inline(always)]
    fn drive(&self, row: usize, u: R, du: R) -> R {
        self.constant[row] * u + self.ramp[row] * du
    }

    #[inline(always)]
    fn step(&self, x: [R; 4], u: R, next: R) -> [R; 4] {
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

/// Runs the oscillator from rest and hands every sample's response to `sample(index, response)`.
#[inline(always)]
pub fn respond<R: Real>(
    oscillator: &Oscillator<R>,
    bench: &Bench<'_, R>,
    mut sample: impl FnMut(usize, &Response<R>),
) {
    let inverse = bench.zero.constant(1.0) / oscillator.inertia_kg_m2;
    let constants = Constants {
        inverse,
        b2: oscillator.stiffness_nm_per_rad * inverse,
        b3: oscillator.damping_nm_s_per_rad * inverse,
    };
    let recursion = Recursion::new(oscillator, bench.interval_s, bench.held);
    let grid = bench.torque_nm();
    let mut x = [bench.zero; 4];
    let mut index = 0;
    for (point, &u) in grid.iter().enumerate() {
        if point == index * bench.substeps {
            sample(index, &constants.response(x, u));
            index += 1;
        }
        if let Some(&next) = grid.get(point + 1) {
            x = recursion.step(x, u, next);
        }
    }
}

/// The constants of the two equations.
struct Constants<R> {
    /// b1 = 1/I.
    inverse: R,
    /// K/I.
    b2: R,
    /// C/I.
    b3: R,
}

impl<R: Real> Constants<R> {
    /// Output and sensitivities from the states at one sample.
    #[inline(always)]
    fn response(&self, [g, dg, z, dz]: [R; 4], u: R) -> Response<R> {
        let Self { inverse, b2, b3 } = *self;
        let d2g = u - b3 * dg - b2 * g;
        let d2z = g - b3 * dz - b2 * z;
        let d3z = dg - b3 * d2z - b2 * dz;
        Response {
            motion: [inverse * g, inverse * dg, inverse * d2g],
            sensitivity: [
                self.row(g, -inverse * z, -inverse * dz),
                self.row(dg, -inverse * dz, -inverse * d2z),
                self.row(d2g, -inverse * d2z, -inverse * d3z),
            ],
        }
    }

    /// b1 = 1/I, b2 = K/I, b3 = C/I, so ∂/∂I = −(∂/∂b1 + K ∂/∂b2 + C ∂/∂b3) / I².
    #[inline(always)]
    fn row(&self, by_b1: R, by_b2: R, by_b3: R) -> [R; 3] {
        let Self { inverse, b2, b3 } = *self;
        let inertia = -inverse * inverse * by_b1 - inverse * (b2 * by_b2 + b3 * by_b3);
        [inertia, inverse * by_b3, inverse * by_b2]
    }
}
