//! Median and quartiles of the numbers a section shows.

/// Order statistics of finite values, in their unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quartiles {
    /// Smallest value.
    pub minimum: f64,
    /// First quartile.
    pub low: f64,
    /// Median.
    pub median: f64,
    /// Third quartile.
    pub high: f64,
    /// Largest value.
    pub maximum: f64,
}

impl Quartiles {
    /// Of the finite ones among `values`, between order statistics by linear interpolation; `None` when none is finite.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = values
            .into_iter()
            .filter(|value| value.is_finite())
            .collect();
        sorted.sort_by(f64::total_cmp);
        let (&minimum, &maximum) = (sorted.first()?, sorted.last()?);
        Some(Self {
            minimum,
            low: quantile(&sorted, 0.25),
            median: quantile(&sorted, 0.5),
            high: quantile(&sorted, 0.75),
            maximum,
        })
    }
}

fn quantile(sorted: &[f64], share: f64) -> f64 {
    let position = share * (sorted.len() - 1) as f64;
    let below = position.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (position - below as f64) * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// NumPy 2: `np.percentile([3, 1, 4, 1, 5, 9], [25, 50, 75])` gives 1.5, 3.5, 4.75.
    #[test]
    fn agrees_with_numpy() {
        let found = Quartiles::of([3.0, 1.0, f64::NAN, 4.0, 1.0, 5.0, 9.0]);
        assert_eq!(
            found,
            Some(Quartiles {
                minimum: 1.0,
                low: 1.5,
                median: 3.5,
                high: 4.75,
                maximum: 9.0
            })
        );
        assert_eq!(Quartiles::of([f64::NAN]), None);
    }
}
