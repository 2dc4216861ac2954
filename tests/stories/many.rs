//! Of more tightenings than are wanted the diagnosis takes some, says so, and judges the model by all.

use crate::coarse;
use snug_study::{RunSettings, Study, Verb, diagnose};
use snug_synthetic::CampaignPlan;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// A campaign of so many files with so many tightenings each.
fn campaign(folder: &Path, files: usize, each: usize) -> Study {
    coarse::study(CampaignPlan::of_size(files, each), 4, folder)
}

/// File and number in it of each that is taken.
fn taken(study: &Study, most: usize) -> Vec<(String, u32)> {
    let listing = snug_ingest::list(&study.source, &study.source.path).unwrap();
    let cases = snug_study::cases(study, &listing.files, most).unwrap();
    let ids = cases.into_iter().map(|case| case.tightening.id.clone());
    ids.map(|id| (id.file, id.number)).collect()
}

#[test]
fn tightenings_are_taken_from_all_over_the_campaign() {
    let folder = tempfile::tempdir().unwrap();
    let study = campaign(folder.path(), 12, 4);
    assert_eq!(taken(&study, usize::MAX).len(), 48);
    let some = taken(&study, 12);
    assert_eq!(some.len(), 12);
    let files: BTreeSet<&String> = some.iter().map(|(file, _)| file).collect();
    let numbers: BTreeSet<u32> = some.iter().map(|(_, number)| *number).collect();
    assert_eq!(files.len(), 6, "two of a file, so that a drift shows");
    assert_eq!(numbers.len(), 4, "late ones as well as early ones");
}

#[test]
fn files_of_one_tightening_each_fill_the_places_too() {
    let folder = tempfile::tempdir().unwrap();
    let study = campaign(folder.path(), 30, 1);
    let some = taken(&study, 20);
    let files: BTreeSet<&String> = some.iter().map(|(file, _)| file).collect();
    assert_eq!(files.len(), some.len());
    assert!((16..=20).contains(&some.len()), "{}", some.len());
}

#[test]
fn the_reasons_say_how_many_were_taken() {
    let folder = tempfile::tempdir().unwrap();
    let mut study = campaign(folder.path(), 12, 2);
    let settings = RunSettings::new(folder.path().join("out"));
    let mut compare = |most| {
        study.diagnosis.most_tightenings = most;
        let never = AtomicBool::new(false);
        let outcome = diagnose(&study, &Verb::Compare, &settings, &|_| (), &never).unwrap();
        let all = outcome.result.tightenings.len();
        (outcome.result.diagnosis.unwrap(), all)
    };
    let (some, all) = compare(8);
    assert_eq!((some.tightenings, all), (8, 24));
    let told = some.reasons.iter();
    let told: Vec<_> = told
        .filter(|one| {
            one.to_string()
                .contains("learnt from 8, taken evenly from 4 of the 12 files")
        })
        .collect();
    assert_eq!(told.len(), 1, "{:?}", some.reasons);
    let (every, _) = compare(240);
    assert!(
        every
            .reasons
            .iter()
            .all(|one| !one.to_string().contains("learnt from"))
    );
}
