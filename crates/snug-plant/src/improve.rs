//! The loop of the mission at a plant's size: what is missing is learnt from a sample, how large it is from all rows, and which tools
//! have it, and since when, from every row's own fit.

mod outputs;
mod sample;
mod shows;
mod thresholds;
mod whole;

use crate::engine::Engine;
use crate::error::PlantError;
use crate::fit::{FitSettings, Fitted, fit_with};
use crate::functions::question::{State, States};
use crate::storage::dataset::{Commit, Dataset};
use crate::storage::partition::{Partition, date_of};
use crate::storage::store::Store;
use crate::watch::{WatchSettings, Watched, watch};
use outputs::{Outputs, written};
use sample::{Sample, SampleSize, sample};
use serde::Serialize;
use shows::where_it_shows;
use snug_study::{ProgressEvent, Study, Verb, compared_by, diagnose_prepared};
use std::sync::atomic::AtomicBool;
use thresholds::FEWEST;
use whole::Whole;

/// How a dataset is improved on.
#[derive(Debug, Clone)]
pub struct ImproveSettings {
    /// Effects beside the study's own with which the model begins.
    pub effects: Vec<String>,
    /// Probability with which an effect that `share` of the tightenings have is not missed.
    pub power: f64,
    /// Smallest share of the tightenings that have an effect which must not be missed.
    pub share: f64,
    /// What decides which rows are in the sample, and everything random in the ranking.
    pub seed: u64,
    /// Where rows are asked and fitted.
    pub engine: Engine,
    /// Rows of one job.
    pub rows_per_job: usize,
    /// A pass, or the fit of every row, is given up when for so long no partition came out and those that were tried failed \[s\].
    pub given_up_after_s: u64,
    /// Whether every row is fitted with the model that was found, and tools are watched.
    pub results: bool,
    /// Whether partitions that have results of the same rows and the same model are left as they are.
    pub resume: bool,
}

impl Default for ImproveSettings {
    fn default() -> Self {
        let usual = FitSettings::default();
        Self {
            effects: Vec::new(),
            power: 0.9,
            share: 0.1,
            seed: 0,
            engine: Engine::default(),
            rows_per_job: usual.rows_per_job,
            given_up_after_s: usual.given_up_after_s,
            results: true,
            resume: false,
        }
    }
}

/// What it came to.
#[derive(Debug, Clone)]
pub struct Improved {
    /// The verdict in a sentence.
    pub headline: String,
    /// Effects that were added, in their order.
    pub added: Vec<String>,
    /// Of every rung over all rows: effects, error over noise (root mean square in the output's unit where the noise is not known).
    pub ladder: Vec<(Vec<String>, f64)>,
    /// Rows of the dataset.
    pub rows: usize,
    /// Rows of the sample.
    pub sampled: usize,
    /// What is watched of the results; `None` where there are none.
    pub watched: Option<Watched>,
}

/// How the dataset was asked, as `verdict.json` says it under `plant`.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Asked {
    /// Rows of the dataset.
    rows: usize,
    /// Partitions.
    partitions: usize,
    sample: SampleTold,
    /// Where the model at first leaves more than elsewhere.
    stands_out: Vec<StandsOut>,
    ladder: Vec<whole::RungTold>,
    /// What of this file is of the sample and what of all rows.
    note: &'static str,
}

/// A tool, and the days on which the model at first leaves more of it than of others.
#[derive(Debug, Clone, Serialize)]
struct StandsOut {
    tool: String,
    first_day: String,
    /// `None` where it has not ended.
    last_day: Option<String>,
}

#[derive(Debug, Clone, Serialize)]
struct SampleTold {
    #[serde(flatten)]
    wanted: SampleSize,
    formula: &'static str,
    taken: usize,
    strata: usize,
    parts_of_time: usize,
    in_states: usize,
    partitions: usize,
    seed: u64,
}

const NOTE: &str = "ladder[].error_over_noise and the sizes in added[] are of all rows; everything else is of the sample";

const FORMULA: &str = "rows = ((3.0 + z(power)) / shown_standard_deviations)^2 / share; 3.0: largest z of the family of effects by chance, 1 in 20";

/// Improves on the model of the dataset at `data`; everything that was found goes to `to`. `told` hears what is done.
///
/// # Errors
/// [`PlantError::Nothing`] where there is no dataset, [`PlantError::Setting`], [`PlantError::Pass`] for partitions that cannot be asked,
/// [`PlantError::Partitions`] for those that cannot be fitted: then verdict and report are there all the same.
pub async fn improve(
    data: Store,
    to: Store,
    settings: &ImproveSettings,
    told: &(dyn Fn(&str) + Sync + Send),
) -> Result<Improved, PlantError> {
    let wanted = SampleSize::of(settings.power, settings.share)?;
    let data = Dataset::open(data, "tightenings", "import").await?;
    let mut study = data.study()?;
    study.check_effects(&settings.effects)?;
    study.model.effects.extend(settings.effects.iter().cloned());
    study.diagnosis.search.seed = settings.seed;
    let parts = data.partitions().await?;
    let rows: usize = parts.iter().map(|(_, commit)| commit.rows()).sum();
    let few = sample(&data, &parts, &States::default(), FEWEST, settings.seed).await?;
    let compared = compared_by(&study, &few.prepared)?;
    let session = settings.engine.session(&[&data.store]).await?;
    let whole = Whole {
        data: &data,
        study: &study,
        parts: &parts,
        settings,
        states: &States::default(),
        session: &session,
        compared,
        first: &few.prepared[0],
    };
    let first = whole.rung(&study, told).await?;
    let states = match &first.fit {
        Ok(fit) => where_it_shows(&fit.parts),
        Err(_) => States::default(),
    };
    told(&format!(
        "drawing a sample of {} of {rows} rows",
        wanted.rows
    ));
    let drawn = sample(&data, &parts, &states, wanted.rows, settings.seed).await?;
    let mut asked_of = study.clone();
    asked_of.title = format!("A sample of {} of {rows} tightenings", drawn.prepared.len());
    let found = diagnosed(&asked_of, &drawn.prepared, told)?;
    let whole = Whole {
        states: &states,
        ..whole
    };
    let rungs = whole.rungs(&found, &first, told).await?;
    let asked = Asked {
        rows,
        partitions: parts.len(),
        sample: SampleTold::of(wanted, &drawn, settings.seed),
        stands_out: stands_out(&states),
        ladder: rungs.iter().map(|rung| rung.told(&found)).collect(),
        note: NOTE,
    };
    let outputs = Outputs {
        rungs: &rungs,
        asked: &asked,
        sample: drawn.identity,
    };
    let mut improved = written(&to, found, outputs).await?;
    improved.rows = rows;
    if settings.results {
        let model = &rungs[rungs.len() - 1].study;
        improved.watched = Some(results(&data, &to, model, settings, &parts, told).await?);
    }
    Ok(improved)
}

impl SampleTold {
    fn of(wanted: SampleSize, drawn: &Sample, seed: u64) -> Self {
        Self {
            wanted,
            formula: FORMULA,
            taken: drawn.prepared.len(),
            strata: drawn.strata,
            parts_of_time: drawn.parts_of_time,
            in_states: drawn.in_states,
            partitions: drawn.partitions,
            seed,
        }
    }
}

fn stands_out(states: &States) -> Vec<StandsOut> {
    let told = |(tool, state): (&String, &State)| StandsOut {
        tool: tool.clone(),
        first_day: date_of(state.first),
        last_day: state.last.map(date_of),
    };
    states.0.iter().map(told).collect()
}

/// What the sample says.
fn diagnosed(
    study: &Study,
    prepared: &[snug_preprocess::Prepared],
    told: &(dyn Fn(&str) + Sync + Send),
) -> Result<snug_study::PreparedDiagnosis, PlantError> {
    let never = AtomicBool::new(false);
    let hear = |event: ProgressEvent<'_>| {
        if let ProgressEvent::Stage { what } = event {
            told(what);
        }
    };
    let asked = || diagnose_prepared(study, prepared, &Verb::Improve, None, &hear, &never);
    Ok(tokio::task::block_in_place(asked)?)
}

/// Every row fitted with the model that was found, each with sizes of its own, and what is watched of that.
async fn results(
    data: &Dataset,
    to: &Store,
    model: &Study,
    settings: &ImproveSettings,
    parts: &[(Partition, Commit)],
    told: &(dyn Fn(&str) + Sync + Send),
) -> Result<Watched, PlantError> {
    told("fitting every row with the model that was found");
    let fit_settings = FitSettings {
        effects: Vec::new(),
        engine: settings.engine.clone(),
        resume: settings.resume,
        rows_per_job: settings.rows_per_job,
        given_up_after_s: settings.given_up_after_s,
    };
    let progress = |fitted: &Fitted| {
        told(&format!(
            "{} rows of {} partitions of {}",
            fitted.rows,
            fitted.partitions,
            parts.len()
        ));
    };
    let results = to.below("results")?;
    fit_with(data, model, results.clone(), &fit_settings, &progress).await?;
    let watching = WatchSettings {
        results,
        data: Some(data.store.clone()),
        to: to.below("watch")?,
    };
    watch(&watching).await
}
