//! Campaigns with a fifth of the usual samples, to be quick.

use snug_ingest::{Format, ThesisLayout};
use snug_study::Study;
use snug_synthetic::{CampaignPlan, MatStyle, simulate};
use std::path::Path;

const RATE_HZ: f64 = 2000.0;

/// The study of a campaign that is simulated by `plan` and written into `folder`.
pub fn study(mut plan: CampaignPlan, seed: u64, folder: &Path) -> Study {
    plan.sample_rate_hz = RATE_HZ;
    let data = folder.join("data");
    let campaign = simulate(&plan, seed).unwrap();
    campaign.write(&data, MatStyle::default()).unwrap();
    let mut study = Study::on(data);
    study.source.format = Format::Thesis(ThesisLayout {
        sample_rate_hz: RATE_HZ,
        ..ThesisLayout::default()
    });
    study
}
