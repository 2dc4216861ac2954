//! The base model's response, exact between samples, with its sensitivities.
//!
//! With b1 = 1/I, b2 = k l²/I, b3 = c l²/I the angle is θ = b1 g, where g″ + b3 g′ + b2 g = T. A second pair of states,
//! z″ + b3 z′ + b2 z = g, gives every sensitivity: ∂θ/∂b1 = g, ∂θ/∂b2 = −b1 z, ∂θ/∂b3 = −b1 z′. So four states carry the
//! response and all three derivatives; higher derivatives follow from the two equations themselves.

use crate::Input;
use crate::exponential::exponential;

/// The base model in the form the recursion uses.
#[derive(Debug, Clone, Copy)]
pub struct Oscillator {
    /// I = I_n + m l² \[kg m²\].
    pub inertia_kg_m2: f64,
    /// C = c l² \[Nm s/rad\].
    pub damping_nm_s_per_rad: f64,
    /// K = k l² \[Nm/rad\].
    pub stiffness_nm_per_rad: f64,
}

/// θ, ω, α at one sample and, per quantity, ∂/∂I, ∂/∂C, ∂/∂K.
#[derive(Debug, Clone, Copy)]
pub struct Response {
    /// θ \[rad\], ω \[rad/s\], α \[rad/s²\].
    pub motion: [f64; 3],
    /// Rows θ, ω, α; columns I, C, K.
    pub sensitivity: [[f64; 3]; 3],
}

/// x_{k+1} = A x_k + B0 u_k + B1 (u_{k+1} − u_k) for x = (g, g′, z, z′).
struct Recursion {
    /// e^(A h) of the pair (g, g′), and of (z, z′) by itself.
    own: [[f64; 2]; 2],
    /// What (g, g′) adds to (z, z′).
    coupling: [[f64; 2]; 2],
    constant: [f64; 4],
    ramp: [f64; 4],
}

impl Recursion {
    fn new(oscillator: &Oscillator, interval_s: f64, held: bool) -> Self {
        let b2 = oscillator.stiffness_nm_per_rad / oscillator.inertia_kg_m2;
        let b3 = oscillator.damping_nm_s_per_rad / oscillator.inertia_kg_m2;
        let h = interval_s;
        // States g, g′, z, z′, then the input and its step over one interval.
        let generator = [
            [0.0, h, 0.0, 0.0, 0.0, 0.0],
            [-b2 * h, -b3 * h, 0.0, 0.0, h, 0.0],
            [0.0, 0.0, 0.0, h, 0.0, 0.0],
            [h, 0.0, -b2 * h, -b3 * h, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
            [0.0; 6],
        ];
        let e = exponential(&generator);
        Self {
            own: [[e[0][0], e[0][1]], [e[1][0], e[1][1]]],
            coupling: [[e[2][0], e[2][1]], [e[3][0], e[3][1]]],
            constant: [e[0][4], e[1][4], e[2][4], e[3][4]],
            ramp: if held {
                [0.0; 4]
            } else {
                [e[0][5], e[1][5], e[2][5], e[3][5]]
            },
        }
    }

    #[inline(always)]
    fn step(&self, x: [f64; 4], u: f64, next: f64) -> [f64; 4] {
        let du = next - u;
        let drive = |row: usize| self.constant[row] * u + self.ramp[row] * du;
        let (a, e) = (&self.own, &self.coupling);
        [
            a[0][0] * x[0] + a[0][1] * x[1] + drive(0),
            a[1][0] * x[0] + a[1][1] * x[1] + drive(1),
            e[0][0] * x[0] + e[0][1] * x[1] + a[0][0] * x[2] + a[0][1] * x[3] + drive(2),
            e[1][0] * x[0] + e[1][1] * x[1] + a[1][0] * x[2] + a[1][1] * x[3] + drive(3),
        ]
    }
}

/// Runs the oscillator from rest and hands every sample's response to `sample(index, response)`.
#[inline(always)]
pub fn respond(oscillator: &Oscillator, input: &Input, mut sample: impl FnMut(usize, &Response)) {
    let inverse = 1.0 / oscillator.inertia_kg_m2;
    let b2 = oscillator.stiffness_nm_per_rad * inverse;
    let b3 = oscillator.damping_nm_s_per_rad * inverse;
    let recursion = Recursion::new(oscillator, input.grid_interval_s(), input.held());
    let grid = input.grid();
    let mut x = [0.0; 4];
    let mut index = 0;
    for (point, &u) in grid.iter().enumerate() {
        if point == index * input.substeps() {
            sample(index, &response(x, u, inverse, b2, b3));
            index += 1;
        }
        if let Some(&next) = grid.get(point + 1) {
            x = recursion.step(x, u, next);
        }
    }
}

/// Output and sensitivities from the states at one sample.
#[inline(always)]
fn response([g, dg, z, dz]: [f64; 4], u: f64, inverse: f64, b2: f64, b3: f64) -> Response {
    let d2g = u - b3 * dg - b2 * g;
    let d2z = g - b3 * dz - b2 * z;
    let d3z = dg - b3 * d2z - b2 * dz;
    let row = |by_b1: f64, by_b2: f64, by_b3: f64| {
        // b1 = 1/I, b2 = K/I, b3 = C/I, so ∂/∂I = −(∂/∂b1 + K ∂/∂b2 + C ∂/∂b3) / I².
        let inertia = -inverse * inverse * by_b1 - inverse * (b2 * by_b2 + b3 * by_b3);
        [inertia, inverse * by_b3, inverse * by_b2]
    };
    Response {
        motion: [inverse * g, inverse * dg, inverse * d2g],
        sensitivity: [
            row(g, -inverse * z, -inverse * dz),
            row(dg, -inverse * dz, -inverse * d2z),
            row(d2g, -inverse * d2z, -inverse * d3z),
        ],
    }
}
