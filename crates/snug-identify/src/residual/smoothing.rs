//! Residuals seen from afar: averaged over neighbouring samples, over ever fewer of them.
//!
//! Where a law sets in with a jump, as at the edge of a gap in the grip, the residual of a slightly wrong parameter is a
//! spike at the wrong instant, and no slope leads from one instant to the other. Averaged, they overlap.

/// Samples to either side over which residuals are averaged, one fit after the other: 8 ms at 10 kHz at first. A fit that is
/// a few samples off sees the jump only when it is spread over as many.
pub const HALF_WIDTHS: [usize; 5] = [80, 20, 8, 3, 1];

/// Averages over `half_width` samples to either side, fewer at the ends.
pub fn smooth(signal: &mut [f64], half_width: usize) {
    let last = signal.len();
    let mut sums = vec![0.0; last + 1];
    let mut sum = 0.0;
    for (value, upto) in signal.iter().zip(&mut sums[1..]) {
        sum += value;
        *upto = sum;
    }
    let mean = |from: usize, to: usize| (sums[to] - sums[from]) / (to - from) as f64;
    let inner = half_width.min(last)..last.saturating_sub(half_width).max(half_width.min(last));
    for index in (0..inner.start).chain(inner.end..last) {
        signal[index] = mean(
            index.saturating_sub(half_width),
            (index + half_width + 1).min(last),
        );
    }
    // Where nothing ends, all means are over the same number of samples.
    let width = 2 * half_width + 1;
    let pairs = sums.iter().zip(sums.iter().skip(width));
    for (value, (from, to)) in signal[inner].iter_mut().zip(pairs) {
        *value = (to - from) / width as f64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means of what lies within reach, by hand.
    #[test]
    fn a_spike_is_spread_over_as_many_samples_as_are_within_reach() {
        let mut signal = [0.0, 0.0, 0.0, 6.0, 0.0, 0.0, 0.0, 3.0];
        smooth(&mut signal, 1);
        assert_eq!(signal, [0.0, 0.0, 2.0, 2.0, 2.0, 0.0, 1.0, 1.5]);
    }

    #[test]
    fn of_a_signal_shorter_than_the_reach_only_the_mean_is_left() {
        let mut signal = [1.0, 2.0, 6.0];
        smooth(&mut signal, 80);
        assert_eq!(signal, [3.0, 3.0, 3.0]);
    }
}
