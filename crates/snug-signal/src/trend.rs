//! What a signal is beside a straight line.

/// `signal` without the straight line that fits its samples best by least squares, in its own unit.
pub fn without_trend(mut signal: Vec<f64>) -> Vec<f64> {
    let count = signal.len() as f64;
    let middle = 0.5 * (count - 1.0);
    let mean = signal.iter().sum::<f64>() / count;
    let at = |index: usize| index as f64 - middle;
    let moment: f64 = signal.iter().enumerate().map(|(i, y)| at(i) * y).sum();
    let slope = 12.0 * moment / (count * (count * count - 1.0)).max(1.0);
    for (index, value) in signal.iter_mut().enumerate() {
        *value -= mean + slope * at(index);
    }
    signal
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_all_trend() {
        let line = (0..50).map(|i| 3.0 - 0.2 * f64::from(i)).collect();
        assert!(without_trend(line).iter().all(|left| left.abs() < 1e-12));
    }
}
