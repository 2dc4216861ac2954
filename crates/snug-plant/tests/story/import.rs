//! Files come in once, and their fits have the bits that a run of the study gives them.

use crate::plant::Plant;
use snug_plant::{FitSettings, Naming, Tables, import, query};
use snug_study::{RunSettings, Study, run};
use std::path::Path;
use std::sync::atomic::AtomicBool;

fn embedded() -> Study {
    Study::on(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/campaign"))
}

fn naming() -> Naming {
    let naming = Naming::of_all(None, Some("2026-03-01".into()), None);
    naming.with_template("{tool}_{skip}").unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn the_same_files_twice_are_the_same_rows() {
    let plant = Plant::empty();
    let first = import(&embedded(), &naming(), plant.store("data"))
        .await
        .unwrap();
    assert!(first.rows > 0 && first.partitions > 1);
    let before = plant.commits("data", "tightenings").await;
    let again = import(&embedded(), &naming(), plant.store("data"))
        .await
        .unwrap();
    assert_eq!((again.rows, again.files, again.known), (0, 0, first.files));
    assert_eq!(plant.commits("data", "tightenings").await, before);
}

#[tokio::test(flavor = "multi_thread")]
async fn fits_have_the_bits_of_a_run() {
    let plant = Plant::empty();
    import(&embedded(), &naming(), plant.store("data"))
        .await
        .unwrap();
    plant.fit("results", &FitSettings::default()).await.unwrap();
    let settings = RunSettings::new(plant.path("out"));
    let never = AtomicBool::new(false);
    let outcome = run(&embedded(), &settings, &|_| (), &never).unwrap();
    let tables = Tables {
        results: Some(plant.store("results")),
        ..Tables::default()
    };
    let text = "SELECT file, number, mass_kg, stiffness_n_per_m_low, error_over_noise, selected FROM results";
    let answer = query(&tables, text).await.unwrap();
    let mut compared = 0;
    for batch in answer {
        use arrow::array::{Array, AsArray};
        use arrow::datatypes::{Float64Type, UInt32Type};
        let files = batch.column(0).as_string::<i32>();
        let numbers = batch.column(1).as_primitive::<UInt32Type>();
        let values: Vec<_> = (2..5)
            .map(|at| batch.column(at).as_primitive::<Float64Type>().clone())
            .collect();
        let selected = batch.column(5).as_boolean();
        for row in 0..batch.num_rows() {
            let is_same = |one: &&snug_campaign::TighteningResult| {
                one.id.file == files.value(row) && one.id.number == numbers.value(row)
            };
            let one = outcome.result.tightenings.iter().find(is_same).unwrap();
            let Some(estimate) = &one.estimate else {
                assert!(values[0].is_null(row));
                continue;
            };
            let bits = |at: usize| {
                values[at]
                    .is_valid(row)
                    .then(|| values[at].value(row).to_bits())
            };
            assert_eq!(bits(0), estimate.value("mass_kg").map(f64::to_bits));
            let low = estimate
                .parameter("stiffness_n_per_m")
                .unwrap()
                .interval
                .map(|one| one.low);
            assert_eq!(bits(1), low.map(f64::to_bits));
            assert_eq!(bits(2), one.measures.error_over_noise.map(f64::to_bits));
            assert_eq!(selected.value(row), one.selection.selected());
            compared += 1;
        }
    }
    assert!(compared > 10, "{compared}");
}

#[tokio::test]
async fn a_dataset_keeps_one_preparation() {
    let plant = Plant::empty();
    import(&embedded(), &naming(), plant.store("data"))
        .await
        .unwrap();
    let mut other = embedded();
    other.set_preset(snug_study::Preset::Thesis);
    let error = import(&other, &naming(), plant.store("data"))
        .await
        .unwrap_err();
    assert!(error.to_string().contains("another preparation"), "{error}");
}

#[tokio::test]
async fn queries_only_read() {
    let plant = Plant::empty();
    import(&embedded(), &naming(), plant.store("data"))
        .await
        .unwrap();
    let tables = Tables {
        data: Some(plant.store("data")),
        ..Tables::default()
    };
    for text in [
        "COPY tightenings TO '/tmp/x.csv'",
        "DROP TABLE tightenings",
        "SET a.b = 1",
    ] {
        assert!(query(&tables, text).await.is_err(), "{text}");
    }
    let answer = query(&tables, "SELECT count(*) FROM findings")
        .await
        .unwrap();
    assert_eq!(answer.len(), 1);
}
