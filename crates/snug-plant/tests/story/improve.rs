//! What came over three of twelve tools is named from a sample, its size is that of all rows, and the tools that have it are found.

use crate::cluster::Cluster;
use crate::plant::Plant;
use arrow::array::{Array, AsArray, RecordBatch};
use arrow::datatypes::{Float64Type, UInt32Type};
use snug_plant::{Engine, ImproveSettings, Improved, PlantError, Simulation, improve};
use std::fs;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// After which time a worker is killed in a pass that takes several times as long.
const IN_THE_MIDDLE: Duration = Duration::from_millis(150);

/// A sixth of the rows have it; two rows of every tool in every fifth of the time are asked.
fn plant() -> Simulation {
    Simulation {
        tools: 12,
        days: 10,
        per_day: 5,
        effect: Some("cubic_stiffness".to_owned()),
        from_day: 5,
        sample_rate_hz: 2000.0,
        ..Simulation::default()
    }
}

fn settings() -> ImproveSettings {
    ImproveSettings {
        share: 0.15,
        ..ImproveSettings::default()
    }
}

async fn improved(
    plant: &Plant,
    to: &str,
    settings: &ImproveSettings,
) -> Result<Improved, PlantError> {
    improve(plant.store("data"), plant.store(to), settings, &|_| ()).await
}

fn read(plant: &Plant, name: &str) -> RecordBatch {
    let file = fs::File::open(plant.path(name)).unwrap();
    let reader = parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder::try_new(file);
    let batches: Vec<RecordBatch> = (reader.unwrap().build().unwrap())
        .map(Result::unwrap)
        .collect();
    arrow::compute::concat_batches(&batches[0].schema(), &batches).unwrap()
}

fn json(plant: &Plant, name: &str) -> serde_json::Value {
    serde_json::from_slice(&fs::read(plant.path(name)).unwrap()).unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn an_effect_of_three_tools_is_named_sized_and_dated() {
    let plant = Plant::simulated(&plant()).await;
    let done = improved(&plant, "out", &settings()).await.unwrap();
    assert_eq!(done.added, ["cubic_stiffness"]);
    let errors: Vec<f64> = done.ladder.iter().map(|(_, error)| *error).collect();
    assert!(errors[0] > 1.15 && errors[1] < 1.02, "{errors:?}");
    let watched = done.watched.unwrap();
    let mut found: Vec<&str> = watched.tools.iter().map(|one| one.name.as_str()).collect();
    found.sort_unstable();
    assert_eq!(found, ["T0003", "T0007", "T0010"]);
    for tool in &watched.tools {
        assert_eq!(tool.effect.as_deref(), Some("cubic_stiffness"));
        assert_eq!(tool.since.as_deref(), Some("2026-03-05"));
    }
    let verdict = json(&plant, "out/verdict.json");
    assert_eq!(verdict["verdict"], "adequate");
    assert_eq!(verdict["added"][0]["effect"], "cubic_stiffness");
    assert_eq!(verdict["ladder"][1]["error_over_noise"], errors[1]);
    assert_eq!(verdict["plant"]["ladder"][1]["rows"], 600.0);
    let groups = &verdict["added"][0]["parameters"][0]["by_group"]["groups"];
    let present = groups
        .as_array()
        .unwrap()
        .iter()
        .filter(|one| one["present"] == true);
    let present: Vec<&str> = present.filter_map(|one| one["group"].as_str()).collect();
    let since = |tool: &str| format!("{tool} since 2026-03-05");
    assert_eq!(present, ["T0003", "T0007", "T0010"].map(since));
    let report = fs::read_to_string(plant.path("out/report.html")).unwrap();
    assert!(report.contains("cubic stiffness"));
    // Of three states and twelve tools each has a size of its own: there where it came, nothing elsewhere.
    let sizes = read(&plant, "out/sizes.parquet");
    let column = |name: &str| sizes.column_by_name(name).unwrap();
    let groups = column("group").as_string::<i32>();
    let number = |name: &str| column(name).as_primitive::<Float64Type>();
    let rungs = column("rung").as_primitive::<UInt32Type>();
    assert_eq!((sizes.num_rows(), rungs.value(0)), (15, 1));
    for row in 0..sizes.num_rows() {
        let (low, high) = (number("low"), number("high"));
        let there = low.is_valid(row) && low.value(row) > 1e5;
        let has_it = groups.value(row).ends_with("since 2026-03-05");
        assert_eq!(
            there,
            has_it,
            "{} {}",
            groups.value(row),
            number("value").value(row)
        );
        assert!(low.is_null(row) || low.value(row) < high.value(row));
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn where_nothing_is_missing_nothing_is_added() {
    let quiet = Simulation {
        effect: None,
        days: 6,
        per_day: 3,
        ..plant()
    };
    let plant = Plant::simulated(&quiet).await;
    let settings = ImproveSettings {
        share: 0.5,
        ..settings()
    };
    let done = improved(&plant, "out", &settings).await.unwrap();
    assert_eq!(done.added, Vec::<String>::new());
    assert_eq!(done.ladder.len(), 1);
    let watched = done.watched.unwrap();
    assert_eq!((watched.tools.len(), watched.quiet_tools), (0, 12));
}

/// Whoever asks, and whoever is asked: the same bits in every table.
#[tokio::test(flavor = "multi_thread")]
async fn embedded_and_two_workers_give_the_same_bits() {
    let small = Simulation {
        tools: 6,
        days: 5,
        per_day: 8,
        in_tools: vec![2],
        from_day: 3,
        ..plant()
    };
    let plant = Plant::simulated(&small).await;
    let without_results = ImproveSettings {
        share: 0.5,
        results: false,
        effects: vec!["cubic_stiffness".to_owned()],
        ..settings()
    };
    improved(&plant, "embedded", &without_results)
        .await
        .unwrap();
    let cluster = Cluster::start();
    let _workers = (cluster.worker(), cluster.worker());
    let on_cluster = ImproveSettings {
        engine: Engine::Cluster {
            address: cluster.address(),
            parts: 5,
        },
        rows_per_job: 100,
        ..without_results
    };
    improved(&plant, "cluster", &on_cluster).await.unwrap();
    assert_same_bits(&plant, "cluster", "embedded");
}

fn assert_same_bits(plant: &Plant, one: &str, other: &str) {
    for table in [
        "sizes.parquet",
        "ladder.parquet",
        "sample.parquet",
        "study.ron",
        "verdict.json",
    ] {
        let content = |to: &str| fs::read(plant.path(&format!("{to}/{table}"))).unwrap();
        assert_eq!(content(one), content(other), "{table}");
    }
}

/// Passes that were told, each with the time at which it ended.
type Passes = Mutex<Vec<(String, Instant)>>;

/// Of two workers one dies while the sums of a pass are with both: what it had is asked again, and nothing twice.
#[tokio::test(flavor = "multi_thread")]
async fn a_worker_killed_in_the_middle_of_a_pass_changes_no_bit() {
    let plant = Plant::simulated(&Simulation {
        tools: 6,
        days: 5,
        per_day: 60,
        in_tools: vec![2],
        from_day: 3,
        ..plant()
    })
    .await;
    let embedded = ImproveSettings {
        share: 0.5,
        results: false,
        effects: vec!["cubic_stiffness".to_owned()],
        ..settings()
    };
    improved(&plant, "embedded", &embedded).await.unwrap();
    let cluster = Cluster::start();
    let _first = cluster.worker();
    let second = Mutex::new(Some(cluster.worker()));
    let on_cluster = ImproveSettings {
        engine: Engine::Cluster {
            address: cluster.address(),
            parts: 5,
        },
        ..embedded
    };
    let (passes, killed) = (Passes::default(), Arc::new(Mutex::new(None)));
    let told = |text: &str| {
        if !text.contains("over all rows") {
            return;
        }
        let mut passes = passes.lock().unwrap();
        passes.push((text.to_owned(), Instant::now()));
        let Some(worker) = second.lock().unwrap().take() else {
            return;
        };
        let killed = killed.clone();
        std::thread::spawn(move || {
            std::thread::sleep(IN_THE_MIDDLE);
            drop(worker);
            *killed.lock().unwrap() = Some(Instant::now());
        });
    };
    let (data, to) = (plant.store("data"), plant.store("cluster"));
    improve(data, to, &on_cluster, &told).await.unwrap();
    assert_same_bits(&plant, "cluster", "embedded");
    // The pass after the first had begun when the worker died, and ended afterwards.
    let passes = passes.into_inner().unwrap();
    let killed = killed.lock().unwrap().unwrap();
    assert!(passes[1].0.contains("pass 2"), "{passes:?}");
    assert!(
        passes[0].1 < killed && killed < passes[1].1,
        "{killed:?} {passes:?}"
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn a_damaged_partition_is_named_and_no_sum_is_told() {
    let few = Simulation {
        tools: 3,
        days: 10,
        per_day: 3,
        effect: None,
        ..plant()
    };
    let plant = Plant::simulated(&few).await;
    let commits = plant.commits("data", "tightenings").await;
    for (part, commit) in [&commits[0], &commits[7], &commits[20]] {
        let path = plant.path("data").join(&commit.files[0].name);
        let whole = fs::read(&path).unwrap();
        fs::write(&path, &whole[..whole.len() / 2]).unwrap();
        let error = improved(&plant, "out", &settings()).await.unwrap_err();
        let PlantError::Pass { failed, partitions } = &error else {
            panic!("{error}");
        };
        assert_eq!((failed.len(), *partitions), (1, 30));
        assert_eq!(failed[0].0, part.to_string());
        fs::write(&path, &whole).unwrap();
    }
    assert!(!plant.path("out/verdict.json").exists());
}

#[tokio::test]
async fn what_is_no_power_or_share_is_refused_by_name() {
    let plant = Plant::empty();
    for (power, share, named) in [
        (1.0, 0.1, "power"),
        (0.9, 0.0, "share"),
        (0.9, 2.0, "share"),
    ] {
        let settings = ImproveSettings {
            power,
            share,
            ..settings()
        };
        let error = improved(&plant, "out", &settings).await.unwrap_err();
        assert!(matches!(error, PlantError::Setting { .. }), "{error}");
        assert!(error.to_string().starts_with(named), "{error}");
    }
}
