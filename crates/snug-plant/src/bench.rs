//! What the engine costs: its fits beside the same in memory, its reading beside plain reading, one worker beside two, memory, a
//! worker's death.

mod cluster;
mod process;

use crate::engine::Engine;
use crate::engine::{reading_session, rows_of};
use crate::error::PlantError;
use crate::fit::{FitSettings, fit};
use crate::intake::simulate::{Simulation, simulate_plant};
use crate::rows;
use crate::storage::dataset::Dataset;
use crate::storage::schema;
use crate::storage::store::Store;
use cluster::Cluster;
use process::{Resources, Spent, Whole, run};
use rayon::prelude::*;
use serde::Serialize;
use snug_identify::{FitTask, SIDE_BY_SIDE, identify_all};
use snug_model::Input;
use snug_preprocess::Prepared;
use snug_study::{Study, StudyError, fit_numbers};
use std::path::Path;
use std::time::Duration;

/// What is measured.
#[derive(Debug, Clone)]
pub struct BenchSettings {
    /// Rows of each dataset that is made, the first of which is also fitted in memory.
    pub rows: Vec<usize>,
    /// Samples per second of its tightenings, whose window is 0.3 s \[Hz\].
    pub sample_rate_hz: f64,
    /// Where datasets and results go.
    pub to: Store,
}

/// The figures of one dataset.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Figures {
    /// Rows.
    pub rows: usize,
    /// Bytes of its files.
    pub bytes: u64,
    /// Least squares alone (`identify_all`), rows in memory \[1/s of processor time\].
    pub identified_in_memory_per_s: Option<f64>,
    /// The same with all that is reported of a fit (`fit_numbers`) \[1/s of processor time\].
    pub fitted_in_memory_per_s: Option<f64>,
    /// By the engine in one process of its own, from Parquet to results \[1/s of processor time\].
    pub embedded_per_s: f64,
    /// The same \[s\].
    pub embedded_s: f64,
    /// Bytes that it read \[1/s of processor time\].
    pub embedded_bytes_per_s: f64,
    /// Plain reading of the same files \[byte/s\].
    pub plain_bytes_per_s: f64,
    /// Largest memory of that process \[byte\].
    pub embedded_peak_bytes: u64,
    /// With one worker that has one core \[s\].
    pub one_worker_s: f64,
    /// With two \[s\].
    pub two_workers_s: f64,
    /// Largest memory of a worker \[byte\].
    pub worker_peak_bytes: u64,
    /// With two of which one is killed halfway \[s\].
    pub with_a_death_s: f64,
    /// Rows that were lost or doubled then.
    pub lost_or_doubled: usize,
    /// The same with one effect in the model, where arithmetic is the larger share.
    pub with_effect: Option<WithEffect>,
}

/// Fits with one effect beside mass, damping and stiffness.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WithEffect {
    /// The effect.
    pub effect: &'static str,
    /// In memory, with all that is reported of a fit \[1/s of processor time\].
    pub fitted_in_memory_per_s: f64,
    /// By the engine in one process of its own, from Parquet to results \[1/s of processor time\].
    pub embedded_per_s: f64,
}

/// Makes every dataset and measures; `told` hears of each figure's beginning.
///
/// # Errors
/// As the commands that are measured; [`PlantError::Setting`] where the system does not say what a process spends.
pub async fn bench(
    settings: &BenchSettings,
    told: &(dyn Fn(&str) + Sync + Send),
) -> Result<Vec<Figures>, PlantError> {
    let mut all = Vec::new();
    for (index, &rows) in settings.rows.iter().enumerate() {
        all.push(figures(settings, rows, index == 0, told).await?);
    }
    let text = serde_json::to_vec_pretty(&all)?;
    settings.to.put("bench.json", text).await?;
    Ok(all)
}

/// Tools and days of a dataset.
const TOOLS: usize = 10;
const DAYS: usize = 10;

/// The effect that rows are also fitted with: one size, from one start.
const EFFECT: &str = "cubic_stiffness";

/// Parts of a cluster's plans.
const PARTS: usize = 8;

/// One dataset and what is measured of it.
struct Bench<'a> {
    at: Store,
    data: Dataset,
    resources: Resources,
    told: &'a (dyn Fn(&str) + Sync + Send),
}

async fn figures(
    settings: &BenchSettings,
    rows: usize,
    in_memory: bool,
    told: &(dyn Fn(&str) + Sync + Send),
) -> Result<Figures, PlantError> {
    told(&format!("{rows} rows: making them"));
    let at = settings.to.below(&rows.to_string())?;
    let simulation = Simulation {
        tools: TOOLS,
        days: DAYS,
        per_day: rows.div_ceil(TOOLS * DAYS),
        sample_rate_hz: settings.sample_rate_hz,
        ..Simulation::default()
    };
    let open = || async { Dataset::open(at.below("data")?, "tightenings", "bench").await };
    if open().await.is_err() {
        simulate_plant(&simulation, at.below("data")?).await?;
    }
    let bench = Bench {
        data: open().await?,
        at,
        resources: Resources::of(std::process::id())?,
        told,
    };
    let mut found = Figures::default();
    bench.embedded(&mut found).await?;
    if in_memory {
        bench.in_memory(&mut found).await?;
    }
    bench.on_cluster(&mut found).await?;
    Ok(found)
}

impl Bench<'_> {
    async fn fit(&self, to: &str, settings: &FitSettings) -> Result<(), PlantError> {
        let to = self.at.below(to)?;
        fit(self.data.store.clone(), to, settings, &|_| ())
            .await
            .map(|_| ())
    }

    async fn embedded(&self, found: &mut Figures) -> Result<(), PlantError> {
        let commits = self.data.partitions().await?;
        let files = || commits.iter().flat_map(|(_, commit)| &commit.files);
        found.rows = files().map(|file| file.rows).sum();
        found.bytes = files().map(|file| file.bytes as u64).sum();
        (self.told)("plain reading");
        let spent = Spent::since(&self.resources)?;
        for file in files() {
            self.data.store.get(&file.name).await?;
        }
        found.plain_bytes_per_s = found.bytes as f64 / spent.wall_s();
        (self.told)("embedded");
        let spent = self.embedded_fit("embedded", &[]).await?;
        found.embedded_s = spent.wall_s;
        found.embedded_per_s = found.rows as f64 / spent.processor_s;
        found.embedded_bytes_per_s = found.bytes as f64 / spent.processor_s;
        found.embedded_peak_bytes = spent.peak_bytes;
        Ok(())
    }

    async fn in_memory(&self, found: &mut Figures) -> Result<(), PlantError> {
        (self.told)("in memory");
        let mut study = self.data.study()?;
        let prepared = in_one_batch(&self.data).await?;
        let rates = || in_memory_rates(&study, &prepared);
        let (identified, fitted) = tokio::task::block_in_place(rates)?;
        found.identified_in_memory_per_s = Some(identified);
        found.fitted_in_memory_per_s = Some(fitted);
        (self.told)("with one effect, in memory and embedded");
        study.model.effects.push(EFFECT.to_owned());
        let rate = || fitted_per_s(&study, &prepared);
        let in_memory = tokio::task::block_in_place(rate)?;
        let spent = self.embedded_fit("effect", &["--effects", EFFECT]).await?;
        found.with_effect = Some(WithEffect {
            effect: EFFECT,
            fitted_in_memory_per_s: in_memory,
            embedded_per_s: found.rows as f64 / spent.processor_s,
        });
        Ok(())
    }

    /// A fit in one process of its own.
    async fn embedded_fit(&self, to: &str, options: &[&str]) -> Result<Whole, PlantError> {
        let to = self.at.below(to)?;
        let fit = ["fit", "--data", self.data.store.url(), "--to", to.url()];
        run(&[&fit, options].concat()).await
    }

    async fn on_cluster(&self, found: &mut Figures) -> Result<(), PlantError> {
        (self.told)("one worker");
        let cluster = Cluster::start().await?;
        let first = cluster.worker().await?;
        let settings = FitSettings {
            engine: Engine::Cluster {
                address: cluster.address(),
                parts: PARTS,
            },
            ..FitSettings::default()
        };
        let spent = Spent::since(&self.resources)?;
        self.fit("one", &settings).await?;
        found.one_worker_s = spent.wall_s();
        (self.told)("two workers");
        let second = cluster.worker().await?;
        let spent = Spent::since(&self.resources)?;
        self.fit("two", &settings).await?;
        found.two_workers_s = spent.wall_s();
        found.worker_peak_bytes = first.peak_bytes()?.max(second.peak_bytes()?);
        (self.told)("two workers, of which one is killed");
        let halfway = Duration::from_secs_f64(0.5 * found.two_workers_s);
        let death = tokio::spawn(async move {
            tokio::time::sleep(halfway).await;
            drop(second);
        });
        let spent = Spent::since(&self.resources)?;
        let mut fitted = self.fit("death", &settings).await;
        death.await.ok();
        if let Err(PlantError::Partitions { .. }) = fitted {
            let resumed = FitSettings {
                resume: true,
                ..settings
            };
            fitted = self.fit("death", &resumed).await;
        }
        fitted?;
        found.with_a_death_s = spent.wall_s();
        let (whole, death) = (self.at.below("embedded")?, self.at.below("death")?);
        found.lost_or_doubled = differing(&whole, &death).await?;
        Ok(())
    }
}

/// Partitions whose results differ in a bit, counted by their rows.
async fn differing(one: &Store, other: &Store) -> Result<usize, PlantError> {
    let mut differing = 0;
    let (one, other) = (
        Dataset::open(one.clone(), "results", "fit").await?,
        Dataset::open(other.clone(), "results", "fit").await?,
    );
    for (part, commit) in one.partitions().await? {
        let same = other.commit_of(&part).await?;
        if same.is_none_or(|same| same.digest() != commit.digest()) {
            differing += commit.rows();
        }
    }
    Ok(differing)
}

/// Every row of a small dataset.
async fn in_one_batch(data: &Dataset) -> Result<Vec<Prepared>, PlantError> {
    let commits = data.partitions().await?;
    let urls = data.urls(commits.iter().map(|(_, commit)| commit));
    let session = reading_session(&[&data.store]);
    let rows = rows_of(&session, urls, &schema::tightenings()).await?;
    let mut prepared = Vec::new();
    for batch in rows.collect().await? {
        prepared.extend(rows::prepared(&batch).map_err(PlantError::columns("the dataset"))?);
    }
    Ok(prepared)
}

/// Rows per second of processor time on all cores: least squares alone, and with all that is reported.
fn in_memory_rates(study: &Study, prepared: &[Prepared]) -> Result<(f64, f64), PlantError> {
    let resources = Resources::of(std::process::id())?;
    let model_of = |one: &Prepared| {
        study
            .model
            .model(one.tightening.rig)
            .map_err(StudyError::from)
    };
    let models = prepared
        .iter()
        .map(model_of)
        .collect::<Result<Vec<_>, _>>()?;
    let input_of = |one: &Prepared| {
        let tightening = &one.tightening;
        let interval_s = tightening.time_base.interval_s;
        let onset_s = tightening.onset.unwrap_or(0) as f64 * interval_s;
        Input::new(&tightening.torque_nm, interval_s, study.model.intersample()).with_onset(onset_s)
    };
    let inputs: Vec<Input> = prepared.iter().map(input_of).collect();
    let task = |row: usize| {
        let tightening = &prepared[row].tightening;
        FitTask::new(tightening, &inputs[row], &models[row], &study.identify)
    };
    let tasks: Vec<FitTask<'_>> = (0..prepared.len()).map(task).collect();
    let spent = Spent::since(&resources)?;
    let found = tasks.par_chunks(SIDE_BY_SIDE).map(|some| {
        let estimates = identify_all(some);
        estimates.iter().filter(|one| one.is_ok()).count()
    });
    let identified = found.sum::<usize>() as f64 / spent.so_far(&resources)?.1;
    Ok((identified, fitted_per_s(study, prepared)?))
}

/// Rows per second of processor time on all cores, with all that is reported.
fn fitted_per_s(study: &Study, prepared: &[Prepared]) -> Result<f64, PlantError> {
    let resources = Resources::of(std::process::id())?;
    let all: Vec<&Prepared> = prepared.iter().collect();
    let spent = Spent::since(&resources)?;
    let found = (all.par_chunks(SIDE_BY_SIDE))
        .map(|some| fit_numbers(study, some).map(|fitted| fitted.len()))
        .collect::<Result<Vec<usize>, _>>()?;
    Ok(found.iter().sum::<usize>() as f64 / spent.so_far(&resources)?.1)
}

impl Figures {
    /// The figures in words, a line each.
    pub fn told(&self) -> String {
        let mega = |bytes: f64| format!("{:.0} MB", bytes / 1e6);
        let mut lines = vec![format!(
            "{} rows of {:.1} kB",
            self.rows,
            self.bytes as f64 / self.rows as f64 / 1e3
        )];
        if let (Some(identified), Some(fitted)) =
            (self.identified_in_memory_per_s, self.fitted_in_memory_per_s)
        {
            lines.push(format!(
                "  in memory: {identified:.0} rows/s and core by least squares alone, {fitted:.0} with all that is reported"
            ));
            lines.push(format!(
                "  embedded over in memory: {:.2} of least squares alone, {:.2} of the same work",
                self.embedded_per_s / identified,
                self.embedded_per_s / fitted
            ));
        }
        lines.push(format!(
            "  embedded: {:.0} rows/s and core, {}/s read and core, {:.1} s, largest memory {}",
            self.embedded_per_s,
            mega(self.embedded_bytes_per_s),
            self.embedded_s,
            mega(self.embedded_peak_bytes as f64)
        ));
        if let Some(with) = &self.with_effect {
            lines.push(format!(
                "  with {}: embedded {:.0} rows/s and core, in memory {:.0}: {:.2} of the same work",
                with.effect,
                with.embedded_per_s,
                with.fitted_in_memory_per_s,
                with.embedded_per_s / with.fitted_in_memory_per_s
            ));
        }
        lines.push(format!(
            "  plain reading: {}/s",
            mega(self.plain_bytes_per_s)
        ));
        lines.push(format!(
            "  one worker {:.1} s, two {:.1} s: {:.2} times as fast; largest memory of a worker {}",
            self.one_worker_s,
            self.two_workers_s,
            self.one_worker_s / self.two_workers_s,
            mega(self.worker_peak_bytes as f64)
        ));
        lines.push(format!(
            "  one of two killed halfway: {:.1} s, {:.1} s more; {} rows lost, doubled or with another bit",
            self.with_a_death_s,
            self.with_a_death_s - self.two_workers_s,
            self.lost_or_doubled
        ));
        lines.join("\n")
    }
}

/// The program that runs.
fn program() -> Result<std::path::PathBuf, PlantError> {
    std::env::current_exe().map_err(|source| PlantError::Read {
        path: Path::new("this program").to_owned(),
        source,
    })
}
