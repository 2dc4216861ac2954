//! Peak torque and the target torque it stands for; the target groups tightenings in the statistics.

/// Width of a target-torque bin \[Nm\].
const BIN_NM: f64 = 5.0;

/// Largest torque of the segment \[Nm\]; not-a-number samples are passed over, 0 when nothing is left.
pub(crate) fn peak_torque_nm(torque_nm: &[f64]) -> f64 {
    let peak = torque_nm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if peak.is_finite() { peak } else { 0.0 }
}

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

    #[test]
    fn peak_passes_over_missing_samples() {
        assert_eq!(peak_torque_nm(&[1.0, f64::NAN, 3.0, 2.0]), 3.0);
        assert_eq!(peak_torque_nm(&[f64::NAN]), 0.0);
        assert_eq!(peak_torque_nm(&[]), 0.0);
    }
}
