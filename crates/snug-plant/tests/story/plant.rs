//! A small simulated plant in a folder of its own, and what a fit made of it.

use snug_plant::{
    Commit, Dataset, FitSettings, Fitted, Partition, PlantError, Simulation, Store, fit,
    simulate_plant,
};
use tempfile::TempDir;

/// Datasets and results side by side.
pub struct Plant {
    folder: TempDir,
}

/// Few tools and days, sampled coarsely.
pub fn small() -> Simulation {
    Simulation {
        tools: 3,
        days: 2,
        per_day: 12,
        sample_rate_hz: 2000.0,
        ..Simulation::default()
    }
}

impl Plant {
    pub fn empty() -> Self {
        Self {
            folder: tempfile::tempdir().unwrap(),
        }
    }

    pub async fn simulated(simulation: &Simulation) -> Self {
        let plant = Self::empty();
        let done = simulate_plant(simulation, plant.store("data"))
            .await
            .unwrap();
        let wanted = simulation.tools * simulation.days * simulation.per_day;
        assert_eq!(done.rows, wanted);
        plant
    }

    pub fn path(&self, name: &str) -> std::path::PathBuf {
        self.folder.path().join(name)
    }

    pub fn store(&self, name: &str) -> Store {
        Store::open(self.path(name).to_str().unwrap()).unwrap()
    }

    pub async fn fit(&self, to: &str, settings: &FitSettings) -> Result<Fitted, PlantError> {
        fit(self.store("data"), self.store(to), settings, &|_| ()).await
    }

    pub async fn commits(&self, name: &str, table: &'static str) -> Vec<(Partition, Commit)> {
        let dataset = Dataset::open(self.store(name), table, "test")
            .await
            .unwrap();
        dataset.partitions().await.unwrap()
    }

    /// Digests of the results' files, partition by partition.
    pub async fn digests(&self, name: &str) -> Vec<(Partition, Vec<String>)> {
        let commits = self.commits(name, "results").await.into_iter();
        let digests = |commit: Commit| commit.files.into_iter().map(|file| file.sha256).collect();
        commits
            .map(|(part, commit)| (part, digests(commit)))
            .collect()
    }
}
