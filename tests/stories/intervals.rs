//! The stated 95 % intervals cover the truth in about 95 % of tightenings, under white and coloured noise and a bias.
//!
//! Data come from the independent simulator, with its own integrator and step.

use crate::campaign::{run_study, study_on};
use snug_campaign::{CampaignResult, Quantity};
use snug_study::Preset;
use snug_synthetic::{CampaignPlan, MatStyle, NoiseKind, Truth, simulate};

/// Campaigns of 48 tightenings by default, and when many cases are asked for.
const CAMPAIGNS: (u64, u64) = (3, 24);

#[test]
fn intervals_cover_the_truth() {
    check(Quantity::Acceleration);
}

/// Unweighted least squares on the twice integrated signal: a worse estimate, but its intervals must say so.
#[test]
fn intervals_of_a_displacement_fit_cover_the_truth() {
    check(Quantity::Displacement);
}

fn check(fitted_output: Quantity) {
    let campaigns = if snug_tests::many() {
        CAMPAIGNS.1
    } else {
        CAMPAIGNS.0
    };
    let mut covered = [0_usize; 3];
    let mut total = 0;
    for seed in 0..campaigns {
        let noise = if seed % 2 == 0 {
            NoiseKind::Coloured
        } else {
            NoiseKind::White
        };
        let plan = CampaignPlan::of_size(8, 6)
            .with_noise(noise)
            .with_bias(0.1 * (seed % 3) as f64);
        let campaign = simulate(&plan, 1000 + seed).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let data = folder.path().join("data");
        campaign.write(&data, MatStyle::default()).unwrap();
        let mut study = study_on(&data, Preset::Snug);
        study.identify.fitted_output = fitted_output;
        let (outcome, _out) = run_study(&study).unwrap();
        assert_eq!(outcome.left_out, 0);
        total += count(&outcome.result, &campaign.truth, &mut covered);
    }
    assert_eq!(total as u64, 48 * campaigns);
    println!("{fitted_output:?}: covered {covered:?} of {total}");
    // The promise is 90 to 98 %; the few default cases scatter by 1.8 %, the many by 0.6 %.
    let (low, high) = if snug_tests::many() {
        (0.90, 0.98)
    } else {
        (0.88, 0.99)
    };
    for (name, covered) in ["mass", "damping", "stiffness"].iter().zip(covered) {
        let share = covered as f64 / total as f64;
        assert!((low..=high).contains(&share), "{name}: {share} of {total}");
    }
}

pub fn count(result: &CampaignResult, truth: &Truth, covered: &mut [usize; 3]) -> usize {
    for tightening in &result.tightenings {
        // A file is named after its label and a number of its own.
        let (label, _) = tightening.id.file.rsplit_once('_').unwrap();
        let truth = truth
            .tightenings
            .iter()
            .find(|t| t.file == label && t.index + 1 == tightening.id.number as usize)
            .unwrap();
        let estimate = tightening.estimate.as_ref().unwrap();
        for (index, value) in [truth.m, truth.c, truth.k].into_iter().enumerate() {
            // A parameter on a constraint states no interval and covers nothing.
            covered[index] += usize::from(
                estimate.parameters[index]
                    .interval
                    .is_some_and(|interval| (interval.low..=interval.high).contains(&value)),
            );
        }
    }
    result.tightenings.len()
}
