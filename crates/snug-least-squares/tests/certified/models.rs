//! The 27 regression functions of the NIST StRD nonlinear sets: y = f(x; b).

use super::dual::Dual;
use std::f64::consts::PI;

/// f for one observation with predictors x.
pub type Model = fn(&[Dual], &[f64]) -> Dual;

fn polynomial(coefficients: &[Dual], x: f64) -> Dual {
    let highest_first = coefficients.iter().rev();
    highest_first.fold(Dual::from(0.0), |sum, &coefficient| sum * x + coefficient)
}

/// (b1 + b2 x + …)/(1 + … x + …), the first `above` coefficients above the line.
fn rational(b: &[Dual], above: usize, x: f64) -> Dual {
    polynomial(&b[..above], x) / (1.0 + x * polynomial(&b[above..], x))
}

fn exponentials(b: &[Dual], x: f64) -> Dual {
    let terms = b.chunks_exact(2).map(|pair| pair[0] * (-pair[1] * x).exp());
    terms.fold(Dual::from(0.0), |sum, term| sum + term)
}

fn gaussian(b: &[Dual], x: f64) -> Dual {
    let peak = |b: &[Dual]| b[0] * (-((x - b[1]) / b[2]).square()).exp();
    b[0] * (-b[1] * x).exp() + peak(&b[2..5]) + peak(&b[5..8])
}

fn periodic(b: &[Dual], x: f64) -> Dual {
    let wave = |cosine: Dual, sine: Dual, period: Dual| {
        let angle = 2.0 * PI * x / period;
        cosine * angle.cos() + sine * angle.sin()
    };
    b[0] + wave(b[1], b[2], Dual::from(12.0)) + wave(b[4], b[5], b[3]) + wave(b[7], b[8], b[6])
}

/// The function of a data set by its name.
pub fn model(name: &str) -> Option<Model> {
    Some(match name {
        "Bennett5" => |b, x| b[0] * (b[1] + x[0]).power(-1.0 / b[2]),
        "BoxBOD" | "Misra1a" => |b, x| b[0] * (1.0 - (-b[1] * x[0]).exp()),
        "Chwirut1" | "Chwirut2" => |b, x| (-b[0] * x[0]).exp() / (b[1] + b[2] * x[0]),
        "DanWood" => |b, x| b[0] * Dual::from(x[0]).power(b[1]),
        "ENSO" => |b, x| periodic(b, x[0]),
        "Eckerle4" => |b, x| b[0] / b[1] * (-0.5 * ((x[0] - b[2]) / b[1]).square()).exp(),
        "Gauss1" | "Gauss2" | "Gauss3" => |b, x| gaussian(b, x[0]),
        "Hahn1" | "Thurber" => |b, x| rational(b, 4, x[0]),
        "Kirby2" => |b, x| rational(b, 3, x[0]),
        "Lanczos1" | "Lanczos2" | "Lanczos3" => |b, x| exponentials(b, x[0]),
        "MGH09" => |b, x| {
            let square = x[0] * x[0];
            b[0] * (square + x[0] * b[1]) / (square + x[0] * b[2] + b[3])
        },
        "MGH10" => |b, x| b[0] * (b[1] / (x[0] + b[2])).exp(),
        "MGH17" => |b, x| b[0] + b[1] * (-x[0] * b[3]).exp() + b[2] * (-x[0] * b[4]).exp(),
        "Misra1b" => |b, x| b[0] * (1.0 - 1.0 / (1.0 + b[1] * x[0] / 2.0).square()),
        "Misra1c" => |b, x| b[0] * (1.0 - (1.0 + 2.0 * b[1] * x[0]).power(Dual::from(-0.5))),
        "Misra1d" => |b, x| b[0] * b[1] * x[0] / (1.0 + b[1] * x[0]),
        "Nelson" => |b, x| b[0] - b[1] * x[0] * (-b[2] * x[1]).exp(),
        "Rat42" => |b, x| b[0] / (1.0 + (b[1] - b[2] * x[0]).exp()),
        "Rat43" => |b, x| b[0] / (1.0 + (b[1] - b[2] * x[0]).exp()).power(1.0 / b[3]),
        "Roszman1" => |b, x| b[0] - b[1] * x[0] - (b[2] / (x[0] - b[3])).atan() / PI,
        _ => return None,
    })
}

/// What stands on the left: Nelson's response is log y.
pub fn response(name: &str, y: f64) -> f64 {
    if name == "Nelson" { y.ln() } else { y }
}
