//! The yardstick: one base-model fit with nothing around it.
//!
//! θ = b1 g with g″ + b3 g′ + b2 g = T, and z″ + b3 z′ + b2 z = g for the sensitivities. One pass is the exact recursion
//! for straight input and nine inner products; b1 is linear and eliminated; Gauss–Newton on b2, b3 with halving. No
//! constraints, no weights, no covariance, no checks: what any complete fit can at best approach on one core.

/// What is fitted: angle \[rad\] under torque \[Nm\].
pub struct Record<'a> {
    pub torque_nm: &'a [f64],
    pub angle_rad: &'a [f64],
    pub interval_s: f64,
    pub lever_arm_m: f64,
    pub known_inertia_kg_m2: f64,
}

/// Inner products of (g, z, z′, y) with each other, as far as they are needed.
#[derive(Default, Clone, Copy)]
pub struct Products {
    pub gg: f64,
    pub gz: f64,
    pub gd: f64,
    pub zz: f64,
    pub zd: f64,
    pub dd: f64,
    pub yg: f64,
    pub yz: f64,
    pub yd: f64,
}

/// The optimum m \[kg\], c \[kg/s\], k \[N/m\] of ½‖θ − θ̂‖² from `start` (the same).
pub fn fit(record: &Record<'_>, start: [f64; 3]) -> [f64; 3] {
    let mut descent = Descent::new(record, start);
    while !descent.is_done {
        let products = pass(record, &recursion(descent.trial, record.interval_s));
        descent.advance(&products);
    }
    descent.values(record)
}

/// Gauss–Newton on (b2, b3), one pass after the other.
pub struct Descent {
    /// Where the next pass is to be made.
    pub trial: [f64; 2],
    /// Whether no further pass is needed.
    pub is_done: bool,
    here: [f64; 2],
    step: [f64; 2],
    inverse_inertia: f64,
    /// How b1 follows b2 and b3, relative.
    follow: [f64; 2],
    energy: f64,
    cost: f64,
    passes: usize,
}

/// More passes than any fit needs.
const MOST_PASSES: usize = 50;
/// Relative step that is taken without a look at where it leads: what is left then is smaller by orders of magnitude.
const SMALL: f64 = 1e-6;
/// Share of Σ y² that rounding makes of the cost, which is a difference of such sums.
const ROUNDING: f64 = 1e-13;

impl Descent {
    pub fn new(record: &Record<'_>, start: [f64; 3]) -> Self {
        let square = record.lever_arm_m * record.lever_arm_m;
        let inertia = record.known_inertia_kg_m2 + start[0] * square;
        let trial = [start[2] * square / inertia, start[1] * square / inertia];
        Self {
            trial,
            is_done: false,
            here: trial,
            step: [0.0; 2],
            inverse_inertia: 1.0 / inertia,
            follow: [0.0; 2],
            energy: record.angle_rad.iter().map(|y| y * y).sum(),
            cost: f64::INFINITY,
            passes: 0,
        }
    }

    /// Takes the pass that was made at `trial` and says where the next is to be made.
    pub fn advance(&mut self, p: &Products) {
        self.passes += 1;
        let cost = self.energy - p.yg * p.yg / p.gg;
        if cost <= self.cost + ROUNDING * self.energy {
            (self.here, self.cost, self.inverse_inertia) = (self.trial, cost, p.yg / p.gg);
            self.step = gauss_newton(p);
            self.follow = [p.gz / p.gg, p.gd / p.gg];
        } else {
            self.step = self.step.map(|step| 0.5 * step);
        }
        let is_small = |index: usize| self.step[index].abs() < SMALL * self.here[index].abs();
        self.is_done = (is_small(0) && is_small(1)) || self.passes >= MOST_PASSES;
        self.trial = [self.here[0] + self.step[0], self.here[1] + self.step[1]];
        if self.is_done {
            self.here = self.trial;
            let [d2, d3] = self.step;
            self.inverse_inertia *= 1.0 + d2 * self.follow[0] + d3 * self.follow[1];
        }
    }

    /// m, c, k where it stands.
    pub fn values(&self, record: &Record<'_>) -> [f64; 3] {
        let square = record.lever_arm_m * record.lever_arm_m;
        let inertia = 1.0 / self.inverse_inertia;
        [
            (inertia - record.known_inertia_kg_m2) / square,
            self.here[1] * inertia / square,
            self.here[0] * inertia / square,
        ]
    }
}

/// The residual is y − b1 g; its derivatives by b2, b3 are b1 z, b1 z′ once the part along g is taken out.
fn gauss_newton(p: &Products) -> [f64; 2] {
    let b1 = p.yg / p.gg;
    let project = |own: f64, along: f64, other: f64| own - along * other / p.gg;
    let h22 = b1 * b1 * project(p.zz, p.gz, p.gz);
    let h23 = b1 * b1 * project(p.zd, p.gz, p.gd);
    let h33 = b1 * b1 * project(p.dd, p.gd, p.gd);
    let g2 = -b1 * project(p.yz, p.gz, p.yg);
    let g3 = -b1 * project(p.yd, p.gd, p.yg);
    let determinant = h22 * h33 - h23 * h23;
    [
        (g2 * h33 - g3 * h23) / determinant,
        (g3 * h22 - g2 * h23) / determinant,
    ]
}

/// One run over the samples.
fn pass(record: &Record<'_>, recursion: &Recursion) -> Products {
    let Recursion {
        own,
        coupling,
        constant,
        ramp,
    } = recursion;
    let torque = record.torque_nm;
    let mut p = Products::default();
    let mut x = [0.0_f64; 4];
    for (k, (&u, &y)) in torque.iter().zip(record.angle_rad).enumerate() {
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
        // Each by itself: packed in pairs by the compiler, they wait longer for each other than they gain.
        let driven = |index: usize| constant[index] * u + ramp[index] * du;
        let next = [
            own[0] * g + own[1] * x[1] + driven(0),
            own[2] * g + own[3] * x[1] + driven(1),
            coupling[0] * g + coupling[1] * x[1] + own[0] * z + own[1] * d + driven(2),
            coupling[2] * g + coupling[3] * x[1] + own[2] * z + own[3] * d + driven(3),
        ];
        x = next.map(std::hint::black_box);
    }
    p
}

/// (g, g′) follow `own`, (z, z′) follow `own` and are driven through `coupling`; all by the torque and its change.
pub struct Recursion {
    pub own: [f64; 4],
    pub coupling: [f64; 4],
    pub constant: [f64; 4],
    pub ramp: [f64; 4],
}

impl Recursion {
    /// Number of coefficients.
    pub const SIZE: usize = 16;

    /// All coefficients, in order.
    pub fn coefficients(&self) -> impl Iterator<Item = f64> + '_ {
        let parts = [&self.own, &self.coupling, &self.constant, &self.ramp];
        parts.into_iter().flatten().copied()
    }
}

/// e^(A h) of (g, g′, z, z′, u, Δu) at (b2, b3) by its Taylor series (‖A h‖ is far below 1 at these rates).
pub fn recursion([b2, b3]: [f64; 2], h: f64) -> Recursion {
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
    Recursion {
        own: [first[0], second[0], first[1], second[1]],
        coupling: [first[2], second[2], first[3], second[3]],
        constant: [input[0], input[1], input[2], input[3]],
        ramp: [step[0], step[1], step[2], step[3]],
    }
}
