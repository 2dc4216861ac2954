//! Whether what a model leaves is white noise however long it is looked at: then nothing is left in it that could be explained.
//!
//! Of white noise the mean over q samples has 1/q of the variance of one; of anything that goes on for longer, more (Lo and MacKinlay 1988,
//! The Review of Financial Studies 1(1), 41–66, for increments).

/// Fewest stretches from whose means a variance is told. Chosen.
const FEWEST: usize = 8;
/// Standard deviations of a variance within which it is that of white noise. Chosen: by chance alone one of 30 000 lies beyond, of some
/// thirteen lengths one of 2 000.
const SIGMAS: f64 = 4.0;

/// Whether nothing in what is `left` of recordings goes on for longer than white noise does. Stretches are 2, 4, 8 … samples long, as long
/// as there are [`FEWEST`] of them.
pub(crate) fn is_white_noise(left: &[Vec<f64>]) -> bool {
    let samples: usize = left.iter().map(Vec::len).sum();
    let squares: f64 = left.iter().flatten().map(|value| value * value).sum();
    let mut sums = left.to_vec();
    let mut length = 1.0;
    let goes_on = |sums: &[Vec<f64>], length: f64| {
        let stretches = sums.iter().map(Vec::len).sum::<usize>() as f64;
        let of_means: f64 = sums.iter().flatten().map(|sum| sum * sum).sum();
        let times = of_means / (stretches * length) / (squares / samples as f64);
        times > 1.0 + SIGMAS * (2.0 / stretches).sqrt()
    };
    loop {
        for one in &mut sums {
            *one = one.chunks_exact(2).map(|pair| pair[0] + pair[1]).collect();
        }
        length *= 2.0;
        if sums.iter().map(Vec::len).sum::<usize>() < FEWEST {
            return samples > 0;
        }
        if goes_on(&sums, length) {
            return false;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    fn of(samples: usize, drift: f64) -> Vec<Vec<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut noise = || -> f64 { StandardNormal.sample(&mut random) };
        let place = |index: usize| drift * (2.0 * (index % samples) as f64 / samples as f64 - 1.0);
        let values: Vec<f64> = (0..2 * samples)
            .map(|index| noise() + place(index))
            .collect();
        values.chunks(samples).map(<[f64]>::to_vec).collect()
    }

    /// A drift of a third of the noise correlates neighbours by 0.03, which no one sees there.
    #[test]
    fn a_drift_far_below_the_noise_is_no_noise() {
        assert!(is_white_noise(&of(4000, 0.0)));
        assert!(!is_white_noise(&of(4000, 0.3)));
    }

    #[test]
    fn what_turns_about_every_sample_goes_on_no_longer_than_noise() {
        let turning: Vec<f64> = (0..1000)
            .map(|k| if k % 2 == 0 { 1.0 } else { -1.0 })
            .collect();
        assert!(is_white_noise(&[turning]));
    }

    #[test]
    fn of_nothing_nothing_is_known() {
        assert!(!is_white_noise(&[]));
        assert!(!is_white_noise(&[Vec::new()]));
    }
}
