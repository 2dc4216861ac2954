//! What a column's numbers say: whether they rise as times do, whether one is the derivative of another, whether a motion
//! comes back.

/// Steps of a time column may differ from their mean by so much of it, half of them.
const UNEVEN: f64 = 0.5;
/// Correlation beyond which a column is the derivative of another \[–\]. Chosen.
const ALIKE: f64 = 0.97;
/// Share of a motion's way, there and back, that its ends must be apart to go on in one direction \[–\]. Chosen.
const ONE_WAY: f64 = 0.8;

/// Whether no number differs from the others.
pub(super) fn is_constant(values: &[f64]) -> bool {
    let mut numbers = values.iter().filter(|value| value.is_finite());
    let first = numbers.next();
    numbers.all(|value| Some(value) == first)
}

/// Whether the numbers rise from row to row, half of them by nearly the same step.
pub(super) fn rises(values: &[f64]) -> bool {
    let steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mean = steps.iter().sum::<f64>() / steps.len().max(1) as f64;
    let even = steps
        .iter()
        .filter(|step| (*step - mean).abs() <= UNEVEN * mean)
        .count();
    !steps.is_empty() && steps.iter().all(|step| *step > 0.0) && 2 * even >= steps.len()
}

/// Median of the steps.
pub(super) fn median_step(values: &[f64]) -> f64 {
    let mut steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.retain(|step| step.is_finite());
    let middle = steps.len() / 2;
    match steps.is_empty() {
        true => f64::NAN,
        false => *steps.select_nth_unstable_by(middle, f64::total_cmp).1,
    }
}

/// By what `rate`'s sum over time (in steps of `interval_s`) is multiplied to be `of`, both without their straight line;
/// `None` where that is not what it is.
pub(super) fn derivative(of: &[f64], rate: &[f64], interval_s: f64) -> Option<f64> {
    let mut sum = 0.0;
    let integral: Vec<f64> = (rate.iter())
        .map(|value| {
            sum += interval_s * if value.is_finite() { *value } else { 0.0 };
            sum
        })
        .collect();
    let (a, b) = (without_line(of)?, without_line(&integral)?);
    let product = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    let (ab, aa, bb) = (product(&a, &b), product(&a, &a), product(&b, &b));
    let correlation = ab / (aa * bb).sqrt();
    (correlation > ALIKE).then_some(ab / bb)
}

/// The numbers without the straight line through them; `None` where one is missing or they are that line.
fn without_line(values: &[f64]) -> Option<Vec<f64>> {
    let count = values.len() as f64;
    if values.len() < 3 || !values.iter().all(|value| value.is_finite()) {
        return None;
    }
    let mean = values.iter().sum::<f64>() / count;
    let middle = (count - 1.0) / 2.0;
    let along = |index: usize| index as f64 - middle;
    let slope = values
        .iter()
        .enumerate()
        .map(|(index, value)| along(index) * value)
        .sum::<f64>()
        / (0..values.len())
            .map(|index| along(index) * along(index))
            .sum::<f64>();
    let left: Vec<f64> = values
        .iter()
        .enumerate()
        .map(|(index, value)| value - mean - slope * along(index))
        .collect();
    left.iter().any(|value| *value != 0.0).then_some(left)
}

/// Whether a motion goes on in one direction, as a drive that turns.
pub(super) fn runs_away(values: &[f64]) -> bool {
    let numbers: Vec<f64> = values
        .iter()
        .copied()
        .filter(|value| value.is_finite())
        .collect();
    let total: f64 = numbers
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .sum();
    match (numbers.first(), numbers.last()) {
        (Some(first), Some(last)) => (last - first).abs() > ONE_WAY * total,
        _ => false,
    }
}

/// Work of the input along a motion over the sum of its sizes from sample to sample, −1 to 1: a rig that is driven takes
/// energy in. `None` where nothing is done.
pub(super) fn work(input: &[f64], steps: impl Iterator<Item = f64>) -> Option<f64> {
    let done = input.iter().zip(steps).map(|(input, step)| input * step);
    let (sum, sizes) = done
        .filter(|work| work.is_finite())
        .fold((0.0, 0.0), |(sum, sizes), work| {
            (sum + work, sizes + work.abs())
        });
    (sizes > 0.0).then(|| sum / sizes)
}

/// Largest size.
pub(super) fn largest(values: &[f64]) -> f64 {
    values
        .iter()
        .filter(|value| value.is_finite())
        .fold(0.0, |most, value| value.abs().max(most))
}

/// A number in four digits.
pub(super) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    rounded.to_string()
}
