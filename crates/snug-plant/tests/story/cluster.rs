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

fn started(arguments: &[String]) -> Process {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snug-plant"));
    command.args(arguments).env("RUST_LOG", "warn");
    command.stdout(Stdio::null()).stderr(Stdio::inherit());
    Process(command.spawn().unwrap())
}

/// A scheduler.
pub struct Cluster {
    port: u16,
    scheduler: Process,
}

fn scheduler(port: u16) -> Process {
    let address = format!("127.0.0.1:{port}");
    let scheduler = started(&["scheduler".into(), "--bind".into(), address]);
    listens(port);
    scheduler
}

impl Cluster {
    pub fn start() -> Self {
        let port = free_port();
        Self {
            port,
            scheduler: scheduler(port),
        }
    }

    /// Kills the scheduler and starts another in its place, which knows of nothing.
    pub fn restart(mut self) -> Self {
        self.scheduler.0.kill().unwrap();
        self.scheduler.0.wait().unwrap();
        Self {
            port: self.port,
            scheduler: scheduler(self.port),
        }
    }

    pub fn address(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    pub fn worker(&self) -> Process {
        let (port, command_port) = (free_port(), free_port());
        let worker = started(&[
            "worker".into(),
            format!("--scheduler=127.0.0.1:{}", self.port),
            format!("--port={port}"),
            format!("--command-port={command_port}"),
            "--cores=1".into(),
        ]);
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
