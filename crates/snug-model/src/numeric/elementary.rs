//! e^x and tanh x with the same operations for one number and for many side by side.
//!
//! x = k ln 2 + r with a whole k and |r| ≤ ½ ln 2; then e^r = (R + r)/(R − r), where R = r (e^r + 1)/(e^r − 1) is 2 and a
//! short polynomial in r². Source: FreeBSD's e_exp.c (Sun Microsystems 1993), whose coefficients these are.

use crate::numeric::real::{Real, Task};

/// ln 2 in two parts; the first has few enough digits that k times it is exact.
const LN_2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];
/// R − 2 over r², by powers of r².
const EVEN_PART: [f64; 5] = [
    0.166_666_666_666_666_02,
    -0.002_777_777_777_701_559_3,
    6.613_756_321_437_934e-5,
    -1.653_390_220_546_525_2e-6,
    4.138_136_797_057_238_5e-8,
];

/// k, r and R.
#[inline(always)]
fn reduce<R: Real>(x: R) -> (R, R, R) {
    let k = (x * std::f64::consts::LOG2_E).nearest();
    let r = x - k * LN_2[0] - k * LN_2[1];
    let square = r * r;
    let [a, b, c, d, e] = EVEN_PART;
    let tail = square * (square * (square * (square * e + d) + c) + b) + a;
    (k, r, square * tail + 2.0)
}

/// e^x to a unit in the last place or so.
pub fn exponential_function<R: Real>(x: R) -> R {
    out_of_line(
        x,
        #[inline(always)]
        |x| {
            // Beyond, it is 0 or infinite anyway. 2^k in two steps, since either may leave the range by itself.
            let (k, r, even) = reduce(x.within(-746.0, 710.0));
            let half = (k * 0.5).nearest();
            let power = (r * 2.0) / (even - r) + 1.0;
            power * half.power_of_two() * (k - half).power_of_two()
        },
    )
}

/// tanh x = (e^2x − 1)/(e^2x + 1) to 1e−15 of its value.
///
/// With s = 2^k it is ((s − 1) R + (s + 1) r)/((s + 1) R + (s − 1) r): one division, and no digits lost near 0, where s is 1.
pub fn hyperbolic_tangent<R: Real>(x: R) -> R {
    out_of_line(
        x,
        #[inline(always)]
        |x| {
            // tanh 20 is 1 to the last digit.
            let (k, r, even) = reduce((x * 2.0).within(-40.0, 40.0));
            let s = k.power_of_two();
            let (less, more) = (s - 1.0, s + 1.0);
            (less * even + more * r) / (more * even + less * r)
        },
    )
}

struct Function<R, F>(R, F);

impl<R: Real, F: Fn(R) -> R> Task for Function<R, F> {
    type Output = R;
    #[inline(always)]
    fn run(self) -> R {
        self.1(self.0)
    }
}

/// Within the equations of motion these functions would cost every effect registers, used or not.
#[inline(never)]
fn out_of_line<R: Real>(x: R, function: impl Fn(R) -> R) -> R {
    x.vectorize(Function(x, function))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hyperbolic_tangent_agrees_with_the_standard_library() {
        for step in -60_000..=60_000 {
            let x = f64::from(step) * 5e-4 + 1e-7;
            let error = (hyperbolic_tangent(x) - x.tanh()).abs();
            assert!(error <= 2e-15 * x.tanh().abs(), "{x}: {error:e}");
        }
        assert_eq!(hyperbolic_tangent(0.0), 0.0);
        assert_eq!(hyperbolic_tangent(f64::NEG_INFINITY), -1.0);
        assert!(hyperbolic_tangent(f64::NAN).is_nan());
    }

    #[test]
    fn exponential_function_agrees_with_the_standard_library() {
        for step in -75_000..=71_000 {
            let x = f64::from(step) * 1e-2 + 1e-5;
            let (found, expected) = (exponential_function(x), x.exp());
            // The smallest numbers have no more than absolute precision.
            let within = 4e-16 * expected + 1e-323;
            assert!(
                found == expected || (found - expected).abs() <= within,
                "{x}: {found:e} {expected:e}"
            );
        }
        assert_eq!(exponential_function(0.0), 1.0);
        assert_eq!(exponential_function(f64::NEG_INFINITY), 0.0);
        assert_eq!(exponential_function(f64::INFINITY), f64::INFINITY);
        assert!(exponential_function(f64::NAN).is_nan());
    }
}
