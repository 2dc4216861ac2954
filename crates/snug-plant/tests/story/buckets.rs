//! Datasets in the buckets of a store that is busy, slow, or does not answer: all rows once, or exactly those named that are not there.

use crate::cluster::Cluster;
use crate::plant::{Plant, small};
use crate::store::{Answer, Said, StoreServer};
use hyper::Method;
use snug_plant::{FitSettings, Partition};
use std::time::Duration;

/// Longest that a fit may take of which one partition's requests are not answered: each of them is given up after seven times 1 s and
/// the waits between them, the partition is tried twice, and what it takes to start and to be busy with other tests.
const BOUNDED: Duration = Duration::from_secs(90);

const FIT: [&str; 5] = [
    "fit",
    "--data",
    "s3://data/",
    "--to",
    "s3://results/of/today",
];

/// A plant that is fitted in folders, and the store over these.
async fn plant() -> (Plant, StoreServer) {
    let plant = Plant::simulated(&small()).await;
    plant.fit("truth", &FitSettings::default()).await.unwrap();
    let server = StoreServer::over(&plant, &["data", "results"]).await;
    (plant, server)
}

async fn assert_whole(plant: &Plant, but: &[&Partition]) {
    let mut expected = plant.digests("truth").await;
    expected.retain(|(part, _)| !but.contains(&part));
    assert_eq!(plant.digests("results/of/today").await, expected);
}

async fn assert_resumed(plant: &Plant, server: &StoreServer, done: usize, left: usize) {
    server.answers(|_, _, _| Answer::Right);
    let said = server.program(&[&FIT[..], &["--resume"]].concat()).await;
    let expected = format!(
        "{} tightenings of {done} partitions have results now; {left} partitions were left as they are\n",
        12 * done
    );
    assert_eq!(said.output, expected, "{said:?}");
    assert_whole(plant, &[]).await;
}

fn assert_named(said: &Said, named: &[&Partition]) {
    assert_eq!(said.code, Some(1), "{said:?}");
    let count = format!("{} of 6 partitions failed", named.len());
    assert!(said.error.contains(&count), "{said:?}");
    for part in named {
        assert!(said.error.contains(&format!("\n  {part}: ")), "{said:?}");
    }
    assert!(said.took < BOUNDED, "{said:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_store_that_is_busy_or_slow_costs_no_row() {
    let (plant, server) = plant().await;
    server.answers(|number, _, _| match number % 6 {
        1 | 2 => Answer::Busy,
        4 => Answer::Late(Duration::from_millis(300)),
        // Beyond the time that a request may take.
        5 if number % 24 == 5 => Answer::Late(Duration::from_millis(1500)),
        _ => Answer::Right,
    });
    let said = server.program(&FIT).await;
    assert_eq!(said.code, Some(0), "{said:?}");
    assert!(server.asked() > 50, "{}", server.asked());
    assert_whole(&plant, &[]).await;
    let ask = "SELECT count(*) AS n, count(DISTINCT key) AS keys FROM results";
    let said = server
        .program(&["sql", "--results", "s3://results/of/today", ask])
        .await;
    let counted = said.output.replace(' ', "");
    assert!(counted.contains("|72|72|"), "{said:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_partition_that_cannot_be_read_is_named_in_bounded_time() {
    let (plant, server) = plant().await;
    let lost = Partition::new("2026-03-02", "T0003").unwrap();
    let folder = format!("/tightenings/{lost}/");
    server.answers(move |_, _, path| match path.contains(&folder) {
        true => Answer::Never,
        false => Answer::Right,
    });
    let said = server.program(&FIT).await;
    assert_named(&said, &[&lost]);
    assert_whole(&plant, &[&lost]).await;
    assert_resumed(&plant, &server, 1, 5).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn results_that_cannot_be_written_are_named_and_never_read() {
    let (plant, server) = plant().await;
    let [rows, marker] = ["T0001", "T0002"].map(|tool| Partition::new("2026-03-01", tool).unwrap());
    let lost = [
        format!("/results/{rows}/"),
        format!("/commits/{marker}.json"),
    ];
    server.answers(move |_, method, path| {
        let concerned = lost.iter().any(|lost| path.contains(lost));
        match *method == Method::PUT && concerned {
            true => Answer::Busy,
            false => Answer::Right,
        }
    });
    let said = server.program(&FIT).await;
    assert_named(&said, &[&rows, &marker]);
    assert_whole(&plant, &[&rows, &marker]).await;
    assert_resumed(&plant, &server, 2, 4).await;
}

/// Nothing is waited for once and again for every partition: the store is gone.
#[tokio::test(flavor = "multi_thread")]
async fn a_store_that_is_gone_is_not_asked_for_every_partition() {
    let (plant, server) = plant().await;
    server.answers(|_, _, path| match path.contains("/tightenings/") {
        true => Answer::Never,
        false => Answer::Right,
    });
    let said = server
        .program(&[&FIT[..], &["--give-up-after", "5"]].concat())
        .await;
    let parts = plant.commits("data", "tightenings").await;
    let named: Vec<&Partition> = parts.iter().map(|(part, _)| part).collect();
    assert_named(&said, &named);
    assert_eq!(said.error.matches("not tried: ").count(), 3, "{said:?}");
    assert_resumed(&plant, &server, 6, 0).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn workers_read_buckets_by_themselves() {
    let (plant, server) = plant().await;
    server.answers(|number, _, _| match number % 5 {
        3 => Answer::Busy,
        _ => Answer::Right,
    });
    let cluster = Cluster::start_in(server.environment(), &[]);
    let _workers = (cluster.worker(), cluster.worker());
    let address = cluster.address();
    let said = server
        .program(&[&FIT[..], &["--cluster", &address, "--parts", "4"]].concat())
        .await;
    assert_eq!(said.code, Some(0), "{said:?}");
    assert_whole(&plant, &[]).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_bucket_without_a_name_or_with_credentials_in_its_url_is_refused() {
    let plant = Plant::empty();
    let server = StoreServer::over(&plant, &[]).await;
    for (url, why) in [
        ("s3:///data", "names no bucket"),
        (
            "s3://key:secret@data/",
            "credentials come from the environment",
        ),
        ("ftp://data/", "known are folders, file:// and s3://"),
    ] {
        let said = server.program(&["fit", "--data", url, "--to", "x"]).await;
        assert_eq!(said.code, Some(2), "{said:?}");
        assert!(said.error.contains(why), "{said:?}");
    }
}
