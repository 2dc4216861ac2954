//! An effect that comes over three tools of twelve is found, named and dated; where nothing happens, nothing is told.

use crate::plant::Plant;
use snug_plant::{FitSettings, Simulation, WatchSettings, Watched, watch};

async fn watched(simulation: &Simulation, effects: &[&str]) -> (Plant, Watched) {
    let plant = Plant::simulated(simulation).await;
    let settings = FitSettings {
        effects: effects.iter().map(|&name| name.to_owned()).collect(),
        ..FitSettings::default()
    };
    plant.fit("results", &settings).await.unwrap();
    let told = watch(&WatchSettings {
        results: plant.store("results"),
        data: Some(plant.store("data")),
        to: plant.store("watch"),
    })
    .await
    .unwrap();
    (plant, told)
}

fn plant(effect: Option<&str>) -> Simulation {
    Simulation {
        tools: 12,
        days: 11,
        per_day: 5,
        effect: effect.map(str::to_owned),
        strength: 0.5,
        in_tools: vec![3, 7, 10],
        from_day: 7,
        sample_rate_hz: 2000.0,
        ..Simulation::default()
    }
}

fn assert_found(told: &Watched, effect: &str) {
    let mut found: Vec<(&str, Option<&str>, Option<&str>)> = (told.tools.iter())
        .map(|one| {
            (
                one.name.as_str(),
                one.since.as_deref(),
                one.effect.as_deref(),
            )
        })
        .collect();
    found.sort_unstable();
    let expected = ["T0003", "T0007", "T0010"].map(|tool| (tool, Some("2026-03-07"), Some(effect)));
    assert_eq!(found, expected);
    assert_eq!(told.quiet_tools, 9);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_gap_that_came_is_found_named_and_dated() {
    let (plant, told) = watched(&plant(Some("backlash")), &["backlash", "coulomb_friction"]).await;
    assert_found(&told, "backlash");
    let page = std::fs::read_to_string(plant.path("watch").join("watch.html")).unwrap();
    assert!(page.contains("T0007: backlash since 2026-03-07"));
    assert!(page.contains("One tightening: T00"));
}

#[tokio::test(flavor = "multi_thread")]
async fn friction_that_came_is_found_named_and_dated() {
    let simulation = plant(Some("coulomb_friction"));
    let (_, told) = watched(&simulation, &["backlash", "coulomb_friction"]).await;
    assert_found(&told, "coulomb_friction");
}

#[tokio::test(flavor = "multi_thread")]
async fn where_nothing_happens_nothing_is_told() {
    let (_, told) = watched(&plant(None), &["backlash"]).await;
    assert_eq!(told.tools, []);
    assert_eq!(told.quiet_tools, 12);
}
