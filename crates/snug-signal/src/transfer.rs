//! From an input to an output, frequency by frequency: averaged spectra, the response between them and their coherence.

use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};
use std::f64::consts::PI;
use std::sync::Arc;

/// Ratio of neighbouring frequencies up to which spectral lines are averaged together. Chosen: a response that falls with the
/// square of the frequency changes by a fifth in between.
const TOGETHER: f64 = 1.1;

/// By what a stretch is multiplied before it is transformed, so that its ends leak nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Taper {
    /// Falls as half a cosine from 1 at the start, where everything is at rest, to 0 at the end, where it may not be.
    Falling,
    /// Rises and falls (Hann), of values about their mean.
    Hann,
}

impl Taper {
    fn weights(self, length: usize) -> Vec<f64> {
        let share = |index: usize| (index as f64 + 0.5) / length as f64;
        let weight = |index: usize| match self {
            Self::Falling => 0.5 * (1.0 + (PI * share(index)).cos()),
            Self::Hann => 0.5 * (1.0 - (2.0 * PI * share(index)).cos()),
        };
        (0..length).map(weight).collect()
    }
}

/// The spectra of input and output, averaged over stretches of one length.
///
/// With U and Y the transforms of a tapered stretch's input and output, over all stretches and over lines that lie together,
///
/// ```text
/// H = Σ U* Y / Σ |U|²,   γ² = |Σ U* Y|² / (Σ |U|² Σ |Y|²)
/// ```
///
/// (H₁ of Bendat and Piersol, Random Data, 4th edition, section 6.1.4). γ² is 1 where the output follows from the input in the same
/// linear way in every stretch, less where noise, a change or a law that is not linear is in it.
pub struct Transfer {
    plan: Arc<dyn RealToComplex<f64>>,
    taper: Taper,
    weights: Vec<f64>,
    input: Vec<f64>,
    output: Vec<f64>,
    cross: Vec<Complex<f64>>,
    stretches: usize,
}

/// The response about one frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransferLine {
    /// Frequency over that of sampling \[–\]: cycles in a sample.
    pub cycles: f64,
    /// H, in the output's unit over the input's.
    pub response: Complex<f64>,
    /// γ², 0 to 1; `None` where it is of one value alone and says nothing.
    pub coherence: Option<f64>,
    /// How many values of their own were averaged \[–\].
    pub averages: f64,
}

impl TransferLine {
    /// By what factor the gain may be wrong: with 95 % it lies between |H| over this and |H| times this; `None` without coherence.
    ///
    /// exp(1.96 ε) with ε = √((1 − γ²) / (2 n γ²)) of n averages (Bendat and Piersol, chapter 9).
    pub fn factor_95(&self) -> Option<f64> {
        let coherence = self.coherence.filter(|coherence| *coherence > 0.0)?;
        let relative = ((1.0 - coherence) / (2.0 * self.averages * coherence)).sqrt();
        Some((1.959_964 * relative).exp())
    }

    /// Whether the coherence is beyond what 19 of 20 unrelated records show: 1 − 0.05^(1/(n − 1)).
    pub fn is_coherent(&self) -> bool {
        let by_chance = 1.0 - 0.05_f64.powf(1.0 / (self.averages - 1.0));
        self.coherence
            .is_some_and(|coherence| coherence > by_chance)
    }
}

impl Transfer {
    /// For stretches of `length` samples.
    pub fn of_length(length: usize, taper: Taper) -> Self {
        let lines = length / 2 + 1;
        Self {
            plan: RealFftPlanner::new().plan_fft_forward(length.max(1)),
            taper,
            weights: taper.weights(length.max(1)),
            input: vec![0.0; lines],
            output: vec![0.0; lines],
            cross: vec![Complex::default(); lines],
            stretches: 0,
        }
    }

    /// Takes one more stretch into the averages.
    ///
    /// # Panics
    /// Where input or output have another length.
    pub fn add(&mut self, input: &[f64], output: &[f64]) {
        let (u, y) = (self.transform(input), self.transform(output));
        for (line, (u, y)) in u.iter().zip(&y).enumerate() {
            self.input[line] += u.norm_sqr();
            self.output[line] += y.norm_sqr();
            self.cross[line] += u.conj() * y;
        }
        self.stretches += 1;
    }

    fn transform(&self, values: &[f64]) -> Vec<Complex<f64>> {
        assert_eq!(values.len(), self.weights.len(), "the length it is for");
        let middle = match self.taper {
            Taper::Falling => 0.0,
            Taper::Hann => values.iter().sum::<f64>() / values.len() as f64,
        };
        let pairs = values.iter().zip(&self.weights);
        let mut tapered: Vec<f64> = pairs.map(|(value, h)| h * (value - middle)).collect();
        let mut lines = self.plan.make_output_vec();
        (self.plan.process(&mut tapered, &mut lines)).expect("buffers of the plan's own lengths");
        lines
    }

    /// The response from the first line above 0 to half the sampling rate, at frequencies that grow by a factor; lines without input
    /// are left out.
    pub fn lines(&self) -> Vec<TransferLine> {
        let count = self.input.len();
        let mut told = Vec::new();
        let mut first = 1;
        while first < count {
            let end = ((first as f64 * TOGETHER).ceil() as usize).clamp(first + 1, count);
            told.extend(self.line(first..end));
            first = end;
        }
        told
    }

    fn line(&self, lines: std::ops::Range<usize>) -> Option<TransferLine> {
        let input: f64 = self.input[lines.clone()].iter().sum();
        let output: f64 = self.output[lines.clone()].iter().sum();
        let cross: Complex<f64> = self.cross[lines.clone()].iter().sum();
        let moment: f64 = (lines.clone())
            .map(|line| line as f64 * self.input[line])
            .sum();
        let averages =
            self.stretches as f64 * (lines.len() as f64 / self.lines_of_noise()).max(1.0);
        let is_sane = input > 0.0 && input.is_finite() && output.is_finite();
        is_sane.then(|| TransferLine {
            cycles: moment / input / self.weights.len() as f64,
            response: cross / input,
            coherence: (averages > 1.0 && output > 0.0)
                .then(|| (cross.norm_sqr() / (input * output)).min(1.0)),
            averages,
        })
    }

    /// Over how many lines the taper spreads one: what lies that near is not independent.
    fn lines_of_noise(&self) -> f64 {
        let sum: f64 = self.weights.iter().sum();
        let squares: f64 = self.weights.iter().map(|h| h * h).sum();
        self.weights.len() as f64 * squares / (sum * sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const INTERVAL_S: f64 = 1e-3;

    /// Evenly distributed about 0, the same each time.
    fn noise(seed: u64) -> impl Iterator<Item = f64> {
        let mut state = seed;
        std::iter::repeat_with(move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        })
    }

    /// y' = (u − y) / τ, u held between samples: exact.
    fn first_order(input: &[f64], tau_s: f64) -> Vec<f64> {
        let stays = (-INTERVAL_S / tau_s).exp();
        let mut state = 0.0;
        input
            .iter()
            .map(|u| {
                let now = state;
                state = stays * state + (1.0 - stays) * u;
                now
            })
            .collect()
    }

    /// 1 / (1 + iωτ), later by half an interval in which the input is held.
    fn truth(cycles: f64, tau_s: f64) -> Complex<f64> {
        let w = TAU * cycles / INTERVAL_S;
        Complex::from_polar(1.0, -0.5 * w * INTERVAL_S) / Complex::new(1.0, w * tau_s)
    }

    /// A pulse that is over before the window ends, and an answer that is not.
    #[test]
    fn the_answer_to_a_pulse_that_is_cut_off_is_found() {
        let tau_s = 0.05;
        let mut transfer = Transfer::of_length(300, Taper::Falling);
        for length in [40, 60, 75, 90] {
            let pulse = |t: usize| {
                if t < length {
                    (t as f64 / 30.0).sin()
                } else {
                    0.0
                }
            };
            let input: Vec<f64> = (0..300).map(pulse).collect();
            transfer.add(&input, &first_order(&input, tau_s));
        }
        let lines = transfer.lines();
        for line in lines.iter().filter(|line| line.cycles < 0.03).skip(1) {
            let off = line.response / truth(line.cycles, tau_s);
            assert!((off.norm() - 1.0).abs() < 0.1, "{line:?}");
            assert!(off.arg().abs() < 0.1, "{line:?}");
            assert!(
                line.coherence > Some(0.97) && line.is_coherent(),
                "{line:?}"
            );
        }
    }

    /// Nine parts of noise in ten of the output's power: γ² is 0.1, and the stated factor holds the truth about 95 times in 100.
    #[test]
    fn coherence_says_how_much_is_noise_and_how_well_the_gain_is_known() {
        let (mut inside, mut all, mut coherences) = (0_usize, 0, Vec::new());
        for seed in 1..=20 {
            let mut transfer = Transfer::of_length(256, Taper::Hann);
            let input: Vec<f64> = noise(seed).take(256 * 40).collect();
            let output: Vec<f64> = (input.iter().zip(noise(1000 + seed)))
                .map(|(u, e)| 2.0 * u + 6.0 * e + 7.0)
                .collect();
            for (u, y) in input.chunks(256).zip(output.chunks(256)) {
                transfer.add(u, y);
            }
            for line in transfer.lines() {
                let factor = line.factor_95().expect("there is coherence");
                let off = line.response.norm() / 2.0;
                inside += usize::from((1.0 / factor..factor).contains(&off));
                all += 1;
                coherences.push(line.coherence.expect("there is"));
            }
        }
        let mean = coherences.iter().sum::<f64>() / coherences.len() as f64;
        assert!((mean - 0.1).abs() < 0.02, "{mean}");
        let share = inside as f64 / f64::from(all);
        assert!((0.9..=0.99).contains(&share), "{share}");
    }

    /// One stretch and one line follow one another whatever they are.
    #[test]
    fn of_one_value_alone_nothing_is_said() {
        let mut transfer = Transfer::of_length(64, Taper::Hann);
        let input: Vec<f64> = noise(1).take(64).collect();
        transfer.add(&input, &noise(2).take(64).collect::<Vec<_>>());
        let first = transfer.lines()[0];
        assert_eq!((first.coherence, first.factor_95()), (None, None));
        assert!(!first.is_coherent());
        let still = Transfer::of_length(64, Taper::Hann);
        assert!(still.lines().is_empty());
    }
}
