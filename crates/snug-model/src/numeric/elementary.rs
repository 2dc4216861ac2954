//! e^x, tanh x, sin x and cos x with the same operations for one number and for many side by side.
//!
//! x = k ln 2 + r with a whole k and |r| ≤ ½ ln 2; then e^r = (R + r)/(R − r), where R = r (e^r + 1)/(e^r − 1) is 2 and a
//! short polynomial in r². Source: FreeBSD's e_exp.c (Sun Microsystems 1993), whose coefficients these are.
//!
//! x = q π/2 + r with a whole q and |r| ≤ π/4; sin r and cos r are their Taylor series, and q mod 4 says which is which. Source of the
//! three parts of π/2: Cody and Waite, Software Manual for the Elementary Functions (1980).

use crate::numeric::lanewise::{Lanewise, Task};

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

/// π/2 in three parts of 33, 33 and 53 binary digits; q times the first two is exact up to q = 2²⁰, beyond which x itself is known no
/// better.
const HALF_PI: [f64; 3] = [
    1.570_796_326_734_125_6,
    6.077_100_506_303_966e-11,
    2.022_226_624_879_595e-21,
];
/// (−1)ⁿ/(2n + 1)! from n = 1 on: sin r = r + r³ (…), to 2⁻⁶⁰ over |r| ≤ π/4.
const SINE: [f64; 8] = alternating_reciprocals(1.0);
/// (−1)ⁿ/(2n)! from n = 1 on: cos r = 1 + r² (…).
const COSINE: [f64; 8] = alternating_reciprocals(0.0);

/// −1/((1 + s)(2 + s)), and so on: every term is the one before over −(2n − 1 + s)(2n + s).
const fn alternating_reciprocals(s: f64) -> [f64; 8] {
    let mut series = [0.0; 8];
    let (mut term, mut n) = (1.0, 0);
    while n < 8 {
        let twice = 2.0 * (n as f64 + 1.0);
        term /= -(twice - 1.0 + s) * (twice + s);
        series[n] = term;
        n += 1;
    }
    series
}

/// The value of a polynomial whose coefficients begin with the constant.
#[inline(always)]
fn polynomial<R: Lanewise>(coefficients: &[f64; 8], x: R) -> R {
    let mut value = x.splat(coefficients[7]);
    for &coefficient in coefficients[..7].iter().rev() {
        value = value * x + coefficient;
    }
    value
}

/// sin x and cos x to 2⁻⁵² and what x itself is uncertain by.
pub fn sine_and_cosine<R: Lanewise>(x: R) -> (R, R) {
    out_of_line(
        x,
        #[inline(always)]
        |x| {
            let q = (x * std::f64::consts::FRAC_2_PI).nearest();
            let r = x - q * HALF_PI[0] - q * HALF_PI[1] - q * HALF_PI[2];
            // A whole number of that size has no fraction left to tell.
            let r = r.within(-1.0, 1.0);
            let square = r * r;
            let sine = r + r * square * polynomial(&SINE, square);
            let cosine = square * polynomial(&COSINE, square) + 1.0;
            // q mod 4, from −2 to 2.
            let quarter = q - (q * 0.25).nearest() * 4.0;
            let one = x.splat(1.0);
            let is_odd = (-((quarter.magnitude() - 1.0).magnitude()) + 0.5).is_positive();
            let sine_is_kept = one.is_above((quarter - 0.5).magnitude());
            let cosine_is_kept = one.is_above((quarter + 0.5).magnitude());
            let (of_sine, of_cosine) = (
                R::choose(is_odd, cosine, sine),
                R::choose(is_odd, sine, cosine),
            );
            (
                R::choose(sine_is_kept, of_sine, -of_sine),
                R::choose(cosine_is_kept, of_cosine, -of_cosine),
            )
        },
    )
}

/// k, r and R.
#[inline(always)]
fn reduce<R: Lanewise>(x: R) -> (R, R, R) {
    let k = (x * std::f64::consts::LOG2_E).nearest();
    let r = x - k * LN_2[0] - k * LN_2[1];
    let square = r * r;
    let [a, b, c, d, e] = EVEN_PART;
    let tail = square * (square * (square * (square * e + d) + c) + b) + a;
    (k, r, square * tail + 2.0)
}

/// e^x to a unit in the last place or so.
pub fn exponential_function<R: Lanewise>(x: R) -> R {
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
pub fn hyperbolic_tangent<R: Lanewise>(x: R) -> R {
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

impl<R: Lanewise, T, F: Fn(R) -> T> Task for Function<R, F> {
    type Output = T;
    #[inline(always)]
    fn run(self) -> T {
        self.1(self.0)
    }
}

/// Within the equations of motion these functions would cost every effect registers, used or not.
#[inline(never)]
fn out_of_line<R: Lanewise, T>(x: R, function: impl Fn(R) -> T) -> T {
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
    fn sine_and_cosine_agree_with_the_standard_library() {
        let steps = (-200_000..=200_000).map(|step| f64::from(step) * 1e-3 + 1e-7);
        let quarters = (-40..=40).map(|quarter| f64::from(quarter) * std::f64::consts::FRAC_PI_4);
        let far = (1..2000).map(|step| f64::from(step) * 12_345.678_9);
        for x in steps.chain(quarters).chain(far) {
            let (sine, cosine) = sine_and_cosine(x);
            let of_itself = if x.abs() > 1.6e6 { x.abs() } else { 0.0 };
            let within = 3e-16 + f64::EPSILON * of_itself;
            assert!((sine - x.sin()).abs() <= within, "{x}: {sine} {}", x.sin());
            assert!((cosine - x.cos()).abs() <= within, "{x}: {cosine}");
        }
        assert_eq!(sine_and_cosine(0.0), (0.0, 1.0));
        assert_eq!(sine_and_cosine(1e-9).0, 1e-9);
        assert!(sine_and_cosine(f64::NAN).0.is_nan() && sine_and_cosine(f64::NAN).1.is_nan());
        assert!(sine_and_cosine(1e300).0.abs() <= 1.0);
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
