//! Where there is nothing of an effect, and how far a size is from there.

/// The size at which an effect is not there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Nothing {
    /// A size within what it may be, or the end nearest to it.
    At(f64),
    /// The larger, the less there is of it, without end, as of a mass that hardly moves: 1/size is 0 there, and what has a standard
    /// error in proportion.
    Beyond,
}

impl Nothing {
    /// From where an effect says that it vanishes, 0 where it does not, and within which limits a size may lie.
    pub fn of(vanishes_at: Option<f64>, (least, most): (f64, f64)) -> Self {
        match vanishes_at {
            Some(at) if at > most && least >= 0.0 => Self::Beyond,
            at => Self::At(at.unwrap_or(0.0).clamp(least, most)),
        }
    }

    /// How far `size` is from it, in the size's unit and by its standard error: (1/s) / (σ/s²) = s/σ where it is beyond all.
    pub fn distance(self, size: f64) -> f64 {
        match self {
            Self::At(nothing) => size - nothing,
            Self::Beyond => size,
        }
    }

    /// The interval of a size known to ±`reach`; without an upper end where that may be beyond all.
    pub fn interval(self, size: f64, reach: f64) -> (f64, Option<f64>) {
        match self {
            Self::At(_) => (size - reach, Some(size + reach)),
            Self::Beyond => {
                let share = reach / size;
                let high = (share < 1.0).then(|| size / (1.0 - share));
                (size / (1.0 + share), high)
            }
        }
    }

    /// The same within what a size may be; what may reach as far as it may go may be nothing where that is beyond all.
    pub fn interval_within(
        self,
        size: f64,
        reach: f64,
        (least, most): (f64, f64),
    ) -> (f64, Option<f64>) {
        let (low, high) = self.interval(size, reach);
        let high = match self {
            Self::Beyond => high.filter(|high| *high < most),
            Self::At(_) => high.map(|high| high.min(most)),
        };
        (low.max(least), high)
    }

    /// Whether a size with an interval up to `high` may be nothing because that is beyond all.
    pub fn is_reached(self, high: Option<f64>) -> bool {
        self == Self::Beyond && high.is_none()
    }

    /// Whether a size may lie on one side of it only.
    pub fn is_an_end_of(self, (least, most): (f64, f64)) -> bool {
        match self {
            Self::At(nothing) => nothing <= least || nothing >= most,
            Self::Beyond => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_as_far_from_nothing_as_it_is_larger_or_smaller() {
        let friction = Nothing::of(Some(0.0), (0.0, 300.0));
        assert_eq!(friction, Nothing::At(0.0));
        assert_eq!(friction.distance(4.0), 4.0);
        assert_eq!(friction.interval(4.0, 1.0), (3.0, Some(5.0)));
        assert!(friction.is_an_end_of((0.0, 300.0)));
        assert!(!friction.is_an_end_of((-1.0, 300.0)));
        assert_eq!(Nothing::of(None, (2.0, 5.0)), Nothing::At(2.0));
    }

    /// 1/4 ± 1/16 lies from 1/3.2 to 1/(16/3); 1/4 ± 1/2 holds 0.
    #[test]
    fn a_mass_without_end_has_an_interval_in_its_reciprocal() {
        let mass = Nothing::of(Some(1e12), (0.05, 1e6));
        assert_eq!(mass, Nothing::Beyond);
        let (low, high) = mass.interval(4.0, 1.0);
        assert!((low - 3.2).abs() < 1e-12);
        assert!((high.unwrap_or(0.0) - 16.0 / 3.0).abs() < 1e-12);
        assert_eq!(mass.interval(4.0, 8.0), (4.0 / 3.0, None));
        assert!(mass.is_reached(None) && !mass.is_reached(high));
        assert_eq!(mass.interval_within(4.0, 1.0, (3.5, 5.0)), (3.5, None));
        let friction = Nothing::At(0.0);
        assert_eq!(
            friction.interval_within(4.0, 1.0, (3.5, 4.5)),
            (3.5, Some(4.5))
        );
    }
}
