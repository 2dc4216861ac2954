//! The program's arguments.

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use snug_campaign::words::program;
use snug_plant::{
    BenchSettings, CLUSTER_PARTS, Engine, FitSettings, GIVEN_UP_AFTER_S, ImproveSettings, Naming,
    PlantError, STANDS_STILL_AFTER_S, SchedulerSettings, Simulation, Store, WorkerSettings,
};
use snug_study::Study;
use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;

/// A plant's tightenings as Parquet: brought in, fitted on one machine or many, asked and watched.
///
/// URL is a folder, file:///… or s3://BUCKET/…; where a bucket is and who asks for it, the environment says (AWS_ENDPOINT_URL,
/// AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY, AWS_REGION, AWS_ALLOW_HTTP).
#[derive(Debug, Parser)]
#[command(version)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

impl Arguments {
    /// As typed, under the name that was typed: that of a program that started this one, as in `snug plant`, or its own. Ends the
    /// program where they are wrong.
    pub fn typed() -> Self {
        let name: &'static str = match std::env::var(program::VARIABLE) {
            Ok(front) => {
                let front: &str = front.leak();
                program::set_program(front);
                format!("{front} plant").leak()
            }
            Err(_) => "snug-plant",
        };
        let mut command = Self::command().name(name).bin_name(name);
        let matches = command.get_matches_mut();
        Self::from_arg_matches(&matches).unwrap_or_else(|error| error.format(&mut command).exit())
    }
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Measurement files to a dataset, each file once: rows, and what was found of them.
    Import(ImportOptions),
    /// A plant of simulated tools straight into a dataset.
    Simulate(SimulateOptions),
    /// Fits every row; results as Parquet.
    Fit(FitOptions),
    /// What is missing, learnt from a sample; how large it is, from all rows; which tools have it, and since when.
    Improve(ImproveOptions),
    /// The engine's scheduler, with Snug's functions registered.
    Scheduler(SchedulerOptions),
    /// One of the engine's workers, with Snug's functions registered.
    Worker(WorkerOptions),
    /// Measures what the engine costs: beside the same in memory, plain reading, workers, memory, a worker's death.
    Bench(BenchOptions),
    /// Asks a dataset and results: tables tightenings, findings, results.
    Sql(SqlOptions),
    /// What changed, when, in which tools; which differ from their sisters. Tables, JSON and a page.
    Watch(WatchOptions),
}

/// Of `import`.
#[derive(Debug, Args)]
pub struct ImportOptions {
    /// Folder with data in the thesis' layout, or a study (RON) that says how its data are written.
    #[arg(value_name = "DIR|STUDY.ron")]
    source: PathBuf,
    /// The dataset.
    #[arg(long, value_name = "URL")]
    pub to: String,
    /// What files' names say, for example '{tool}_{day}_{time}'; also {station} and {skip}.
    #[arg(long, value_name = "TEMPLATE")]
    names: Option<String>,
    /// Tool of files whose names say none.
    #[arg(long)]
    tool: Option<String>,
    /// Day (YYYY-MM-DD) of files whose names say none.
    #[arg(long)]
    day: Option<String>,
    /// Station of files whose names say none.
    #[arg(long)]
    station: Option<String>,
}

impl ImportOptions {
    /// The study that reads and prepares the files.
    pub fn study(&self) -> Result<Study, PlantError> {
        let is_study = self
            .source
            .extension()
            .is_some_and(|ending| ending == "ron");
        let study = match is_study {
            true => Study::read(&self.source)?,
            false => Study::on(self.source.clone()),
        };
        study.check()?;
        Ok(study)
    }

    /// What files' names say.
    pub fn naming(&self) -> Result<Naming, PlantError> {
        let naming = Naming::of_all(self.tool.clone(), self.day.clone(), self.station.clone());
        match &self.names {
            Some(template) => naming.with_template(template),
            None => Ok(naming),
        }
    }
}

/// Of `simulate`.
#[derive(Debug, Args)]
pub struct SimulateOptions {
    /// The dataset.
    #[arg(long, value_name = "URL")]
    pub to: String,
    /// Tools.
    #[arg(long, default_value_t = 12)]
    tools: usize,
    /// Days.
    #[arg(long, default_value_t = 20)]
    days: usize,
    /// The first of them.
    #[arg(long, value_name = "YYYY-MM-DD", default_value = "2026-03-01")]
    first_day: String,
    /// Tightenings of a tool on a day.
    #[arg(long, value_name = "N", default_value_t = 20)]
    per_day: usize,
    /// Effect that comes over some tools.
    #[arg(long)]
    effect: Option<String>,
    /// How strong it is, 0 to 1.
    #[arg(long, default_value_t = 0.5)]
    strength: f64,
    /// Numbers of the tools that have it.
    #[arg(long, value_delimiter = ',', default_values_t = [3, 7, 10])]
    in_tools: Vec<u32>,
    /// Day, counted from 1, from which they have it.
    #[arg(long, value_name = "N", default_value_t = 11)]
    from_day: usize,
    /// Samples per second.
    #[arg(long, value_name = "HZ", default_value_t = 10_000.0)]
    rate: f64,
    /// What decides everything random.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

impl SimulateOptions {
    /// What is simulated.
    pub fn simulation(&self) -> Simulation {
        Simulation {
            tools: self.tools,
            days: self.days,
            first_day: self.first_day.clone(),
            per_day: self.per_day,
            effect: self.effect.clone(),
            strength: self.strength,
            in_tools: self.in_tools.clone(),
            from_day: self.from_day,
            sample_rate_hz: self.rate,
            seed: self.seed,
        }
    }
}

/// Of `fit`.
#[derive(Debug, Args)]
pub struct FitOptions {
    /// The dataset.
    #[arg(long, value_name = "URL")]
    pub data: String,
    /// The results.
    #[arg(long, value_name = "URL")]
    pub to: String,
    /// Effects beside the study's own.
    #[arg(long, value_delimiter = ',', value_name = "EFFECT,…")]
    effects: Vec<String>,
    #[command(flatten)]
    engine: EngineOptions,
}

impl FitOptions {
    /// How the dataset is fitted.
    pub fn settings(&self) -> FitSettings {
        let usual = FitSettings::default();
        FitSettings {
            effects: self.effects.clone(),
            engine: self.engine.engine(),
            resume: self.engine.resume,
            rows_per_job: self.engine.rows_per_job.unwrap_or(usual.rows_per_job),
            given_up_after_s: self.engine.give_up_after,
        }
    }
}

/// Of `improve`.
#[derive(Debug, Args)]
pub struct ImproveOptions {
    /// The dataset.
    #[arg(long, value_name = "URL")]
    pub data: String,
    /// Where verdict.json, report.html, study.ron, tables, results and what is watched of them go.
    #[arg(long, value_name = "URL")]
    pub to: String,
    /// Effects with which the model begins, beside the study's own.
    #[arg(long, value_delimiter = ',', value_name = "EFFECT,…")]
    effects: Vec<String>,
    /// Probability with which an effect that --share of the tightenings have is not missed.
    #[arg(long, default_value_t = 0.9)]
    power: f64,
    /// Smallest share of the tightenings that have an effect which must not be missed.
    #[arg(long, default_value_t = 0.1)]
    share: f64,
    /// What decides which rows are in the sample, and everything random in the ranking.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Only what all rows share: no fit of every row, and nothing watched.
    #[arg(long)]
    no_results: bool,
    #[command(flatten)]
    engine: EngineOptions,
}

impl ImproveOptions {
    /// How the dataset is improved on.
    pub fn settings(&self) -> ImproveSettings {
        let usual = ImproveSettings::default();
        ImproveSettings {
            effects: self.effects.clone(),
            power: self.power,
            share: self.share,
            seed: self.seed,
            engine: self.engine.engine(),
            rows_per_job: self.engine.rows_per_job.unwrap_or(usual.rows_per_job),
            given_up_after_s: self.engine.give_up_after,
            results: !self.no_results,
            resume: self.engine.resume,
        }
    }
}

/// Where the work is done, and how it is cut.
#[derive(Debug, Args)]
pub struct EngineOptions {
    /// Scheduler of a cluster; without it, this process does everything.
    #[arg(long, value_name = "HOST:PORT")]
    cluster: Option<String>,
    /// Parts that a cluster's workers take at the same time.
    #[arg(long, value_name = "N", default_value_t = CLUSTER_PARTS)]
    parts: usize,
    /// Only what has no results yet, or results of other rows.
    #[arg(long)]
    resume: bool,
    /// Rows of one job.
    #[arg(long, value_name = "N")]
    rows_per_job: Option<usize>,
    /// What is left is not tried when for so many seconds no partition came out and those that were tried failed.
    #[arg(long, value_name = "S", default_value_t = GIVEN_UP_AFTER_S)]
    give_up_after: u64,
}

impl EngineOptions {
    fn engine(&self) -> Engine {
        match &self.cluster {
            Some(address) => Engine::Cluster {
                address: address.clone(),
                parts: self.parts,
            },
            None => Engine::Embedded,
        }
    }
}

/// Of `scheduler`.
#[derive(Debug, Args)]
pub struct SchedulerOptions {
    /// Address that it listens at. Whoever reaches it may run plans: keep it on loopback or a network of its own.
    #[arg(long, value_name = "IP:PORT", default_value = "127.0.0.1:50050")]
    bind: SocketAddr,
    /// A job is given up when for so many seconds no part of it was finished or begun and none ran at a living worker.
    #[arg(long, value_name = "S", default_value_t = STANDS_STILL_AFTER_S)]
    give_up_after: u64,
}

impl SchedulerOptions {
    /// How it is started.
    pub fn settings(&self) -> SchedulerSettings {
        SchedulerSettings {
            bind: self.bind,
            give_up_after_s: self.give_up_after,
        }
    }
}

/// Of `worker`.
#[derive(Debug, Args)]
pub struct WorkerOptions {
    /// The scheduler.
    #[arg(long, value_name = "IP:PORT", default_value = "127.0.0.1:50050")]
    scheduler: SocketAddr,
    /// Address that it listens at, under which scheduler, clients and other workers reach it.
    #[arg(long, value_name = "IP", default_value = "127.0.0.1")]
    bind: IpAddr,
    /// Port for data.
    #[arg(long, default_value_t = 50051)]
    port: u16,
    /// Port for commands.
    #[arg(long, default_value_t = 50052)]
    command_port: u16,
    /// Tasks at a time; default one a core.
    #[arg(long, value_name = "N")]
    cores: Option<usize>,
    /// Folder for what is handed between stages; default one of its own.
    #[arg(long, value_name = "DIR")]
    work_dir: Option<String>,
}

impl WorkerOptions {
    /// How it is started.
    pub fn settings(&self) -> WorkerSettings {
        WorkerSettings {
            scheduler: self.scheduler,
            bind: self.bind,
            port: self.port,
            command_port: self.command_port,
            cores: self.cores,
            work_dir: self.work_dir.clone(),
        }
    }
}

/// Of `bench`.
#[derive(Debug, Args)]
pub struct BenchOptions {
    /// Rows of each dataset that is made; the first is also fitted in memory.
    #[arg(long, value_delimiter = ',', value_name = "N,…", default_values_t = [10_000, 100_000])]
    rows: Vec<usize>,
    /// Samples per second; windows are 0.3 s long.
    #[arg(long, value_name = "HZ", default_value_t = 2000.0)]
    rate: f64,
    /// Where datasets and results go; datasets that are there are taken.
    #[arg(long, value_name = "URL", default_value = "out/plant-bench")]
    to: String,
}

impl BenchOptions {
    /// What is measured.
    pub fn settings(&self) -> Result<BenchSettings, PlantError> {
        Ok(BenchSettings {
            rows: self.rows.clone(),
            sample_rate_hz: self.rate,
            to: Store::open(&self.to)?,
        })
    }
}

/// Of `sql`.
#[derive(Debug, Args)]
pub struct SqlOptions {
    /// The question; it only reads.
    pub query: String,
    /// A dataset: tables tightenings and findings.
    #[arg(long, value_name = "URL")]
    pub data: Option<String>,
    /// Results of a fit: table results.
    #[arg(long, value_name = "URL")]
    pub results: Option<String>,
}

/// Of `watch`.
#[derive(Debug, Args)]
pub struct WatchOptions {
    /// Results of a fit.
    #[arg(long, value_name = "URL")]
    pub results: String,
    /// The dataset that they were made from: with it, the page leads down to single tightenings.
    #[arg(long, value_name = "URL")]
    pub data: Option<String>,
    /// Where watch.html, watch.json, watch.parquet and daily.parquet go.
    #[arg(long, value_name = "URL")]
    pub to: String,
}
