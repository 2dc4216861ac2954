//! Where the original program takes displacement as zero, its 1-based sample numbers and rounding included.

use std::ops::Range;

/// Where the original takes the offset when there is no local minimum \[s\]: its 1-based sample 274.
const FALLBACK_S: f64 = 0.0274;

/// Index of the displacement sample that the original program declares zero.
///
/// The first strict local minimum (both neighbours larger, both within the search) among the first `round(n/3)` samples;
/// otherwise the 1-based sample 274 at 10 kHz, scaled with the sampling rate. `None` for no samples.
pub(crate) fn zero_index(displacement_rad: &[f64], interval_s: f64) -> Option<usize> {
    let last = displacement_rad.len().checked_sub(1)?;
    let searched = &displacement_rad[..third(displacement_rad.len()).min(displacement_rad.len())];
    let minimum = searched
        .windows(3)
        .position(|triple| triple[1] < triple[0] && triple[1] < triple[2])
        .map(|position| position + 1);
    let fallback = ((FALLBACK_S / interval_s).round() as usize).saturating_sub(1);
    Some(minimum.unwrap_or(fallback.min(last)))
}

/// A third of `count`, rounded as MATLAB rounds.
pub(crate) fn third(count: usize) -> usize {
    (count as f64 / 3.0).round() as usize
}

/// Samples of the window after the searched third, where the original asks whether the displacement goes up:
/// 1-based `round(n/3)` to n.
pub(crate) fn after_third(count: usize) -> Range<usize> {
    third(count).saturating_sub(1).min(count)..count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_local_minimum_wins() {
        let mut displacement = vec![0.0; 2999];
        for (index, value) in displacement.iter_mut().enumerate() {
            *value = (index as f64 - 400.0).powi(2);
        }
        assert_eq!(zero_index(&displacement, 1e-4), Some(400));
        displacement[100] -= 1e6;
        assert_eq!(zero_index(&displacement, 1e-4), Some(100));
    }

    #[test]
    fn falls_back_to_sample_274() {
        let rising: Vec<f64> = (0..2999).map(f64::from).collect();
        assert_eq!(zero_index(&rising, 1e-4), Some(273));
        let flat = vec![1.0; 2999];
        assert_eq!(
            zero_index(&flat, 1e-4),
            Some(273),
            "a plateau is no strict minimum"
        );
        let mut late = rising;
        late[1000] = -1.0;
        assert_eq!(
            zero_index(&late, 1e-4),
            Some(273),
            "sample 1001 is not searched"
        );
        assert_eq!(zero_index(&[1.0, 2.0], 1e-4), Some(1));
        assert_eq!(zero_index(&[], 1e-4), None);
    }

    #[test]
    fn the_up_check_reads_1000_to_2999() {
        assert_eq!(after_third(2999), 999..2999);
    }
}
