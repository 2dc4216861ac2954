//! The peak torque of a segment.

/// Largest torque of the segment \[Nm\]; not-a-number samples are passed over, 0 when nothing is left.
pub(crate) fn peak_torque_nm(torque_nm: &[f64]) -> f64 {
    let peak = torque_nm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if peak.is_finite() { peak } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peak_passes_over_missing_samples() {
        assert_eq!(peak_torque_nm(&[1.0, f64::NAN, 3.0, 2.0]), 3.0);
        assert_eq!(peak_torque_nm(&[f64::NAN]), 0.0);
        assert_eq!(peak_torque_nm(&[]), 0.0);
    }
}
