//! The target torque that a peak torque stands for; it groups tightenings in the statistics.

/// Width of a target-torque bin \[Nm\] (thesis).
const BIN_NM: f64 = 5.0;

/// Rounds a peak torque to the target it belongs to: ⌊T/5 + 0.5⌋ · 5 \[Nm\] (thesis).
///
/// Half a bin goes up, as the original does it: 37.5 Nm becomes 40 Nm.
pub fn target_torque_nm(peak_torque_nm: f64) -> f64 {
    (peak_torque_nm / BIN_NM + 0.5).floor() * BIN_NM
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_to_five_with_halves_up() {
        for (peak, target) in [
            (42.49, 40.0),
            (42.5, 45.0),
            (37.5, 40.0),
            (2.4, 0.0),
            (-2.6, -5.0),
        ] {
            assert_eq!(target_torque_nm(peak), target, "{peak}");
        }
    }
}
