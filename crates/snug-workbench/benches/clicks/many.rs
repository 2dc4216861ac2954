//! The mystery at another size: the same rig and hidden effect, more people.

use crate::server::study_in;
use snug_synthetic::fixtures::{MYSTERY_SEED, mystery_plan};
use snug_synthetic::{CampaignPlan, MatStyle, simulate};
use std::path::{Path, PathBuf};

/// A study in `folder` on the mystery, or on one that is so many times as large.
pub fn study_of(folder: &Path, times: usize) -> PathBuf {
    let study = study_in(folder);
    if times == 1 {
        return study;
    }
    let plan = CampaignPlan {
        files: CampaignPlan::of_size(6 * times, 4).files,
        ..mystery_plan()
    };
    let data = folder.join("data");
    let campaign = simulate(&plan, MYSTERY_SEED).unwrap();
    campaign.write(&data, MatStyle::default()).unwrap();
    std::fs::write(&study, format!("(source: (path: {data:?}))")).unwrap();
    study
}
