//! Past motion for the stretch reflex, whose delay may lead to any instant between two steps.

/// The angle as it was: what a delayed law looks back on. Cubic Hermite between the steps that were taken.
#[derive(Debug, Default)]
pub(crate) struct History {
    time_s: Vec<f64>,
    theta_rad: Vec<f64>,
    omega_rad_per_s: Vec<f64>,
}

impl History {
    /// Notes one finished step; times never go back.
    pub(crate) fn note(&mut self, time_s: f64, theta_rad: f64, omega_rad_per_s: f64) {
        self.time_s.push(time_s);
        self.theta_rad.push(theta_rad);
        self.omega_rad_per_s.push(omega_rad_per_s);
    }

    /// θ at `time_s`; zero before the first step.
    pub(crate) fn theta_rad(&self, time_s: f64) -> f64 {
        let after = self.time_s.partition_point(|&noted| noted <= time_s);
        if after == 0 {
            return 0.0;
        }
        let before = after - 1;
        if after == self.time_s.len() {
            return self.theta_rad[before];
        }
        let step = self.time_s[after] - self.time_s[before];
        let u = (time_s - self.time_s[before]) / step;
        let (uu, uuu) = (u * u, u * u * u);
        (2.0 * uuu - 3.0 * uu + 1.0) * self.theta_rad[before]
            + (uuu - 2.0 * uu + u) * step * self.omega_rad_per_s[before]
            + (3.0 * uu - 2.0 * uuu) * self.theta_rad[after]
            + (uuu - uu) * step * self.omega_rad_per_s[after]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_looked_up_exactly() {
        let cubic = |t: f64| 1.0 + 2.0 * t - 3.0 * t * t + 0.5 * t * t * t;
        let slope = |t: f64| 2.0 - 6.0 * t + 1.5 * t * t;
        let mut history = History::default();
        for t in [0.0, 0.5, 0.6, 2.0] {
            history.note(t, cubic(t), slope(t));
        }
        for t in [0.0, 0.1, 0.55, 1.3, 2.0] {
            assert!((history.theta_rad(t) - cubic(t)).abs() < 1e-13);
        }
        assert_eq!(history.theta_rad(-0.1), 0.0);
    }
}
