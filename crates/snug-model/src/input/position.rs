//! Places between the points of a torque, and what it is there.

/// A place among points: behind point number `index` by this part of an interval.
#[derive(Clone, Copy)]
pub(super) struct Position {
    index: isize,
    part: f64,
}

impl Position {
    pub fn new(intervals: f64) -> Self {
        let index = intervals.floor();
        Self {
            index: index as isize,
            part: intervals - index,
        }
    }

    #[inline(always)]
    pub fn moved(self, points: usize) -> Self {
        Self {
            index: self.index.saturating_add_unsigned(points),
            ..self
        }
    }

    /// Value and slope before the first point, where the value before it is known; `None` elsewhere.
    #[inline(always)]
    pub fn rising(
        self,
        before: Option<f64>,
        points: &[f64],
        interval_s: f64,
    ) -> Option<(f64, f64)> {
        let before = before.filter(|_| self.index < 0)?;
        let rise = points.first()? - before;
        Some(match self.index {
            -1 => (before + rise * self.part, rise / interval_s),
            _ => (before, 0.0),
        })
    }

    /// The interval it lies in, or the point whose value is held there.
    #[inline(always)]
    fn among(self, points: &[f64]) -> Result<usize, f64> {
        let last = points.len().saturating_sub(1);
        match usize::try_from(self.index) {
            Err(_) => Err(points.first().copied().unwrap_or(0.0)),
            Ok(index) if index >= last => Err(points.last().copied().unwrap_or(0.0)),
            Ok(index) => Ok(index),
        }
    }

    /// Value and slope of the line between the points, `interval_s` apart; the ends are held.
    #[inline(always)]
    pub fn straight(self, points: &[f64], interval_s: f64) -> (f64, f64) {
        match self.among(points) {
            Err(held) => (held, 0.0),
            Ok(index) => {
                let (here, step) = (points[index], points[index + 1] - points[index]);
                (here + step * self.part, step / interval_s)
            }
        }
    }

    /// Value and slope of the cubics that meet at the points, `interval_s` apart, with the slopes from one neighbour to
    /// the other; the ends are held.
    #[inline(always)]
    pub fn curved(self, points: &[f64], interval_s: f64) -> (f64, f64) {
        let index = match self.among(points) {
            Err(held) => return (held, 0.0),
            Ok(index) => index,
        };
        let (u, last) = (self.part, points.len() - 1);
        let (here, next) = (points[index], points[index + 1]);
        let slope_here = 0.5 * (next - points[index.saturating_sub(1)]);
        let slope_next = 0.5 * (points[(index + 2).min(last)] - here);
        // Hermite form: here + u (m + u (b + u a)).
        let a = 2.0 * (here - next) + slope_here + slope_next;
        let b = 3.0 * (next - here) - 2.0 * slope_here - slope_next;
        (
            here + u * (slope_here + u * (b + u * a)),
            (slope_here + u * (2.0 * b + 3.0 * u * a)) / interval_s,
        )
    }
}
