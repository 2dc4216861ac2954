//! A run killed at any moment.

use crate::program::{differing, ended, expected, fixture, partials, results, snug, text};
use rand::{Rng, SeedableRng, rngs::StdRng};
use std::time::{Duration, Instant};

/// How often a run is killed; more with `cargo xtask test --many`.
const KILLS: [u32; 2] = [40, 100];

#[test]
fn kills_leave_old_results_or_new_ones_and_recordings_that_can_be_recovered() {
    let out = tempfile::tempdir().unwrap();
    let data = [fixture("mystery"), fixture("campaign")];
    let wanted = [expected(&data[0]), expected(&data[1])];
    let words = |which: usize| {
        [
            "run",
            "--data",
            text(&data[which]),
            "--out",
            text(out.path()),
            "--quiet",
        ]
    };
    let kills = KILLS[usize::from(std::env::var_os("SNUG_MANY").is_some())];
    let started = Instant::now();
    assert_eq!(ended(&mut snug(&words(0))).0, 0);
    let whole = started.elapsed();
    let mut random = StdRng::seed_from_u64(19);
    let (mut standing, mut survived, mut recovered) = (0, 0, 0);
    for kill in 0..kills {
        let next = 1 - standing;
        let mut child = snug(&words(next)).spawn().unwrap();
        // Half of them at the end, where the results are exchanged.
        let share = match kill % 2 {
            0 => random.random_range(0.0..1.0),
            _ => random.random_range(0.8..1.2),
        };
        std::thread::sleep(whole.mul_f64(share));
        child.kill().unwrap();
        let ended_by_itself = child.wait().unwrap().success();
        survived += u32::from(ended_by_itself);
        // A kill among the renames is made good by whoever takes the folder next.
        if out.path().join(".snug-exchange").exists() {
            assert_eq!(ended(&mut snug(&words(next))).0, 0);
        }
        let left = results(out.path());
        if left == wanted[next] {
            standing = next;
        } else {
            let differ = differing(&left, &wanted[standing]);
            assert!(differ.is_empty(), "kill {kill} at {share:.3}: {differ:?}");
            assert!(!ended_by_itself);
        }
        for partial in partials(out.path()) {
            recovers(&partial);
            recovered += 1;
            for path in partials(out.path()) {
                std::fs::remove_file(path).unwrap();
            }
        }
    }
    println!("{kills} kills: {survived} came too late, {recovered} recordings recovered");
    assert!(recovered > kills / 4, "{recovered} recordings");
    assert!(survived < kills);
    assert_eq!(
        ended(&mut snug(&words(1 - standing))).0,
        0,
        "and the folder is free"
    );
    assert!(started.elapsed() < Duration::from_secs(900));
}

/// The recording has an index afterwards, and every message that was whole before.
fn recovers(partial: &std::path::Path) {
    let before = std::fs::read(partial).unwrap();
    let was_cut = mcap::Summary::read(&before).ok().flatten().is_none();
    let (code, said) = ended(&mut snug(&["recover", text(partial)]));
    assert_eq!(code, 0, "{said}");
    let after = std::fs::read(partial).unwrap();
    let summary = mcap::Summary::read(&after)
        .unwrap()
        .expect("there is an index");
    let messages = mcap::MessageStream::new(&after)
        .unwrap()
        .map(Result::unwrap)
        .count();
    let counted = summary.stats.expect("the index counts").message_count;
    assert_eq!(counted, messages as u64);
    assert_eq!(was_cut, before != after, "{said}");
    assert_eq!(
        said.contains("the recording is complete"),
        !was_cut,
        "{said}"
    );
}
