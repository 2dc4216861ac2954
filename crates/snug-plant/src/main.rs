//! The program: reads its arguments, does what they ask, and says in a line what came of it.

mod arguments;

use arguments::{Arguments, Command, FitOptions};
use snug_plant::{Figures, Improved, PlantError, Store, Tables, WatchSettings, Watched};
use std::io::Write;
use std::process::ExitCode;
use tracing_subscriber::EnvFilter;

fn main() -> ExitCode {
    let arguments = Arguments::typed();
    let level = match arguments.command {
        Command::Scheduler(_) | Command::Worker(_) => "info",
        _ => "warn",
    };
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new(level));
    tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        .with_env_filter(filter)
        .init();
    let runtime = match tokio::runtime::Runtime::new() {
        Ok(runtime) => runtime,
        Err(error) => return failed(&format!("no thread can be started: {error}"), 1),
    };
    let ended = runtime.block_on(work(arguments.command));
    runtime.shutdown_background();
    match ended {
        Ok(said) => match writeln!(std::io::stdout(), "{said}") {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
            Err(error) => failed(&format!("standard output: {error}"), 1),
        },
        Err(error) => failed(&error.to_string(), exit_code(&error)),
    }
}

fn failed(why: &str, code: u8) -> ExitCode {
    writeln!(std::io::stderr(), "{why}").ok();
    ExitCode::from(code)
}

/// 2 for bad arguments, as every program of Snug; 1 for everything else.
fn exit_code(error: &PlantError) -> u8 {
    match error {
        PlantError::Study(error) if error.is_bad_argument() => 2,
        PlantError::Setting { .. } | PlantError::Place { .. } | PlantError::Other { .. } => 2,
        _ => 1,
    }
}

async fn work(command: Command) -> Result<String, PlantError> {
    match command {
        Command::Import(options) => {
            let (study, naming) = (options.study()?, options.naming()?);
            let done = snug_plant::import(&study, &naming, Store::open(&options.to)?).await?;
            Ok(format!(
                "{} tightenings of {} files came into {} partitions, with {} findings; {} files were there already",
                done.rows, done.files, done.partitions, done.findings, done.known
            ))
        }
        Command::Simulate(options) => {
            let simulation = options.simulation();
            let done = snug_plant::simulate_plant(&simulation, Store::open(&options.to)?).await?;
            Ok(format!(
                "{} simulated tightenings came into {} partitions",
                done.rows, done.partitions
            ))
        }
        Command::Fit(options) => fitted(&options).await,
        Command::Improve(options) => {
            let (data, to) = (Store::open(&options.data)?, Store::open(&options.to)?);
            let done = snug_plant::improve(data, to, &options.settings(), &hear).await?;
            Ok(improved(&done))
        }
        Command::Scheduler(options) => {
            snug_plant::scheduler(&options.settings()).await?;
            Ok("the scheduler has ended".to_owned())
        }
        Command::Worker(options) => {
            snug_plant::worker(&options.settings()).await?;
            Ok("the worker has ended".to_owned())
        }
        Command::Bench(options) => {
            let figures = snug_plant::bench(&options.settings()?, &hear).await?;
            let told: Vec<String> = figures.iter().map(Figures::told).collect();
            Ok(told.join("\n"))
        }
        Command::Sql(options) => {
            let open = |url: &Option<String>| url.as_deref().map(Store::open).transpose();
            let tables = Tables {
                data: open(&options.data)?,
                results: open(&options.results)?,
            };
            let answer = snug_plant::query(&tables, &options.query).await?;
            snug_plant::as_text(&answer)
        }
        Command::Watch(options) => {
            let settings = WatchSettings {
                results: Store::open(&options.results)?,
                data: options.data.as_deref().map(Store::open).transpose()?,
                to: Store::open(&options.to)?,
            };
            Ok(told(&snug_plant::watch(&settings).await?))
        }
    }
}

/// What is under way, a line each.
fn hear(what: &str) {
    writeln!(std::io::stderr(), "{what}").ok();
}

async fn fitted(options: &FitOptions) -> Result<String, PlantError> {
    let (data, to) = (Store::open(&options.data)?, Store::open(&options.to)?);
    let told = |fitted: &snug_plant::Fitted| {
        hear(&format!(
            "{} rows of {} partitions",
            fitted.rows, fitted.partitions
        ));
    };
    let done = snug_plant::fit(data, to, &options.settings(), &told).await?;
    Ok(format!(
        "{} tightenings of {} partitions have results now; {} partitions were left as they are",
        done.rows, done.partitions, done.left
    ))
}

/// What an improvement came to: the verdict, the ladder, the tools.
fn improved(done: &Improved) -> String {
    let mut lines = vec![
        done.headline.clone(),
        format!(
            "learnt from {} of {} tightenings; error over noise of all of them:",
            done.sampled, done.rows
        ),
    ];
    for (effects, error) in &done.ladder {
        let effects = match effects.is_empty() {
            true => "the base model".to_owned(),
            false => effects.join(" + "),
        };
        lines.push(format!("  {error:.4} {effects}"));
    }
    lines.extend(done.watched.iter().map(told));
    lines.join("\n")
}

/// What was found, a line a tool.
fn told(watched: &Watched) -> String {
    let all = watched.tools.len() + watched.quiet_tools;
    let mut lines = vec![format!(
        "{} of {all} tools changed or differ",
        watched.tools.len()
    )];
    for found in &watched.tools {
        let since = found
            .since
            .as_deref()
            .map_or_else(String::new, |day| format!(" since {day}"));
        let what: Vec<&str> = found.changed.iter().map(|one| one.name.as_str()).collect();
        let what = match what.is_empty() {
            true => "differs from its sisters".to_owned(),
            false => what.join(", "),
        };
        let effect = found
            .effect
            .as_deref()
            .map_or_else(String::new, |effect| format!("{effect}: "));
        lines.push(format!("  {}{since}: {effect}{what}", found.name));
    }
    lines.join("\n")
}
