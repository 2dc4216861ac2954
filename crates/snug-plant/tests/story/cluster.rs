//! The same bits from this process, from one worker and from two, and with a worker killed in the middle.

use crate::plant::{Plant, small};
use snug_plant::{Engine, FitSettings, PlantError, Simulation};
use std::net::TcpListener;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A process that ends with the test.
pub struct Process(Child);

impl Drop for Process {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

fn free_port() -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    listener.local_addr().unwrap().port()
}

/// Names and values of variables.
type Environment = Vec<(String, String)>;

fn started(arguments: &[String], environment: &Environment) -> Process {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snug-plant"));
    command.args(arguments).env("RUST_LOG", "warn");
    command.envs(environment.iter().cloned());
    command.stdout(Stdio::null()).stderr(Stdio::inherit());
    Process(command.spawn().unwrap())
}

/// A scheduler.
pub struct Cluster {
    port: u16,
    scheduler: Process,
    environment: Environment,
    options: Vec<String>,
}

fn scheduler(port: u16, environment: &Environment, options: &[String]) -> Process {
    let mut arguments = vec!["scheduler".into(), format!("--bind=127.0.0.1:{port}")];
    arguments.extend(options.iter().cloned());
    let scheduler = started(&arguments, environment);
    listens(port);
    scheduler
}

impl Cluster {
    pub fn start() -> Self {
        Self::start_in(Environment::new(), &[])
    }

    /// The scheduler's options, and what stands in its environment and its workers'.
    pub fn start_in(environment: Environment, options: &[&str]) -> Self {
        let port = free_port();
        let options: Vec<String> = options.iter().map(|&option| option.to_owned()).collect();
        Self {
            port,
            scheduler: scheduler(port, &environment, &options),
            environment,
            options,
        }
    }

    /// Kills the scheduler and starts another in its place, which knows of nothing.
    pub fn restart(mut self) -> Self {
        self.scheduler.0.kill().unwrap();
        self.scheduler.0.wait().unwrap();
        self.scheduler = scheduler(self.port, &self.environment, &self.options);
        self
    }

    pub fn address(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    pub fn worker(&self) -> Process {
        self.worker_with(&[])
    }

    pub fn worker_with(&self, options: &[String]) -> Process {
        let (port, command_port) = (free_port(), free_port());
        let mut arguments = vec![
            "worker".into(),
            format!("--scheduler=127.0.0.1:{}", self.port),
            format!("--port={port}"),
            format!("--command-port={command_port}"),
            "--cores=1".into(),
        ];
        arguments.extend(options.iter().cloned());
        let worker = started(&arguments, &self.environment);
        listens(port);
        worker
    }

    pub fn settings(&self) -> FitSettings {
        FitSettings {
            effects: vec!["backlash".into()],
            engine: Engine::Cluster {
                address: self.address(),
                parts: 4,
            },
            ..FitSettings::default()
        }
    }
}

fn listens(port: u16) {
    let until = Instant::now() + Duration::from_secs(30);
    while std::net::TcpStream::connect(("127.0.0.1", port)).is_err() {
        assert!(Instant::now() < until, "nothing listens at {port}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn embedded_one_worker_and_two_give_the_same_bits() {
    let plant = Plant::simulated(&small()).await;
    let embedded = FitSettings {
        effects: vec!["backlash".into()],
        ..FitSettings::default()
    };
    let done = plant.fit("embedded", &embedded).await.unwrap();
    assert_eq!((done.rows, done.partitions), (72, 6));
    let cluster = Cluster::start();
    let _first = cluster.worker();
    plant.fit("one", &cluster.settings()).await.unwrap();
    let _second = cluster.worker();
    plant.fit("two", &cluster.settings()).await.unwrap();
    let expected = plant.digests("embedded").await;
    assert_eq!(plant.digests("one").await, expected);
    assert_eq!(plant.digests("two").await, expected);
}

/// What the engine does not mend by itself is told, and `resume` does it.
#[tokio::test(flavor = "multi_thread")]
async fn a_worker_that_is_killed_costs_no_row() {
    let plant = Plant::simulated(&Simulation {
        per_day: 60,
        ..small()
    })
    .await;
    let cluster = Cluster::start();
    let _first = cluster.worker();
    let second = cluster.worker();
    let settings = cluster.settings();
    let expected = FitSettings {
        engine: Engine::Embedded,
        ..settings.clone()
    };
    plant.fit("embedded", &expected).await.unwrap();
    let killer = std::thread::spawn(move || {
        std::thread::sleep(Duration::from_millis(700));
        drop(second);
    });
    let fitted = plant.fit("cluster", &settings).await;
    killer.join().unwrap();
    let resumed = FitSettings {
        resume: true,
        ..settings
    };
    match fitted {
        Ok(done) => assert_eq!(done.rows, 360),
        Err(PlantError::Partitions { failed, .. }) => {
            let done = plant.fit("cluster", &resumed).await.unwrap();
            assert_eq!(done.partitions, failed.len());
        }
        Err(other) => panic!("{other}"),
    }
    assert_eq!(
        plant.digests("cluster").await,
        plant.digests("embedded").await
    );
}

/// Nobody works, or the only one who did is gone: the scheduler says so after a time that does not depend on the rows.
#[tokio::test(flavor = "multi_thread")]
async fn a_job_that_stands_still_is_given_up_and_resumed() {
    let plant = Plant::simulated(&small()).await;
    let cluster = Cluster::start_in(Vec::new(), &["--give-up-after=3"]);
    let settings = FitSettings {
        given_up_after_s: 8,
        ..cluster.settings()
    };
    let began = Instant::now();
    let error = plant.fit("results", &settings).await.unwrap_err();
    let took = began.elapsed();
    let PlantError::Partitions { failed, partitions } = error else {
        panic!("{error}");
    };
    assert_eq!((failed.len(), partitions), (6, 6));
    assert!(
        failed[0].1.contains("none ran at a worker that is alive"),
        "{failed:?}"
    );
    assert!(failed[5].1.contains("not tried"), "{failed:?}");
    // A job and three partitions that stood still for 3 s each, seen every 2 s.
    assert!(took < Duration::from_secs(40), "{took:?}");
    let _worker = cluster.worker();
    let resumed = FitSettings {
        resume: true,
        ..settings
    };
    let done = plant.fit("results", &resumed).await.unwrap();
    assert_eq!((done.rows, done.partitions, done.left), (72, 6, 0));
}

/// A part of some seconds is work, not standing still.
#[tokio::test(flavor = "multi_thread")]
async fn a_part_that_takes_long_is_not_given_up() {
    let plant = Plant::simulated(&Simulation {
        per_day: 20,
        ..small()
    })
    .await;
    let cluster = Cluster::start_in(Vec::new(), &["--give-up-after=1"]);
    let _worker = cluster.worker();
    let settings = FitSettings {
        engine: Engine::Cluster {
            address: cluster.address(),
            parts: 1,
        },
        ..cluster.settings()
    };
    let began = Instant::now();
    let done = plant.fit("results", &settings).await.unwrap();
    assert_eq!((done.rows, done.partitions), (120, 6));
    // Long enough for what stands still to be seen.
    let took = began.elapsed();
    assert!(took > Duration::from_secs(3), "{took:?}");
}

#[tokio::test]
async fn without_a_scheduler_every_partition_is_named() {
    let plant = Plant::simulated(&small()).await;
    let settings = FitSettings {
        engine: Engine::Cluster {
            address: format!("127.0.0.1:{}", free_port()),
            parts: 4,
        },
        ..FitSettings::default()
    };
    let error = plant.fit("results", &settings).await.unwrap_err();
    let text = error.to_string();
    assert!(text.contains("6 of 6 partitions failed"), "{text}");
    assert!(text.contains("2026-03-02/T0003"), "{text}");
    assert!(plant.commits("results", "results").await.is_empty());
}
