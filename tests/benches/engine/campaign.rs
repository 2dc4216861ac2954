//! The data: campaigns from snug-synthetic, always the same, written as MAT files into a folder that goes away again.

use crate::bare_loop::Record;
use snug_campaign::Quantity;
use snug_identify::FitTask;
use snug_model::THESIS_START;
use snug_study::Study;
use snug_synthetic::{CampaignPlan, HiddenEffect, MatStyle, simulate};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Of every campaign.
const SEED: u64 = 20_240_607;

/// A campaign on disk.
pub struct Campaign {
    folder: TempDir,
    /// Tightenings in it.
    pub tightenings: usize,
}

impl Campaign {
    /// At least `tightenings`, four a file, that hide `effects`.
    pub fn hiding(effects: &[(HiddenEffect, f64)], tightenings: usize) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let (each, data) = (4, folder.path().join("data"));
        let files = tightenings.div_ceil(each);
        let mut plan = CampaignPlan::of_size(files, each);
        for &(effect, strength) in effects {
            plan = plan.hiding(effect, strength);
        }
        // Few files at a time: a whole year of tightenings need not fit into memory.
        let all = std::mem::take(&mut plan.files);
        for (part, files) in (0_u64..).zip(all.chunks(PART)) {
            plan.files = files.to_vec();
            let mut made =
                simulate(&plan, SEED + part).expect("the benchmark's own plan can be simulated");
            for (index, file) in made.files.iter_mut().enumerate() {
                file.name = format!("{:05}.mat", part as usize * PART + index);
            }
            made.write(&data, MatStyle::default())
                .expect("a temporary folder can be written");
        }
        Self {
            folder,
            tightenings: files * each,
        }
    }

    /// The study that takes it as measured.
    pub fn study(&self) -> Study {
        Study::on(self.data())
    }

    /// The measurement files.
    pub fn data(&self) -> PathBuf {
        self.folder.path().join("data")
    }

    /// Room beside the data.
    pub fn beside(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Its tightenings, prepared.
    pub fn cases(&self) -> Vec<FitTask<'static>> {
        cases(&self.data(), usize::MAX)
    }

    /// As many of them as a study learns effects from by itself.
    pub fn usual_cases(&self) -> Vec<FitTask<'static>> {
        cases(&self.data(), self.study().diagnosis.most_tightenings)
    }
}

/// At most so many of the tightenings in a folder of measurement files, prepared.
pub fn cases(data: &Path, most: usize) -> Vec<FitTask<'static>> {
    let study = Study::on(data.to_path_buf());
    let listing =
        snug_ingest::list(&study.source, &study.source.path).expect("the files were just written");
    snug_study::cases(&study, &listing.files, most).expect("the benchmark's own data")
}

/// Files that are simulated at a time.
const PART: usize = 32;

/// What the bare loops take of a tightening: torque and displacement.
pub fn record<'a>(case: &'a FitTask<'_>) -> Record<'a> {
    let tightening = &case.tightening;
    let displacement = tightening.motion.get(Quantity::Displacement);
    Record {
        torque_nm: &tightening.torque_nm,
        angle_rad: displacement.expect("preparation integrates the acceleration"),
        interval_s: tightening.time_base.interval_s,
        lever_arm_m: tightening.rig.lever_arm_m,
        known_inertia_kg_m2: tightening.rig.known_inertia_kg_m2,
    }
}

/// Where every fit begins: m, c, k.
pub const START: [f64; 3] = THESIS_START;
