//! Workers killed at ten places of a fit, and a scheduler that is started anew in the middle: no row is lost, doubled or another.

use crate::cluster::Cluster;
use crate::plant::{Plant, small};
use snug_plant::{Engine, FitSettings, Fitted, Partition, PlantError, Simulation};
use std::io::Write;
use std::time::{Duration, Instant};

const KILLS: u32 = 10;

/// What must come out: the digests of one machine.
struct Truth {
    plant: Plant,
    digests: Vec<(Partition, Vec<String>)>,
}

async fn truth(settings: &FitSettings) -> Truth {
    let plant = Plant::simulated(&Simulation {
        per_day: 30,
        ..small()
    })
    .await;
    let embedded = FitSettings {
        engine: Engine::Embedded,
        ..settings.clone()
    };
    plant.fit("embedded", &embedded).await.unwrap();
    let digests = plant.digests("embedded").await;
    assert_eq!(digests.len(), 6);
    Truth { plant, digests }
}

impl Truth {
    /// Ends what a fit left open: it said exactly which partitions failed, and only these are done. Gives how many they were.
    async fn mended(
        &self,
        to: &str,
        settings: &FitSettings,
        fitted: Result<Fitted, PlantError>,
    ) -> usize {
        let failed = match fitted {
            Ok(done) => {
                assert_eq!((done.rows, done.partitions), (180, 6));
                0
            }
            Err(PlantError::Partitions { failed, partitions }) => {
                assert_eq!(partitions, 6);
                let named: Vec<&str> = failed.iter().map(|(part, _)| part.as_str()).collect();
                for (part, _) in self.plant.commits(to, "results").await {
                    assert!(!named.contains(&part.to_string().as_str()), "{part}");
                }
                let resumed = FitSettings {
                    resume: true,
                    ..settings.clone()
                };
                let done = self.plant.fit(to, &resumed).await.unwrap();
                assert_eq!(
                    (done.partitions, done.left),
                    (failed.len(), 6 - failed.len())
                );
                failed.len()
            }
            Err(other) => panic!("{other}"),
        };
        assert_eq!(self.plant.digests(to).await, self.digests);
        failed
    }
}

fn say(text: &str) {
    writeln!(std::io::stderr(), "{text}").ok();
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "takes minutes: cargo test --release --locked --test story kills -- --ignored --nocapture"]
async fn ten_workers_killed_at_ten_places_cost_no_row() {
    let cluster = Cluster::start();
    let settings = cluster.settings();
    let truth = truth(&settings).await;
    let _first = cluster.worker();
    let mut second = cluster.worker();
    let began = Instant::now();
    truth.plant.fit("quiet", &settings).await.unwrap();
    let whole = began.elapsed();
    for kill in 0..KILLS {
        let after = whole * (2 * kill + 1) / (2 * KILLS);
        let killer = std::thread::spawn(move || {
            std::thread::sleep(after);
            drop(second);
        });
        let to = format!("kill-{kill}");
        let began = Instant::now();
        let fitted = truth.plant.fit(&to, &settings).await;
        let took = began.elapsed();
        killer.join().unwrap();
        second = cluster.worker();
        let failed = truth.mended(&to, &settings, fitted).await;
        say(&format!(
            "killed after {after:.1?} of {whole:.1?}: {took:.1?}, {failed} partitions named and resumed"
        ));
    }
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "takes minutes: cargo test --release --locked --test story kills -- --ignored --nocapture"]
async fn a_scheduler_started_anew_in_the_middle_costs_no_row() {
    let mut cluster = Cluster::start();
    let settings = cluster.settings();
    let truth = truth(&settings).await;
    let _workers = (cluster.worker(), cluster.worker());
    let began = Instant::now();
    truth.plant.fit("quiet", &settings).await.unwrap();
    let whole = began.elapsed();
    for restart in 0..3 {
        let after = whole * (2 * restart + 1) / 6;
        let anew = std::thread::spawn(move || {
            std::thread::sleep(after);
            cluster.restart()
        });
        let to = format!("restart-{restart}");
        let began = Instant::now();
        let fitted = truth.plant.fit(&to, &settings).await;
        let took = began.elapsed();
        cluster = anew.join().unwrap();
        // Workers tell the new scheduler of themselves with their next heartbeat.
        std::thread::sleep(Duration::from_secs(5));
        let failed = truth.mended(&to, &settings, fitted).await;
        say(&format!(
            "restarted after {after:.1?} of {whole:.1?}: {took:.1?}, {failed} partitions named and resumed"
        ));
    }
}
