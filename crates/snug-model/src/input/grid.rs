//! What an input is between its samples, on a grid as fine as a simulation asks for.

use snug_campaign::Intersample;

/// `samples` on a grid `substeps` times as fine.
pub(crate) fn grid(samples: &[f64], intersample: Intersample, substeps: usize) -> Vec<f64> {
    let points = (samples.len().saturating_sub(1) * substeps + 1).min(samples.len() * substeps);
    let between = |point: usize| {
        let (before, share) = (point / substeps, point % substeps);
        let after = (before + 1).min(samples.len() - 1);
        let risen = (samples[after] - samples[before]) * share as f64 / substeps as f64;
        samples[before] + risen
    };
    match intersample {
        _ if substeps == 1 => samples.to_vec(),
        Intersample::BandLimited => snug_signal::straight_pieces(samples, substeps),
        Intersample::Linear => (0..points).map(between).collect(),
        Intersample::ZeroOrder => (0..points).map(|point| samples[point / substeps]).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_input_stays_and_a_straight_one_rises_evenly() {
        let samples = [1.0, 3.0, -1.0];
        let held = grid(&samples, Intersample::ZeroOrder, 4);
        assert_eq!(held, [1.0, 1.0, 1.0, 1.0, 3.0, 3.0, 3.0, 3.0, -1.0]);
        let straight = grid(&samples, Intersample::Linear, 4);
        assert_eq!(straight, [1.0, 1.5, 2.0, 2.5, 3.0, 2.0, 1.0, 0.0, -1.0]);
        for kind in [Intersample::ZeroOrder, Intersample::Linear] {
            assert_eq!(grid(&samples, kind, 1), samples);
            assert!(grid(&[], kind, 4).is_empty());
        }
    }
}
