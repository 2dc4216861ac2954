//! Which samples of a tightening count, and how a signal of every sample becomes what the solver sees of it.

use crate::residual::whitening::Whitening;
use snug_campaign::Quantity;
use snug_model::Input;
use std::ops::Range;

/// What counts of a tightening's residual, and of each of its derivatives.
///
/// Where the noise is known, it is whitened. Where it is not and a displacement is restarted from the measured motion, a straight line from one
/// restart to the next counts only so far as errors of the motion that was taken up there are not as large: such an error is a line at first, of
/// twice or more the noise's size at its end.
#[derive(Debug, Clone)]
pub struct Scoring {
    whitening: Option<Whitening>,
    unscored: usize,
    samples: usize,
    /// Where straight lines from restart to restart count as far as they are no errors.
    beside: Option<BesideLines>,
}

impl Scoring {
    /// Of a fitted `quantity` under this `input`, without `unscored` samples at its start, in which an unknown initial state dies away.
    pub fn new(
        quantity: Quantity,
        input: &Input,
        whitening: Option<Whitening>,
        unscored: usize,
    ) -> Self {
        let unscored = unscored.min(input.samples());
        let beside = whitening.is_none() && has_lines(quantity, input);
        Self {
            whitening,
            unscored,
            samples: input.samples(),
            beside: beside.then(|| BesideLines::of(input, unscored)),
        }
    }

    /// The filter that whitens it, where the noise is known.
    pub fn whitening(&self) -> Option<&Whitening> {
        self.whitening.as_ref()
    }

    /// Samples at the start that count for nothing.
    pub(crate) fn unscored(&self) -> usize {
        self.unscored
    }

    /// Whether every sample counts as it is.
    pub(crate) fn is_plain(&self) -> bool {
        self.whitening.is_none() && self.unscored == 0 && self.beside.is_none()
    }

    /// How many numbers count.
    pub fn count(&self) -> usize {
        match &self.beside {
            Some(beside) => beside.count(),
            None => {
                let lost = self.whitening().map_or(0, Whitening::order);
                (self.samples - self.unscored).saturating_sub(lost)
            }
        }
    }

    /// What counts of a `signal` of every sample: [`count`](Self::count) numbers.
    pub fn weigh(&self, signal: &[f64], weighed: &mut [f64]) {
        match (&self.whitening, &self.beside) {
            (Some(whitening), _) => whitening.apply(&signal[self.unscored..], weighed),
            (None, Some(beside)) => beside.innovations(signal, weighed),
            (None, None) => weighed.copy_from_slice(&signal[self.unscored..]),
        }
    }
}

/// Whether errors of the motion taken up under this `input` are straight lines of a fitted `quantity`.
pub(crate) fn has_lines(quantity: Quantity, input: &Input) -> bool {
    input.is_restarted() && quantity == Quantity::Displacement
}

/// What a signal is beside straight lines, one from each restart to the next, as numbers that are white with the signal's own variance where it is
/// white but for such lines, of known variances: how far each sample lies from what is known of the line from those before it, over the standard
/// deviation of that (innovations of a Kalman filter whose state, a line, stays; Harvey 1989, Forecasting, Structural Time Series Models and the
/// Kalman Filter, 3.2),
///
/// w_m = (r_m − h b) / √s, s = 1 + h P hᵀ, then b ← b + P hᵀ (r_m − h b) / s and P⁻¹ ← P⁻¹ + hᵀ h, with h = (1, m).
///
/// Where nothing is known of a line its first two samples say it and are no numbers; the others are the recursive residuals of Brown, Durbin
/// and Evans 1975 (Journal of the Royal Statistical Society B 37(2), 149–192).
#[derive(Debug, Clone)]
struct BesideLines {
    /// Samples from one restart to the next, and which of the `kinds` of lines is there.
    stretches: Vec<(Range<usize>, usize)>,
    kinds: Vec<Line>,
}

/// A line from a restart on, and what each sample says of it.
#[derive(Debug, Clone)]
struct Line {
    /// Variance of its value and slope at the restart, over that of a sample \[–\].
    variances: [f64; 2],
    /// Samples after the restart of the first that counts.
    first: usize,
    innovations: Vec<Innovation>,
}

/// How a sample's distance from a line counts, and by how much of it value and slope of the line move.
#[derive(Debug, Clone)]
struct Innovation {
    over_deviation: f64,
    gain: [f64; 2],
}

/// Precision of a line of which nothing is known, over that of a sample \[–\]: nothing beside what two samples say, and no rounding.
const NOTHING_KNOWN: f64 = 1e-14;

impl Line {
    fn new(variances: [f64; 2], first: usize) -> Self {
        Self {
            variances,
            first,
            innovations: Vec::new(),
        }
    }

    /// Samples that only say the line.
    fn lost(&self) -> usize {
        let unknown = self.variances.iter().filter(|one| one.is_infinite());
        unknown.count()
    }

    /// How many numbers a stretch is beside it.
    fn numbers(&self, stretch: &Range<usize>) -> usize {
        stretch.len().saturating_sub(self.lost())
    }

    /// Known for so many samples.
    fn reach(&mut self, samples: usize) {
        let mut precision = self.variances.map(|one| (1.0 / one).max(NOTHING_KNOWN));
        let mut between = 0.0;
        self.innovations.clear();
        for m in self.first..self.first + samples {
            let m = m as f64;
            let [of_value, of_slope] = precision;
            let determinant = of_value * of_slope - between * between;
            // P hᵀ.
            let told = [
                (of_slope - between * m) / determinant,
                (of_value * m - between) / determinant,
            ];
            let variance = 1.0 + told[0] + m * told[1];
            self.innovations.push(Innovation {
                over_deviation: variance.sqrt().recip(),
                gain: told.map(|told| told / variance),
            });
            precision = [of_value + 1.0, of_slope + m * m];
            between += m;
        }
    }

    fn innovations(&self, samples: &[f64], numbers: &mut [f64]) {
        let (mut value, mut slope) = (0.0, 0.0);
        let lost = samples.len() - numbers.len();
        let at = (self.first..).zip(&self.innovations);
        for (place, (&sample, (m, innovation))) in samples.iter().zip(at).enumerate() {
            let beside = sample - value - m as f64 * slope;
            value += innovation.gain[0] * beside;
            slope += innovation.gain[1] * beside;
            if let Some(number) = place.checked_sub(lost) {
                numbers[number] = innovation.over_deviation * beside;
            }
        }
    }
}

impl BesideLines {
    fn of(input: &Input, unscored: usize) -> Self {
        let apart = input.samples_between_restarts().unwrap_or(1);
        let mut kinds: Vec<Line> = Vec::new();
        let mut longest = 0;
        let of_one = |stretch: Range<usize>| {
            let (variances, first) = (
                input.variance_at_restart(stretch.start),
                stretch.start % apart,
            );
            let line = Line::new(variances.unwrap_or([f64::INFINITY; 2]), first);
            let known = |one: &Line| (one.variances, one.first) == (line.variances, line.first);
            let kind = kinds.iter().position(known).unwrap_or(kinds.len());
            if kind == kinds.len() {
                kinds.push(line);
            }
            longest = longest.max(stretch.len());
            (stretch, kind)
        };
        let stretches = input.stretches(unscored).map(of_one).collect();
        kinds.iter_mut().for_each(|line| line.reach(longest));
        Self { stretches, kinds }
    }

    fn count(&self) -> usize {
        let numbers = |(stretch, kind): &(Range<usize>, usize)| self.kinds[*kind].numbers(stretch);
        self.stretches.iter().map(numbers).sum()
    }

    fn innovations(&self, signal: &[f64], numbers: &mut [f64]) {
        let mut rest = numbers;
        for (stretch, kind) in &self.stretches {
            let line = &self.kinds[*kind];
            let (numbers, further) = rest.split_at_mut(line.numbers(stretch));
            line.innovations(&signal[stretch.clone()], numbers);
            rest = further;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use snug_campaign::Intersample;

    const APART: usize = 12;

    fn restarted(samples: usize, quantity: Quantity, unscored: usize) -> Scoring {
        let input = Input::new(&vec![0.0; samples], 1e-3, Intersample::Linear);
        let motions = vec![[0.0; 2]; samples.div_ceil(APART)];
        let input = input.with_restarts(APART, motions);
        Scoring::new(quantity, &input, None, unscored)
    }

    fn weighed(scoring: &Scoring, signal: &[f64]) -> Vec<f64> {
        let mut weighed = vec![f64::NAN; scoring.count()];
        scoring.weigh(signal, &mut weighed);
        weighed
    }

    /// Another line in every stretch, the first and the last of which are cut short.
    #[test]
    fn straight_lines_between_restarts_count_for_nothing() {
        let (samples, unscored) = (62, 5);
        let scoring = restarted(samples, Quantity::Displacement, unscored);
        let line = |k: usize| (k / APART) as f64 * 40.0 - 3.0 * (k % APART) as f64;
        let lines: Vec<f64> = (0..samples).map(line).collect();
        // 7, 4 times 12 and 2 samples, two numbers less of each.
        assert_eq!(scoring.count(), 5 + 4 * 10);
        assert!(weighed(&scoring, &lines).iter().all(|w| w.abs() < 1e-10));
    }

    /// From numpy.polyfit: least squares of all five, and each sample beside the line through those before it.
    #[test]
    fn what_counts_is_what_lies_beside_the_line_of_least_squares() {
        let signal = [1.0, 0.0, 0.0, 2.0, 5.0];
        let scoring = restarted(signal.len(), Quantity::Displacement, 0);
        let near = |found: &[f64], expected: &[f64]| {
            assert_eq!(found.len(), expected.len());
            let mut pairs = found.iter().zip(expected);
            assert!(
                pairs.all(|(one, other)| (one - other).abs() < 1e-12),
                "{found:?}"
            );
        };
        let recursive = [
            0.408_248_290_463_863_1,
            1.460_593_486_680_443_3,
            2.213_594_362_117_865_5,
        ];
        near(&weighed(&scoring, &signal), &recursive);
        let squares: f64 = recursive.iter().map(|number| number * number).sum();
        assert!((squares - 7.2).abs() < 1e-12);
    }

    /// Beside lines of known variances it is rᵀ (I + A P Aᵀ)⁻¹ r of every stretch, the first of which was begun three samples before
    /// (numpy.linalg).
    #[test]
    fn lines_count_as_far_as_they_are_larger_than_errors() {
        let signal = [0.0, 0.0, 0.0, 2.0, 5.0, 1.0, 0.0, 0.0, 2.0, 5.0];
        let input =
            Input::new(&[0.0; 10], 1e-3, Intersample::Linear).with_restarts(5, vec![[0.0; 2]; 2]);
        let input = input.with_variances_at_restarts(vec![[0.5, 0.25], [4.0, 1.0]]);
        let scoring = Scoring::new(Quantity::Displacement, &input, None, 3);
        let squares = |numbers: &[f64]| numbers.iter().map(|number| number * number).sum::<f64>();
        let found = weighed(&scoring, &signal);
        assert_eq!(found.len(), 7);
        for (found, expected) in [
            (&found[..2], 5.462686567164179),
            (&found[2..], 8.1195219123506),
        ] {
            assert!((squares(found) - expected).abs() < 1e-12, "{found:?}");
        }
    }

    /// A speed's error is no line, and where the noise is known that says what counts.
    #[test]
    fn other_signals_count_as_they_are() {
        let signal = [4.0, 1.0, 0.0, 2.0, 5.0];
        let scoring = restarted(signal.len(), Quantity::Velocity, 1);
        assert_eq!(weighed(&scoring, &signal), signal[1..]);
    }
}
