//! The yardstick: one base-model fit with nothing around it.
//!
//! θ = b1 g with g″ + b3 g′ + b2 g = T, and z″ + b3 z′ + b2 z = g for the sensitivities. One pass is the exact recursion
//! for straight input and nine inner products; b1 is linear and eliminated; Gauss–Newton on b2, b3 with halving. No
//! constraints, no weights, no covariance, no checks: what any complete fit can at best approach on one core.

/// Inner products of (g, −z, −z′, θ) with each other, upper triangle.
#[derive(Default, Clone, Copy)]
struct Products {
    gg: f64,
    gz: f64,
    gd: f64,
    zz: f64,
    zd: f64,
    dd: f64,
    yg: f64,
    yz: f64,
    yd: f64,
}

/// The optimum m \[kg\], c \[kg/s\], k \[N/m\] of ½‖θ − θ̂‖², from `start` (the same), for the angle \[rad\] under torque \[Nm\], lever `l` \[m\] and inertia `known` \[kg m²\].
pub fn fit(
    torque: &[f64],
    angle: &[f64],
    interval_s: f64,
    l: f64,
    known: f64,
    start: [f64; 3],
) -> [f64; 3] {
    let square = l * l;
    let inertia = known + start[0] * square;
    let (mut b2, mut b3) = (start[2] * square / inertia, start[1] * square / inertia);
    let energy: f64 = angle.iter().map(|y| y * y).sum();
    let mut products = pass(torque, angle, interval_s, b2, b3);
    let mut passes = 1;
    let mut cost = energy - products.yg * products.yg / products.gg;
    loop {
        let p = &products;
        let b1 = p.yg / p.gg;
        // Residual y − b1 g; its derivatives by b2, b3 are b1 z, b1 z′ once the part along g is taken out.
        let project = |own: f64, along: f64, other: f64| own - along * other / p.gg;
        let h22 = b1 * b1 * project(p.zz, p.gz, p.gz);
        let h23 = b1 * b1 * project(p.zd, p.gz, p.gd);
        let h33 = b1 * b1 * project(p.dd, p.gd, p.gd);
        let g2 = -b1 * project(p.yz, p.gz, p.yg);
        let g3 = -b1 * project(p.yd, p.gd, p.yg);
        let determinant = h22 * h33 - h23 * h23;
        let (mut d2, mut d3) = (
            (g2 * h33 - g3 * h23) / determinant,
            (g3 * h22 - g2 * h23) / determinant,
        );
        let small = d2.abs() < 1e-9 * b2.abs() && d3.abs() < 1e-9 * b3.abs();
        if small || passes > 50 {
            let inertia = 1.0 / b1;
            return [
                (inertia - known) / square,
                b3 * inertia / square,
                b2 * inertia / square,
            ];
        }
        loop {
            let trial = pass(torque, angle, interval_s, b2 + d2, b3 + d3);
            passes += 1;
            let trial_cost = energy - trial.yg * trial.yg / trial.gg;
            if trial_cost <= cost * (1.0 + 1e-14) || passes > 50 {
                (b2, b3, cost, products) = (b2 + d2, b3 + d3, trial_cost, trial);
                break;
            }
            (d2, d3) = (0.5 * d2, 0.5 * d3);
        }
    }
}

/// One run over the samples.
fn pass(torque: &[f64], angle: &[f64], h: f64, b2: f64, b3: f64) -> Products {
    let (own, coupling, constant, ramp) = recursion(b2, b3, h);
    let mut p = Products::default();
    let mut x = [0.0_f64; 4];
    for (k, (&u, &y)) in torque.iter().zip(angle).enumerate() {
        let [g, _, z, d] = x;
        p.gg += g * g;
        p.gz += g * z;
        p.gd += g * d;
        p.zz += z * z;
        p.zd += z * d;
        p.dd += d * d;
        p.yg += y * g;
        p.yz += y * z;
        p.yd += y * d;
        let du = torque.get(k + 1).map_or(0.0, |next| next - u);
        x = [
            own[0] * x[0] + own[1] * x[1] + constant[0] * u + ramp[0] * du,
            own[2] * x[0] + own[3] * x[1] + constant[1] * u + ramp[1] * du,
            coupling[0] * x[0]
                + coupling[1] * x[1]
                + own[0] * x[2]
                + own[1] * x[3]
                + constant[2] * u
                + ramp[2] * du,
            coupling[2] * x[0]
                + coupling[3] * x[1]
                + own[2] * x[2]
                + own[3] * x[3]
                + constant[3] * u
                + ramp[3] * du,
        ];
    }
    p
}

type Blocks = ([f64; 4], [f64; 4], [f64; 4], [f64; 4]);

/// e^(A h) of (g, g′, z, z′, u, Δu) by its Taylor series (‖A h‖ is far below 1 at these rates).
fn recursion(b2: f64, b3: f64, h: f64) -> Blocks {
    // Column by column: apply the generator to a vector repeatedly.
    let apply = |v: [f64; 6]| {
        [
            h * v[1],
            h * (v[4] - b2 * v[0] - b3 * v[1]),
            h * v[3],
            h * (v[0] - b2 * v[2] - b3 * v[3]),
            v[5],
            0.0,
        ]
    };
    let column = |index: usize| {
        let mut term = [0.0; 6];
        term[index] = 1.0;
        let mut sum = term;
        for order in 1..=12 {
            term = apply(term).map(|value| value / f64::from(order));
            for (total, value) in sum.iter_mut().zip(term) {
                *total += value;
            }
        }
        sum
    };
    let (first, second, input, step) = (column(0), column(1), column(4), column(5));
    (
        [first[0], second[0], first[1], second[1]],
        [first[2], second[2], first[3], second[3]],
        [input[0], input[1], input[2], input[3]],
        [step[0], step[1], step[2], step[3]],
    )
}
