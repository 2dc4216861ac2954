//! The offset of a channel as the quiet part shows it, with a standard error that holds under coloured noise.

use crate::noise::autoregression::Autoregression;
use crate::segment::channel::Channel;
use snug_campaign::Correction;

/// A constant error measured in the quiet part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Offset {
    /// Mean of the quiet part, in the channel's unit.
    pub(crate) value: f64,
    /// Its standard error under the measured, coloured noise.
    pub(crate) standard_error: f64,
    /// Whether it differs from zero beyond chance.
    pub(crate) significant: bool,
}

impl Offset {
    /// Mean of the quiet part with standard error √(S_0 / n), S_0 the noise's long-run variance.
    ///
    /// The mean, not a median: spikes are repaired before, and on clean noise the mean is the efficient one. A channel
    /// without noise has standard error 0.
    pub(crate) fn measure(
        quiet: &[f64],
        noise: Option<&Autoregression>,
        significance: f64,
    ) -> Self {
        let value = quiet.iter().sum::<f64>() / quiet.len() as f64;
        let standard_error = noise.map_or(0.0, |noise| noise.standard_error_of_mean(quiet.len()));
        Self {
            value,
            standard_error,
            significant: value.abs() > significance * standard_error,
        }
    }

    pub(crate) fn subtract_from(&self, samples: &mut [f64]) {
        for sample in samples {
            *sample -= self.value;
        }
    }

    /// The correction as it is reported; `None` for a channel that does not enter the model.
    pub(crate) fn correction(&self, channel: Channel) -> Option<Correction> {
        channel.offset_effect().map(|effect| Correction {
            constant_of: channel.quantity(),
            effect: effect.to_owned(),
            value: self.value,
            standard_error: self.standard_error,
            unit: channel.unit().to_owned(),
            significant: self.significant,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::synthetic::{autoregressive_noise, coloured_noise, white_noise};

    /// Share of 400 simulations whose 95 % interval covers the true bias, and the largest |z|.
    fn coverage(noise: impl Fn(u64) -> Vec<f64>) -> (f64, f64) {
        let (mut covered, mut largest) = (0, 0.0_f64);
        for seed in 0..400 {
            let mut signal = noise(seed);
            for value in &mut signal {
                *value += 0.07;
            }
            let fitted = Autoregression::fit(&signal, 30).expect("not constant");
            let offset = Offset::measure(&signal, Some(&fitted), 3.9);
            let z = ((offset.value - 0.07) / offset.standard_error).abs();
            covered += usize::from(z < 1.96);
            largest = largest.max(z);
        }
        (covered as f64 / 400.0, largest)
    }

    #[test]
    fn intervals_cover_the_true_bias() {
        // Binomial standard deviation at 400 runs is 1.1 %: 93–97 % is where an honest 95 % lies.
        for (name, (share, largest)) in [
            ("white", coverage(|seed| white_noise(7400, 0.5, seed))),
            ("sensor", coverage(|seed| coloured_noise(7400, 0.5, seed))),
            (
                "peak",
                coverage(|seed| autoregressive_noise(7400, &[-1.2, 0.6], 0.3, seed)),
            ),
        ] {
            assert!((0.93..=0.97).contains(&share), "{name}: {share}");
            assert!(largest < 4.5, "{name}: {largest}");
        }
    }

    #[test]
    fn an_iid_standard_error_would_be_far_too_small() {
        // White plus AR(1) of pole 0.9: S_0 / variance = 0.635 + 0.365·19 = 7.57.
        let signal = coloured_noise(100_000, 0.5, 9);
        let fitted = Autoregression::fit(&signal, 30).expect("not constant");
        let offset = Offset::measure(&signal, Some(&fitted), 3.9);
        let naive = 0.5 / (100_000.0_f64).sqrt();
        assert!((offset.standard_error / naive - 7.57_f64.sqrt()).abs() < 0.15);
    }

    #[test]
    fn without_noise_the_offset_is_exact() {
        let offset = Offset::measure(&[0.25; 100], None, 3.9);
        assert_eq!(
            (offset.value, offset.standard_error, offset.significant),
            (0.25, 0.0, true)
        );
        assert!(!Offset::measure(&[0.0; 100], None, 3.9).significant);
        assert_eq!(offset.correction(Channel::GripForce), None);
        assert_eq!(
            offset
                .correction(Channel::Torque)
                .map(|c| c.effect)
                .as_deref(),
            Some("torque_offset")
        );
    }
}
