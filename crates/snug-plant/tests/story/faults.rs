//! What is damaged is named, what is unfinished is never read, and what is done is not done again.

use crate::plant::{Plant, small};
use snug_plant::{FitSettings, PlantError, Tables, query};
use std::fs;

async fn count(plant: &Plant, table: &str) -> String {
    let tables = Tables {
        data: Some(plant.store("data")),
        results: Some(plant.store("results")),
    };
    let text = format!("SELECT count(*) AS n, count(DISTINCT key) AS keys FROM {table}");
    let answer = query(&tables, &text).await.unwrap();
    snug_plant::as_text(&answer)
        .unwrap()
        .lines()
        .nth(3)
        .unwrap()
        .replace(' ', "")
}

#[tokio::test(flavor = "multi_thread")]
async fn a_damaged_file_is_named_and_the_others_are_whole() {
    let plant = Plant::simulated(&small()).await;
    let commits = plant.commits("data", "tightenings").await;
    let (part, commit) = &commits[3];
    let path = plant.path("data").join(&commit.files[0].name);
    let whole = fs::read(&path).unwrap();
    let mut damaged = whole.clone();
    for byte in &mut damaged[whole.len() / 2..whole.len() / 2 + 64] {
        *byte ^= 0x5a;
    }
    fs::write(&path, &damaged).unwrap();
    let error = plant
        .fit("results", &FitSettings::default())
        .await
        .unwrap_err();
    let PlantError::Partitions { failed, partitions } = &error else {
        panic!("{error}");
    };
    assert_eq!((failed.len(), *partitions), (1, 6));
    assert_eq!(failed[0].0, part.to_string());
    assert!(error.to_string().contains(&part.to_string()));
    assert_eq!(count(&plant, "results").await, "|60|60|");
    fs::write(&path, &whole).unwrap();
    let resumed = FitSettings {
        resume: true,
        ..FitSettings::default()
    };
    let done = plant.fit("results", &resumed).await.unwrap();
    assert_eq!((done.rows, done.partitions, done.left), (12, 1, 5));
    assert_eq!(count(&plant, "results").await, "|72|72|");
}

/// One bit of one sample, in a file that can otherwise be read.
#[tokio::test(flavor = "multi_thread")]
async fn a_file_cut_short_or_gone_is_named() {
    let plant = Plant::simulated(&small()).await;
    let commits = plant.commits("data", "tightenings").await;
    let path = |index: usize| {
        let (_, commit): &(_, snug_plant::Commit) = &commits[index];
        plant.path("data").join(&commit.files[0].name)
    };
    let whole = fs::read(path(0)).unwrap();
    fs::write(path(0), &whole[..whole.len() / 2]).unwrap();
    fs::remove_file(path(4)).unwrap();
    let error = plant
        .fit("results", &FitSettings::default())
        .await
        .unwrap_err();
    let PlantError::Partitions { failed, .. } = &error else {
        panic!("{error}");
    };
    let named: Vec<&str> = failed.iter().map(|(part, _)| part.as_str()).collect();
    assert_eq!(named, [commits[0].0.to_string(), commits[4].0.to_string()]);
    assert_eq!(count(&plant, "results").await, "|48|48|");
}

#[tokio::test(flavor = "multi_thread")]
async fn files_that_no_marker_names_are_not_there() {
    let plant = Plant::simulated(&small()).await;
    plant.fit("results", &FitSettings::default()).await.unwrap();
    for (name, table) in [("data", "tightenings"), ("results", "results")] {
        let (part, commit) = plant.commits(name, table).await.remove(0);
        let own = plant.path(name).join(&commit.files[0].name);
        fs::copy(&own, own.with_file_name("left-by-a-killed-process.parquet")).unwrap();
        if table == "results" {
            fs::remove_file(plant.path(name).join(format!("commits/{part}.json"))).unwrap();
        }
    }
    assert_eq!(count(&plant, "tightenings").await, "|72|72|");
    assert_eq!(count(&plant, "results").await, "|60|60|");
    let resumed = FitSettings {
        resume: true,
        ..FitSettings::default()
    };
    let done = plant.fit("results", &resumed).await.unwrap();
    assert_eq!((done.partitions, done.left), (1, 5));
}

#[tokio::test]
async fn results_of_another_model_are_not_mixed() {
    let plant = Plant::simulated(&small()).await;
    plant.fit("results", &FitSettings::default()).await.unwrap();
    let other = FitSettings {
        effects: vec!["backlash".into()],
        ..FitSettings::default()
    };
    let error = plant.fit("results", &other).await.unwrap_err();
    assert!(error.to_string().contains("another model"), "{error}");
    let unknown = FitSettings {
        effects: vec!["phlogiston".into()],
        ..FitSettings::default()
    };
    let error = plant.fit("elsewhere", &unknown).await.unwrap_err();
    assert!(error.to_string().contains("phlogiston"), "{error}");
}
