//! Which samples of a tightening are drawn.

/// Indices of at most about `points` samples that keep the shape of every signal.
///
/// The time axis is cut into equal buckets; of each bucket the smallest and the largest sample of `leading` (the noisiest
/// signal) stay, as do the first and last sample and every signal's own extremes, so that peaks are drawn as they are.
/// All signals share the indices, so that their values at one index belong to one instant.
pub fn indices(leading: &[f64], others: &[&[f64]], points: usize) -> Vec<usize> {
    let length = others
        .iter()
        .map(|signal| signal.len())
        .chain([leading.len()])
        .max()
        .unwrap_or(0);
    if length <= points {
        return (0..length).collect();
    }
    let buckets = (points / 2).max(1);
    let mut kept = vec![0, length - 1];
    for bucket in 0..buckets {
        let range = bucket * length / buckets..(bucket + 1) * length / buckets;
        match extremes(leading, range.clone()) {
            Some((low, high)) => kept.extend([low, high]),
            None => kept.push(range.start),
        }
    }
    for signal in others {
        if let Some((low, high)) = extremes(signal, 0..length) {
            kept.extend([low, high]);
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept
}

/// Where a signal is smallest and largest within `range`; `None` where it has no finite sample.
fn extremes(signal: &[f64], range: std::ops::Range<usize>) -> Option<(usize, usize)> {
    let end = range.end.min(signal.len());
    let finite = || (range.start..end).filter(|index| signal[*index].is_finite());
    let low = finite().min_by(|a, b| signal[*a].total_cmp(&signal[*b]))?;
    let high = finite().max_by(|a, b| signal[*a].total_cmp(&signal[*b]))?;
    Some((low, high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_signals_stay_whole() {
        assert_eq!(indices(&[1.0, 2.0, 3.0], &[], 10), vec![0, 1, 2]);
        assert!(indices(&[], &[], 10).is_empty());
    }

    #[test]
    fn single_sample_spikes_survive() {
        let mut leading = vec![0.0; 10_000];
        leading[4321] = 7.0;
        let mut other = vec![0.0; 10_000];
        other[8765] = -3.0;
        let kept = indices(&leading, &[&other], 200);
        assert!(kept.contains(&4321) && kept.contains(&8765));
        assert!(kept.contains(&0) && kept.contains(&9_999));
        assert!(kept.len() <= 204, "{}", kept.len());
        assert!(kept.is_sorted());
    }

    #[test]
    fn gaps_of_nan_do_not_stop_it() {
        let leading = vec![f64::NAN; 1000];
        assert!(indices(&leading, &[], 100).len() >= 50);
    }
}
