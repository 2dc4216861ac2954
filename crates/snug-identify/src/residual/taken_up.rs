//! How uncertain the motion is that a simulation takes up at a restart.

use crate::residual::local_cubic::LocalCubic;
use crate::residual::thresholds::{MOST_OF_NORMAL, MOST_RESTARTS};
use snug_signal::white_noise_level;

/// Variance of the angle and of the velocity times the time of a sample, over that of one sample's noise \[–\], where these cubics of what was
/// `measured` are `taken_up`: what white noise makes of them, and beside it by how much more than noise those over half as many samples differ,
/// since the motion bends otherwise than a cubic. The few restarts at which they differ most do not count: what a sensor did there is no bend of
/// the motion. Infinite where there is no noise.
pub(crate) fn variances(
    taken_up: &[LocalCubic],
    narrower: &[LocalCubic],
    measured: &[f64],
) -> Vec<[f64; 2]> {
    let noise = noise_variance(measured);
    if noise <= 0.0 {
        return vec![[f64::INFINITY; 2]; taken_up.len()];
    }
    let bent = [0, 1].map(|part| {
        let pairs = || taken_up.iter().zip(narrower);
        let squares = pairs().map(|(a, b)| (a.motion[part] - b.motion[part]).powi(2));
        // The wider cubic is the surer, and tells all that the other does: their difference has the difference of their variances.
        let of_noise = pairs().map(|(a, b)| b.of_noise[part] - a.of_noise[part]);
        let of_noise = MOST_OF_NORMAL * of_noise.sum::<f64>() / taken_up.len() as f64;
        (mean_of_most(squares.collect()) / noise - of_noise).max(0.0)
    });
    let variance = |one: &LocalCubic| [0, 1].map(|part| one.of_noise[part] + bent[part]);
    taken_up.iter().map(variance).collect()
}

/// Variance of single samples' white noise: of second differences of second differences, which a motion over more than a few samples hardly moves,
/// and whose variance is seventy times the noise's in place of six.
fn noise_variance(measured: &[f64]) -> f64 {
    let bends = measured.windows(3).map(|y| y[0] - 2.0 * y[1] + y[2]);
    white_noise_level(&bends.collect::<Vec<_>>()).powi(2) * 6.0 / 70.0
}

/// Mean of these without the few largest.
fn mean_of_most(mut squares: Vec<f64>) -> f64 {
    squares.sort_by(f64::total_cmp);
    let kept = (MOST_RESTARTS * squares.len() as f64).ceil();
    squares.iter().take(kept as usize).sum::<f64>() / kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::residual::local_cubic::local_cubics;

    const APART: usize = 25;

    /// Of cubics over so many samples on either side.
    fn of(measured: &[f64], half_width: usize) -> Vec<[f64; 2]> {
        let cubics = |half_width: usize| local_cubics(measured, APART, half_width);
        variances(&cubics(half_width), &cubics(half_width / 2), measured)
    }

    /// White noise of standard deviation 1.
    fn noise(samples: usize) -> Vec<f64> {
        let mut state = 7_u64;
        let mut uniform = move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let twelve = |_| (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        (0..samples).map(twelve).collect()
    }

    /// From numpy: of the cubic over 17 samples, (AᵀA)⁻¹ of its value and slope in the middle, and four times as much more as 400 restarts give by
    /// chance (standard deviation of 400 draws of noise).
    #[test]
    fn noise_alone_makes_of_a_cubic_what_least_squares_say() {
        let found = of(&noise(10_000), 8);
        let of_middle = found[200];
        let expected = [0.133_126_934_984_520_1, 0.015_702_041_050_338_26];
        for ((found, least), chance) in of_middle.iter().zip(expected).zip([0.0081, 0.0063]) {
            assert!(
                *found >= least - 1e-12 && *found < least + 4.0 * chance,
                "{found} {least}"
            );
        }
        assert!(
            found[0][1] > 10.0 * of_middle[1],
            "an end is known from one side"
        );
    }

    /// A swing of 60 samples bends otherwise than a cubic over 33 by far more than noise of a ten-thousandth.
    #[test]
    fn what_bends_is_as_uncertain_as_it_is_wrong() {
        let swing = |k: usize| (k as f64 * std::f64::consts::TAU / 60.0).sin();
        let measured = noise(10_000).into_iter().enumerate();
        let measured: Vec<f64> = measured.map(|(k, e)| swing(k) + 1e-4 * e).collect();
        let found = of(&measured, 16);
        let places = (1..399).map(|place| {
            let at = place * APART;
            let slope =
                (at as f64 * std::f64::consts::TAU / 60.0).cos() * std::f64::consts::TAU / 60.0;
            (LocalCubic::fit(&measured, at, 16).motion[1] - slope).powi(2)
        });
        let actual = places.sum::<f64>() / 398.0 / 1e-8;
        let ratio = found[200][1] / actual;
        assert!((0.5..2.0).contains(&ratio), "{ratio}");
    }

    /// A sensor that slips in one place of four hundred makes the motion no less certain anywhere.
    #[test]
    fn a_slip_is_no_bend_of_the_motion() {
        let slipped = noise(10_000).into_iter().enumerate();
        let slipped = slipped.map(|(k, e)| e + if k < 5000 { 0.0 } else { 1000.0 });
        let slipped: Vec<f64> = slipped.collect();
        let [found, plain] = [&slipped, &noise(10_000)].map(|one| of(one, 8)[150]);
        for (found, plain) in found.iter().zip(plain) {
            assert!((found / plain - 1.0).abs() < 0.1, "{found} {plain}");
        }
    }

    #[test]
    fn without_noise_nothing_is_said_of_the_motion() {
        let line: Vec<f64> = (0..200).map(|k| f64::from(k) * 0.5).collect();
        assert!(of(&line, 8).concat().iter().all(|one| one.is_infinite()));
    }
}
